// viewproj inspect: sixteen numbers to every reading that they admit, and to another convention.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/inspect/notes.hpp"
#include "commands/inspect/report.hpp"
#include "commands/output_option.hpp"
#include "input/convention_names.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/names.hpp"
#include "text/visible.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::size_t kMostReadings = 1000;

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

std::vector<WrittenMatrix> chooseMatrices(std::vector<WrittenMatrix> given,
                                          const std::optional<std::vector<std::string>>& asked,
                                          const std::string& source) {
  if (!asked) {
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
  for (const std::string& name : *asked) {
    const auto found = places.find(name);
    if (found == places.end())
      throw InputError(source + ": has no matrix " + cmd::quoted(name) +
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

/// How numbers count: as they stand, or as far as their digits show.
struct Precision {
  bool isFloat = false, isExact = false;

  bool trusts(const WrittenMatrix& m) const {
    // As many digits as these are all that a float32 or a double has, but for one.
    constexpr int kFloat = 8, kDouble = 16;
    return isExact || m.digits >= (isFloat ? kFloat : kDouble);
  }
};

InspectedMatrix inspectOne(const WrittenMatrix& written, const Precision& precision, const Choice& choice,
                           const std::optional<Convention>& stated) {
  const bool byDigits = !precision.trusts(written) && written.within != std::array<double, 16>{};
  const Inspection inspection =
      inspectMatrix(written.numbers, precision.isFloat ? EntryPrecision::float32 : EntryPrecision::float64,
                    byDigits ? written.within : std::array<double, 16>{});
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
  if (byDigits && !plain.empty())
    m.notes.push_back(
        "The intervals take each number to be known as far as its digits show; --exact takes it as it "
        "stands.");
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

/// A projection is none.
bool isOfAWorld(const InspectedMatrix& m) {
  return std::any_of(m.readings.begin(), m.readings.end(),
                     [](const NumberedReading& n) { return n.reading.kind != MatrixKind::projection; });
}

constexpr const char* kNoWorld = "--world changes nothing here: a projection is the same in a world of either hand";

struct Options {
  CameraOptions writing;
  Notes notes;
  std::string file = "-";
  std::optional<std::vector<std::string>> which;
  Choice choice;
  std::optional<std::string_view> format;
  bool asFloat = false, exact = false;
};

constexpr std::string_view kTable = "table", kReports[] = {kTable, "json"};

/// The form of the output, of a report or of converted matrices.
std::string_view formOf(const Options& o, bool converts) {
  if (!o.format) return converts ? "json" : kTable;
  const std::vector<std::string_view> forms =
      converts ? known(namesOf(std::span<const FormRow<std::string_view>>(matrixForms())))
               : std::vector<std::string_view>(std::begin(kReports), std::end(kReports));
  if (std::find(forms.begin(), forms.end(), *o.format) == forms.end())
    throw UsageError("--to " + std::string(*o.format) +
                     (converts
                          ? " is of readings; with --convention there are "
                          : " is of a matrix in another convention, which --convention names; without it there are ") +
                     joined(forms));
  return *o.format;
}

/// A calibration's whole file holds its matrices among much else.
WrittenMatrices parsed(const std::string& text, const std::string& source) {
  try {
    return parseMatrices(text, source);
  } catch (const InputError& e) {
    const auto has = [&](const char* word) { return text.find(word) != std::string::npos; };
    if (!text.starts_with("%YAML") && !has("camera_matrix") && !has("image_width") && !has("distortion")) throw;
    throw InputError(std::string(e.what()) + "; a camera file is read by matrix FILE --to summary");
  }
}

int run(const Options& o) {
  const bool converts = o.writing.namesConvention();
  if (o.writing.namesAxis() && !converts)
    throw UsageError("--reverse-z and --ndc-z go with --convention NAME, the convention to write");
  const std::string_view format = formOf(o, converts);
  const Choice& choice = o.choice;

  const std::string source = o.file == "-" ? kStandardInputName : visible(o.file);
  WrittenMatrices given = parsed(readWholeFile(o.file, kMostBytes), source);
  const bool isFloat = o.asFloat || (given.isFloat && !o.exact);
  const std::vector<WrittenMatrix> chosen = chooseMatrices(std::move(given.matrices), o.which, source);
  // One at a time: its readings take many times the memory of its numbers.
  const auto inspected = [&](const WrittenMatrix& m) {
    return inspectOne(m, {isFloat, o.exact || (given.isOwn && !mayBeFloats(m))}, choice, given.convention);
  };

  bool hasWorld = false;
  if (converts) {
    MatrixSet set;
    const bool chose = choice.readAs || choice.number;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i].isCalibration)
        throw InputError(
            source + ": " + nameOf(chosen[i], i) +
            ": is a calibration in pixels, and has no form in other conventions; without --convention inspect "
            "tells the camera in it, and matrix takes that");
      const InspectedMatrix m = inspected(chosen[i]);
      hasWorld |= isOfAWorld(m);
      set.matrices.push_back(convertOne(m, nameOf(chosen[i], i), source, chose ? std::nullopt : given.convention,
                                        o.writing, set.convention));
    }
    set.asFloat = isFloat;
    if (choice.world && !hasWorld) o.notes.say(kNoWorld);
    writeOutput(writeMatrices(set, format, source));
    return 0;
  }
  Report report(format == "json", isFloat);
  bool allFit = true;
  for (const WrittenMatrix& written : chosen) {
    if (written.isCalibration) {
      if (choice.readAs || choice.number)
        throw UsageError(choice.asked() + ": a calibration of three rows has one reading, in no convention");
      hasWorld = hasWorld || written.columns == 4;
      const bool isExact = o.exact || (given.isOwn && !mayBeFloats(written));
      try {
        writeOutput(report.add(
            written,
            inspectCalibration(written, isFloat ? EntryPrecision::float32 : EntryPrecision::float64, isExact)));
      } catch (const CameraError& e) {
        throw InputError(source + ": " + (written.name.empty() ? e.field() : written.name) + ": " + e.message() +
                         "; three rows are K or K [R | t], and any other matrix has 16 numbers");
      }
      continue;
    }
    const InspectedMatrix m = inspected(written);
    allFit &= !m.readings.empty();
    hasWorld |= isOfAWorld(m);
    writeOutput(report.add(m));
  }
  writeOutput(report.end());
  if (choice.world && allFit && !hasWorld) o.notes.say(kNoWorld);
  return allFit ? 0 : 1;
}

}  // namespace

Action defineInspect(CommandLine& line) {
  const auto o = std::make_shared<Options>();
  line.setDescription(
      "Every reading of a 4x4 matrix: which conventions it can be written in, and the camera in it; with --convention "
      "the same matrix in another convention. Of three rows of three or four numbers, K or P of a calibration, the "
      "camera. Status 1 where nothing fits.");
  line.setExample(
      "viewproj matrix samples/picking-a-pixel/camera.json --which projection --to flat | viewproj inspect");
  addValue(line, "FILE", "", o->file, readFileName,
           "The matrices: JSON, an initialiser of C, HLSL, GLSL or NumPy, or rows of numbers; absent or - for standard "
           "input");
  addValue(line, "--which", "NAMES", o->which, splitNames, "Of several matrices only these, by name");
  line.addFlag("--float", o->asFloat, "The numbers are float32s (default: doubles)");
  line.addFlag("--exact", o->exact, "The numbers are what they stand for, however few digits they have");
  addChoice(line, "--world", "HAND", o->choice.world, rowsOf(kWorldNames), "Only readings of this handedness", "both");
  addChoice(line, "--read-as", "NAME", o->choice.readAs, presetConventions(), "Only readings of this convention",
            "all");
  addValue(line, "--reading", "N", o->choice.number, wholeNumber(1, kMostReadings), "Only this reading, by its number");
  o->writing.addWriting(line);
  auto forms = matrixForms();
  forms.insert(forms.begin(), {kTable, kTable, ".txt"});
  addForm(line, o->format, std::span<const FormRow<std::string_view>>(forms),
          "Form of the output; with --convention any but table, without it table or json",
          "table; with --convention json");
  o->notes.add(line);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
