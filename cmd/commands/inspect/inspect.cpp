// viewproj inspect: sixteen numbers to every reading that they admit, and to another convention.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "commands/command.hpp"
#include "commands/inspect/notes.hpp"
#include "commands/inspect/report.hpp"
#include "commands/options.hpp"
#include "input/convention_names.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/names.hpp"
#include "text/parse_number.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;

/// Which readings are wanted.
struct Choice {
  std::optional<Handedness> world;
  std::optional<Convention> readAs;
  std::optional<std::size_t> number;

  /// The options that choose.
  std::string asked() const {
    std::vector<std::string_view> given;
    if (world) given.push_back("--world");
    if (readAs) given.push_back("--read-as");
    if (number) given.push_back("--reading");
    return joined(given, " and ");
  }

  bool takes(const NumberedReading& n, NumberOrder order) const {
    const Reading& r = n.reading;
    if (number && *number != n.number) return false;
    if (world && r.kind != MatrixKind::projection && r.convention.world != *world) return false;
    return !readAs || fits(r, *readAs, order);
  }
};

/// Matrices that `matrix` writes and that are none of a camera alone.
bool isPassedOver(const std::string& name) {
  return name.starts_with("viewport") || name == "projectionInverse" || name == "viewProjectionInverse";
}

std::vector<WrittenMatrix> chooseMatrices(std::vector<WrittenMatrix> given, const std::string& list,
                                          const std::string& source) {
  if (list.empty()) {
    const std::string first = given.front().name;
    std::erase_if(given, [](const WrittenMatrix& m) { return isPassedOver(m.name); });
    if (given.empty())
      throw InputError(source + ": has only " + first + "; --which " + first + " inspects it all the same");
    return given;
  }
  std::vector<WrittenMatrix> chosen;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < given.size(); ++i) names.push_back(nameOf(given[i], i));
  std::unordered_map<std::string_view, std::size_t> places;  // of a name that several have, the first
  for (std::size_t i = 0; i < names.size(); ++i) places.emplace(names[i], i);
  for (const std::string& name : splitNames("--which", list)) {
    const auto found = places.find(name);
    if (found == places.end())
      throw InputError(source + ": has no matrix '" + name + "'" +
                       suggestion(name, std::vector<std::string_view>(names.begin(), names.end())));
    chosen.push_back(given[found->second]);
  }
  return chosen;
}

/// A matrix of a name that says its kind is of that kind.
bool nameAllows(const std::string& name, MatrixKind kind) {
  if (name == "view") return kind == MatrixKind::view;
  if (name == "viewInverse") return kind == MatrixKind::worldFromView;
  if (name == "projection") return kind == MatrixKind::projection;
  return true;
}

/// Of these, the ones that the input's own words allow: the matrix's name and, if there is one, the convention.
std::vector<NumberedReading> asStated(const InspectedMatrix& m, const std::optional<Convention>& stated) {
  std::vector<NumberedReading> result;
  for (const NumberedReading& n : m.readings) {
    const Reading& r = n.reading;
    if (!nameAllows(m.written.name, r.kind)) continue;
    if (stated && !(fits(r, *stated, m.written.order) && (!r.lens || r.convention.reverseZ == stated->reverseZ) &&
                    (r.kind == MatrixKind::projection || r.convention.world == stated->world)))
      continue;
    result.push_back(n);
  }
  return result;
}

/// What the input's own convention makes of the matrix.
std::string statedNote(const InspectedMatrix& m, const Convention& stated) {
  std::string numbers;
  for (const NumberedReading& n : asStated(m, stated))
    numbers += (numbers.empty() ? "" : " or ") + std::to_string(n.number);
  if (numbers.empty()) return "No reading here is of the convention that the input states.";
  return "Of the convention that the input states: reading " + numbers + ".";
}

InspectedMatrix inspectOne(const WrittenMatrix& written, EntryPrecision precision, const Choice& choice,
                           const std::optional<Convention>& stated) {
  const Inspection inspection = inspectMatrix(written.numbers, precision);
  InspectedMatrix m{written, {}, inspection.readings.size(), inspection.asWrittenFault, inspection.transposedFault, {}};
  std::vector<Reading> plain;
  for (std::size_t i = 0; i < inspection.readings.size(); ++i) {
    const NumberedReading numbered{i + 1, inspection.readings[i]};
    if (!choice.takes(numbered, written.order)) continue;
    m.readings.push_back(numbered);
    plain.push_back(numbered.reading);
  }
  m.notes = notesOn(plain);
  if (plain.empty() && m.all > 0)
    m.notes.push_back("None of its readings, of which there are " + std::to_string(m.all) + ", is as " +
                      choice.asked() + " asks.");
  if (stated && !plain.empty()) m.notes.insert(m.notes.begin(), statedNote(m, *stated));
  return m;
}

