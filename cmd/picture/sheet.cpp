#include "picture/sheet.hpp"

#include <algorithm>

#include "picture/svg.hpp"

namespace viewproj::cmd {
namespace {

struct SymbolRow {
  Symbol symbol;
  const char* text;
  const char* element;  ///< 20 wide, its middle at (10, 0)
};

// clang-format off
constexpr SymbolRow kSymbols[] = {
    {Symbol::point, "point", R"(<circle class="dot" cx="10" r="4.5"/>)"},
    {Symbol::hiddenPoint, "point not seen", R"(<circle class="dot hollow" cx="10" r="4.5"/>)"},
    {Symbol::hiddenLine, "hidden", R"(<path class="edge hid" d="M0,0h19"/>)"},
    {Symbol::ghost, "without the lens", R"(<path class="ghost" d="M0,0h19"/>)"},
    {Symbol::cross, "pixel: first hit, distance", R"(<path class="cross" d="M2,0h16M10,-8v16"/>)"},
    {Symbol::normal, "normal", R"(<path class="normal" d="M0,0h12"/><path class="normal head" d="M19,0l-8,-3.4v6.8Z"/>)"},
    {Symbol::pairPixel, "pixel of the record", R"(<path class="cross" d="M4,-6l12,12m0,-12l-12,12"/>)"},
    {Symbol::miss, "from the record's pixel to the computed one", R"(<path class="miss" d="M0,0h12"/><path class="miss head" d="M19,0l-8,-3.4v6.8Z"/>)"},
    {Symbol::outside, "outside", R"(<path class="out" d="M15,0l-9,-6v12Z"/>)"},
    {Symbol::behind, "behind: turn that way", R"(<path class="out hollow" d="M15,0l-9,-6v12Z"/>)"},
    {Symbol::area, "outline on the ground", R"(<rect class="area" x="1" y="-5" width="17" height="11"/><rect class="rim" x="1" y="-5" width="17" height="11"/>)"},
    {Symbol::stem, "down to the ground", R"(<path class="stem" d="M0,0h19"/>)"},
    {Symbol::grid, "grid", R"(<path class="grid g1" d="M0,0h19"/>)"},
    {Symbol::horizon, "horizon", R"(<path class="horizon" d="M0,0h19"/>)"},
};
// clang-format on

std::string elementOf(const Label& label) {
  const Rect& box = label.chosen->box;
  std::string out;
  if (label.chosen->leader) {
    constexpr double kFromMark = 5;
    const Vec2 mark = *label.chosen->leader, end = leaderEnd(box, mark);
    const double size = distance(mark, end);
    if (size > kFromMark) out = svg::path("lead", svg::line({between(mark, end, kFromMark / size), end}));
  }
  std::string inner = svg::escaped(label.text);
  if (!label.note.empty()) inner += "<tspan class=\"note\" dx=\"5\">" + svg::escaped(label.note) + "</tspan>";
  const Vec2 at{(box.left + box.right) / 2, box.bottom - 0.36 * label.style.size};
  return out + svg::text(std::string(label.style.name) + (label.isFaint ? " faint" : ""), at, "middle", inner);
}

/// Rows of items below the frame, as many a row as fit.
class Rows {
 public:
  Rows(const Rect& frame, double top) : frame_(frame), x_(frame.left), y_(top) {}

  void add(const std::string& text, const std::string& symbol = "") {
    constexpr double kGap = 16, kOfSymbol = 26;
    const double before = symbol.empty() ? 0 : kOfSymbol, width = before + textWidth(text, kOfLegend);
    if (x_ + width > frame_.right && x_ > frame_.left) next();
    if (!symbol.empty())
      elements_ += "<g transform=\"translate(" + svg::pair({x_, y_ - 4}) + ")\">" + symbol + "</g>\n";
    elements_ += svg::text(kOfLegend.name, {x_ + before, y_}, "start", svg::escaped(text));
    right_ = std::max(right_, x_ + width);
    x_ += width + kGap;
  }
  void next() {
    constexpr double kHeight = 19;
    if (x_ > frame_.left) y_ += kHeight;
    x_ = frame_.left;
  }
  const std::string& elements() const { return elements_; }
  double right() const { return right_; }
  double bottom() const { return y_; }

