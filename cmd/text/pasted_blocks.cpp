// Tokens to runs of numbers that no word and no key parts; runs to parts (what one bracket holds, or one line); parts
// to stacks, which are the rows of a matrix or a matrix each.
#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "text/pasted_parts.hpp"

namespace viewproj::cmd::pasted {
namespace {

/// A call that makes a matrix: what it is given is none.
bool makesMatrix(std::string_view callee) {
  const std::string c = lower(callee);
  for (const char* word : {"lookat", "look_at", "perspective", "frustum", "viewport", "unproject"})
    if (c.find(word) != kNone) return true;
  return c.ends_with("rgb") || c.ends_with("rgba");
}

/// Whether the run ends with 0 1 2 or 1 2 3 on a line alone: a table's header that counts its columns.
bool countsColumns(const std::vector<Number>& numbers, std::size_t line) {
  std::size_t first = numbers.size();
  while (first > 0 && numbers[first - 1].line == line) --first;
  for (std::size_t i = first; i < numbers.size(); ++i)
    if (numbers[i].value != numbers[first].value + static_cast<double>(i - first)) return false;
  return numbers.size() > first + 1 && isOneOf(numbers[first].text, {"0", "1"});
}

// ---- Parts and stacks

using Part = std::span<const Number>;
using Stack = std::span<const Part>;

/// Cuts a list where the key of neighbours differs.
template <class List, class Key>
std::vector<List> cut(List list, Key key) {
  std::vector<List> parts;
  for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
    for (end = begin + 1; end < list.size() && key(list[end]) == key(list[end - 1]);) ++end;
    parts.push_back(list.subspan(begin, end - begin));
  }
  return parts;
}

bool isShape(std::size_t rows, std::size_t columns) {
  return (rows == 3 && columns == 3) || ((rows == 3 || rows == 4) && columns == 4) || (rows == 4 && columns == 3);
}
bool isCount(std::size_t n) { return n == 9 || n == 12 || n == 16; }

Block asRows(Stack parts) {
  Block block{{}, parts.size(), parts[0].size(), false};
  for (const Part& part : parts)
    for (const Number& n : part) block.numbers.push_back(&n);
  return block;
}

/// 9, 12 or 16 numbers in memory order, or in rows that ; or \\ ends.
Block flat(Stack parts) {
  Block block = asRows(parts);
  const std::size_t count = block.numbers.size();
  const auto endsEvery = [&](std::size_t columns) {
    for (std::size_t i = 1; i < count; ++i)
      if ((block.numbers[i]->rowEnds != block.numbers[i - 1]->rowEnds) != (i % columns == 0)) return false;
    return true;
  };
  block.columns = count == 9 || (count == 12 && endsEvery(3)) ? 3 : 4;
  block.rows = count / block.columns;
  block.isInMemoryOrder = !endsEvery(block.columns);
  return block;
}

/// 25 numbers of one bracket: a 4x4 that ends with 0 0 0 1 and a K.
std::vector<Block> poseAndK(Stack parts) {
  const Block all = asRows(parts);
  const auto is = [&](std::size_t i, double value) { return all.numbers[i]->value == value; };
  const bool fits = is(12, 0) && is(13, 0) && is(14, 0) && is(15, 1) && !is(16, 0) && !is(20, 0) && !is(24, 0) &&
                    is(19, 0) && is(22, 0) && is(23, 0);
  if (!fits) return {};
  return {{{all.numbers.begin(), all.numbers.begin() + 16}, 4, 4, true},
          {{all.numbers.begin() + 16, all.numbers.end()}, 3, 3, true}};
}

/// Whether the gap in the middle of each line is wider than its others, or has a bar.
bool haveGap(Stack lines) {
  const auto gap = [](const Number& a, const Number& b) {
    const char* const end = a.text.data() + a.text.size();  // a repeated number has no gap
    return b.text.data() > end ? std::string_view(end, b.text.data()) : std::string_view();
  };
  return std::all_of(lines.begin(), lines.end(), [&](const Part& line) {
    const std::size_t half = line.size() / 2;
    const std::string_view middle = gap(line[half - 1], line[half]);
    std::size_t widest = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
      if (i != half) widest = std::max(widest, gap(line[i - 1], line[i]).size());
    return middle.size() > widest || (middle.find('|') != kNone && middle.size() == widest);
  });
}

/// Matrices side by side: parts i, i + count, i + 2 count ... are one's rows.
std::vector<Block> sideBySide(const std::vector<Part>& parts, std::size_t count) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Part> rows;
    for (std::size_t j = i; j < parts.size(); j += count) rows.push_back(parts[j]);
    Block& block = blocks.emplace_back(asRows(rows));
    block.number = i;
    block.beside = count;
  }
  return blocks;
}

