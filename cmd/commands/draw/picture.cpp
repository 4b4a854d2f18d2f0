#include "commands/draw/picture.hpp"

#include <algorithm>
#include <cmath>

#include "commands/draw/sheet.hpp"
#include "output/labels.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

using svg::Box;

constexpr const char* kTitle = "What the camera sees";
constexpr double kTitleHeight = 52, kNoteHeight = 19, kArrow = 11, kCross = 7;
constexpr std::size_t kMostNotes = 5, kMany = 500;

constexpr const char* kStyle =
    "<style>.ground{fill:#fff}text{fill:#222}.grid{stroke:#e6e6e6}.frame{fill:none;stroke:#888}"
    ".small,.axis,.label{font-size:13px}.axis{fill:#666}.label{paint-order:stroke;stroke:#fff;stroke-width:3px}"
    ".shape,.segment{fill:none;stroke-width:1.5;stroke-linecap:round;stroke-linejoin:round}"
    ".shape{stroke:#2468b4}.of-shape{fill:#2468b4}.segment{stroke:#1f7a4d}.of-segment{fill:#1f7a4d}"
    ".point,.away{fill:#c2410c;stroke:#c2410c}.beyond,.behind{fill:#fff}"
    ".pixel{fill:none;stroke:#7c2bb8;stroke-width:2}.of-pixel{fill:#7c2bb8}"
    "@media(prefers-color-scheme:dark){.ground{fill:#15181d}text{fill:#ddd}.grid{stroke:#2b3038}.axis{fill:#9aa0a8}"
    ".label{stroke:#15181d}.shape{stroke:#6aa9f4}.of-shape{fill:#6aa9f4}.segment{stroke:#55c08a}"
    ".of-segment{fill:#55c08a}.point,.away{fill:#f0875a;stroke:#f0875a}.beyond,.behind{fill:#15181d}"
    ".pixel{stroke:#c58af0}.of-pixel{fill:#c58af0}}</style>\n";

std::string fine(double coordinate) { return formatDigits(std::round(coordinate * 100) / 100, 9); }
std::string fine(const Vec2& p) { return fine(p.x) + " " + fine(p.y); }

std::string titled(const std::string& element, const std::string& name, const std::string& title) {
  return "<" + element + "><title>" + svg::escaped(title) + "</title></" + name + ">\n";
}

bool isInside(const Box& frame, const Vec2& p) {
  return p.x >= frame.left && p.x <= frame.right && p.y >= frame.top && p.y <= frame.bottom;
}

std::string titleOf(const DrawnPoint& point) {
  const ScreenPoint& p = point.screen;
  if (p.status == PointStatus::behind) return point.label + ": behind the eye";
  if (p.status == PointStatus::atInfinity) return point.label + ": a direction, no screen position";
  std::string title =
      point.label + ": screen " + formatNumber(p.x) + " " + formatNumber(p.y) + ", depth " + formatNumber(p.depth);
  if (std::isfinite(p.viewDistance)) title += ", viewDistance " + formatNumber(p.viewDistance);
  return title;
}

/// What of a point's place its mark does not show.
std::string remarkOn(const ScreenPoint& p) {
  if (p.status == PointStatus::behind) return ", behind";
  if (p.status == PointStatus::atInfinity) return ", at infinity";
  return p.outside & sideNear ? ", before near" : p.outside & sideFar ? ", beyond far" : "";
}

class Picture {
 public:
  explicit Picture(const View& view)
      : view_(view), sheet_(makeSheet(view.camera.viewport(), kTitleHeight)), labels_(sheet_.frame) {}

  std::string draw() {
    for (const Outline& outline : view_.outlines) drawOutline(outline);
    for (const DrawnPoint& point : view_.points) drawPoint(point);
    for (const DrawnPixel& pixel : view_.pixels) drawPixel(pixel);
    // Marks are all known by now. What was asked for by name comes first, what lies outside last.
    for (const std::vector<Wanted>* wanted : {&ofPixels_, &ofPoints_, &ofOutlines_, &ofArrows_})
      for (const Wanted& label : *wanted) words_ += labels_.place(label.marked, label.words, label.style).value_or("");
    return header() + gridOf(sheet_) + shapes_ + frame() + arrows_ + marks_ + words_ + footer() + "</svg>\n";
  }

 private:
  struct Wanted {
    Box marked;
    std::string words, style;
  };

