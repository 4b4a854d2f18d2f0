#include <algorithm>
#include <array>
#include <cmath>

#include "camera/names.hpp"
#include "camera/write_camera.hpp"
#include "commands/explain/explain.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// The part of a name before its last dot.
std::string stemOf(const std::string& name) { return name.substr(0, name.rfind('.')); }

std::string lossInWords(const Line& line) {
  if (line.lost == 0) return "";
  if (line.lost == kAllDigits) return "cancels to 0";
  return "cancels: " + std::to_string(line.lost) + (line.lost == 1 ? " digit lost" : " digits lost");
}

class Table {
 public:
  Table(const Explanation& explanation, int digits) : e_(explanation), digits_(digits) {}

  std::string text() const {
    const Convention& c = e_.writing();
    std::string out = "written with view " + std::string(nameOf(kViewNames, c.view)) + ", NDC z " +
                      std::string(nameOf(kNdcZNames, c.ndcZ)) + (c.reverseZ ? " reversed" : "") + ", NDC y " +
                      std::string(nameOf(kNdcYNames, c.ndcY)) + ", " + std::string(nameOf(kVectorsNames, c.vectors)) +
                      " vectors " + (c.vectors == Vectors::row ? "(v M)" : "(M v)") + ", " +
                      std::string(nameOf(kStorageNames, c.storage)) + "\n";
    for (const Stage& stage : e_.stages()) out += "\n" + stageText(stage);
    out += "\n";
    for (const std::string& remark : e_.remarks()) out += remark + "\n";
    for (const Result& result : e_.results()) out += resultText(result) + "\n";
    return out;
  }

 private:
  std::string number(double value) const { return formatDigits(value, digits_); }
  std::string factor(double value) const { return value < 0 ? "(" + number(value) + ")" : number(value); }

  std::string stageText(const Stage& stage) const {
    std::string out = stage.name + ": " + stage.says + "\n";
    for (const ShownMatrix& m : stage.matrices) out += matrixText(m);
    std::size_t width = 0;
    for (const Line& line : stage.lines)
      if (line.kind != LineKind::given) width = std::max(width, line.name.size());
    for (std::size_t i = 0; i < stage.lines.size();) {
      std::size_t end = i + 1;
      if (isPlain(stage.lines[i]))
        while (end < stage.lines.size() && isPlain(stage.lines[end]) &&
               stemOf(stage.lines[end].name) == stemOf(stage.lines[i].name))
          ++end;
      out += end - i > 1 ? givenText(stage.lines, i, end) : lineText(stage.lines[i], width);
      i = end;
    }
    return out;
  }

  static bool isPlain(const Line& line) { return line.kind == LineKind::given && line.remark.empty(); }

  /// Given numbers of one name: as a vector, or each with its own.
  std::string givenText(const std::vector<Line>& lines, std::size_t from, std::size_t to) const {
    const std::string stem = stemOf(lines[from].name);
    const bool isVector = lines[from].name.ends_with(".x");
    std::vector<std::string> parts;
    for (std::size_t i = from; i < to; ++i)
      parts.push_back((isVector ? "" : lines[i].name.substr(stem.size() + 1) + " ") + number(lines[i].value));
    return "  " + stem + " = " + (isVector ? "(" + joined(parts) + ")" : joined(parts)) + "\n";
  }

  std::string matrixText(const ShownMatrix& m) const {
    std::array<std::size_t, 4> widths{};
    for (const auto& row : m.matrix.m)
      for (std::size_t j = 0; j < 4; ++j) widths[j] = std::max(widths[j], number(row[j]).size());
    std::string out;
    for (std::size_t i = 0; i < 4; ++i) {
      out += i == 0 ? "  " + m.name + " =" : std::string(m.name.size() + 4, ' ');
      for (std::size_t j = 0; j < 4; ++j) {
        const std::string cell = number(m.matrix[i][j]);
        out += std::string(widths[j] - cell.size() + 2, ' ') + cell;
      }
      out += "\n";
    }
    return out;
  }

  std::string termText(const Term& term, bool isFirst) const {
    std::vector<std::string> factors;
    bool minus = false;
    for (const std::string& name : term) {
      if (name == "-1")
        minus = true;
      else
        factors.push_back(factor(e_.valueOf(name)));
    }
    // A lone first number needs no brackets.
    if (isFirst && !minus && term.size() == 1) factors[0] = number(e_.valueOf(term[0]));
    return (isFirst ? (minus ? "-" : "") : minus ? " - " : " + ") + joined(factors, "*");
  }

