#include "commands/options.hpp"

#include <algorithm>
#include <cctype>
#include <memory>

#include "commands/output_option.hpp"
#include "input/camera_fields.hpp"
#include "input/convention_names.hpp"
#include "input/points.hpp"
#include "input/typed_value.hpp"
#include "output/camera_text.hpp"
#include "output/output_file.hpp"
#include "text/csv_format.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "text/parse_number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

Names<ConventionPreset> presets() {
  Names<ConventionPreset> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset);
  return names;
}

/// What may stand between fields and be none of a number, a name or a quote.
bool isPunctuation(char c) { return std::string_view("!#$%&()*/:;<=>?@[\\]^`{|}~,").find(c) != std::string_view::npos; }

char readDelimiter(const std::string& option, const std::string& text) {
  for (const SeparatorName& one : kSeparators)
    if (text == one.name || text == one.plural || text == std::string(1, one.separator)) return one.separator;
  if (text == "\\t") return '\t';
  if (text.size() == 1 && isPunctuation(text[0])) return text[0];
  std::vector<std::string_view> names;
  for (const SeparatorName& one : kSeparators) names.push_back(one.name);
  throw UsageError(option + " " + visible(text) + ": expected " + alternatives(names) + " or a character as ;");
}

constexpr std::size_t kMostJobs = 1024;
constexpr std::size_t kMostLines = 1ull << 53;

}  // namespace

Names<Convention> presetConventions() {
  Names<Convention> names;
  for (const ConventionPreset& preset : conventionPresets()) names.emplace_back(preset.name, preset.convention);
  return names;
}

void addModelOption(CLI::App& app, std::optional<std::string>& model, const std::string& what,
                    const std::string& effect) {
  addValue(
      app, "--model", "FILE", model, readFileName,
      "Where the model of the " + what +
          " stands in the world: 4 rows of a matrix, or a glTF node's translation, rotation and scale; a file or "
          "the JSON itself" +
          (effect.empty() ? "; world coordinates are rounded to doubles (default: " + what + " in world coordinates)"
                          : "; " + effect));
}

void addSceneOption(CLI::App& app, std::optional<std::string>& scene, const std::string& help) {
  addValue(app, "--scene", "FILE", scene, readFileName, "Scene file, or the JSON itself" + help);
}

void CameraOptions::add(CLI::App& app) {
  notes_.add(app);
  const Heading heading(app, "Camera");
  addValue(app, "-c,--camera", "FILE[#NAME]", camera_, readFileName,
           "Camera file, or the JSON itself; also glTF, transforms.json, three.js, an OpenCV calibration or "
           "matrices. #NAME picks one of several cameras");
  app.add_flag("--list", list_, "Name the cameras that the camera file holds, and do nothing else");
  addValue(app, "--viewport", "WxH", viewport_, readSize,
           "Viewport size in pixels, as in 1920x1080 (default: the file's)");
  addValues(
      app, "--set", "FIELD=VALUE", set_,
      [](const std::string&, const std::string& text) { return readAssignment(text); },
      "Set a field of the camera file, as in projection.fovY=75");
  addChoice(app, "--read-as", "NAME", readAs_, namesAlone(presetNames()), "Read the camera in this convention",
            "the file's, or opengl");
  if (auto* const line = dynamic_cast<CommandLine*>(&app))
    line->later(isCameraOption, [this, line] { addFields(*line); });
  else
    addFields(app);
  app.add_flag("--allow-stretch", allowStretch_, "Let the camera's shape differ from the viewport's");
  app.add_flag("--ignore-distortion", ignoreDistortion_, "Take a lens that distorts as one that does not");
}

void CameraOptions::addWriting(CLI::App& app) {
  const Heading heading(app, "Convention written");
  addChoice(app, "--convention", "NAME", convention_, presets(),
            "Write in this convention; without a camera file also read the options in it", "the one that was read");
  app.add_flag_function(
         "--reverse-z,!--no-reverse-z",
         [this](std::int64_t sum) {
           if (sum == 0) throw UsageError("--reverse-z and --no-reverse-z contradict each other");
           reverseZ_ = sum > 0;
         },
         "Write depth with near and far exchanged, or not (default: as the convention has it)")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addChoice(app, "--ndc-z", "RANGE", ndcZ_, rowsOf(kNdcZNames), "Write this range of NDC z", "the convention's");
}

void CameraOptions::addFile(CLI::App& app) {
  takesFile_ = true;
  addValue(app, "FILE", "", file_, readFileName, "Camera file, where -c was not given; absent or - for standard input");
}