  void drawOutline(const Outline& outline) {
    if (outline.pieces.empty()) return;
    ++outlinesSeen_;
    std::string path, last;
    Box reach{INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (const VisibleSegment& piece : outline.pieces) {
      const Vec2 start = sheet_(piece.start.screen), end = sheet_(piece.end.screen);
      if (fine(start) != fine(end)) path += (fine(start) == last ? "" : "M" + fine(start)) + "L" + fine(end);
      if (fine(start) != fine(end) || path.empty()) last = fine(end);
      labels_.avoidLine(start.x, start.y, end.x, end.y);
      for (const Vec2& p : {start, end})
        reach = {std::min(reach.left, p.x), std::min(reach.top, p.y), std::max(reach.right, p.x),
                 std::max(reach.bottom, p.y)};
    }
    // What is seen as a point is drawn as one.
    if (path.empty()) path = "M" + last + "L" + last;
    const std::string kind = outline.isSegment ? "segment" : "shape";
    shapes_ += titled("path class=\"" + kind + "\" d=\"" + path + "\"", "path", outline.label);
    if (outline.isSegment) {
      const double x = (reach.left + reach.right) / 2, y = (reach.top + reach.bottom) / 2;
      reach = svg::around(x, y, 2, 2);
    }
    ofOutlines_.push_back({reach, outline.label, "class=\"label of-" + kind + "\""});
  }

  void drawPoint(const DrawnPoint& point) {
    const ScreenPoint& p = point.screen;
    const double radius = view_.points.size() > kMany ? 2 : 3.5;
    const bool beyond = p.outside & (sideNear | sideFar);
    const std::string words = point.label + remarkOn(p);
    pointsSeen_ += p.visible();
    behind_ += p.status == PointStatus::behind;
    if (p.status == PointStatus::inFront && (p.outside & ~unsigned{sideNear | sideFar}) == 0) {
      const Vec2 at = sheet_({p.x, p.y});
      marks_ += titled("circle class=\"point" + std::string(beyond ? " beyond" : "") + "\" cx=\"" + fine(at.x) +
                           "\" cy=\"" + fine(at.y) + "\" r=\"" + fine(radius) + "\"",
                       "circle", titleOf(point));
      mark(ofPoints_, svg::around(at.x, at.y, radius + 1, radius + 1), words, "class=\"label\"");
      return;
    }
    const bool hollow = p.status != PointStatus::inFront;
    const Vec2 middle = sheet_.middle(), at = hollow ? Vec2{} : sheet_({p.x, p.y});
    const Vec2 toward = hollow ? Vec2{point.toward.x, -point.toward.y} : Vec2{at.x - middle.x, at.y - middle.y};
    drawArrow(toward, std::string("away") + (hollow ? " behind" : ""), words, "class=\"label\"", titleOf(point));
  }

  void drawPixel(const DrawnPixel& pixel) {
    const Vec2 at = sheet_(pixel.screen), middle = sheet_.middle();
    const std::string style = "class=\"label of-pixel\"";
    if (!isInside(sheet_.frame, at)) {
      drawArrow({at.x - middle.x, at.y - middle.y}, "pixel", pixel.label, style, pixel.detail);
      return;
    }
    const std::string size = fine(2 * kCross);
    marks_ += titled("path class=\"pixel\" d=\"M" + fine(Vec2{at.x - kCross, at.y}) + "h" + size + "M" +
                         fine(Vec2{at.x, at.y - kCross}) + "v" + size + "\"",
                     "path", pixel.detail);
    mark(ofPixels_, svg::around(at.x, at.y, kCross, kCross), pixel.label, style);
  }

  /// On the border, where the way from the middle of the picture leaves it. toward: right and down.
  void drawArrow(Vec2 toward, const std::string& kind, const std::string& words, const std::string& style,
                 const std::string& title) {
    const Vec2 middle = sheet_.middle();
    const auto bounded = [](double v) { return std::isnan(v) ? 0 : std::clamp(v, -1e100, 1e100); };
    toward = {bounded(toward.x), bounded(toward.y)};
    if (toward == Vec2{0, 0}) toward = {0, 1};  // straight behind: any way is as good
    const double length = std::hypot(toward.x, toward.y);
    const Vec2 way{toward.x / length, toward.y / length}, across{-way.y, way.x};
    const double reach = std::min((sheet_.frame.right - middle.x) / std::fabs(way.x),
                                  (sheet_.frame.bottom - middle.y) / std::fabs(way.y));
    const Vec2 tip{middle.x + reach * way.x, middle.y + reach * way.y};
    const auto corner = [&](double side) {
      return fine({tip.x - kArrow * way.x + side * across.x, tip.y - kArrow * way.y + side * across.y});
    };
    arrows_ += titled("path class=\"" + kind + "\" d=\"M" + fine(tip) + "L" + corner(4.5) + "L" + corner(-4.5) + "z\"",
                      "path", title);
    const Vec2 center{tip.x - kArrow / 2 * way.x, tip.y - kArrow / 2 * way.y};
    mark(ofArrows_, svg::around(center.x, center.y, kArrow / 2, kArrow / 2), words, style);
  }

  void mark(std::vector<Wanted>& wanted, const Box& box, const std::string& words, const std::string& style) {
    labels_.avoid(box);
    wanted.push_back({box, words, style});
  }

  std::string frame() const {
    const Box& f = sheet_.frame;
    return "<rect class=\"frame\" x=\"" + fine(f.left) + "\" y=\"" + fine(f.top) + "\" width=\"" +
           fine(f.right - f.left) + "\" height=\"" + fine(f.bottom - f.top) + "\"/>\n";
  }

  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    std::string seen;
    const auto count = [&](std::size_t visible, std::size_t all, const char* what) {
      if (all > 0)
        seen += (seen.empty() ? "visible: " : ", ") + std::to_string(visible) + " of " + std::to_string(all) + what;
    };
    count(pointsSeen_, view_.points.size(), " points");
    if (behind_ > 0) seen += " (" + std::to_string(behind_) + " behind)";
    count(outlinesSeen_, view_.outlines.size(), " outlines");
    if (!seen.empty()) notes.push_back(seen);
    const auto limit = [&](std::size_t drawn, std::size_t read, const char* what) {
      if (drawn < read)
        notes.push_back("only the first " + std::to_string(drawn) + " of " + std::to_string(read) + " " + what +
                        " are drawn");
    };
    limit(view_.points.size(), view_.pointsRead, "points");
    limit(view_.outlines.size(), view_.outlinesRead, "outlines");
    if (labels_.dropped() > 0)
      notes.push_back("+" + std::to_string(labels_.dropped()) + " more without room for a label");
    if (sheet_.stretched) notes.push_back("the picture is drawn stretched: its pixels are not square here");
    notes.insert(notes.end(), view_.notes.begin(), view_.notes.end());
    if (notes.size() > kMostNotes) {
      const std::size_t more = notes.size() - kMostNotes + 1;
      notes.resize(kMostNotes - 1);
      notes.push_back("+" + std::to_string(more) + " more notes");
    }
    return notes;
  }