/// Indices, if each number has one, go from the first to the last: 0 to 15, m00 to m33, M11 to M44. Those of two digits
/// say where each number stands.
bool placeByIndices(Block& block) {
  std::vector<const Number*>& numbers = block.numbers;
  const auto has = [&](auto property) { return std::all_of(numbers.begin(), numbers.end(), property); };
  if (!has([](const Number* n) { return n->indexDigits > 0; }) || numbers.front()->indexDigits > 2) return true;
  if (!has([](const Number* n) { return n->indexDigits == 2; }))
    return numbers.front()->indexDigits == 2 ||
           (numbers.back()->index - numbers.front()->index == numbers.size() - 1 && numbers.front()->index < 2);
  std::vector<const Number*> sorted = numbers;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Number* a, const Number* b) { return a->index < b->index; });
  const std::size_t first = sorted.front()->index, last = sorted.back()->index;
  const std::size_t columns = last % 10 - first % 10 + 1, rows = last / 10 - first / 10 + 1;
  if ((first != 0 && first != 11) || !isShape(rows, columns) || rows * columns != numbers.size()) return false;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (sorted[i]->index != first + i / columns * 10 + i % columns) return false;
  block = {sorted, rows, columns, false};
  return true;
}

class BlockFinder {
 public:
  BlockFinder(const Run& run, const std::vector<Bracket>& brackets, const std::vector<std::size_t>& emptyLines)
      : run_(run), brackets_(brackets), emptyLines_(emptyLines) {}

  Blocks found;

