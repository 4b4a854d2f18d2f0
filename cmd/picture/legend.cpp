// Ticks along the frame; below it the facts of the camera, the symbols that occur, and notes.
#include <algorithm>
#include <numbers>

#include "camera/plain_camera.hpp"
#include "camera/read_lens.hpp"
#include "numbers/vectors.hpp"
#include "picture/drawing.hpp"
#include "picture/rim.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

struct SymbolRow {
  const char* text;
  const char* elements;  ///< 20 wide, their middle at (10, 0)
};

// clang-format off
constexpr SymbolRow kSymbols[] = {
    {"point", R"(<circle class="dot" cx="10" r="4.5"/>)"},
    {"point not seen", R"(<circle class="dot hollow" cx="10" r="4.5"/>)"},
    {"hidden", R"(<path class="edge hid" d="M0,0h19"/>)"},
    {"without the lens", R"(<path class="ghost" d="M0,0h19"/>)"},
    {"pixel: first hit, distance", R"(<path class="cross" d="M2,0h16M10,-8v16"/>)"},
    {"normal", R"(<path class="normal" d="M0,0h12"/><path class="normal head" d="M19,0l-8,-3.4v6.8Z"/>)"},
    {"pixel of the record", R"(<path class="cross" d="M4,-6l12,12m0,-12l-12,12"/>)"},
    {"from the record's pixel to the computed one", R"(<path class="miss" d="M0,0h12"/><path class="miss head" d="M19,0l-8,-3.4v6.8Z"/>)"},
    {"outside", R"(<path class="out" d="M15,0l-9,-6v12Z"/>)"},
    {"behind: turn that way", R"(<path class="out hollow" d="M15,0l-9,-6v12Z"/>)"},
    {"outline on the ground", R"(<rect class="area" x="1" y="-5" width="17" height="11"/><rect class="rim" x="1" y="-5" width="17" height="11"/>)"},
    {"down to the ground", R"(<path class="stem" d="M0,0h19"/>)"},
    {"fine grid", R"(<path class="grid g0" d="M0,0h19"/>)"},
    {"grid", R"(<path class="grid g1" d="M0,0h19"/>)"},
    {"horizon", R"(<path class="horizon" d="M0,0h19"/>)"},
    {"end of the lens", R"(<path class="end" d="M0,0h19"/>)"},
};
// clang-format on

std::string digits(double value, int count = 4) { return formatDigits(value, count); }
/// With so many decimals at most.
std::string degrees(double angle, int decimals) {
  const double unit = std::pow(10, decimals);
  return digits(std::round(angle * unit) / unit + 0.0, 10) + "°";
}

std::string placeText(const View& view) {
  const Vec3 eye = view.eye();
  if (!view.worldIsEcef()) return "eye " + digits(eye.x) + ", " + digits(eye.y) + ", " + digits(eye.z);
  const Geodetic place = ecefToGeodetic(eye);
  const HeadingPitchRoll angles = headingPitchRollOf(plainPose(view.camera().pose()), true);
  const std::string roll = degrees(angles.roll.value, 2);
  return degrees(place.lat, 4) + " " + degrees(place.lon, 4) + ", " + digits(place.height, 5) + " m; heading " +
         degrees(std::fmod(std::round(angles.heading.value * 100) / 100 + 360, 360), 2) + ", pitch " +
         degrees(angles.pitch.value, 2) + (roll == "0°" ? "" : ", roll " + roll);
}

/// The angle that the picture shows between the middles of two opposite sides, by their places on its rim.
double degreesBetween(const Camera& camera, double from, double to) {
  const Rim rim(camera);
  const Pose pose = camera.pose();
  const bool isAcross = from > 3;
  const auto turn = [&](double side) {
    const Vec3 way = rim.at(side).ray.direction;
    return std::atan2(detail::dot(way, isAcross ? pose.right() : pose.up()), detail::dot(way, pose.forward()));
  };
  return (turn(to) - turn(from)) * 180 / std::numbers::pi;
}

