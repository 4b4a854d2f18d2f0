// viewproj inspect: sixteen numbers to every reading that they admit, and to another convention.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/names.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/inspect_report.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr int kTableDigits = 9;

/// Matrices that `matrix` writes and that are none of a camera alone.
bool isPassedOver(const std::string& name) {
  return name.starts_with("viewport") || name == "projectionInverse" || name == "viewProjectionInverse";
}

std::vector<WrittenMatrix> chooseMatrices(std::vector<WrittenMatrix> matrices,
                                          const std::optional<std::vector<std::string>>& which,
                                          const std::string& source) {
  if (!which) {
    const std::string first = matrices.front().name;
    std::erase_if(matrices, [](const WrittenMatrix& m) { return isPassedOver(m.name); });
    if (matrices.empty())
      throw InputError(source + ": has only " + first + "; --which " + first + " inspects it all the same");
    return matrices;
  }
  std::vector<WrittenMatrix> chosen;
  for (const std::string& name : *which) {
    const auto found =
        std::find_if(matrices.begin(), matrices.end(), [&](const WrittenMatrix& m) { return m.name == name; });
    if (found == matrices.end()) {
      std::vector<std::string_view> names;
      for (const WrittenMatrix& m : matrices) names.push_back(m.name);
      throw InputError(source + ": has no matrix " + inQuotes(name) + suggestion(name, names));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

struct InspectOptions {
  CameraOptions writing;
  std::optional<std::string> operand;
  std::optional<std::vector<std::string>> which;
  std::optional<Convention> readAs;
  std::optional<std::string_view> form;
  std::optional<std::size_t> digits;
  bool isFloat = false;
};

/// The one matrix that the readings give. world: that of the matrices with a pose, which is one for all.
NamedMatrix convertOne(const WrittenMatrix& written, const InspectQuery& query, const std::string& source,
                       const CameraOptions& writing, std::optional<Handedness>& world) {
  const auto fail = [&](const std::string& message) {
    return InputError(source + ": " + written.name + ": " + message);
  };
  if (written.isCalibration())
    throw fail("is a calibration in pixels, and has no form in other conventions; matrix FILE reads it");
  const std::vector<MatrixCamera> readings = statedReadings(written, query);
  if (readings.empty())
    throw fail("no reading of it is as --read-as or the input states; without --convention inspect lists them");
  std::optional<Mat4> result;
  for (const MatrixCamera& reading : readings) {
    Mat4 matrix;
    try {
      matrix = converted(reading, writing.writing({.world = reading.convention.world}));
    } catch (const CameraError& e) {
      throw fail(e.what());
    }
    if (result && !(*result == matrix))
      throw fail(
          "its readings give different matrices, as inspect without --convention lists them; --read-as NAME picks a "
          "convention, a name as in {\"view\": [...]} (view, viewInverse, projection) a kind, sixteen numbers in a row "
          "the order in memory");
    result = matrix;
  }
  if (readings.back().kind != MatrixKind::projection) {
    const Handedness own = readings.back().convention.world;
    if (world.value_or(own) != own)
      throw fail("its world is " + std::string(nameOf(kWorldNames, own)) +
                 "-handed, unlike that of the matrices before it; --which picks");
    world = own;
  }
  return {written.name, *result};
}

/// In another convention.
int runConversion(const InspectOptions& o, const std::vector<WrittenMatrix>& matrices, const InspectQuery& query,
                  const std::string& source) {
  const std::string_view form = o.form.value_or("json");
  MatrixSet set;
  set.asFloat = query.isFloat;
  std::optional<Handedness> world;
  for (const WrittenMatrix& matrix : matrices)
    set.matrices.push_back(convertOne(matrix, query, source, o.writing, world));
  const std::optional<Convention>& known = query.stated ? query.stated : query.readAs;
  set.convention = o.writing.writing({.world = world.value_or(known.value_or(Convention{}).world)});
  writeOutput(writeMatrices(set, form, source));
  return 0;
}

/// Matrix by matrix: the readings of one take many times the memory of its numbers.
int runReport(const InspectOptions& o, const std::vector<WrittenMatrix>& matrices, const InspectQuery& query,
              const std::string& source) {
  const bool isJson = o.form == "json";
  const int digits = o.digits ? static_cast<int>(*o.digits) : isJson ? 0 : kTableDigits;
  if (isJson)
    writeOutput(std::string("{\"entries\": \"") + (query.isFloat ? "float32" : "float64") + "\", \"matrices\": [");
  bool allFit = true;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    OrderedJson report;
    try {
      report = inspectReport(matrices[i], query);
    } catch (const CameraError& e) {
      throw InputError(source + ": " + matrices[i].name + ": " + e.message() +
                       "; three rows are K or K [R | t], and any other matrix has 16 numbers");
    }
    allFit = allFit && (matrices[i].isCalibration() || !report["readings"].empty());
    writeOutput(isJson ? (i > 0 ? ",\n  " : "\n  ") + jsonText(report, digits, 1)
                       : (i > 0 ? "\n" : "") + tableText(inspectPage(report), digits));
  }
  if (isJson) writeOutput("\n]}\n");
  return allFit ? 0 : 1;
}

int runInspect(const InspectOptions& o, const CLI::App& app) {
  const bool converts = o.writing.namesConvention();
  if (o.writing.namesAxis() && !converts)
    throw UsageError("--reverse-z and --ndc-z go with --convention NAME, the convention to write");
  const bool isReport = !o.form || o.form == "table" || o.form == "json";
  if (!converts && !isReport)
    throw UsageError("--to " + std::string(*o.form) + ": expected table or json; --convention NAME writes matrices");
  if (converts && isReport && o.form && *o.form != "json")
    throw UsageError("--to " + std::string(*o.form) + ": with --convention expected a form of matrices, as json or c");
  const std::string file = inputFile(app).value_or("-"), source = shownName(file);
  WrittenMatrices given = parseMatrices(readWholeFile(file, kMostBytes), source);
  const InspectQuery query{o.isFloat || given.isFloat, o.readAs, given.convention};
  const std::vector<WrittenMatrix> matrices = chooseMatrices(std::move(given.matrices), o.which, source);
  if (o.readAs && std::any_of(matrices.begin(), matrices.end(), [](const auto& m) { return m.isCalibration(); }))
    throw UsageError("--read-as: a calibration of three rows has one reading, in no convention");
  return converts ? runConversion(o, matrices, query, source) : runReport(o, matrices, query, source);
}

}  // namespace

Action declareInspect(CLI::App& app) {
  const auto o = std::make_shared<InspectOptions>();
  app.description(
      "Every reading of a 4x4 matrix: which conventions it can be written in, and the camera in it; with --convention "
      "the same matrix in another convention. Of three rows of three or four numbers, K or P of a calibration, the "
      "camera. The exit status is 1 where nothing fits.");
  app.footer(
      "Examples:\n"
      "  viewproj matrix --fov-y 60 --aspect 16/9 --near 0.1 --to c | viewproj inspect\n"
      "  echo '[[800,0,320],[0,800,240],[0,0,1]]' | viewproj inspect");
  addValue(app, "FILE", "", o->operand, readFileName,
           "The matrices: JSON, an initialiser of C, HLSL, GLSL or NumPy, or rows of numbers; absent or - for standard "
           "input");
  addValue(app, "--which", "NAMES", o->which, splitNames, "Of several matrices only these, by name");
  app.add_flag("--float", o->isFloat, "The numbers are float32s (default: doubles)");
  addChoice(app, "--read-as", "NAME", o->readAs, presetChoices(), "Only readings of this convention", "all");
  auto forms = matrixForms();
  forms.insert(forms.begin(), {"table", "table", ".txt"});
  addForm(app, o->form, std::span<const FormRow<std::string_view>>(forms),
          "Output format; without --convention table or json", "table; with --convention json");
  addDigits(app, o->digits, "all, 9 in a table");
  o->writing.addWriting(app);
  return [o, &app] { return runInspect(*o, app); };
}

}  // namespace viewproj::cmd
