#include "commands/options.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "commands/help.hpp"
#include "input/camera_source.hpp"
#include "input/convention_names.hpp"
#include "input/points.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "text/parse_number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

/// The value of a name of a table, or a UsageError.
template <class Table>
auto choose(const std::string& option, const std::string& name, const Table& table) {
  std::vector<std::string_view> known;
  for (const auto& [row, value] : table) {
    if (row == name) return value;
    known.push_back(row);
  }
  failUnknown(option, name, known);
}

constexpr std::size_t kMostJobs = 1024;

/// From 1 to most, or a UsageError.
std::size_t wholeNumber(const std::string& option, const std::string& text, std::size_t most) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end != text.data() + text.size() || error != std::errc() || number < 1 || number > most)
    throw UsageError(option + " " + text + ": expected a whole number from 1 to " + std::to_string(most));
  return number;
}

}  // namespace

void failUnknown(const std::string& option, std::string_view name, std::span<const std::string_view> known) {
  throw UsageError(option + ": '" + std::string(name) + "' is not known" + suggestion(name, known));
}

void requireKnown(const std::string& option, std::string_view name, std::span<const std::string_view> known) {
  if (std::find(known.begin(), known.end(), name) == known.end()) failUnknown(option, name, known);
}

std::vector<double> readNumbers(const std::string& option, const std::string& text, std::size_t fewest,
                                std::size_t most, const std::string& form) {
  auto numbers = parseNumberList(text);
  if (!numbers || numbers->size() < fewest || numbers->size() > most)
    throw UsageError(option + " " + text + ": expected " + form);
  return std::move(*numbers);
}