 private:
  Rect frame_;
  double x_, y_, right_ = 0;
  std::string elements_;
};

}  // namespace

void Sheet::explain(Symbol symbol, const std::string& text) {
  std::string& known = symbols_[symbol];
  if (known.find(text) == std::string::npos) known += (known.empty() ? "" : "; ") + text;
}

void Sheet::addPhoto(const std::string& url) {
  std::string image = svg::rect("photo", frame_);
  image.replace(0, std::string("<rect").size(), "<image href=\"" + url + "\" preserveAspectRatio=\"none\"");
  add(Layer::photo, image);
}

void Sheet::addLines(const std::vector<Piece>& pieces, const std::string& style, double weight) {
  constexpr double kOfHidden = 0.4, kShortest = 0.05;
  for (const Piece& piece : pieces) {
    const Rect box = boundsOf(piece.line);
    if (!(std::max(box.right - box.left, box.bottom - box.top) > kShortest)) continue;
    const std::string data = svg::line(piece.line);
    if (hasPhoto_) add(Layer::lines, svg::path("halo", data));
    add(Layer::lines, svg::path(style + (piece.isHidden ? " hid" : ""), data));
    labels.addInk(piece.line, weight * (piece.isHidden ? kOfHidden : 1));
    if (piece.isHidden) explain(Symbol::hiddenLine);
  }
}

void Sheet::addMark(const Vec2& at, double radius, const std::string& element) {
  add(Layer::marks, element);
  labels.addMark(grown({at.x, at.y, at.x, at.y}, radius));
}

void Sheet::addArrow(const Vec2& from, const Vec2& to, const std::string& style) {
  constexpr double kHead = 8, kHalfWidth = 0.42, kInk = 2;
  const double size = distance(from, to), head = std::min(kHead, 0.6 * size);
  const Vec2 way{(to.x - from.x) / size, (to.y - from.y) / size}, neck{to.x - head * way.x, to.y - head * way.y};
  const Vec2 side{-kHalfWidth * head * way.y, kHalfWidth * head * way.x};
  if (hasPhoto_) add(Layer::marks, svg::path("halo", svg::line({from, to})));
  add(Layer::marks, svg::path(style, svg::line({from, neck})));
  add(Layer::marks,
      svg::path(style + " head",
                svg::line({to, {neck.x + side.x, neck.y + side.y}, {neck.x - side.x, neck.y - side.y}}, true)));
  labels.addInk(from, to, kInk);
}

void Sheet::addFilled(Layer layer, const std::string& style, const std::vector<Vec2>& corners) {
  if (corners.size() > 2) add(layer, svg::path(style + (hasPhoto_ ? " glass" : ""), svg::line(corners, true)));
}

std::string Sheet::svg(const std::string& title, const std::vector<std::string>& facts, const std::string& ticks,
                       bool ticksBelow) {
  constexpr double kMargin = 22, kBelow = 26, kOfTicks = 20;
  std::string names;
  std::size_t missing = 0;
  for (const Label& label : labels.place()) label.chosen ? void(names += elementOf(label)) : void(++missing);
  if (missing > 0) note(std::to_string(missing) + " of the names have no room");
  Rows rows(frame_, frame_.bottom + kBelow + (ticksBelow ? kOfTicks : 0));
  for (const std::string& fact : facts) rows.add(fact);
  rows.next();
  for (const SymbolRow& row : kSymbols)
    if (const auto found = symbols_.find(row.symbol); found != symbols_.end())
      rows.add(found->second.empty() ? row.text : found->second, row.element);
  for (const std::string& line : notes_) {
    rows.next();
    rows.add(line);
  }
  const double right = std::max({frame_.right, rows.right(), frame_.left + textWidth(title, {"title", 17, true})});
  const Vec2 size{right + kMargin, rows.bottom() + kMargin};
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + svg::number(size.x) + " " +
                    svg::number(size.y) + "\" font-family=\"Helvetica, Arial, DejaVu Sans, sans-serif\">\n<title>" +
                    svg::escaped(title) + "</title>\n" + svg::kStyles + "<clipPath id=\"frame\">" +
                    svg::rect("", frame_) + "</clipPath>\n" + svg::rect("page", {0, 0, size.x, size.y}) +
                    svg::text("title", {frame_.left, 24}, "start", svg::escaped(title)) + svg::rect("sky", frame_) +
                    "<g clip-path=\"url(#frame)\">\n";
  for (const std::string& layer : layers_) out += layer;
  return out + "</g>\n" + svg::rect("frame", frame_) + ticks + names + rows.elements() + "</svg>\n";
}

}  // namespace viewproj::cmd