  void find(Part numbers) {
    // An index that is the first one again, on another line, begins a new matrix.
    const Number& first = numbers[0];
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= numbers.size(); ++i) {
      const bool isFirstAgain = i < numbers.size() && first.indexDigits > 1 && numbers[i].index == first.index &&
                                numbers[i].indexDigits == first.indexDigits && numbers[i].line != numbers[i - 1].line;
      if (i < numbers.size() && !isFirstAgain) continue;
      findOne(numbers.subspan(begin, i - begin));
      begin = i;
    }
  }

 private:
  void findOne(Part numbers) {
    last_ = &numbers.back();
    std::map<std::size_t, std::size_t> total;
    for (const Number& n : numbers)
      for (std::size_t b = n.bracket; b != 0; b = brackets_[b].parent) ++total[b];
    cells_.clear();
    sizes_.clear();
    for (const Number& n : numbers) {
      std::size_t b = n.bracket;
      while (b != 0 && total[b] < 2) b = brackets_[b].parent;
      cells_[n.bracket] = b;
      ++sizes_[b];
    }
    std::vector<Part> parts;
    for (const Part& cell : cut(numbers, [&](const Number& n) { return cells_[n.bracket]; }))
      if (const std::size_t c = cellOf(cell); c != 0 && (sizes_[c] == 3 || sizes_[c] == 4))
        parts.push_back(cell);
      else
        for (const Part& line : cut(cell, [](const Number& n) { return n.line; })) parts.push_back(line);
    dropLabels(parts);
    holds_.clear();
    for (const Part& part : parts)
      for (std::size_t b = part[0].bracket; b != 0; b = brackets_[b].parent) ++holds_[b];
    const auto group = [&](const Part& p) { return std::pair(parentOf(p), isAlone(p) ? p.data() : nullptr); };
    for (const Stack& stack : cut(Stack(parts), group)) place(stack);
  }

  /// The innermost bracket of two numbers or more.
  std::size_t cellOf(const Part& part) { return cells_[part[0].bracket]; }

  /// An index, an offset, a size beside a bracket of numbers is none of them.
  void dropLabels(std::vector<Part>& parts) {
    std::set<std::size_t> wide;
    for (const Part& part : parts)
      if (part.size() >= 3 && cellOf(part) != 0) wide.insert(part[0].line);
    const bool areSeveral = parts.size() > 1;
    std::erase_if(parts, [&](const Part& part) {
      return part.size() < 3 && wide.contains(part[0].line) && !(areSeveral && isCount(sizes_[cellOf(part)]));
    });
  }

  /// The innermost bracket that holds several parts.
  std::size_t parentOf(const Part& part) {
    const std::size_t cell = cellOf(part);
    std::size_t b = part[0].bracket;
    while (b != 0 && !(holds_[b] >= 2 && (cell == 0 || b <= cell))) b = brackets_[b].parent;
    return b;
  }

  /// All of a matrix in one bracket on one line.
  bool isAlone(const Part& part) {
    return cellOf(part) != 0 && part.size() == sizes_[cellOf(part)] && isCount(part.size());
  }

  /// Outside of brackets an empty line parts first.
  void place(Stack stack) {
    const std::size_t inside = parentOf(stack[0]);
    std::vector<Stack> first{stack}, second = cut(stack, [&](const Part&p) { return emptyLines_[p[0].line]; });
    if (inside == 0) std::swap(first, second);
    for (const auto* pieces : {&first, &second}) {
      std::vector<std::vector<Block>> blocks;
      for (const Stack& piece : *pieces) blocks.push_back(matricesOf(piece, inside));
      const bool isNone = std::all_of(blocks.begin(), blocks.end(), [](const auto& b) { return b.empty(); });
      if (isNone && pieces == &first) continue;
      for (std::size_t i = 0; i < pieces->size(); ++i) {
        if (blocks[i].empty()) passOver((*pieces)[i]);
        for (Block& block : blocks[i]) keep(std::move(block), inside);
      }
      return;
    }
  }

  void passOver(Stack parts) {
    std::size_t count = 0;
    bool areEven = parts.size() > 1;
    for (const Part& part : parts) {
      count += part.size();
      areEven = areEven && part.size() == parts[0].size();
    }
    const bool areRows = parts[0].size() == 3 || parts[0].size() == 4;
    passOver(parts[0][0], count,
             areEven && (areRows || isCount(count))
                 ? std::to_string(parts.size()) + " rows of " + std::to_string(parts[0].size()) +
                       " numbers are no matrix" + (areRows ? "; put an empty line between two matrices" : "")
                 : "");
  }

  void passOver(const Number& first, std::size_t count, std::string why) {
    if (why.empty()) why = std::to_string(count) + " numbers are no matrix, which has 9, 12 or 16";
    const bool isNamed = first.keyLine == first.line || first.keyLine + 1 == first.line;
    const std::string_view name = !first.label.empty() ? first.label : isNamed ? first.key : "";
    found.passedOver.push_back({first.line, count, std::string(name), std::move(why), first.bracket != 0});
  }

  void keep(Block block, std::size_t inside) {
    const Number& first = *block.numbers.front();
    const std::size_t cell = cells_[first.bracket], count = block.numbers.size();
    const bool isOneCell = cell == cells_[block.numbers.back()->bracket];
    const std::size_t holder = inside != 0 ? inside : isOneCell ? cell : 0;  // the bracket around all of it
    const bool isCutOff = holder != 0 ? !brackets_[holder].isClosed : run_.isUnopened && block.numbers.back() == last_;
    const bool lacks = std::any_of(block.numbers.begin(), block.numbers.end(), [&](const Number* n) {
      for (std::size_t b = n->bracket; b != 0; b = brackets_[b].parent)
        if (brackets_[b].lacks) return true;
      return false;
    });
    const std::string numbers = std::to_string(count) + " numbers ";
    if (isCutOff && count < 16)
      passOver(first, count, numbers + "in a bracket of which an end is missing");
    else if (lacks)
      passOver(first, count, numbers + "in a bracket with an index that has no number");
    else if (!placeByIndices(block))
      passOver(first, count, numbers + "whose indices do not go from the first entry to the last");
    else
      found.blocks.push_back(std::move(block));
  }

  std::vector<Block> matricesOf(Stack parts, std::size_t inside) {
    std::map<std::size_t, std::size_t> ofLine;
    std::size_t count = 0, most = 0, least = kNone;
    bool isOne = true, areCells = true;
    for (const Part& part : parts) {
      ++ofLine[part[0].line];
      count += part.size();
      most = std::max(most, part.size());
      least = std::min(least, part.size());
      isOne = isOne && cellOf(part) == cellOf(parts[0]);
      areCells = areCells && cellOf(part) != 0;
    }
    if (isOne && cellOf(parts[0]) != 0 && count == 25) return poseAndK(parts);
    // Outside of brackets the parts lie one a line, or all on one, or are side by side.
    const std::size_t aLine = ofLine.begin()->second, lines = ofLine.size();
    const bool areEven = std::all_of(ofLine.begin(), ofLine.end(), [&](const auto& l) { return l.second == aLine; });
    if (least == most) {
      if (isCount(most) && !(isOne && inside != 0)) {
        std::vector<Block> each;
        for (std::size_t i = 0; i < parts.size(); ++i) each.push_back(flat(parts.subspan(i, 1)));
        return each;
      }
      const bool isInRows = inside != 0 || (areEven && (aLine == 1 || lines == 1));
      const bool isFourByThree = parts.size() == 4 && most == 3;
      if (isShape(parts.size(), most) && isInRows && (inside != 0 || areCells || !isFourByThree))
        return {asRows(parts)};
      if (inside == 0 && areEven && areCells && aLine > 1 && most == 4 && isShape(lines, most))
        return sideBySide({parts.begin(), parts.end()}, aLine);
      if (inside == 0 && aLine == 1 && areEven && most == 8 && isShape(lines, 4) && haveGap(parts)) {
        std::vector<Part> halves;
        for (const Part& line : parts) halves.insert(halves.end(), {line.subspan(0, 4), line.subspan(4)});
        return sideBySide(halves, 2);
      }
      if (most == 3 || most == 4) return {};
    }
    const bool areEights = parts.size() == 2 && least == 8 && most == 8;
    if (isOne && isCount(count) && (inside != 0 || most == 1 || areEights)) return {flat(parts)};
    if (inside == 0 && parts.size() == 5)  // "4 4" in front of sixteen
      for (const bool isFront : {true, false}) {
        const Stack rows = parts.subspan(isFront ? 1 : 0, 4);
        if (std::all_of(rows.begin(), rows.end(), [](const Part& p) { return p.size() == 4; }) &&
            parts[isFront ? 0 : 4].size() < 3)
          return {asRows(rows)};
      }
    return {};
  }

  const Run& run_;
  const std::vector<Bracket>& brackets_;
  const std::vector<std::size_t>& emptyLines_;
  const Number* last_ = nullptr;
  std::map<std::size_t, std::size_t> cells_, sizes_, holds_;  ///< by bracket
};

}  // namespace