  std::string header() const {
    const Viewport& v = view_.camera.viewport();
    const std::string caption = formatNumber(v.width) + " x " + formatNumber(v.height) + " pixels, counted from the " +
                                (v.origin == Origin::topLeft ? "top" : "bottom") + " left, centres at " +
                                formatNumber(v.pixelCenter);
    const double height = bottomOf(sheet_) + 16 + kNoteHeight * static_cast<double>(notes().size());
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + fine({svg::kWidth, height}) +
           "\" font-family=\"sans-serif\" font-size=\"15\">\n<title>" + kTitle + "</title>\n" + kStyle +
           "<rect class=\"ground\" width=\"100%\" height=\"100%\"/>\n" +
           svg::text(16, 24, kTitle, "font-weight=\"bold\"") + svg::text(16, 43, fitting(caption), "class=\"small\"");
  }

  std::string footer() const {
    std::string out;
    double y = bottomOf(sheet_) + 22;
    for (const std::string& note : notes()) {
      out += svg::text(16, y, fitting(note), "class=\"small\"");
      y += kNoteHeight;
    }
    return out;
  }

  /// Cut off where the sheet ends.
  static std::string fitting(const std::string& words) {
    const double room = svg::kWidth - 32;
    if (widthOf(words, svg::kSmallText) <= room) return words;
    double left = room - widthOf("…", svg::kSmallText);
    std::string_view rest = words;
    std::size_t fits = 0;
    while ((left -= widthOfFirst(rest, svg::kSmallText)) >= 0) fits = words.size() - rest.size();
    return words.substr(0, fits) + "…";
  }

  const View& view_;
  Sheet sheet_;
  Labels labels_;
  std::string shapes_, arrows_, marks_, words_;
  std::vector<Wanted> ofPixels_, ofPoints_, ofOutlines_, ofArrows_;
  std::size_t pointsSeen_ = 0, outlinesSeen_ = 0, behind_ = 0;
};

}  // namespace

std::string pictureOf(const View& view) { return Picture(view).draw(); }

}  // namespace viewproj::cmd
