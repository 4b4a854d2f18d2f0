#include "commands/options.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "output/output_file.hpp"
#include "records/points.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

void addModel(CLI::App& app, std::optional<std::string>& model, const std::string& help) {
  addValue(app, "--model", "FILE", model, readFileName,
           help + ": 4 rows of a matrix, or {translation, rotation, scale}; a file or the JSON itself");
}

CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help) {
  return addValue(app, "--scene", "FILE", scene, readFileName, "Scene file, or the JSON itself: " + help);
}

void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise) {
  addValue(app, "--digits", "N", digits, wholeNumber(1, kMostDigits),
           "Significant digits, 1 to " + std::to_string(kMostDigits) + " (default: " + otherwise + ")");
}

void addPrecision(CLI::App& app, Precision& precision) {
  static constexpr std::pair<std::string_view, Precision> kNames[] = {{"exact", Precision::exact},
                                                                      {"standard", Precision::standard}};
  addChoice(app, "--precision", "MODE", precision, rowsOf(kNames), "Arithmetic");
}

void requireOneStandardInput(std::initializer_list<NamedInput> inputs) {
  const NamedInput* first = nullptr;
  for (const NamedInput& input : inputs) {
    if (!input.isStandard) continue;
    if (first)
      throw UsageError(std::string(first->what) + " and " + input.what + " cannot both come from standard input");
    first = &input;
  }
}

GivenPoint readGivenPoint(const std::string& option, const std::string& text) {
  constexpr const char* kForms = "X,Y,Z or X,Y,Z,W, x=X,y=Y,z=Z or lat=LAT,lon=LON,height=HEIGHT";
  GivenPoint point{option + " " + text, {}, text.find('=') != std::string::npos};
  if (!point.named) {
    const std::vector<double> numbers = readNumbers(option, text, 3, 4, kForms);
    for (std::size_t i = 0; i < numbers.size(); ++i) point.numbers.emplace_back(coordinates::kXyzw[i].name, numbers[i]);
    return point;
  }
  const UsageError wrong(point.text + ": expected " + kForms);
  const std::vector<std::string> parts = splitNames(option, text);
  for (const Coordinate* row : kPointRows) {
    for (std::size_t i = 0; i < row->fewest; ++i) {
      const std::string name(row->parts[i].name);
      const auto part =
          std::find_if(parts.begin(), parts.end(), [&](const std::string& one) { return one.starts_with(name + "="); });
      if (part == parts.end()) break;
      const auto number = parseNumber(part->substr(name.size() + 1));
      if (!number) throw UsageError(point.text + ": " + name + " is no number");
      point.numbers.emplace_back(name, *number);
    }
    if (point.numbers.empty()) continue;
    if (point.numbers.size() < row->fewest || point.numbers.size() != parts.size()) throw wrong;
    return point;
  }
  throw wrong;
}

std::string GivenPoint::json() const {
  std::string json;
  for (const auto& [name, number] : numbers)
    json += (json.empty() ? "" : ",") + (named ? "\"" + name + "\":" : "") + formatNumber(number);
  return named ? "{" + json + "}" : "[" + json + "]";
}

void GivenPoint::requireFit(bool worldIsEcef) const {
  if (!named && numbers.size() == 3 && worldIsEcef)
    throw UsageError(text + ": " + bareTriple("lat=LAT,lon=LON,height=HEIGHT or x=X,y=Y,z=Z"));
  if (numbers[0].first == "lat" && !worldIsEcef)
    throw UsageError(text + ": a place needs a camera that stands on the Earth");
}

Vec4 GivenPoint::point() const {
  if (numbers[0].first == "lat") {
    const Geodetic place{numbers[0].second, numbers[1].second, numbers[2].second};
    if (!isPlace(place)) throw UsageError(text + ": lat is not from -90 to 90 degrees");
    const Vec3 p = geodeticToEcef(place);
    return {p.x, p.y, p.z, 1};
  }
  return {numbers[0].second, numbers[1].second, numbers[2].second, numbers.size() > 3 ? numbers[3].second : 1};
}

void ReportOptions::add(CLI::App& app, int tableDigits) {
  static constexpr FormRow<ReportForm> kForms[] = {
      {"table", ReportForm::table, ".txt"}, {"json", ReportForm::json, ".json"}, {"csv", ReportForm::csv, ".csv"}};
  addForm(app, form_, std::span<const FormRow<ReportForm>>(kForms), "Output format");
  addDigits(app, digits_, "all in JSON and CSV, " + std::to_string(tableDigits) + " in a table");
  tableDigits_ = tableDigits;
}

int ReportOptions::digits() const {
  return digits_ ? static_cast<int>(*digits_) : form_ == ReportForm::table ? tableDigits_ : 0;
}

void ReportOptions::write(const OrderedJson& report, const char* rows) const {
  if (form_ == ReportForm::table)
    writeOutput(tableText(report, digits()));
  else if (form_ == ReportForm::json)
    writeOutput(jsonText(report, digits()) + "\n");
  else
    writeOutput(csvText(*rows ? report.at(rows) : report, digits()));
}

}  // namespace viewproj::cmd