GivenPoint readPointOption(const std::string& text) {
  constexpr const char* kForms = "X,Y,Z or X,Y,Z,W, x=X,y=Y,z=Z or lat=LAT,lon=LON,height=HEIGHT";
  GivenPoint point{text, {}, text.find('=') != std::string::npos};
  if (!point.named) {
    const std::vector<double> numbers = readNumbers("--point", text, 3, 4, kForms);
    for (std::size_t i = 0; i < numbers.size(); ++i) point.numbers.emplace_back(coordinates::kXyzw[i].name, numbers[i]);
    return point;
  }
  const UsageError wrong("--point " + text + ": expected " + kForms);
  const std::vector<std::string> parts = splitNames("--point", text);
  for (const Coordinate* row : kPointRows) {
    for (std::size_t i = 0; i < row->parts.size(); ++i) {
      const std::string name(row->parts[i].name);
      const auto part =
          std::find_if(parts.begin(), parts.end(), [&](const std::string& one) { return one.starts_with(name + "="); });
      if (part == parts.end() && i < row->fewest) break;
      if (part == parts.end()) continue;
      const auto number = parseNumber(part->substr(name.size() + 1));
      if (!number) throw UsageError("--point " + text + ": " + name + " is no number");
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
  if (!named && worldIsEcef && numbers.size() == 3)
    throw UsageError("--point " + text + ": " + bareTriple("lat=LAT,lon=LON,height=HEIGHT or x=X,y=Y,z=Z"));
  if (numbers[0].first == "lat" && !worldIsEcef)
    throw UsageError("--point " + text + ": a place needs a camera that stands on the Earth");
}

Vec4 GivenPoint::point() const {
  if (numbers[0].first == "lat") {
    const Geodetic place{numbers[0].second, numbers[1].second, numbers[2].second};
    if (!isPlace(place)) throw UsageError("--point " + text + ": lat is not from -90 to 90 degrees");
    const Vec3 p = geodeticToEcef(place);
    return {p.x, p.y, p.z, 1};
  }
  return {numbers[0].second, numbers[1].second, numbers[2].second, numbers.size() > 3 ? numbers[3].second : 1};
}

std::vector<double> readPixelOption(const std::string& text) {
  return readNumbers("--pixel", text, 2, 3, "X,Y or X,Y,DEPTH");
}

Heading::Heading(CLI::App& app, const std::string& name) : app_(app) { app.option_defaults()->group(name); }
// NOLINTNEXTLINE(bugprone-exception-escape): where no memory is left, the program has ended
Heading::~Heading() { app_.option_defaults()->group(kOwnOptions); }

CLI::Option* addRepeatable(CLI::App& app, const std::string& name, std::vector<std::string>& values,
                           const std::string& description) {
  return app.add_option(name, values, description + "; repeatable")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void addModel(CLI::App& app, std::string& model, const std::string& what) {
  app.add_option("--model", model,
                 "Where the model of the " + what +
                     " stands in the world: 4 rows of a matrix, or a glTF node's translation, rotation and scale; a "
                     "file or the JSON itself (default: " +
                     what + " in world coordinates)")
      ->type_name("FILE");
}

std::vector<std::string> splitNames(const std::string& option, const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    names.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  std::unordered_set<std::string_view> seen;
  for (const std::string& name : names)
    if (!seen.insert(name).second) throw UsageError(option + ": " + name + " is named twice");
  return names;
}

void CameraOptions::add(CLI::App& app) {
  const Heading heading(app, "Camera");
  app.add_option("-c,--camera", camera_,
                 "Camera file, or the JSON itself; also glTF, transforms.json, three.js, an OpenCV calibration or "
                 "matrices. #NAME picks one of several cameras")
      ->type_name("FILE[#NAME]");
  app.add_flag("--list", list_, "Name the cameras that the camera file holds, and do nothing else");
  app.add_option("--viewport", viewport_, "Viewport size in pixels, as in 1920x1080 (default: the file's)")
      ->type_name("WxH");
  addRepeatable(app, "--set", set_, "Set a field of the camera file, as in projection.fovY=75")
      ->type_name("FIELD=VALUE");
  app.add_option("--read-as", readAs_, "Read the camera in this convention (default: the file's, or opengl)")
      ->type_name("NAME");
  app.add_flag("--allow-stretch", allowStretch_, "Let the camera's shape differ from the viewport's");
  app.add_flag("--ignore-distortion", ignoreDistortion_, "Take a lens that distorts as one that does not");
}

void CameraOptions::addWriting(CLI::App& app) {
  const Heading heading(app, "Convention written");
  app.add_option("--convention", convention_,
                 "Write in this convention, in place of the one that was read: " + joined(presetNames()))
      ->type_name("NAME");
  reverseZGiven_ = app.add_flag("--reverse-z,!--no-reverse-z", reverseZ_,
                                "Write depth with near and far exchanged, or not (default: as the convention has it)");
  app.add_option("--ndc-z", ndcZ_, "Write this range of NDC z: -1..1 or 0..1 (default: the convention's)")
      ->type_name("RANGE");
}

void CameraOptions::addFile(CLI::App& app) {
  takesFile_ = true;
  app.add_option("FILE", file_, "Camera file, where -c was not given; absent or - for standard input");
}

CameraFile CameraOptions::read() const {
  if (!camera_.empty() && !file_.empty())
    throw UsageError("-c gives the camera already; leave out one of it and " + file_);
  if (camera_.empty() && !takesFile_) throw UsageError("-c FILE is needed: the camera");
  const std::string from = !camera_.empty() ? camera_ : !file_.empty() ? file_ : "-";
  const CameraSource picked = splitPick(from);
  Document document(picked.file, camera_.empty() ? "FILE" : "--camera");
  if (!viewport_.empty()) {
    const std::size_t x = std::min(viewport_.find_first_of("xX"), viewport_.size() - 1);
    const auto width = parseNumber(viewport_.substr(0, x));
    const auto height = parseNumber(viewport_.substr(x + 1));
    if (!width || !height || !(*width > 0 && *height > 0))
      throw UsageError("--viewport " + viewport_ + ": expected WIDTHxHEIGHT, as in 1920x1080");
    if (document.root().contains("viewport") && !document.root()["viewport"].is_object()) document.set("viewport=null");
    document.set("viewport.width=" + formatNumber(*width));
    document.set("viewport.height=" + formatNumber(*height));
  }
  for (const std::string& assignment : set_) document.set(assignment);
  if (!readAs_.empty() && !conventionPreset(readAs_)) failUnknown("--read-as", readAs_, presetNames());
  if (list_) {
    writeOutput(listCameras(document));
    throw HelpGiven{};
  }
  return readAnyCamera(document, picked.pick, {readAs_, allowStretch_, ignoreDistortion_});
}

bool CameraOptions::fromStandardInput() const { return splitPick(camera_).file == "-"; }

Convention CameraOptions::writing(const CameraFile& file) const {
  Convention c = file.convention;
  if (!convention_.empty()) {
    const auto preset = conventionPreset(convention_);
    if (!preset) failUnknown("--convention", convention_, presetNames());
    c = *preset;
    c.world = file.convention.world;
  }
  if (reverseZGiven_ && reverseZGiven_->count() > 0) c.reverseZ = reverseZ_;
  if (!ndcZ_.empty()) c.ndcZ = choose("--ndc-z", ndcZ_, kNdcZNames);
  return c;
}

void StreamOptions::addInput(CLI::App& app, const std::string& what) {
  const Heading heading(app, "Input");
  app.add_option("FILE", file_, "The " + what + "; absent or - for standard input");
  app.add_option("--from", from_, "Form of FILE: json, csv, text, f64 (default: as its name and first bytes tell)")
      ->type_name("FORM");
  const bool pixels = what == "pixels";
  app.add_option("--columns", columns_,
                 std::string("Columns of CSV, fields of JSON or numbers of a line that hold the coordinates, as in ") +
                     (pixels ? "u,v or 1,2 or x=u,y=v,depth=d" : "E,N,U or 2,3,4 or lat=la,lon=lo,height=h") +
                     " (default: by their names)")
      ->type_name("COLUMNS");
}

void StreamOptions::add(CLI::App& app, const std::string& what) {
  addInput(app, what);
  const Heading heading(app, "Output");
  app.add_option("--to", to_, "Form of the output: ndjson, json, csv, text, f64, table (default: as the input)")
      ->type_name("FORM");
  app.add_option("--prefix", prefix_, "Put this in front of the results' names")->type_name("P");
  app.add_flag("--keep-going", keepGoing_, "Put an error record in a bad record's place and go on");
  app.add_option("--jobs", jobs_, "Threads to work with (default: one a processor)")->type_name("N");
  app.add_flag("--no-header", noHeader_, "CSV: write no header line");
  app.add_option("--first-line", firstLine_,
                 "Number of the input's first line in messages, where it is a part of a file (default: 1)")
      ->type_name("N");
}

FilterSetup StreamOptions::setup(const ChoosableColumns& choosable) const {
  static constexpr NameRow<Form> kFrom[] = {
      {"json", Form::json}, {"csv", Form::csv}, {"text", Form::text}, {"f64", Form::f64}};
  static constexpr NameRow<OutputForm> kTo[] = {{"ndjson", OutputForm::lines}, {"json", OutputForm::array},
                                                {"csv", OutputForm::csv},      {"text", OutputForm::text},
                                                {"f64", OutputForm::f64},      {"table", OutputForm::table}};
  FilterSetup setup;
  if (!file_.empty()) setup.file = file_;
  const bool plain = std::all_of(prefix_.begin(), prefix_.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == ':';
  });
  if (!plain) throw UsageError("--prefix " + prefix_ + ": expected letters, digits or any of _ - . :");
  if (!from_.empty()) setup.from = choose("--from", from_, kFrom);
  if (!to_.empty()) setup.to = choose("--to", to_, kTo);
  setup.keepGoing = keepGoing_;
  setup.writer.header = !noHeader_;
  if (!jobs_.empty()) setup.jobs = static_cast<unsigned>(wholeNumber("--jobs", jobs_, kMostJobs));
  if (!firstLine_.empty()) setup.firstLine = wholeNumber("--first-line", firstLine_, 1ull << 53);
  setup.writer.prefix = prefix_;
  if (!columns_.empty()) {
    setup.columns = chooseColumns(columns_, choosable);
    setup.csvDefaults = setup.writer.numberNames = setup.columns.columnNames();
    return setup;
  }
  for (const auto& rows : {choosable.rows.first(1), choosable.others})
    for (const Coordinate* row : rows)
      for (const CoordinatePart& part : row->parts) setup.csvDefaults.emplace_back(part.name);
  return setup;
}

void StreamOptions::settleOnEarth(FilterSetup& setup, bool worldIsEcef) {
  if (!worldIsEcef) return;
  const ColumnChoice& columns = setup.columns;
  if (columns.given() && !columns.saysWhat) {
    std::string place, ecef;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string end = "=" + columns.picks[i].name + (i < 2 ? "," : "");
      place += std::string(coordinates::kPlace[i].name) + end;
      ecef += std::string(coordinates::kXyzw[i].name) + end;
    }
    throw UsageError("--columns " + columns.text + ": " + bareTriple(place + " or " + ecef));
  }
  if (!columns.given()) setup.writer.numberNames = setup.csvDefaults;
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

void StreamOptions::requireOneInput(const FilterSetup& setup, const CameraOptions& camera,
                                    const NamedInput& other) const {
  if (!setup.given.empty()) {
    const std::string& given = setup.given.front().option;
    if (!file_.empty()) throw UsageError(given + " takes the place of FILE; leave out one of it and " + file_);
    requireNoInputOption(given.substr(0, given.find(' ')) + " takes the place of");
  }
  requireOneStandardInput(
      {{"the camera", camera.fromStandardInput()}, other, {"the records", setup.given.empty() && setup.file == "-"}});
}

void StreamOptions::requireNoInputOption(const std::string& why) const {
  for (const auto& [name, value] :
       {std::pair("--from", &from_), {"--columns", &columns_}, {"--first-line", &firstLine_}})
    if (!value->empty()) throw UsageError(std::string(name) + " is for FILE, which " + why);
}

void ToleranceOption::add(CLI::App& app) {
  app.add_option("--tolerance", text_, "Pixels that auto stays within, on screen x and y (default: 1e-6)")
      ->type_name("PX");
}

double ToleranceOption::value() const {
  if (!given()) return kDefaultTolerance;
  const auto tolerance = parseNumber(text_);
  if (!tolerance || !(*tolerance >= 0))
    throw UsageError("--tolerance " + text_ + ": expected pixels, a number not below 0");
  return *tolerance;
}

void PrecisionOption::add(CLI::App& app) {
  app.add_option("--precision", name_,
                 "Arithmetic: exact, standard (double), fast (float32), or auto, the cheapest that will do (default: "
                 "exact)")
      ->type_name("MODE");
}

std::optional<Precision> PrecisionOption::value() const {
  static constexpr NameRow<std::optional<Precision>> kModes[] = {{"exact", Precision::exact},
                                                                 {"standard", Precision::standard},
                                                                 {"fast", Precision::fast},
                                                                 {"auto", std::nullopt}};
  return choose("--precision", name_, kModes);
}

}  // namespace viewproj::cmd
