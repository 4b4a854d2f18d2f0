// The matrices of a text with the names that it has for them.
#include "text/pasted_matrices.hpp"

#include <algorithm>
#include <iterator>
#include <regex>

#include "text/pasted_parts.hpp"

namespace viewproj::cmd {
namespace {

using namespace pasted;

/// Whether the text says that what stands in a row is a column.
bool saysColumns(std::string_view text) {
  const std::string t = lower(text);
  for (const char* word : {"matrix3d", "simd_float", "simd_double", "x_axis", "from_cols", "setcolumn"})
    if (t.find(word) != kNone) return true;
  if (const std::size_t x = t.find("[x:"); x != kNone)
    if (const std::size_t next = t.find_first_not_of(" \t", x + 3); next != kNone && t[next] == '(') return true;
  for (std::size_t at = t.find("mat"); at != kNone; at = t.find("mat", at + 1)) {
    const std::size_t begin = at > 0 && t[at - 1] == 'd' ? at - 1 : at;
    std::size_t end = at + 3;
    while (end < t.size() && isNamePart(t[end])) ++end;
    const std::string_view size = std::string_view(t).substr(at + 3, end - at - 3);
    if ((begin == 0 || !isNamePart(t[begin - 1])) && isOneOf(size, {"3", "4", "3x3", "3x4", "4x3", "4x4"})) return true;
  }
  return false;
}

/// Two letters in a row.
bool hasWord(std::string_view line) {
  const auto isWordLetter = [](char c) { return isNameStart(c) && c != '_'; };
  return std::adjacent_find(line.begin(), line.end(),
                            [&](char a, char b) { return isWordLetter(a) && isWordLetter(b); }) != line.end();
}

struct PlainLine {
  std::string_view text;
  bool isPrinted = false;  ///< a name alone, behind a prompt or a command
};
/// "(gdb) p T_cam", "[INFO] T_cam" and "print(T_cam)" without the prompt, the level of a log and the command.
PlainLine withoutCommand(std::string_view line) {
  static const std::regex front(
      R"(^(?:(\((?:gdb|lldb|pdb)\)|>{1,3}|In \[\d+\]:)|\[?(?:info|debug|trace|warn|warning|error)\b\]?:?)\s+)",
      std::regex::icase);
  static const std::regex command(
      R"(^(?:(?:p|print|po|display|disp|call|expr|v|frame variable)(?:/\w+)?|println!?|console\.log|Debug\.Log)[ (]+)"
      R"(([\w$.:>-]+)[);]*$)");
  static const std::regex name(R"(^[A-Za-z_$][\w$.>\[\]-]*$)");
  constexpr std::size_t kLongest = 200;
  line = line.substr(0, line.find_last_not_of(" \t") + 1);
  if (line.size() > kLongest) return {line};
  const auto finds = [&](std::cmatch& found, const std::regex& what) {
    return std::regex_search(line.data(), line.data() + line.size(), found, what);
  };
  std::cmatch prompt, found;
  if (finds(prompt, front)) line.remove_prefix(static_cast<std::size_t>(prompt.length(0)));
  if (finds(found, command))
    return {line.substr(static_cast<std::size_t>(found.position(1)), static_cast<std::size_t>(found.length(1))), true};
  return {line, prompt.length(1) > 0 && finds(found, name)};
}

/// The headings of a line: what blanks or a colon part, without marks.
std::vector<std::string_view> headingsOf(std::string_view line) {
  std::vector<std::string_view> headings;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != kNone;) {
    const std::size_t end = std::min({line.find("  ", at), line.find('\t', at), line.find(':', at), line.size()});
    headings.push_back(line.substr(at, end - at));
    at = std::min(line.find_first_not_of(':', end), line.size());
  }
  return headings;
}

/// What the lines in front and the brackets around call the matrices.
class Namer {
 public:
  Namer(std::string_view text, const std::vector<Bracket>& brackets) : brackets_(brackets) {
    for (std::size_t at = 0; at <= text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      lines_.push_back(text.substr(at, end - at));
      at = end + 1;
    }
  }

  /// In front of each line: how many empty ones, which may have the mark of a quote or comment.
  std::vector<std::size_t> emptyLines() const {
    std::vector<std::size_t> count(lines_.size() + 2);
    for (std::size_t i = 1; i <= lines_.size(); ++i)
      count[i + 1] = count[i] + (line(i).find_first_not_of("#/%*> \t\v\f") == kNone ? 1 : 0);
    return count;
  }