void CameraOptions::addFields(CLI::App& app) {
  const Heading heading(app, "The camera's fields, over a file's or without one");
  for (const CameraOption& option : cameraOptions())
    if (option.field)
      addOption(app, std::string(option.name), std::string(valueWord(option.field->form)),
                std::string(option.field->help), Times::once,
                [this, option](const std::string&, const std::vector<std::string>& given) {
                  typed_.add(option, given.front());
                });
    else
      app.add_flag_function(
          std::string(option.name), [this, option](std::int64_t) { typed_.add(option, ""); },
          "The projection is " + std::string(option.type->name) + ", where its fields could be another's too");
}

CameraSource CameraOptions::source() const {
  if (camera_ && file_) throw UsageError("-c gives the camera already; leave out one of it and " + *file_);
  if (!camera_ && !takesFile_)
    throw UsageError("-c FILE is needed: the camera; or options that say it, such as --position, --target and --fov-y");
  return splitPick(camera_ ? *camera_ : file_.value_or("-"));
}

std::unique_ptr<Document> CameraOptions::open(const CameraSource& picked) const {
  for (const Assignment& assignment : set_)
    if (const std::string field = dotted(assignment.path);
        viewport_ && (field == "viewport" || field == "viewport.width" || field == "viewport.height"))
      throw UsageError("--viewport and --set " + assignment.text + " both give the size of the picture");
  auto document = isTyped() ? std::make_unique<Document>(Document::Typed{}, "the command line")
                            : std::make_unique<Document>(picked.file, camera_ ? "--camera" : "FILE");
  if (viewport_) setViewportSize(*document, viewport_->width, viewport_->height);
  for (const Assignment& assignment : set_) document->set(assignment);
  return document;
}

int CameraOptions::list() const {
  typed_.requireConsistent();
  if (isTyped()) throw UsageError("--list names the cameras of a file, and there is none");
  writeOutput(listCameras(*open(source())));
  return 0;
}

std::string CameraOptions::readAs() const {
  if (readAs_ || !isTyped() || !convention_) return readAs_.value_or("");
  // A place makes the world right-handed.
  if (typed_.hasPlace() && convention_->convention.world == Handedness::left) return "";
  return std::string(convention_->name);
}

CameraFile CameraOptions::read() const {
  typed_.requireConsistent();
  const CameraSource picked = isTyped() ? CameraSource{} : source();
  std::unique_ptr<Document> opened = open(picked);
  Document& document = *opened;
  CameraFile file = readAnyCamera(document, picked.pick, {readAs(), allowStretch_, ignoreDistortion_}, typed_);
  statesConvention_ = readAs_ || isTyped() || statesConvention(document) || file.worldIsEcef;
  for (const std::string& note : document.notes()) notes_.say(note);
  if (isTyped()) fields_ = std::move(opened);
  return file;
}

std::vector<std::pair<std::string, CameraFile>> CameraOptions::readAll() const {
  typed_.requireConsistent();
  if (isTyped()) throw UsageError("--all is of the cameras of a file, and there is none");
  const CameraSource picked = source();
  if (picked.pick) throw UsageError("--all is of every camera of the file; leave out #" + *picked.pick);
  const std::unique_ptr<Document> document = open(picked);
  std::vector<std::pair<std::string, CameraFile>> cameras;
  for (const std::string& pick : picksOf(*document))
    cameras.emplace_back(pick, readAnyCamera(*document, pick, {readAs(), allowStretch_, ignoreDistortion_}, typed_));
  statesConvention_ = readAs_ || statesConvention(*document);
  for (const std::string& note : document->notes()) notes_.say(note);
  return cameras;
}

std::optional<std::string> CameraOptions::asTyped(const CameraFile& file) const {
  if (!fields_ || fields_->isSet(std::string(field::convention))) return std::nullopt;
  const ConventionPreset* preset = readAs().empty() ? &conventionPresets().front() : findPreset(readAs());
  if (convention_ && convention_->name != preset->name) {
    // On the Earth a preset says nothing but which way a rotation's axes point.
    const ObjectReader fields(*fields_, fields_->root(), {});
    if (readAs_ || !typed_.hasPlace() || fields.has(field::rotation)) return std::nullopt;
    preset = findPreset(convention_->name);
  }
  return writeFields(*fields_, writing(file), *preset);
}

bool CameraOptions::fromStandardInput() const {
  if (isTyped() || (!camera_ && !takesFile_)) return false;
  return splitPick(camera_ ? *camera_ : file_.value_or("-")).file == "-";
}

