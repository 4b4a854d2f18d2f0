#include "output/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace viewproj::cmd {
namespace {

using svg::Box;

constexpr double kCell = 32;
/// With so many marks in it, a cell has no room for a label; through so many lines, one place is as bad as another.
constexpr std::size_t kMostBoxes = 512;
constexpr int kMostLinesThrough = 1024;
constexpr double kGap = 3;

/// Calls f with the number of each cell that the box touches.
template <class F>
bool anyCell(const Box& box, F f) {
  const auto cell = [](double v) { return static_cast<int>(std::floor(v / kCell)); };
  for (int y = cell(box.top); y <= cell(box.bottom); ++y)
    for (int x = cell(box.left); x <= cell(box.right); ++x)
      if (f(y * 4096 + x)) return true;
  return false;
}

/// The next code point of valid UTF-8, or U+FFFD for a byte that is none.
char32_t nextCharacter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  const std::size_t size = first < 0x80                    ? 1
                           : first >= 0xC2 && first < 0xE0 ? 2
                           : first >= 0xE0 && first < 0xF0 ? 3
                           : first >= 0xF0 && first < 0xF5 ? 4
                                                           : 0;
  char32_t c = size == 1 ? first : size == 0 ? 0 : first & (0x7Fu >> size);
  bool good = size > 0;
  for (std::size_t i = 1; i < size; ++i) {
    good = good && (byte(i) & 0xC0) == 0x80;
    c = (c << 6) | (byte(i) & 0x3F);
  }
  good = good && !(size == 3 && c < 0x800) && !(size == 4 && c < 0x10000) && !(c >= 0xD800 && c < 0xE000) &&
         c < 0x110000 && c != 0xFFFE && c != 0xFFFF;
  text.remove_prefix(good ? size : 1);
  return good ? c : 0xFFFD;
}

double widthOf(char32_t c) {
  if (c >= 0x1100) return c == 0x2026 || c == 0xFFFD ? 1.03 : 1.05;
  if (c >= 0x80) return 0.85;
  const char letter = static_cast<char>(c);
  if (std::string_view("mwMW@%").find(letter) != std::string_view::npos) return 1.0;
  if (letter >= 'A' && letter <= 'Z') return 0.79;
  if (std::string_view("ijl.,:;|!' ()[]").find(letter) != std::string_view::npos) return 0.4;
  return 0.65;
}

}  // namespace

double widthOf(std::string_view words, double size) {
  double width = 0;
  while (!words.empty()) width += widthOf(nextCharacter(words));
  return width * size;
}

double widthOfFirst(std::string_view& words, double size) { return widthOf(nextCharacter(words)) * size; }

std::string asLabel(std::string_view text) {
  std::string out;
  for (std::size_t count = 0; !text.empty(); ++count) {
    if (count == kLongestLabel) return out + "…";
    const std::string_view before = text;
    const char32_t c = nextCharacter(text);
    if (c == 0xFFFD)
      out += "\uFFFD";
    else
      out += c < 0x20 || (c >= 0x7F && c < 0xA0) ? " " : before.substr(0, before.size() - text.size());
  }
  return out;
}

void Labels::avoid(const Box& box) {
  const auto covers = [&](const Box& other) {
    return other.left <= box.left && other.right >= box.right && other.top <= box.top && other.bottom >= box.bottom;
  };
  anyCell(box, [&](int cell) {
    std::vector<Box>& there = taken_[cell];
    if (there.size() < kMostBoxes && std::none_of(there.begin(), there.end(), covers)) there.push_back(box);
    return false;
  });
}

void Labels::avoidLine(double x1, double y1, double x2, double y2) {
  anyCell({std::min(x1, x2), std::min(y1, y2), std::max(x1, x2), std::max(y1, y2)}, [&](int cell) {
    linesIn_[cell].push_back(lines_.size());
    return false;
  });
  lines_.push_back({x1, y1, x2, y2});
}

bool Labels::isFree(const Box& box) const {
  if (box.left < frame_.left || box.right > frame_.right || box.top < frame_.top || box.bottom > frame_.bottom)
    return false;
  return !anyCell(box, [&](int cell) {
    const auto there = taken_.find(cell);
    return there != taken_.end() && (there->second.size() == kMostBoxes ||
                                     std::any_of(there->second.begin(), there->second.end(),
                                                 [&](const Box& other) { return overlap(box, other) > 0; }));
  });
}

int Labels::linesThrough(const Box& box) const {
  const auto passes = [&](const Line& line) {
    double from = 0, to = 1;
    const auto clip = [&](double start, double step, double low, double high) {
      if (step == 0) return start >= low && start <= high;
      const double a = (low - start) / step, b = (high - start) / step;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
      return from <= to;
    };
    return clip(line.x1, line.x2 - line.x1, box.left, box.right) &&
           clip(line.y1, line.y2 - line.y1, box.top, box.bottom);
  };
  int count = 0;
  ++queries_;
  anyCell(box, [&](int cell) {
    const auto there = linesIn_.find(cell);
    if (there == linesIn_.end()) return false;
    for (const std::size_t number : there->second) {
      const Line& line = lines_[number];
      if (line.query == queries_) continue;
      line.query = queries_;
      count += passes(line);
      if (count == kMostLinesThrough) return true;
    }
    return false;
  });
  return count;
}

std::optional<std::string> Labels::place(const Box& marked, const std::string& words, const std::string& style) {
  const double width = widthOf(words, textSize_), lineHeight = 1.15 * textSize_, x = (marked.left + marked.right) / 2,
               y = (marked.top + marked.bottom) / 2;
  // Where the text begins (-1), is centred (0) or ends (1), and the middle of its line.
  struct Try {
    int anchor;
    double x, y;
  };
  const double above = marked.top - kGap - lineHeight / 2, below = marked.bottom + kGap + lineHeight / 2;
  const double right = marked.right + kGap, left = marked.left - kGap;
  const std::array<Try, 11> tries = {{{0, x, y},
                                      {-1, right, y},
                                      {1, left, y},
                                      {0, x, above},
                                      {0, x, below},
                                      {-1, x + kGap, above},
                                      {1, x - kGap, above},
                                      {-1, x + kGap, below},
                                      {1, x - kGap, below},
                                      {0, x, above - lineHeight},
                                      {0, x, below + lineHeight}}};
  // Within a shape, a label is its own; a mark it would hide.
  const bool within = marked.right - marked.left > width && marked.bottom - marked.top > lineHeight;
  const Try* best = nullptr;
  Box bestBox{};
  int fewest = 0;
  for (const Try& t : tries) {
    if (&t == &tries.front() && !within) continue;
    if (&t >= tries.end() - 2 && !farther_) break;
    const double start = t.anchor < 0 ? t.x : t.anchor > 0 ? t.x - width : t.x - width / 2;
    const Box box{start, t.y - lineHeight / 2, start + width, t.y + lineHeight / 2};
    if (!isFree(box)) continue;
    const int lines = linesThrough(box);
    if (best && lines >= fewest) continue;
    best = &t;
    bestBox = box;
    fewest = lines;
    if (lines == 0) break;
  }
  if (!best) {
    ++dropped_;
    return std::nullopt;
  }
  avoid(bestBox);
  static constexpr const char* kAnchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
  return svg::text(best->x, best->y + 0.36 * textSize_, words, style + kAnchors[best->anchor + 1]);
}

}  // namespace viewproj::cmd