/// The one matrix that the readings give, or an error that lists them.
NamedMatrix convertOne(const InspectedMatrix& m, const std::string& name, const std::string& source,
                       const std::optional<Convention>& stated, const CameraOptions& writing, Convention& target) {
  const auto fail = [&](const std::string& message) -> InputError {
    return InputError(source + ": " + name + ": " + message);
  };
  if (m.all == 0) throw fail("is nothing known: as written " + m.asWrittenFault + "; transposed " + m.transposedFault);
  const std::vector<NumberedReading> left = asStated(m, stated);
  if (left.empty()) throw fail("no reading of it is as asked for or as the input states");
  std::optional<Mat4> result;
  for (const NumberedReading& n : left) {
    CameraFile file;
    file.convention.world = n.reading.convention.world;
    target = writing.writing(file);
    Mat4 matrix;
    try {
      matrix = converted(n.reading, target);
    } catch (const CameraError& e) {
      throw fail(e.what());
    }
    if (result && !(*result == matrix)) {
      std::string message = "its readings give different matrices; --read-as NAME, --world HAND or --reading N picks:";
      for (const NumberedReading& each : left) message += "\n  " + oneLine(each, m.written.order);
      throw fail(message);
    }
    result = matrix;
  }
  return {name, *result};
}

struct Options {
  CameraOptions writing;
  std::string file = "-", which, world, readAs, number, format;
  bool asFloat = false;
};

int run(const Options& o, const CLI::App& app) {
  const bool converts = app.count("--convention") > 0 || app.count("--reverse-z") > 0 || app.count("--ndc-z") > 0;
  if (converts && app.count("--convention") == 0)
    throw UsageError("--reverse-z and --ndc-z go with --convention NAME, the convention to write");
  static constexpr std::string_view kReports[] = {"table", "json"};
  const std::vector<std::string_view> formats =
      converts ? matrixFormats() : std::vector<std::string_view>(std::begin(kReports), std::end(kReports));
  const std::string format = !o.format.empty() ? o.format : converts ? "json" : "table";
  requireKnown("--to", format, formats);

  Choice choice;
  if (!o.world.empty()) {
    static constexpr std::string_view kWorlds[] = {"right", "left"};
    requireKnown("--world", o.world, kWorlds);
    choice.world = o.world == "right" ? Handedness::right : Handedness::left;
  }
  if (!o.readAs.empty()) {
    choice.readAs = conventionPreset(o.readAs);
    if (!choice.readAs) failUnknown("--read-as", o.readAs, presetNames());
  }
  if (!o.number.empty()) {
    const auto value = parseNumber(o.number);
    if (!value || !(*value >= 1 && *value <= 1000 && *value == std::floor(*value)))
      throw UsageError("--reading " + o.number + ": expected the number of a reading, from 1 on");
    choice.number = static_cast<std::size_t>(*value);
  }

  const std::string source = o.file == "-" ? kStandardInputName : o.file;
  WrittenMatrices given = parseMatrices(readWholeFile(o.file, kMostBytes), source);
  const std::vector<WrittenMatrix> chosen = chooseMatrices(std::move(given.matrices), o.which, source);
  // One at a time: its readings take many times the memory of its numbers.
  const auto inspected = [&](const WrittenMatrix& m) {
    return inspectOne(m, o.asFloat ? EntryPrecision::float32 : EntryPrecision::float64, choice, given.convention);
  };

  if (converts) {
    MatrixSet set;
    const bool chose = choice.readAs || choice.number;
    for (std::size_t i = 0; i < chosen.size(); ++i)
      set.matrices.push_back(convertOne(inspected(chosen[i]), nameOf(chosen[i], i), source,
                                        chose ? std::nullopt : given.convention, o.writing, set.convention));
    set.asFloat = o.asFloat;
    writeOutput(writeMatrices(set, format, source));
    return 0;
  }
  Report report(format == "json", o.asFloat);
  bool allFit = true;
  for (const WrittenMatrix& written : chosen) {
    const InspectedMatrix m = inspected(written);
    allFit &= !m.readings.empty();
    writeOutput(report.add(m));
  }
  writeOutput(report.end());
  return allFit ? 0 : 1;
}

}  // namespace

Action defineInspect(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description(
      "Every reading of a 4x4 matrix: which conventions it can be written in, and the camera in it; with --convention "
      "the same matrix in another convention. Status 1 where nothing fits.");
  app.footer("viewproj matrix samples/picking-a-pixel/camera.json --which projection --to flat | viewproj inspect");
  app.add_option("FILE", o->file,
                 "The matrices: JSON, an initialiser of C, HLSL, GLSL or NumPy, or rows of numbers; absent or - for "
                 "standard input");
  app.add_option("--which", o->which, "Of several matrices only these, by name")->type_name("NAMES");
  app.add_flag("--float", o->asFloat, "The numbers are float32s (default: doubles)");
  app.add_option("--world", o->world, "Only readings of this handedness: right or left")->type_name("HAND");
  app.add_option("--read-as", o->readAs, "Only readings of this convention: " + joined(presetNames()))
      ->type_name("NAME");
  app.add_option("--reading", o->number, "Only this reading, by its number")->type_name("N");
  o->writing.addWriting(app);
  app.add_option("--to", o->format,
                 "Form of the output: table, json (default: table); with --convention: " + joined(matrixFormats()) +
                     " (default: json)")
      ->type_name("FORM");
  return [o, &app] { return run(*o, app); };
}

}  // namespace viewproj::cmd
