#include "output/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "camera/names.hpp"
#include "output/table.hpp"
#include "text/csv.hpp"
#include "text/layout.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kLongestLine = 140;
constexpr std::size_t kIndent = 2;

bool isScalar(const OrderedJson& value) { return !value.is_structured(); }

bool hasNoValue(const OrderedJson& value) {
  return value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()));
}

bool isVector(const OrderedJson& value) {
  return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), isScalar);
}

bool isNumbers(const OrderedJson& value) {
  return isVector(value) &&
         std::all_of(value.begin(), value.end(), [](const OrderedJson& part) { return part.is_number(); });
}

bool isMatrix(const OrderedJson& value) {
  return value.is_array() && !value.empty() && std::all_of(value.begin(), value.end(), isVector);
}

bool isTable(const OrderedJson& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const OrderedJson& row) { return row.is_object(); });
}

std::string numberText(const OrderedJson& value, int digits) {
  if (!value.is_number_float()) return value.dump();
  const double number = value.get<double>() + 0.0;
  return digits > 0 ? formatDigits(number, digits) : formatNumber(number);
}

// ---- JSON

void appendJson(std::string& out, const OrderedJson& value, int digits, std::size_t level) {
  std::string line = compactJson(value, digits);
  if (isScalar(value) || value.empty() || isNumbers(value) || line.size() + level * kIndent <= kLongestLine) {
    out += line;
    return;
  }
  out += value.is_object() ? '{' : '[';
  for (auto part = value.begin(); part != value.end(); ++part) {
    out += (part == value.begin() ? "\n" : ",\n") + std::string((level + 1) * kIndent, ' ');
    if (value.is_object()) out += OrderedJson(part.key()).dump() + ": ";
    appendJson(out, *part, digits, level + 1);
  }
  out += "\n" + std::string(level * kIndent, ' ') + (value.is_object() ? '}' : ']');
}

// ---- Rows and columns

/// The value of every path of an object, in order: {"a": {"b": 1}} is a.b. A list of scalars is one cell where vectors
/// stay whole.
using Cells = std::vector<std::pair<std::string, const OrderedJson*>>;

void gatherCells(Cells& cells, const OrderedJson& value, const std::string& path, bool vectorsStayWhole) {
  if (isScalar(value) || value.empty() || (vectorsStayWhole && isVector(value))) {
    cells.emplace_back(path, &value);
    return;
  }
  std::size_t index = 0;
  for (auto part = value.begin(); part != value.end(); ++part) {
    const std::string name = value.is_object() ? part.key() : std::to_string(index++);
    gatherCells(cells, *part, path.empty() ? name : path + "." + name, vectorsStayWhole);
  }
}

struct Grid {
  std::vector<std::string> header;
  std::vector<std::vector<const OrderedJson*>> rows;  ///< null where a row has no such column
};

Grid gridOf(const OrderedJson& rows, bool vectorsStayWhole) {
  Grid grid;
  for (const OrderedJson& row : rows) {
    Cells cells;
    gatherCells(cells, row, "", vectorsStayWhole);
    auto& out = grid.rows.emplace_back(grid.header.size(), nullptr);
    std::size_t expected = 0;  // rows are alike: the next column is the likely one
    for (const auto& [name, value] : cells) {
      if (expected >= grid.header.size() || grid.header[expected] != name)
        expected =
            static_cast<std::size_t>(std::find(grid.header.begin(), grid.header.end(), name) - grid.header.begin());
      if (expected == grid.header.size()) grid.header.push_back(name);
      out.resize(grid.header.size(), nullptr);
      out[expected++] = value;
    }
  }
  for (auto& row : grid.rows) row.resize(grid.header.size(), nullptr);
  return grid;
}

// ---- For people

std::string cellText(const OrderedJson& value, int digits) {
  if (value.is_number_float() && std::isinf(value.get<double>()))
    return value.get<double>() > 0 ? "infinite" : "-infinite";
  if (hasNoValue(value) || (value.is_array() && value.empty())) return "-";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number()) return numberText(value, digits);
  std::string out;
  for (const OrderedJson& part : value)
    out += (out.empty() ? "" : part.is_string() ? " " : ", ") + cellText(part, digits);
  return out;
}