  std::string madeOf(const Line& line) const {
    if (line.kind == LineKind::quotient)
      return number(e_.valueOf(line.terms[0][0])) + " / " + factor(e_.valueOf(line.terms[0][1])) + " = ";
    std::string out;
    for (const Term& term : line.terms) out += termText(term, out.empty());
    if (line.kind == LineKind::root) return "sqrt(" + out + ") = ";
    const bool isItself = line.terms.size() == 1 && line.terms[0].size() == 1;
    return line.terms.empty() || isItself ? "" : out + " = ";
  }

  std::string lineText(const Line& line, std::size_t width) const {
    const std::size_t padding = line.kind == LineKind::given || line.name.size() > width ? 0 : width - line.name.size();
    std::string out = "  " + line.name + std::string(padding, ' ') + " = " +
                      (line.kind == LineKind::given ? "" : madeOf(line)) + number(line.value);
    std::vector<std::string> notes;
    if (!line.remark.empty()) notes.push_back(line.remark);
    if (line.lost > 0) notes.push_back(lossInWords(line));
    return out + (notes.empty() ? "" : "   " + joined(notes, "; ")) + "\n";
  }

  std::string resultText(const Result& r) const {
    if (r.flag) return r.name + ": " + (*r.flag ? "true" : "false");
    if (r.words) return r.name + ": " + joined(*r.words, " ");
    std::vector<std::string> parts;
    for (double value : r.numbers) parts.push_back(number(value));
    const bool isNone = std::any_of(r.numbers.begin(), r.numbers.end(), [](double v) { return !std::isfinite(v); });
    return r.name + ": " + (isNone ? "null" : parts.size() == 1 ? parts[0] : "[" + joined(parts) + "]");
  }

  const Explanation& e_;
  int digits_;
};

class JsonText {
 public:
  JsonText(const Explanation& explanation, int digits) : e_(explanation), digits_(digits) {}

  std::string text() const {
    std::vector<std::string> stages;
    for (const Stage& stage : e_.stages()) stages.push_back(stageText(stage));
    JsonObject results, out;
    for (const Result& result : e_.results()) results.addText(result.name, resultText(result));
    out.addText("convention", jsonOf(e_.writing())).addText("stages", jsonList(stages, ",\n  "), ",\n ");
    out.addText("remarks", jsonListOf(e_.remarks()), ",\n ").addText("result", results.text(), ",\n ");
    return out.text() + "\n";
  }

 private:
  std::string number(double value) const { return formatDigits(value, digits_); }

  std::string stageText(const Stage& stage) const {
    JsonObject matrices, out;
    std::vector<std::string> lines;
    for (const ShownMatrix& m : stage.matrices) matrices.addText(m.name, matrixText(m.matrix));
    for (const Line& line : stage.lines) lines.push_back(lineText(line));
    out.add("name", stage.name).add("says", stage.says);
    if (!stage.matrices.empty()) out.addText("matrices", matrices.text(), ",\n   ");
    return out.addText("lines", jsonList(lines, ",\n    "), ",\n   ").text();
  }

  std::string matrixText(const Mat4& m) const {
    std::vector<std::string> rows;
    for (const auto& row : m.m) rows.push_back(jsonList(numbers(row)));
    return jsonList(rows);
  }

  std::string lineText(const Line& line) const {
    JsonObject out;
    out.add("name", line.name).addText("value", number(line.value));
    std::vector<std::string> terms;
    for (const Term& term : line.terms) terms.push_back(jsonListOf(term));
    if (line.kind == LineKind::sum) out.addText("sum", jsonList(terms));
    if (line.kind == LineKind::root) out.addText("rootOfSum", jsonList(terms));
    if (line.kind == LineKind::quotient) out.addText("quotient", terms[0]);
    if (line.lost == kAllDigits)
      out.add("cancels", "to 0");
    else if (line.lost > 0)
      out.addText("cancels", std::to_string(line.lost));
    if (!line.remark.empty()) out.add("remark", line.remark);
    return out.text();
  }

  std::string resultText(const Result& r) const {
    if (r.flag) return jsonOf(*r.flag);
    if (r.words) return jsonListOf(*r.words);
    if (std::any_of(r.numbers.begin(), r.numbers.end(), [](double v) { return !std::isfinite(v); })) return "null";
    const std::vector<std::string> parts = numbers(r.numbers);
    return parts.size() == 1 ? parts[0] : jsonList(parts);
  }

  template <class Values>
  std::vector<std::string> numbers(const Values& values) const {
    std::vector<std::string> parts;
    for (double value : values) parts.push_back(number(value));
    return parts;
  }

  const Explanation& e_;
  int digits_;
};

}  // namespace

std::string explanationAsTable(const Explanation& explanation, int digits) { return Table(explanation, digits).text(); }

std::string explanationAsJson(const Explanation& explanation, int digits) {
  return JsonText(explanation, digits).text();
}

}  // namespace viewproj::cmd
