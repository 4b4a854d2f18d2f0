#include "picture/svg.hpp"

#include <cstdio>

namespace viewproj::cmd::svg {

namespace {

constexpr const char* kTexts[] = {
#include <picture_styles.inc>
};

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}

std::string place(const Vec2& at, std::string_view prefix = "") {
  const std::string before(prefix);
  return attribute(before + "x", number(at.x)) + attribute(before + "y", number(at.y));
}

}  // namespace

const char* const kStyles = kTexts[0];

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
