#include "output/matrix_text.hpp"

#include <algorithm>
#include <cmath>

#include "camera/convention.hpp"
#include "camera/depth.hpp"
#include "output/camera_json.hpp"
#include "output/identifiers.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

void appendEntry(std::string& out, double value, bool asFloat) {
  if (asFloat)
    appendNumber(out, static_cast<float>(value));
  else
    appendNumber(out, value);
}

std::string row(const std::array<double, 4>& entries, std::string_view separator, bool asFloat) {
  std::string text;
  for (double entry : entries) {
    if (!text.empty()) text += separator;
    appendEntry(text, entry, asFloat);
  }
  return text;
}

/// Rows as the convention writes them on paper, and every axis of the convention.
std::string asJson(const MatrixSet& set) {
  const std::string_view line = set.camera ? ", " : ",\n  ";
  JsonObject out;
  if (set.camera) out.add("camera", *set.camera);
  out.addText("convention", jsonOf(set.convention), line);
  if (set.eye) out.addText("eye", jsonListOf(std::array{set.eye->x, set.eye->y, set.eye->z}), line);
  for (const NamedMatrix& named : set.matrices) {
    std::vector<std::string> rows;
    for (const auto& entries : laidOut(named.matrix, set.convention).m)
      rows.push_back("[" + row(entries, ", ", set.asFloat) + "]");
    std::string matrix = jsonList(rows, set.camera ? ", " : ",\n    ");
    if (!set.camera) matrix.insert(matrix.size() - 1, "\n  ");
    out.addText(named.name, matrix, line);
  }
  return set.camera ? out.text() + "\n" : "{\n  " + out.members() + "\n}\n";
}

/// Rows on paper in aligned columns, under a line with the name.
std::string asText(const MatrixSet& set) {
  std::string out;
  if (set.eye)
    out +=
        "# eye\n" + formatNumber(set.eye->x) + " " + formatNumber(set.eye->y) + " " + formatNumber(set.eye->z) + "\n\n";
  for (const NamedMatrix& named : set.matrices) {
    if (&named != &set.matrices.front()) out += '\n';
    out += "# " + named.name + "\n";
    const Mat4 paper = laidOut(named.matrix, set.convention);
    std::array<std::array<std::string, 4>, 4> cells;
    std::array<std::size_t, 4> width{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        appendEntry(cells[i][j], paper[i][j], set.asFloat);
        width[j] = std::max(width[j], cells[i][j].size());
      }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        out += std::string(width[j] - cells[i][j].size(), ' ') + cells[i][j] + (j < 3 ? "  " : "\n");
  }
  return out;
}

/// A JSON array of the sixteen numbers in memory order, a matrix a line.
std::string asFlat(const MatrixSet& set) {
  std::string out;
  for (const NamedMatrix& named : set.matrices) {
    out += '[';
    for (double entry : inStorageOrder(named.matrix, set.convention)) {
      if (out.back() != '[') out += ',';
      appendEntry(out, entry, set.asFloat);
    }
    out += "]\n";
  }
  return out;
}

/// Rows on paper, a line each.
std::string asCsv(const MatrixSet& set) {
  std::string out = "matrix,row,column1,column2,column3,column4\n";
  if (set.eye)
    out +=
        "eye,1," + formatNumber(set.eye->x) + "," + formatNumber(set.eye->y) + "," + formatNumber(set.eye->z) + ",\n";
  for (const NamedMatrix& named : set.matrices) {
    const Mat4 paper = laidOut(named.matrix, set.convention);
    for (std::size_t i = 0; i < 4; ++i)
      out += named.name + "," + std::to_string(i + 1) + "," + row(paper[i], ",", set.asFloat) + "\n";
  }
  return out;
}

// Source code: comments that tell the convention, then a constant a matrix.

/// Which way the axes point.
std::string axesInWords(const MatrixSet& set) {
  const Convention& c = set.convention;
  const AxisSigns view = axisSigns(c.view);
  const DepthEnds z = ndcDepths(c);
  return std::string(c.world == Handedness::right ? "Right" : "Left") + "-handed world; view x right, y " +
         (view.up > 0 ? "up" : "down") + ", z " + (view.forward > 0 ? "forward" : "back") +
         (set.bakesViewport ? "; the projection gives screen x, y and window depth, times w"
                            : "; NDC y " + std::string(c.ndcY == NdcY::up ? "up" : "down") + ", z " +
                                  formatNumber(z.atNear) + " at near, " + formatNumber(z.atFar) + " at far");
}

bool hasRowVectors(const MatrixSet& set) { return set.convention.vectors == Vectors::row; }

std::string eyeInWords(const MatrixSet& set) {
  return set.eye ? "Points relative to the eye: subtract " + formatNumber(set.eye->x) + ", " +
                       formatNumber(set.eye->y) + ", " + formatNumber(set.eye->z) + " in double first"
                 : "";
}