std::string gridText(const OrderedJson& value, int digits, std::size_t indent) {
  const Grid grid = gridOf(value, true);
  std::vector<bool> isOfWords(grid.header.size(), false);
  for (const auto& row : grid.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      if (row[i] && (row[i]->is_string() || row[i]->is_array() || row[i]->is_boolean())) isOfWords[i] = true;
  TextRows rows{grid.header};
  for (const auto& row : grid.rows) {
    auto& texts = rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      texts.push_back(!row[i] || (row[i]->is_null() && isOfWords[i]) ? "" : cellText(*row[i], digits));
  }
  return aligned(
      rows, [&](std::size_t column) { return !isOfWords[column]; }, indent);
}

std::string matrixText(const OrderedJson& value, int digits, std::size_t indent) {
  TextRows rows;
  for (const OrderedJson& row : value) {
    auto& texts = rows.emplace_back();
    for (const OrderedJson& entry : row) texts.push_back(cellText(entry, digits));
  }
  return aligned(
      rows, [](std::size_t) { return true; }, indent);
}

void appendSection(std::string& out, const OrderedJson& section, int digits, std::size_t indent) {
  TextRows lines;
  const auto flush = [&] {
    out += aligned(
        lines, [](std::size_t) { return false; }, indent);
    lines.clear();
  };
  const auto heading = [&](const std::string& name) {
    flush();
    if (indent == 0 && !out.empty()) out += "\n";
    out += std::string(indent, ' ') + name + "\n";
  };
  bool afterBlock = false;
  for (const auto& [name, value] : section.items()) {
    const bool isBlock = name == "notes" || (value.is_structured() && !value.empty() && !isVector(value));
    if (!isBlock) {
      if (afterBlock && indent == 0) out += "\n";
      afterBlock = false;
      lines.push_back({name, cellText(value, digits)});
      continue;
    }
    afterBlock = true;
    if (name == "notes") {
      flush();
      if (indent == 0 && !out.empty() && !value.empty()) out += "\n";
      for (const OrderedJson& note : value)
        out += std::string(indent, ' ') + wrapped(note.get<std::string>(), terminalWidth() - indent, indent + kIndent);
      continue;
    }
    heading(name);
    if (isMatrix(value))
      out += matrixText(value, digits, indent + kIndent);
    else if (isTable(value))
      out += gridText(value, digits, indent + kIndent);
    else
      appendSection(out, value, digits, indent + kIndent);
  }
  flush();
}

}  // namespace

OrderedJson asJson(const Vec2& v) { return OrderedJson::array({v.x, v.y}); }
OrderedJson asJson(const Vec3& v) { return OrderedJson::array({v.x, v.y, v.z}); }
OrderedJson asJson(const Vec4& v) { return OrderedJson::array({v.x, v.y, v.z, v.w}); }
OrderedJson asJson(const Mat4& m) { return m.m; }

OrderedJson asJson(const Convention& c) {
  return {{"world", nameOf(kWorldNames, c.world)},      {"view", nameOf(kViewNames, c.view)},
          {"ndcZ", nameOf(kNdcZNames, c.ndcZ)},         {"reverseZ", c.reverseZ},
          {"ndcY", nameOf(kNdcYNames, c.ndcY)},         {"vectors", nameOf(kVectorsNames, c.vectors)},
          {"storage", nameOf(kStorageNames, c.storage)}};
}

std::string compactJson(const OrderedJson& value, int digits) {
  if (hasNoValue(value)) return "null";
  if (value.is_number()) return numberText(value, digits);
  if (isScalar(value)) return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  std::string out(1, value.is_object() ? '{' : '[');
  for (auto part = value.begin(); part != value.end(); ++part) {
    if (part != value.begin()) out += ", ";
    if (value.is_object()) out += OrderedJson(part.key()).dump() + ": ";
    out += compactJson(*part, digits);
  }
  return out + (value.is_object() ? '}' : ']');
}

std::string jsonText(const OrderedJson& value, int digits, std::size_t level) {
  std::string out;
  appendJson(out, value, digits, level);
  return out;
}

std::string tableText(const OrderedJson& report, int digits) {
  std::string out;
  appendSection(out, report, digits, 0);
  return out;
}

std::string csvText(const OrderedJson& rows, int digits) {
  const OrderedJson one = rows.is_object() ? OrderedJson::array({rows}) : OrderedJson();
  const Grid grid = gridOf(rows.is_object() ? one : rows, false);
  std::string out;
  for (std::size_t i = 0; i < grid.header.size(); ++i) out += (i > 0 ? "," : "") + quotedIfNeeded(grid.header[i]);
  out += '\n';
  for (const auto& row : grid.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) out += ',';
      if (!row[i] || hasNoValue(*row[i]) || row[i]->is_structured()) continue;
      out += quotedIfNeeded(row[i]->is_string() ? row[i]->get<std::string>() : compactJson(*row[i], digits));
    }
    out += '\n';
  }
  return out;
}

}  // namespace viewproj::cmd