  void name(PastedMatrix& m, const Block& block) {
    const Number& first = *block.numbers.front();
    m.line = first.line;
    std::string_view label, around, prose;
    for (const Number* n : block.numbers)
      if (label.empty()) label = n->label;
    for (std::size_t b = first.bracket; b != 0; b = brackets_[b].parent) {
      const Bracket& bracket = brackets_[b];
      if (around.empty() && bracket.key != kColumnsApart && !isGeneric(bracket.key)) around = bracket.key;
      m.isByColumns = m.isByColumns || saysColumns(bracket.callee);
      m.isCss = m.isCss || bracket.callee.find("matrix3d") != kNone;
    }
    const bool isNear = first.keyLine > lastLine_ || first.keyLine == m.line;
    std::vector<std::string_view> front;
    for (std::size_t i = m.line - 1; i > lastLine_ && (prose.empty() || front.size() < 3); --i) {
      if (front.size() < 3 && std::any_of(line(i).begin(), line(i).end(), isNameStart)) front.push_back(line(i));
      if (prose.empty() && hasWord(line(i))) prose = line(i);
    }
    const auto tail = [](std::string_view all) {
      constexpr std::size_t kMost = 300;
      return std::string(all.substr(all.size() - std::min(all.size(), kMost)));
    };
    for (auto each = front.rbegin(); each != front.rend(); ++each) m.context += tail(*each) + " ";
    m.context = tail(m.context + tail(line(m.line)));
    constexpr std::string_view kMarks = " \t#/%*>`-=:";
    prose.remove_prefix(std::min(prose.find_first_not_of(kMarks), prose.size()));
    prose = withoutCommand(prose.substr(0, prose.find_last_not_of(kMarks) + 1)).text;
    prose = prose.substr(0, prose.find('\t'));  // of a table's row the first cell
    if (isGeneric(prose)) prose = {};
    const bool hasKey = isNear && !first.key.empty();
    std::string_view printed;
    constexpr std::size_t kFar = 8;
    const std::size_t last = std::max({lastLine_, hasKey ? first.keyLine : 0, m.line - std::min(m.line, kFar)});
    for (std::size_t i = m.line - 1; i > last && printed.empty(); --i)
      if (const PlainLine plain =
              withoutCommand(line(i).substr(std::min(line(i).find_first_not_of(" \t"), line(i).size())));
          plain.isPrinted)
        printed = plain.text;
    m.name = !label.empty()     ? label
             : !around.empty()  ? around
             : !printed.empty() ? printed
             : hasKey           ? first.key
                                : prose;
    if (m.line != columnsLine_) {
      columnsLine_ = m.line;
      hasColumns_ = saysColumns(line(m.line));
    }
    m.isByColumns = m.isByColumns || hasColumns_;
    if (block.beside > 1 && m.line > 1)
      if (const auto headings = headingsOf(line(m.line - 1)); headings.size() == block.beside)
        m.name = headings[block.number];
    lastLine_ = block.numbers.back()->line;
  }

 private:
  std::string_view line(std::size_t number) const { return lines_[number - 1]; }

  const std::vector<Bracket>& brackets_;
  std::vector<std::string_view> lines_;
  std::size_t lastLine_ = 0;  ///< of the matrix before
  std::size_t columnsLine_ = 0;
  bool hasColumns_ = false;
};

/// In a part of the text: without its comments, or the comments alone.
PastedMatrices findIn(std::string_view part, std::string_view text) {
  const Runs runs = runsOf(tokensOf(part));
  Namer namer(text, runs.brackets);
  const std::vector<std::size_t> emptyLines = namer.emptyLines();
  PastedMatrices result;
  for (const Run& run : runs.runs) {
    Blocks found = blocksOf(run, runs.brackets, emptyLines);
    for (const Block& block : found.blocks) {
      PastedMatrix& m = result.matrices.emplace_back();
      namer.name(m, block);
      m.rows = block.rows;
      m.columns = block.columns;
      m.isInMemoryOrder = block.isInMemoryOrder;
      m.factor = run.factor;
      for (const Number* n : block.numbers) {
        std::string digits(n->text);
        for (char& c : digits) c = c == 'd' || c == 'D' ? 'e' : c;
        m.numbers.push_back({n->value, std::move(digits)});
      }
    }
    std::move(found.passedOver.begin(), found.passedOver.end(), std::back_inserter(result.passedOver));
  }
  return result;
}

}  // namespace

PastedMatrices findMatrices(std::string_view given) {
  const PlainText text = plainText(given);
  PastedMatrices live = findIn(text.live, text.all);
  if (!live.matrices.empty()) return live;
  PastedMatrices apart = findIn(text.comments, text.all);
  if (apart.matrices.empty() && !live.passedOver.empty()) return live;
  return apart;
}

}  // namespace viewproj::cmd
