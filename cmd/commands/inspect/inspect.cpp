// viewproj inspect: sixteen numbers to every reading that they admit, and to another convention.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "camera/names.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/inspect/notes.hpp"
#include "commands/inspect/report.hpp"
#include "commands/output_option.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr std::size_t kMostBytes = 1 << 20;

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
      throw InputError(source + ": has no matrix " + inQuotes(name) +
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
    const MatrixCamera& r = n.reading;
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

InspectedMatrix inspectOne(const WrittenMatrix& written, bool isFloat, const std::optional<Convention>& readAs,
                           const std::optional<Convention>& stated) {
  Mat4 matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i / 4][i % 4] = written.numbers[i];
  const MatrixCameras found = camerasOf(matrix, {.float32 = isFloat});
  InspectedMatrix m{written, {}, found.cameras.size(), found.fault, found.transposedFault, {}};
  std::vector<MatrixCamera> plain;
  for (std::size_t i = 0; i < found.cameras.size(); ++i) {
    const MatrixCamera& r = found.cameras[i];
    if (readAs && !fits(r, *readAs, written.order)) continue;
    m.readings.push_back({i + 1, r});
    plain.push_back(r);
  }
  m.notes = notesOn(plain);
  if (plain.empty() && m.all > 0) m.notes.push_back("No reading of it fits --read-as.");
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
      std::string message =
          "its readings give different matrices; --read-as NAME picks a convention, a name as in "
          "{\"view\": [...]} (view, viewInverse, projection) a kind, sixteen numbers in a row the order in memory:";
      for (const NumberedReading& each : left) message += "\n  " + oneLine(each, m.written.order);
      throw fail(message);
    }
    result = matrix;
  }
  return {name, *result};
}

struct Options {
  CameraOptions writing;
  Notes notes;
  std::string file = "-";
  std::optional<std::vector<std::string>> which;
  std::optional<Convention> readAs;
  std::optional<std::string_view> format;
  bool asFloat = false;
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
  const std::string source = o.file == "-" ? kStandardInputName : visible(o.file);
  WrittenMatrices given = parsed(readWholeFile(o.file, kMostBytes), source);
  const bool isFloat = o.asFloat || given.isFloat;
  const std::vector<WrittenMatrix> chosen = chooseMatrices(std::move(given.matrices), o.which, source);
  // One at a time: its readings take many times the memory of its numbers.
  const auto inspected = [&](const WrittenMatrix& m) { return inspectOne(m, isFloat, o.readAs, given.convention); };

  if (converts) {
    MatrixSet set;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i].isCalibration)
        throw InputError(
            source + ": " + nameOf(chosen[i], i) +
            ": is a calibration in pixels, and has no form in other conventions; without --convention inspect "
            "tells the camera in it, and matrix takes that");
      set.matrices.push_back(convertOne(inspected(chosen[i]), nameOf(chosen[i], i), source,
                                        o.readAs ? std::nullopt : given.convention, o.writing, set.convention));
    }
    set.asFloat = isFloat;
    writeOutput(writeMatrices(set, format, source));
    return 0;
  }
  Report report(format == "json", isFloat);
  bool allFit = true;
  for (const WrittenMatrix& written : chosen) {
    if (written.isCalibration) {
      if (o.readAs) throw UsageError("--read-as: a calibration of three rows has one reading, in no convention");
      try {
        writeOutput(report.add(written, inspectCalibration(written)));
      } catch (const CameraError& e) {
        throw InputError(source + ": " + (written.name.empty() ? e.field() : written.name) + ": " + e.message() +
                         "; three rows are K or K [R | t], and any other matrix has 16 numbers");
      }
      continue;
    }
    const InspectedMatrix m = inspected(written);
    allFit &= !m.readings.empty();
    writeOutput(report.add(m));
  }
  writeOutput(report.end());
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
  addChoice(line, "--read-as", "NAME", o->readAs, presetConventions(), "Only readings of this convention", "all");
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