/// Each line between begin and end; empty ones are left out.
std::string comments(std::string_view begin, std::initializer_list<std::string> lines, std::string_view end = "") {
  std::string out;
  for (const std::string& line : lines)
    if (!line.empty()) out += std::string(begin) + line + "." + std::string(end) + "\n";
  return out;
}

/// With a point or an exponent, so that no language takes it for an integer.
std::string floating(double value, bool asFloat) {
  std::string text;
  appendEntry(text, value, asFloat);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

/// Four lines of four numbers, each between open and close, commas between them.
std::string fourLines(const Mat4& lines, bool asFloat, std::string_view open = "  ", std::string_view close = "",
                      std::string_view suffix = "") {
  std::string out;
  for (std::size_t i = 0; i < 4; ++i) {
    out += open;
    for (std::size_t j = 0; j < 4; ++j)
      out += floating(lines[i][j], asFloat) + std::string(suffix) + (j < 3 ? ", " : "");
    out += std::string(close) + (i < 3 ? ",\n" : "\n");
  }
  return out;
}

/// Arrays in memory order: what an API takes.
std::string asC(const MatrixSet& set) {
  const bool byColumns = set.convention.storage == Storage::columnMajor;
  std::string out = comments("/* ",
                             {axesInWords(set),
                              std::string(hasRowVectors(set) ? "Row vectors, point * view * projection"
                                                             : "Column vectors, projection * view * point") +
                                  "; in memory " + (byColumns ? "column after column" : "row after row"),
                              eyeInWords(set)},
                             " */");
  const std::string type = set.asFloat ? "float" : "double", suffix = set.asFloat ? "f" : "";
  if (set.eye)
    out += "static const double eye[3] = {" + floating(set.eye->x, false) + ", " + floating(set.eye->y, false) + ", " +
           floating(set.eye->z, false) + "};\n";
  for (const NamedMatrix& named : set.matrices) {
    const Mat4 paper = laidOut(named.matrix, set.convention);
    out += "static const " + type + " " + named.name + "[16] = {\n" +
           fourLines(byColumns ? transposed(paper) : paper, set.asFloat, "  ", "", suffix) + "};\n";
  }
  return out;
}

/// mat4 takes columns; whatever the convention's vectors, M * v is what multiplies here.
std::string asGlsl(const MatrixSet& set) {
  std::string out = comments(
      "// ", {axesInWords(set), "Column vectors, projection * view * point; each line is a column", eyeInWords(set)});
  for (const NamedMatrix& named : set.matrices)
    out += "const mat4 " + named.name + " = mat4(\n" + fourLines(transposed(named.matrix), true) + ");\n";
  return out;
}

std::string asWgsl(const MatrixSet& set) {
  std::string out = comments(
      "// ", {axesInWords(set), "Column vectors, projection * view * point; each line is a column", eyeInWords(set)});
  for (const NamedMatrix& named : set.matrices)
    out += "const " + named.name + " = mat4x4<f32>(\n" + fourLines(transposed(named.matrix), true) + ");\n";
  return out;
}

/// float4x4 takes rows; both mul(v, M) and mul(M, v) are in use, so the convention's vectors decide.
std::string asHlsl(const MatrixSet& set) {
  std::string out =
      comments("// ", {axesInWords(set),
                       std::string(hasRowVectors(set) ? "Row vectors, mul(mul(point, view), projection)"
                                                      : "Column vectors, mul(projection, mul(view, point))") +
                           "; each line is a row",
                       eyeInWords(set)});
  for (const NamedMatrix& named : set.matrices)
    out += "static const float4x4 " + named.name + " = float4x4(\n" +
           fourLines(laidOut(named.matrix, set.convention), true) + ");\n";
  return out;
}

/// matrix3d() takes columns.
std::string asCss(const MatrixSet& set) {
  std::string out =
      comments("/* ",
               {axesInWords(set), "Column vectors, transform: var(--projection) var(--view); each line is a column",
                eyeInWords(set)},
               " */");
  out += ":root {\n";
  for (const NamedMatrix& named : set.matrices)
    out += "  --" + named.name + ": matrix3d(\n" + fourLines(transposed(named.matrix), set.asFloat, "    ") + "  );\n";
  return out + "}\n";
}

/// Rows on paper.
std::string asNumpy(const MatrixSet& set) {
  std::string out = comments("# ", {axesInWords(set),
                                    hasRowVectors(set) ? "Row vectors, point @ view @ projection"
                                                       : "Column vectors, projection @ view @ point",
                                    eyeInWords(set)});
  out += "import numpy as np\n\n";
  if (set.eye)
    out += "eye = np.array([" + floating(set.eye->x, false) + ", " + floating(set.eye->y, false) + ", " +
           floating(set.eye->z, false) + "])\n";
  for (const NamedMatrix& named : set.matrices)
    out += named.name + " = np.array([\n" +
           fourLines(laidOut(named.matrix, set.convention), set.asFloat, "    [", "]") +
           (set.asFloat ? "], dtype=np.float32)\n" : "])\n");
  return out;
}

struct Format {
  std::string_view name;
  std::string_view endings = {};
  std::string_view help;
  std::string (*write)(const MatrixSet&);
  bool onlyFloat = false;     ///< the language's matrices are float32
  bool floatRange = false;    ///< its numbers end where float32 does: browsers hold larger ones down to that
  bool isCode = false;        ///< names are those of source code
  bool numbersAlone = false;  ///< without the convention they are in
};

constexpr Format kMatrixFormats[] = {
    {.name = "json",
     .endings = ".json .ndjson .jsonl",
     .help = "rows on paper, with the convention they are in",
     .write = asJson},
    {.name = "text", .endings = ".txt", .help = "rows in aligned columns", .write = asText, .numbersAlone = true},
    {.name = "flat", .help = "16 numbers in memory order, a matrix a line", .write = asFlat, .numbersAlone = true},
    {.name = "csv",
     .endings = ".csv",
     .help = "a row of the matrix a line",
     .write = asCsv,
     .isCode = true,
     .numbersAlone = true},
    {.name = "c", .endings = ".c .h .cpp .hpp", .help = "arrays in memory order", .write = asC, .isCode = true},
    {.name = "glsl",
     .endings = ".glsl .vert .frag",
     .help = "mat4, for M * v",
     .write = asGlsl,
     .onlyFloat = true,
     .isCode = true},
    {.name = "hlsl", .endings = ".hlsl", .help = "float4x4", .write = asHlsl, .onlyFloat = true, .isCode = true},
    {.name = "wgsl",
     .endings = ".wgsl",
     .help = "mat4x4<f32>, for M * v",
     .write = asWgsl,
     .onlyFloat = true,
     .isCode = true},
    {.name = "css", .endings = ".css", .help = "matrix3d()", .write = asCss, .floatRange = true, .isCode = true},
    {.name = "numpy", .endings = ".py", .help = "np.array", .write = asNumpy, .isCode = true},
};

const Format& formatOf(std::string_view name) {
  return *std::find_if(std::begin(kMatrixFormats), std::end(kMatrixFormats),
                       [&](const Format& f) { return f.name == name; });
}

/// Throws InputError where float32 makes a row or column all 0, and the matrix singular.
void requireEntries(const NamedMatrix& named, const std::string& source) {
  for (const bool byRows : {true, false})
    for (std::size_t i = 0; i < 4; ++i) {
      double largest = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        const double entry = byRows ? named.matrix[i][j] : named.matrix[j][i];
        if (std::fabs(entry) > std::fabs(largest)) largest = entry;
      }
      if (largest != 0 && static_cast<float>(largest) == 0)
        throw InputError(source + ": " + named.name + " is singular in float32: " + formatNumber(largest) +
                         " would be 0, and all beside it is");
    }
}

