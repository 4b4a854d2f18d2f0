#include "output/matrix_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "camera/names.hpp"
#include "camera/read_convention.hpp"
#include "numbers/vectors.hpp"
#include "output/table.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using detail::rounded;
using detail::twoProd;

namespace {

constexpr CameraMatrix kCameraMatrices[] = {
    {"view", true, false, false, false, Space::view, Space::world},
    {"projection", false, true, false, false, Space::clip, Space::view},
    {"viewProjection", true, true, false, false, Space::clip, Space::world},
    {"modelView", true, false, false, true, Space::view, Space::model},
    {"modelViewProjection", true, true, false, true, Space::clip, Space::model},
    {"viewport", false, false, true, false, Space::screen, Space::ndc},
    {"intrinsics", false, true, true, false, Space::screen, Space::view, "K: pixels of points right, down, forward"},
    {"extrinsics", true, false, false, false, Space::view, Space::world, "[R | t]: the world to right, down, forward"},
    {"P", true, true, true, false, Space::screen, Space::world, "P = K [R | t]: pixels of points of the world"},
    {"tangents", false, true, false, false, Space::view, Space::view, "Left, right, up, down: tangents at the eye"},
    {"angles", false, true, false, false, Space::view, Space::view, "Left, right, up, down: radians from the axis"},
};

std::string entryText(double value, bool asFloat) {
  std::string text;
  if (asFloat)
    appendNumber(text, static_cast<float>(value));
  else
    appendNumber(text, value);
  return text;
}

std::array<double, 3> numbersOf(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Entries with separators between them.
template <class Entries>
std::string joinedEntries(const Entries& entries, std::string_view separator, bool asFloat) {
  std::string text;
  for (const double entry : entries) text += (text.empty() ? "" : std::string(separator)) + entryText(entry, asFloat);
  return text;
}

bool isEdges(const NamedMatrix& named) { return named.rows == 1; }

/// Rows on paper: as the convention writes them, or as they are.
std::vector<std::vector<double>> rowsOnPaper(const NamedMatrix& named, const Convention& convention) {
  const Mat4 m = named.comment.empty() ? laidOut(named.matrix, convention) : named.matrix;
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < named.rows; ++i)
    rows.emplace_back(m[i].begin(), m[i].begin() + static_cast<std::ptrdiff_t>(named.columns));
  return rows;
}

std::vector<std::vector<double>> columnsOf(const NamedMatrix& named) {
  if (isEdges(named)) return rowsOnPaper(named, {});
  return rowsOnPaper({named.name, transposed(named.matrix), named.columns, named.rows, "by columns"}, {});
}

/// Rows as the convention writes them on paper, and every axis of the convention.
std::string asJson(const MatrixSet& set) {
  const std::string_view line = set.camera ? ", " : ",\n  ";
  JsonObject out;
  if (set.camera) out.add("camera", *set.camera);
  out.addText("convention", jsonOf(set.convention), line);
  if (set.eye) out.addText("eye", jsonListOf(numbersOf(*set.eye)), line);
  for (const NamedMatrix& named : set.matrices) {
    std::vector<std::string> rows;
    for (const auto& entries : rowsOnPaper(named, set.convention))
      rows.push_back("[" + joinedEntries(entries, ", ", set.asFloat) + "]");
    if (isEdges(named)) {
      JsonObject edges;
      for (std::size_t i = 0; i < std::size(kEdges); ++i)
        edges.addText(kEdges[i], entryText(named.matrix[0][i], set.asFloat));
      out.addText(named.name, edges.text(), line);
      continue;
    }
    std::string matrix = jsonList(rows, set.camera ? ", " : ",\n    ");
    if (!set.camera) matrix.insert(matrix.size() - 1, "\n  ");
    out.addText(named.name, matrix, line);
  }
  return set.camera ? out.text() + "\n" : "{\n  " + out.members() + "\n}\n";
}

/// The numbers in memory order: row after row of what is of no convention.
std::vector<double> inMemory(const NamedMatrix& named, const Convention& convention) {
  const auto stored = inStorageOrder(named.matrix, convention);
  std::vector<double> numbers;
  if (named.comment.empty()) return {stored.begin(), stored.end()};
  for (const auto& row : rowsOnPaper(named, convention)) numbers.insert(numbers.end(), row.begin(), row.end());
  return numbers;
}

/// A JSON array of the numbers in memory order, a matrix a line. JSON has no place for the convention.
std::string asFlat(const MatrixSet& set) {
  std::string out;
  for (const NamedMatrix& named : set.matrices)
    out += "[" + joinedEntries(inMemory(named, set.convention), ",", set.asFloat) + "]\n";
  return out;
}

enum class Lines {
  rows,     ///< as the convention writes them on paper
  columns,  ///< of the matrix for column vectors, whatever the convention's: the language multiplies M * v
  memory,   ///< in the convention's storage order
};

/// What stands before and after something.
struct Around {
  std::string_view open = {}, close = {};
};

/// How source code writes matrices: comments that say the convention, then a constant for each.
struct Language {
  std::string_view name = {}, endings = {}, help = {};
  Lines lines = Lines::columns;
  std::string_view columnProduct = "projection * view * point";  ///< how a point is multiplied
  std::string_view rowProduct = {};    ///< the same for row vectors, where the language has them
  Around comment = {"// "};            ///< each line of it
  Around all = {};                     ///< the constants
  Around eye = {};                     ///< a constant for the eye; empty: the comment has it
  Around asDouble = {}, asFloat = {};  ///< a constant: before its name, and at its end
  std::string_view equals = {};        ///< after its name
  /// What % stands for there, of 4x4, 3x3 and 3x4 matrices and of four numbers; empty: there are none.
  std::array<std::string_view, 4> types = {};
  Around row = {"  "};                ///< of a matrix
  std::string_view between = ",\n";   ///< rows
  std::string_view suffixFloat = {};  ///< after a number
  bool onlyFloat = false;             ///< its matrices are float32
  bool floatRange = false;            ///< its numbers end where float32 does: browsers hold larger ones down to that
};

constexpr Language kLanguages[] = {
    {.name = "c",
     .endings = ".c .h .cpp .hpp",
     .help = "arrays in memory order",
     .lines = Lines::memory,
     .rowProduct = "point * view * projection",
     .comment = {"/* ", " */"},
     .eye = {"static const double eye[3] = {", "};\n"},
     .asDouble = {"static const double ", "};\n"},
     .asFloat = {"static const float ", "};\n"},
     .equals = "[%] = {\n",
     .types = {"16", "9", "12", "4"},
     .suffixFloat = "f"},
    {.name = "glsl",
     .endings = ".glsl .vert .frag",
     .help = "mat4, for M * v",
     .asFloat = {"const % ", ");\n"},
     .equals = " = %(\n",
     .types = {"mat4", "mat3", "mat4x3", "vec4"},
     .onlyFloat = true},
    {.name = "hlsl",
     .endings = ".hlsl",
     .help = "float4x4",
     .lines = Lines::rows,
     .columnProduct = "mul(projection, mul(view, point))",
     .rowProduct = "mul(mul(point, view), projection)",
     .asFloat = {"static const % ", ");\n"},
     .equals = " = %(\n",
     .types = {"float4x4", "float3x3", "float3x4", "float4"},
     .onlyFloat = true},
    {.name = "wgsl",
     .endings = ".wgsl",
     .help = "mat4x4<f32>, for M * v",
     .asFloat = {"const ", ");\n"},
     .equals = " = %(\n",
     .types = {"mat4x4<f32>", "mat3x3<f32>", "mat4x3<f32>", "vec4<f32>"},
     .onlyFloat = true},
    {.name = "rust",
     .endings = ".rs",
     .help = "[[f32; 4]; 4], for M * v",
     .asFloat = {"const ", "];\n"},
     .equals = ": % = [\n",
     .types = {"[[f32; 4]; 4]", "[[f32; 3]; 3]", "[[f32; 3]; 4]", "[f32; 4]"},
     .row = {"  [", "]"},
     .onlyFloat = true},
    {.name = "css",
     .endings = ".css",
     .help = "matrix3d()",
     .columnProduct = "transform: var(--projection) var(--view)",
     .comment = {"/* ", " */"},
     .all = {":root {\n", "}\n"},
     .asDouble = {"  --", "  );\n"},
     .asFloat = {"  --", "  );\n"},
     .equals = ": %(\n",
     .types = {"matrix3d"},
     .row = {"    "},
     .floatRange = true},
    {.name = "numpy",
     .endings = ".py",
     .help = "np.array",
     .lines = Lines::rows,
     .columnProduct = "projection @ view @ point",
     .rowProduct = "point @ view @ projection",
     .comment = {"# "},
     .all = {"import numpy as np\n\n"},
     .eye = {"eye = np.array([", "])\n"},
     .asDouble = {"", "])\n"},
     .asFloat = {"", "], dtype=np.float32)\n"},
     .equals = " = np.array([\n",
     .row = {"    [", "]"}},
    {.name = "matlab",
     .endings = ".m",
     .help = "matrices",
     .lines = Lines::rows,
     .columnProduct = "projection * view * point",
     .rowProduct = "point * view * projection",
     .comment = {"% "},
     .asDouble = {"", "];\n"},
     .asFloat = {"", "];\n"},
     .equals = " = [\n",
     .between = ";\n"},
};

/// A text of a language with the type of a matrix in place of %. Throws InputError where the language has no such type.
std::string withType(std::string_view text, const Language& language, const NamedMatrix& named) {
  const std::size_t at = text.find('%');
  if (at == std::string_view::npos) return std::string(text);
  const std::string_view type = language.types[isEdges(named) ? 3 : named.rows == 4 ? 0 : named.columns == 3 ? 1 : 2];
  if (type.empty())
    throw InputError("--to " + std::string(language.name) + ": has no place for " + named.name +
                     ", which is no 4x4 matrix");
  return std::string(text.substr(0, at)) + std::string(type) + std::string(text.substr(at + 1));
}

/// Which way the axes point, how a point is multiplied, and what a line of four numbers is.
std::string conventionComment(const MatrixSet& set, const Language& language) {
  const Convention& c = set.convention;
  const bool reversed = c.reverseZ, minusOne = c.ndcZ == NdcZ::minusOneToOne;
  const std::string low = minusOne ? "-1" : "0";
  const bool rowVectors = c.vectors == Vectors::row && !language.rowProduct.empty();
  const bool byColumns =
      language.lines == Lines::columns || (language.lines == Lines::memory && c.storage == Storage::columnMajor);
  std::vector<std::string> lines = {
      std::string(c.world == Handedness::right ? "Right" : "Left") + "-handed world; view x right, y " +
          (c.view == ViewAxes::RDF ? "down" : "up") + ", z " + (c.view == ViewAxes::RUB ? "back" : "forward") +
          (set.bakesViewport ? "; the projection gives screen x, y and window depth, times w"
                             : "; NDC y " + std::string(nameOf(kNdcYNames, c.ndcY)) + ", z " + (reversed ? "1" : low) +
                                   " at near, " + (reversed ? low : "1") + " at far"),
      (rowVectors ? "Row vectors, " + std::string(language.rowProduct)
                  : "Column vectors, " + std::string(language.columnProduct)) +
          (language.lines == Lines::memory
               ? (byColumns ? "; in memory column after column" : "; in memory row after row")
               : (byColumns ? "; each line is a column" : "; each line is a row"))};
  if (std::all_of(set.matrices.begin(), set.matrices.end(), [](const NamedMatrix& m) { return !m.comment.empty(); }))
    lines.clear();
  if (set.eye)
    lines.push_back("Points relative to the eye: subtract " + joinedEntries(numbersOf(*set.eye), ", ", false) +
                    " in double first");
  std::string out;
  for (const std::string& line : lines)
    out += std::string(language.comment.open) + line + "." + std::string(language.comment.close) + "\n";
  return out;
}

/// What a matrix of no convention is.
std::string calibrationComment(const NamedMatrix& named, const Language& language) {
  if (named.comment.empty()) return "";
  const char* const lines = isEdges(named)                     ? ""
                            : language.lines == Lines::columns ? "; each line is a column"
                            : language.lines == Lines::memory  ? "; in memory row after row"
                                                               : "; each line is a row";
  return std::string(language.comment.open) + std::string(named.comment) + lines + "." +
         std::string(language.comment.close) + "\n";
}

/// With a point or an exponent, so that no language takes it for an integer.
std::string floating(double value, bool asFloat) {
  const std::string text = entryText(value, asFloat);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string asCode(const MatrixSet& set, const Language& language) {
  const auto lineOf = [&](const auto& entries, bool asFloat) {
    std::string line;
    for (const double entry : entries)
      line += (line.empty() ? "" : ", ") + floating(entry, asFloat) + std::string(asFloat ? language.suffixFloat : "");
    return line;
  };
  std::string out = conventionComment(set, language) + std::string(language.all.open);
  if (set.eye && !language.eye.open.empty())
    out += std::string(language.eye.open) + lineOf(numbersOf(*set.eye), false) + std::string(language.eye.close);
  const Around& constant = set.asFloat ? language.asFloat : language.asDouble;
  const bool turned = language.lines == Lines::memory && set.convention.storage == Storage::columnMajor;
  for (const NamedMatrix& named : set.matrices) {
    auto lines = language.lines == Lines::columns ? columnsOf(named) : rowsOnPaper(named, set.convention);
    if (turned && named.comment.empty()) {
      NamedMatrix paper = named;
      paper.matrix = laidOut(named.matrix, set.convention);
      lines = columnsOf(paper);
    }
    out += calibrationComment(named, language) + withType(constant.open, language, named) + named.name +
           withType(language.equals, language, named);
    const Around row = isEdges(named) ? Around{"  "} : language.row;
    for (std::size_t i = 0; i < lines.size(); ++i)
      out += std::string(row.open) + lineOf(lines[i], set.asFloat) + std::string(row.close) +
             std::string(i + 1 < lines.size() ? language.between : "\n");
    out += constant.close;
  }
  return out + std::string(language.all.close);
}

/// Rows on paper in aligned columns, under a line with the name.
std::string asText(const MatrixSet& set) {
  constexpr Language kText{.lines = Lines::rows, .rowProduct = "point * view * projection", .comment = {"# "}};
  std::string out = conventionComment(set, kText);
  if (set.eye) out += "\n# eye\n" + joinedEntries(numbersOf(*set.eye), " ", false) + "\n";
  for (const NamedMatrix& named : set.matrices) {
    out += (out.empty() ? "# " : "\n# ") + named.name + "\n" + calibrationComment(named, kText);
    TextRows rows;
    for (const auto& row : rowsOnPaper(named, set.convention)) {
      auto& texts = rows.emplace_back();
      for (const double entry : row) texts.push_back(entryText(entry, set.asFloat));
    }
    out += aligned(rows, [](std::size_t) { return true; });
  }
  return out;
}

/// Throws InputError where float32 makes a row or column all 0, and the matrix singular; and for what is too large.
void requireRepresentable(const MatrixSet& set, bool floatRange, const std::string& source) {
  for (const NamedMatrix& named : set.matrices)
    for (const bool byRows : {true, false})
      for (const auto& line : (byRows ? named.matrix : transposed(named.matrix)).m) {
        const double largest = *std::max_element(line.begin(), line.end(),
                                                 [](double a, double b) { return !(std::fabs(a) >= std::fabs(b)); });
        if (!std::isfinite(floatRange ? static_cast<float>(largest) : largest))
          throw InputError(source + ": " + named.name + " has an entry too large for " +
                           (floatRange ? "float32" : "a double"));
        if (set.asFloat && largest != 0 && static_cast<float>(largest) == 0)
          throw InputError(source + ": " + named.name + " is singular in float32: " + formatNumber(largest) +
                           " would be 0, and all beside it is");
      }
}

/// Constants of the matrices' names. Our own are no word of any of the languages; of any other, m_ makes it none.
void makeIdentifiers(std::vector<NamedMatrix>& matrices) {
  std::unordered_set<std::string> used;
  std::unordered_map<std::string, std::size_t> next;  // number of a name, so that many of one name take no longer
  for (NamedMatrix& named : matrices) {
    std::string name;
    const bool isOwn =
        std::any_of(std::begin(kCameraMatrices), std::end(kCameraMatrices), [&](const CameraMatrix& row) {
          return named.name == row.name || named.name == std::string(row.name) + std::string(kInverse);
        });
    for (const char c : isOwn ? named.name : "m_" + named.name) {
      const bool good = std::isalnum(static_cast<unsigned char>(c)) != 0;
      if (good || !name.ends_with('_')) name += good ? c : '_';  // two _ in a row are the languages' own
    }
    std::size_t& number = next.try_emplace(name, 2).first->second;
    for (named.name = name; !used.insert(named.name).second; ++number)
      named.name = name + (name.ends_with('_') ? "" : "_") + std::to_string(number);
  }
}

/// The edges of the window, left, right, up, down; or K, [R | t] or K [R | t], of the pixels as the viewport counts
/// them.
NamedMatrix calibrationMatrix(const CameraMatrix& row, const MatrixSource& s) {
  const CameraFile& f = s.file;
  if (row.projection && f.projection->isOrthographic())
    f.fail(f.name + ": an orthographic camera has no " + std::string(row.name));
  if (row.pose && f.convention.world == Handedness::left)
    f.fail(f.name + ": " + std::string(row.name) + " is of right-handed worlds; --map x,y,-z mirrors this one");
  NamedMatrix named{std::string(row.name), {}, 3, 4, std::string(row.ofCalibration)};
  if (row.viewport) {
    const std::string center = formatNumber(f.viewport->pixelCenter);
    named.comment += "; the first pixel's centre is " + center + ", " + center;
  }
  if (!row.pose && !row.viewport) {
    named.rows = 1;
    const Projection& p = *f.projection;
    named.matrix[0] = {p.left(), p.right(), p.top(), p.bottom()};
    for (double& edge : named.matrix[0])
      if (row.name == "angles") edge = std::atan(edge);
    return named;
  }
  Convention rightDownForward;
  rightDownForward.view = ViewAxes::RDF;
  const std::optional<Pose> pose = s.relativeToEye && f.pose ? movedTo(*f.pose, Vec3{}) : f.pose;
  const Camera camera = cameraIn(rightDownForward, pose, f.projection, f.viewport);
  if (row.pose) named.matrix = matrix(camera, Space::view, Space::world);
  if (!row.viewport) return named;
  const Intrinsics k = camera.intrinsics();
  const double fy = f.viewport->origin == Origin::bottomLeft ? -k.fy : k.fy;
  if (!row.pose) {
    named.columns = 3;
    named.matrix = {{{{k.fx, 0, k.cx, 0}, {0, fy, k.cy, 0}, {0, 0, 1, 0}, {}}}};
    return named;
  }
  for (std::size_t j = 0; j < 4; ++j) {
    const double z = named.matrix[2][j];
    named.matrix[0][j] = rounded(twoProd(k.fx, named.matrix[0][j]) + twoProd(k.cx, z));
    named.matrix[1][j] = rounded(twoProd(fy, named.matrix[1][j]) + twoProd(k.cy, z));
  }
  return named;
}

}  // namespace

std::span<const CameraMatrix> cameraMatrices() { return kCameraMatrices; }

NamedMatrix CameraMatrix::make(const MatrixSource& s, bool inverse) const {
  const CameraFile& f = s.file;
  if (!ofCalibration.empty()) {
    if (inverse) throw UsageError("--inverse is for 4x4 matrices, not for " + std::string(name));
    return calibrationMatrix(*this, s);
  }
  const Space destination = to == Space::clip && s.bakeViewport ? Space::screen : to;
  const std::optional<Pose> eyeAtOrigin = s.relativeToEye && f.pose && !model ? movedTo(*f.pose, Vec3{}) : f.pose;
  const Camera camera = cameraIn(s.convention, eyeAtOrigin, f.projection, f.viewport);
  const Space first = inverse ? from : destination, second = inverse ? destination : from;
  return {std::string(name) + std::string(inverse ? kInverse : ""),
          model ? matrix(camera, first, second, *s.worldFromLocal) : matrix(camera, first, second)};
}

std::vector<FormRow<std::string_view>> matrixForms() {
  std::vector<FormRow<std::string_view>> forms = {
      {"json", "json", ".json .ndjson .jsonl", "rows on paper, with the convention"},
      {"text", "text", ".txt", "rows in aligned columns"},
      {"flat", "flat", "", "16 numbers in memory order, a matrix a line; without the eye"}};
  for (const Language& language : kLanguages)
    forms.push_back({language.name, language.name, language.endings, language.help});
  return forms;
}

std::string writeMatrices(MatrixSet set, std::string_view format, const std::string& source) {
  const auto language = std::find_if(std::begin(kLanguages), std::end(kLanguages),
                                     [&](const Language& row) { return row.name == format; });
  const bool isCode = language != std::end(kLanguages);
  set.asFloat = set.asFloat || (isCode && language->onlyFloat);
  requireRepresentable(set, set.asFloat || (isCode && language->floatRange), source);
  if (!isCode) return format == "json" ? asJson(set) : format == "text" ? asText(set) : asFlat(set);
  makeIdentifiers(set.matrices);
  return asCode(set, *language);
}

}  // namespace viewproj::cmd
