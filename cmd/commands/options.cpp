#include "commands/options.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "output/output_file.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

CLI::Option* addModel(CLI::App& app, std::optional<std::string>& model, const std::string& help) {
  return addValue(app, "--model", "FILE", model, readFileName,
                  help + ": 4 rows of a matrix, or {translation, rotation, scale}; a file, or its JSON");
}

CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help) {
  return addValue(app, "--scene", "FILE", scene, readFileName, help + ": a scene file, or its JSON");
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

void ReportOptions::add(CLI::App& app, int tableDigits) {
  static constexpr FormRow<ReportForm> kForms[] = {
      {"table", ReportForm::table, ".txt"}, {"json", ReportForm::json, ".json"}, {"csv", ReportForm::csv, ".csv"}};
  addForm(app, form_, std::span<const FormRow<ReportForm>>(kForms), "Output format");
  addDigits(app, digits_, "all in JSON and CSV, " + std::to_string(tableDigits) + " in a table");
  tableDigits_ = tableDigits;
}

void ReportOptions::write(const OrderedJson& report, const char* rows) const {
  const int usual = form_ == ReportForm::table ? tableDigits_ : 0, digits = static_cast<int>(digits_.value_or(usual));
  if (form_ == ReportForm::table)
    writeOutput(tableText(report, digits));
  else if (form_ == ReportForm::json)
    writeOutput(jsonText(report, digits) + "\n");
  else
    writeOutput(csvText(*rows ? report.at(rows) : report, digits));
}

}  // namespace viewproj::cmd