void requireRepresentable(const MatrixSet& set, const Format& format, const std::string& source) {
  const bool floatRange = set.asFloat || format.floatRange;
  for (const NamedMatrix& named : set.matrices)
    for (const auto& entries : named.matrix.m)
      for (double entry : entries) {
        if (!std::isfinite(floatRange ? static_cast<float>(entry) : entry))
          throw InputError(source + ": " + named.name + " has an entry too large for " +
                           (floatRange ? "float32" : "a double"));
      }
  for (const NamedMatrix& named : set.matrices)
    if (set.asFloat) requireEntries(named, source);
}

}  // namespace

std::vector<FormRow<std::string_view>> matrixForms() {
  std::vector<FormRow<std::string_view>> forms;
  for (const Format& format : kMatrixFormats) forms.push_back({format.name, format.name, format.endings, format.help});
  return forms;
}

bool saysNumbersAlone(std::string_view format) { return formatOf(format).numbersAlone; }

std::string writeMatrices(MatrixSet set, std::string_view format, const std::string& source) {
  const Format& known = formatOf(format);
  set.asFloat = set.asFloat || known.onlyFloat;
  for (NamedMatrix& named : set.matrices)
    for (auto& entries : named.matrix.m)
      for (double& entry : entries) entry = toDigits(entry, set.digits);
  requireRepresentable(set, known, source);
  if (known.isCode) {
    std::vector<std::string> names;
    for (const NamedMatrix& named : set.matrices) names.push_back(named.name);
    names = identifiersOf(names, set.eye ? std::vector<std::string>{"eye"} : std::vector<std::string>{});
    for (std::size_t i = 0; i < names.size(); ++i) set.matrices[i].name = names[i];
  }
  return known.write(set);
}

}  // namespace viewproj::cmd