std::vector<std::string> factsOf(const View& view) {
  const Camera& camera = view.camera();
  const Viewport& v = camera.viewport();
  const Projection p = camera.projection();
  std::vector<std::string> facts{digits(v.width, 6) + " × " + digits(v.height, 6) + " px, y " +
                                 (view.isFromTop() ? "down from the top left" : "up from the bottom left")};
  if (view.isParallel())
    facts.push_back(digits(p.right() - p.left()) + " × " + digits(p.top() - p.bottom()) + " wide, orthographic");
  else
    facts.push_back("fov " + digits(degreesBetween(camera, 3.5, 1.5), 3) + "° × " +
                    digits(degreesBetween(camera, 2.5, 0.5), 3) + "°");
  if (const auto lens = lensOf(camera)) {
    const double limit = lens->limitDegrees();
    facts.push_back(std::string(nameOf(lens->model())) + " lens" +
                    (std::isfinite(limit) ? ", ends " + digits(limit, 3) + "° off the axis" : ""));
  }
  facts.push_back(placeText(view));
  if (view.worldIsEcef()) return facts;
  if (view.isParallel() || p.zNear() > 0)
    facts.push_back("near " + digits(p.zNear()) + ", far " + (std::isfinite(p.zFar()) ? digits(p.zFar()) : "infinite"));
  const Convention& c = camera.convention();
  facts.push_back(std::string(c.world == Handedness::right ? "right" : "left") + "-handed world" +
                  (c.view == ViewAxes::RDF ? ", camera y down" : ""));
  return facts;
}

/// Where x and y are counted from.
void drawTicks(const Drawing& drawing) {
  constexpr double kTicks = 8, kSize = 5, kAbove = 8, kBelow = 17, kBeside = 8, kBaseline = 4;
  const View& view = drawing.view;
  const Viewport& v = view.camera().viewport();
  const Rect& f = view.frame();
  const bool isFromTop = view.isFromTop();
  const Vec2 first = view.offSheet({f.left, isFromTop ? f.top : f.bottom});
  for (const bool isX : {true, false}) {
    const double start = isX ? first.x : first.y, size = isX ? v.width : v.height;
    const double step = roundedDown(size / (isX ? kTicks : std::max(2.0, kTicks * v.height / v.width)));
    for (double k = std::ceil(start / step - 1e-9); k * step <= start + size * (1 + 1e-9); ++k) {
      const Vec2 at = view.onSheet(isX ? Vec2{k * step, first.y} : Vec2{first.x, k * step});
      const Vec2 out = isX ? Vec2{0, isFromTop ? -1.0 : 1.0} : Vec2{-1, 0};
      const Vec2 text =
          isX ? Vec2{at.x, at.y + (isFromTop ? -kAbove : kBelow)} : Vec2{at.x - kBeside, at.y + kBaseline};
      drawing.sheet.addLine(Layer::texts, "tick", {at, sum(at, kSize, out)});
      drawing.sheet.addText(Layer::texts, kOfTick, text, isX ? "middle" : "end", digits(k * step + 0.0, 6));
    }
  }
}

/// Rows of items below the frame, as many a row as fit. An item longer than a row goes on in the next one.
class Rows {
 public:
  Rows(Sheet& sheet, double top) : sheet_(sheet), at_{sheet.frame.left, top} {}

  void add(const std::string& text, const char* symbol = nullptr) {
    constexpr double kGap = 16, kOfSymbol = 26;
    const double before = symbol ? kOfSymbol : 0, room = sheet_.frame.right - sheet_.frame.left - before;
    if (at_.x + before + textWidth(text, kOfLegend) > sheet_.frame.right) next();
    std::string row = text;
    while (textWidth(row, kOfLegend) > room && row.find(' ') != std::string::npos) row.resize(row.rfind(' '));
    if (symbol) sheet_.addSymbol(symbol, {at_.x, at_.y - 4});
    sheet_.addText(Layer::texts, kOfLegend, {at_.x + before, at_.y}, "start", row);
    at_.x += before + textWidth(row, kOfLegend) + kGap;
    if (row.size() == text.size()) return;
    next();
    add(text.substr(row.size() + 1));
  }
  void next() {
    constexpr double kHeight = 19;
    if (at_.x > sheet_.frame.left) at_ = {sheet_.frame.left, at_.y + kHeight};
  }

 private:
  Sheet& sheet_;
  Vec2 at_;
};

}  // namespace

void drawLegend(const Drawing& drawing) {
  constexpr double kBelow = 26, kBelowTicks = 46;
  drawTicks(drawing);
  Rows rows(drawing.sheet, drawing.sheet.frame.bottom + (drawing.view.isFromTop() ? kBelow : kBelowTicks));
  for (const std::string& fact : factsOf(drawing.view)) rows.add(fact);
  rows.next();
  const auto& symbols = drawing.sheet.symbols();
  for (const SymbolRow& row : kSymbols)
    if (const auto found = symbols.find(row.text); found != symbols.end())
      rows.add(found->second.empty() ? row.text : found->second, row.elements);
  for (const std::string& note : drawing.notes) {
    rows.next();
    rows.add(note);
  }
}

}  // namespace viewproj::cmd
