#include "output/matrix_text.hpp"

#include "input/convention_names.hpp"
#include "output/number.hpp"
#include "viewproj/view/matrices.hpp"

namespace viewproj::cmd {
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

std::string quotedName(std::string_view name) { return "\"" + std::string(name) + "\""; }

/// Rows as the convention writes them on paper, and every axis of the convention.
std::string asJson(const MatrixSet& set) {
  const Convention& c = set.convention;
  std::string out = "{\n  \"convention\": {\"world\": " + quotedName(nameOf(kWorldNames, c.world)) +
                    ", \"view\": " + quotedName(nameOf(kViewNames, c.view)) +
                    ", \"ndcZ\": " + quotedName(nameOf(kNdcZNames, c.ndcZ)) +
                    ", \"reverseZ\": " + (c.reverseZ ? "true" : "false") +
                    ", \"ndcY\": " + quotedName(nameOf(kNdcYNames, c.ndcY)) +
                    ", \"vectors\": " + quotedName(nameOf(kVectorsNames, c.vectors)) +
                    ", \"storage\": " + quotedName(nameOf(kStorageNames, c.storage)) + "}";
  if (set.eye)
    out += ",\n  \"eye\": [" + formatNumber(set.eye->x) + ", " + formatNumber(set.eye->y) + ", " +
           formatNumber(set.eye->z) + "]";
  for (const NamedMatrix& named : set.matrices) {
    out += ",\n  " + quotedName(named.name) + ": [\n";
    const Mat4 paper = laidOut(named.matrix, c);
    for (std::size_t i = 0; i < 4; ++i) out += "    [" + row(paper[i], ", ", set.asFloat) + (i < 3 ? "],\n" : "]\n");
    out += "  ]";
  }
  return out + "\n}\n";
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

using Format = std::string (*)(const MatrixSet&);
constexpr NameRow<Format> kMatrixFormats[] = {{"json", asJson}, {"text", asText}, {"flat", asFlat}};

}  // namespace

std::vector<std::string_view> matrixFormats() {
  std::vector<std::string_view> names;
  for (const auto& [name, format] : kMatrixFormats) names.push_back(name);
  return names;
}

std::string writeMatrices(const MatrixSet& set, std::string_view format) {
  for (const auto& [name, write] : kMatrixFormats)
    if (name == format) return write(set);
  return "";
}

}  // namespace viewproj::cmd