bool isGeneric(std::string_view key) {
  const std::string_view last = key.substr(key.rfind('.') + 1);
  return isOneOf(last, {"v", "m"}) ||
         isOneOf(lower(last),
                 {"data",      "elements", "value",  "values", "columns", "array",   "type", "name", "result",
                  "ans",       "out",      "floats", "dtype",  "some",    "rows",    "cols", "dt",   "m_data",
                  "m_storage", "info",     "debug",  "trace",  "warn",    "warning", "error"});
}

Runs runsOf(const std::vector<Token>& tokens) {
  constexpr std::size_t kDeepest = 64;  // brackets beyond are not told apart
  constexpr double kMostRepeats = 17;   // more are no matrix
  Runs result;
  std::vector<Bracket>& brackets = result.brackets;
  Run run;
  std::size_t open = 0, depth = 0, rowEnds = 0, keyLine = 0;
  std::string_view label, pending, lastKey;
  bool areApart = false, isElided = false;
  Token before{Kind::word, 0};
  const auto finish = [&](double factor) {
    if (!run.numbers.empty()) result.runs.push_back(std::move(run));
    run = Run{.factor = factor, .refusal = areApart ? "the columns are printed apart" : ""};
    isElided = false;
  };
  for (const Token& token : tokens) {
    const bool isOtherName = depth > 0 && before.kind == Kind::number;
    const Kind kind = token.kind == Kind::alias && !isOtherName ? Kind::key : token.kind;
    if (kind == Kind::number) {
      const bool isAlias = before.kind == Kind::alias && run.numbers.back().text == token.text;
      Number n{token.value, token.text, token.line, open, rowEnds, label, lastKey, keyLine};
      if (before.kind == Kind::index)
        for (const char c : before.text)
          if (isDigit(c) && ++n.indexDigits < 9) n.index = n.index * 10 + static_cast<std::size_t>(c - '0');
      if (!isAlias) run.numbers.push_back(n);
      if (brackets[open].isArguments) run.refusal = "what a call is given is no matrix";
      if (isElided)
        run.refusal =
            "a row or an entry is left out (...); print all of it, in numpy by "
            "np.set_printoptions(threshold=np.inf)";
    } else if (kind == Kind::repeat) {
      for (double i = 1; i < std::min(token.value, kMostRepeats) && !run.numbers.empty(); ++i)
        run.numbers.push_back(Number(run.numbers.back()));
    } else if (kind == Kind::open) {
      const std::string_view callee = before.kind == Kind::callee ? before.text : std::string_view();
      if (++depth <= kDeepest) {
        brackets.push_back({open, callee, pending, brackets[open].isArguments || makesMatrix(callee)});
        open = brackets.size() - 1;
      }
    } else if (kind == Kind::close) {
      ++rowEnds;
      if (before.kind == Kind::index && !before.text.empty()) brackets[open].lacks = open != 0;
      if (depth == 0)
        run.isUnopened = !run.numbers.empty();
      else if (depth-- <= kDeepest) {
        brackets[open].isClosed = true;
        open = brackets[open].parent;
      }
    } else if (kind == Kind::row) {
      ++rowEnds;
    } else if (kind == Kind::elided) {
      isElided = !run.numbers.empty();
    } else if (kind == Kind::tableRule) {
      if (countsColumns(run.numbers, token.line - 1)) finish(1);
    } else if (kind == Kind::word || kind == Kind::key || kind == Kind::factor) {
      areApart = token.text == kColumnsApart || (areApart && kind == Kind::word);
      finish(kind == Kind::factor ? token.value : 1);
      if (kind == Kind::key && token.text != kColumnsApart && !isGeneric(token.text)) {
        lastKey = token.text;
        keyLine = token.line;
      }
    }
    if (kind == Kind::key || kind == Kind::word || kind == Kind::number || kind == Kind::close)
      pending = kind == Kind::key ? token.text : std::string_view();
    label = kind != Kind::index ? std::string_view() : token.label.empty() ? label : token.label;
    before = token;
    before.kind = kind;
  }
  finish(1);
  return result;
}

Blocks blocksOf(const Run& run, const std::vector<Bracket>& brackets, const std::vector<std::size_t>& emptyLines) {
  if (!run.refusal.empty()) {
    const Number& first = run.numbers.front();
    return {{}, {{first.line, run.numbers.size(), std::string(first.key), std::string(run.refusal)}}};
  }
  BlockFinder finder(run, brackets, emptyLines);
  finder.find(run.numbers);
  return std::move(finder.found);
}

}  // namespace viewproj::cmd::pasted
