#include "picture/svg.hpp"

#include <cstdio>

namespace viewproj::cmd::svg {

// Blue is the world, vermilion what was measured or asked for, green the ground: apart for the colour-blind too.
const char* const kStyles = R"(<style>
text{font-size:14px;fill:#1d2733;paint-order:stroke;stroke:#fff;stroke-width:3.5px;stroke-linejoin:round}
path,circle,rect{fill:none;stroke-linejoin:round;stroke-linecap:round}
.page,.sky{fill:#fff}
.title{font-size:17px;font-weight:600}
.leg{font-size:12px;fill:#4a5663;stroke:none}
.num{font-size:11px;fill:#66727f;stroke:none}
.frame{stroke:#7b8794;stroke-width:1.5}
.tick,.lead{stroke:#7b8794}
.land{fill:#eff4f2}
.horizon{stroke:#5d8a78;stroke-width:1.5}
.grid{stroke:#8fb3a3;stroke-width:.8}
.g0{opacity:.55}
.azimuth{font-size:12px;fill:#3f6b5a}
.stem{stroke:#0b62a8;opacity:.6}
.f0{fill:#f1f5fa}.f1{fill:#dbe6f1}.f2{fill:#c3d4e6}.f3{fill:#adc3da}
.glass{fill-opacity:.3}
.photo{image-orientation:none}
.edge{stroke:#2f4a66;stroke-width:1.7}
.belt{stroke:#2f4a66;stroke-width:.8}
.area{fill:#c2410c;fill-opacity:.13}
.rim{stroke:#c2410c;stroke-width:1.6}
.hid{stroke-width:1;stroke-dasharray:2 4;opacity:.75}
.ghost{stroke:#b0641f;stroke-width:1.1;stroke-dasharray:6 4}
.halo{stroke:#fff;stroke-width:4.5;opacity:.75}
.dot{fill:#0b62a8;stroke:#fff;stroke-width:1.2}
.hollow{fill:#fff;stroke:#0b62a8;stroke-width:1.6}
.cross{stroke:#c2410c;stroke-width:2.2}
.normal,.miss{stroke:#c2410c;stroke-width:1.8}
.head{fill:#c2410c;stroke-width:.5}
.out{fill:#46515c;stroke:#fff}
.out.hollow{fill:#fff;stroke:#46515c;stroke-width:1.6}
.of-shape{fill:#2f4a66;font-style:italic}
.of-dot{fill:#084b82;font-weight:600}
.of-cross{fill:#9a3412;font-weight:600}
.of-pixel{fill:#9a3412;font-size:13px}
.of-out{fill:#46515c;font-size:13px}
.faint{opacity:.85}
.note{font-weight:400}
@media(prefers-color-scheme:dark){
text{fill:#e6edf3;stroke:#12181f}
.page,.sky{fill:#12181f}
.leg,.num{fill:#9aa7b4}
.land{fill:#15201f}
.horizon{stroke:#6fae97}
.grid{stroke:#3f6b5a}
.azimuth{fill:#8fc7b2}
.stem{stroke:#5ab0f5}
.f0{fill:#33475b}.f1{fill:#2b3d50}.f2{fill:#233445}.f3{fill:#1c2b3a}
.edge,.belt{stroke:#a9c7e6}
.ghost{stroke:#e0964f}
.halo{stroke:#12181f}
.dot{fill:#5ab0f5;stroke:#12181f}
.hollow{fill:#12181f;stroke:#5ab0f5}
.cross,.normal,.miss,.rim{stroke:#ff8a57}
.head{fill:#ff8a57}
.out{fill:#b8c2cc;stroke:#12181f}
.out.hollow{fill:#12181f;stroke:#b8c2cc}
.of-shape{fill:#b9d2ea}
.of-dot{fill:#8cc8fa}
.of-cross,.of-pixel{fill:#ffa37c}
.of-out{fill:#b8c2cc}
}
</style>
)";

namespace {

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}

std::string place(const Vec2& at, std::string_view prefix = "") {
  const std::string before(prefix);
  return attribute(before + "x", number(at.x)) + attribute(before + "y", number(at.y));
}

}  // namespace

std::string number(double value) {
  char digits[400];
  std::snprintf(digits, sizeof digits, "%.1f", value);
  std::string text = digits;
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string pair(const Vec2& at) { return number(at.x) + "," + number(at.y); }

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string line(const std::vector<Vec2>& points, bool isClosed) {
  std::string data;
  for (const Vec2& p : points) data += (data.empty() ? "M" : "L") + pair(p);
  return data + (isClosed ? "Z" : "");
}

std::string path(std::string_view style, const std::string& data) {
  return "<path" + attribute("class", style) + attribute("d", data) + "/>\n";
}

std::string circle(std::string_view style, const Vec2& center, double radius) {
  return "<circle" + attribute("class", style) + place(center, "c") + attribute("r", number(radius)) + "/>\n";
}

std::string rect(std::string_view style, const Rect& box) {
  return "<rect" + attribute("class", style) + place({box.left, box.top}) +
         attribute("width", number(box.right - box.left)) + attribute("height", number(box.bottom - box.top)) + "/>\n";
}

std::string text(std::string_view style, const Vec2& at, std::string_view anchor, const std::string& inner) {
  return "<text" + attribute("class", style) + (anchor == "start" ? "" : attribute("text-anchor", anchor)) + place(at) +
         ">" + inner + "</text>\n";
}

}  // namespace viewproj::cmd::svg