Convention CameraOptions::writing(const CameraFile& file) const {
  Convention c = file.convention;
  if (convention_) {
    c = convention_->convention;
    c.world = file.convention.world;
  }
  if (reverseZ_) c.reverseZ = *reverseZ_;
  if (ndcZ_) c.ndcZ = *ndcZ_;
  return c;
}

void CameraOptions::noteWriting(const CameraFile& file, const Shown& shown, const std::string& where) const {
  std::vector<std::string_view> idle;
  // Without a file it also says how the options are read.
  if (convention_ && !isTyped() && !shown.axes && !shown.range && !shown.reversal) idle.push_back("--convention");
  if (reverseZ_ && !shown.reversal) idle.push_back(*reverseZ_ ? "--reverse-z" : "--no-reverse-z");
  if (ndcZ_ && !shown.range) idle.push_back("--ndc-z");
  if (!idle.empty())
    notes_.say(joined(idle) + (idle.size() == 1 ? " changes" : " change") + " nothing that is printed here; " + where +
               " would show it");
  if (!convention_ || !shown.world || statesConvention_) return;
  if (convention_->convention.world == file.convention.world) return;
  const std::string name(convention_->name);
  const auto hand = [](Handedness world) { return std::string(nameOf(kWorldNames, world)) + "-handed"; };
  notes_.say(file.name + ": names no convention, so its world stays " + hand(file.convention.world) + "; " + name +
             "'s is " + hand(convention_->convention.world) +
             ", where the same numbers show the mirror image: --read-as " + name + " reads them so");
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
    for (std::size_t i = 0; i < row->parts.size(); ++i) {
      const std::string name(row->parts[i].name);
      const auto part =
          std::find_if(parts.begin(), parts.end(), [&](const std::string& one) { return one.starts_with(name + "="); });
      if (part == parts.end() && i < row->fewest) break;
      if (part == parts.end()) continue;
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
  if (!named && worldIsEcef) throw UsageError(text + ": " + bareTriple("lat=LAT,lon=LON,height=HEIGHT or x=X,y=Y,z=Z"));
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

void StreamOptions::addInput(CLI::App& app, const std::string& what) {
  const Heading heading(app, "Input");
  addValue(app, "FILE", "", file_, readFileName, "The " + what + "; absent or - for standard input");
  addChoice(app, "--from", "FORM", from_, namesOf(inputForms()), "Form of FILE", "as its name and first bytes tell");
  addValue(
      app, "--columns", "COLUMNS", columns_, readText,
      "Columns of CSV, fields of JSON or numbers of a line that hold the coordinates: names or numbers in order, as "
      "in E,N,U or 2,3,4; roles in any order, as in w,x,y,z or lat,lon,height, or of pixels depth,x,y; or each with "
      "its role, as in lat=la,lon=lo,height=h or x=u,y=v,depth=d (default: by their names)");
  addValue(
      app, "--delimiter", "CHAR", delimiter_, readDelimiter,
      "What separates the columns of CSV, in and out: comma, semicolon, tab, blank, bar or a character (default: as "
      "the first line tells)");
  addValue(
      app, "--decimal", "CHAR", decimal_,
      [](const std::string& option, const std::string& text) {
        if (text != "," && text != ".") throw UsageError(option + " " + text + ": expected , or .");
        return text[0];
      },
      "What decimals of CSV and text follow, . or , (default: .)");
  addValue(
      app, "--comment", "CHAR", comment_,
      [](const std::string& option, const std::string& text) {
        if (text.size() != 1 || !isPunctuation(text[0]))
          throw UsageError(option + " " + text + ": expected one character, as in '#'");
        return text[0];
      },
      "What begins a line of CSV or text that is a comment (default: in text #, in CSV nothing)");
}

void StreamOptions::add(CLI::App& app, const std::string& what) {
  addInput(app, what);
  writes_ = true;
  const Heading heading(app, "Output");
  addForm(app, to_, outputForms(), "Form of the output", "as the input");
  addDigits(app, digits_, "all that tell the number from others; in tables 9");
  addValue(
      app, "--prefix", "P", prefix_,
      [](const std::string& option, const std::string& text) {
        const bool plain = std::all_of(text.begin(), text.end(), [](unsigned char c) {
          return c >= 0x80 || std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == ':';
        });
        if (!plain) throw UsageError(option + " " + text + ": expected letters, digits or any of _ - . :");
        return text;
      },
      "Put this in front of the results' names");
  app.add_flag("--keep-going", keepGoing_, "Put an error record in a bad record's place and go on");
  addValue(app, "--jobs", "N", jobs_, wholeNumber(1, kMostJobs), "Threads to work with (default: one a processor)");
  app.add_flag("--force", force_, "f64: write it to a terminal too");
  app.add_flag("--no-header", noHeader_, "CSV: write no header line");
  addValue(app, "--first-line", "N", firstLine_, wholeNumber(1, kMostLines),
           "Number of the input's first line in messages, where it is a part of a file (default: 1)");
}

void StreamOptions::addKeepGoing(CLI::App& app) {
  app.add_flag("--keep-going", keepGoing_, "Leave a bad record out, with a message, and go on; the status is 1 then");
}

FilterSetup StreamOptions::setup(const ChoosableColumns& choosable) const {
  FilterSetup setup;
  setup.file = file_.value_or("-");
  setup.from = from_;
  setup.to = to_;
  setup.keepGoing = keepGoing_;
  setup.jobs = static_cast<unsigned>(jobs_.value_or(0));
  setup.firstLine = firstLine_.value_or(1);
  setup.force = force_;
  setup.writer.digits = static_cast<int>(digits_.value_or(0));
  setup.delimiter = delimiter_;
  setup.decimal = decimal_;
  setup.comment = comment_;
  setup.writer.header = !noHeader_;
  setup.writer.prefix = prefix_.value_or("");
  if (columns_) {
    setup.columns = chooseColumns(*columns_, choosable);
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
    if (file_) throw UsageError(given + " takes the place of FILE; leave out one of it and " + *file_);
    requireNoInputOption(given.substr(0, given.find(' ')) + " takes the place of");
  }
  requireOneStandardInput(
      {{"the camera", camera.fromStandardInput()}, other, {"the records", setup.given.empty() && setup.file == "-"}});
}

void StreamOptions::requireNoInputOption(const std::string& why) const {
  for (const auto& [name, given] : {std::pair("--from", from_.has_value()),
                                    {"--columns", columns_.has_value()},
                                    {"--delimiter", delimiter_ && !writes_},
                                    {"--decimal", decimal_.has_value()},
                                    {"--comment", comment_.has_value()},
                                    {"--first-line", firstLine_.has_value()}})
    if (given) throw UsageError(std::string(name) + " is for FILE, which " + why);
}

void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise) {
  addValue(app, "--digits", "N", digits, wholeNumber(1, kMostDigits),
           "Significant digits of results, from 1 to " + std::to_string(kMostDigits) + " (default: " + otherwise + ")");
}

void addReportForm(CLI::App& app, ReportForm& form, const std::string& svg) {
  static constexpr FormRow<ReportForm> kForms[] = {
      {"table", ReportForm::table, ".txt"}, {"json", ReportForm::json, ".json"}, {"svg", ReportForm::svg, ".svg"}};
  addForm(app, form, std::span(kForms).first(svg.empty() ? 2 : 3),
          "Form of the output" + (svg.empty() ? "" : "; svg plots " + svg));
}

void addTolerance(CLI::App& app, std::optional<double>& tolerance) {
  addValue(app, "--tolerance", "PX", tolerance,
           numberThat([](double pixels) { return pixels >= 0; }, "pixels, a number not below 0"),
           "Pixels that auto stays within, on screen x and y (default: 1e-6)");
}

std::span<const PrecisionRow> precisionModes() {
  static constexpr PrecisionRow kModes[] = {
      {"exact",
       {Precision::exact},
       "double-double, and exact sums where that is not certain",
       "the double nearest the true value, certified number by number; a tie, or a number that cancels to about 0, is "
       "within 0.51 ulp or 1e-26 of the picture's size"},
      {"standard",
       {Precision::standard},
       "double, after the eye is subtracted",
       "a proven bound: 5e-12 pixels at 60 degrees and 1080 lines"},
      {"fast",
       {Precision::fast},
       "float32, after the eye is subtracted in double",
       "a proven bound: 2e-3 pixels at 60 degrees and 1080 lines"},
      {"auto",
       {std::nullopt},
       "the cheapest of these whose bound is within --tolerance",
       "the tolerance, in the picture and one more picture on every side of it; exact elsewhere"},
  };
  return kModes;
}

void addPrecision(CLI::App& app, PrecisionMode& mode) {
  Names<PrecisionMode> modes;
  for (const PrecisionRow& row : precisionModes()) modes.emplace_back(row.name, row.mode);
  addChoice(app, "--precision", "MODE", mode, modes,
            "Arithmetic; standard is double, fast float32, auto the cheapest that will do");
}

}  // namespace viewproj::cmd
