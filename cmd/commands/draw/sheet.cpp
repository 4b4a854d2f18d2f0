#include "commands/draw/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "output/labels.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kRight = 20, kAxis = 24, kTallest = 620;

std::string pixelText(double value) { return formatDigits(value == 0 ? 0 : value, 12); }

/// Round numbers from one end to the other, far enough apart, and the two ends.
struct Ticks {
  std::vector<double> round, labelled;
};

/// apart: how many pixels at the least lie between numbers.
Ticks ticksOf(double from, double length, double apart) {
  Ticks ticks;
  const double decade = std::floor(std::log10(apart));
  double step = 0;
  for (double digit : {1.0, 2.0, 5.0, 10.0}) {
    step = decade < 0 ? digit / std::pow(10, -decade) : digit * std::pow(10, decade);
    if (step >= apart) break;
  }
  const double to = from + length, first = std::ceil(from / step);
  ticks.labelled = {from, to};
  for (int i = 0; i <= length / step + 1; ++i) {
    const double value = decade < 0 ? (first + i) / std::round(1 / step) : (first + i) * step;
    if (!(value > from && value < to)) continue;
    ticks.round.push_back(value);
    if (value - from >= 0.7 * apart && to - value >= 0.7 * apart) ticks.labelled.push_back(value);
  }
  return ticks;
}

double widestNumber(double from, double length) {
  const Ticks ticks = ticksOf(from, length, length / 8);
  double widest = 0;
  for (double value : ticks.labelled) widest = std::max(widest, widthOf(pixelText(value), svg::kSmallText));
  return widest;
}

}  // namespace

Vec2 Sheet::operator()(const Vec2& screen) const {
  const Vec2 corner = pictureCorners(viewport).first;
  const double x = (screen.x - corner.x) / viewport.width, y = (screen.y - corner.y) / viewport.height;
  const bool down = viewport.origin == Origin::topLeft;
  return {frame.left + x * (frame.right - frame.left),
          down ? frame.top + y * (frame.bottom - frame.top) : frame.bottom - y * (frame.bottom - frame.top)};
}

Sheet makeSheet(const Viewport& viewport, double top) {
  Sheet sheet;
  sheet.viewport = viewport;
  const double left = 14 + widestNumber(pictureCorners(viewport).first.y, viewport.height);
  const double shape = viewport.width / viewport.height;
  const double drawn = std::clamp(shape, 1 / kLongestSheet, kLongestSheet);
  sheet.stretched = drawn != shape;
  const double room = svg::kWidth - left - kRight;
  const double width = std::round(std::min(room, kTallest * drawn));
  const double start = std::round(left + (room - width) / 2);
  top += viewport.origin == Origin::topLeft ? kAxis : kAxis / 2;
  sheet.frame = {start, top, start + width, top + std::round(100 * width / drawn) / 100};
  return sheet;
}

double bottomOf(const Sheet& sheet) {
  return sheet.frame.bottom + (sheet.viewport.origin == Origin::topLeft ? 0 : kAxis);
}

std::string gridOf(const Sheet& sheet) {
  const svg::Box& frame = sheet.frame;
  const Viewport& v = sheet.viewport;
  const Vec2 corner = pictureCorners(v).first;
  const bool down = v.origin == Origin::topLeft;
  const double perUnitX = v.width / (frame.right - frame.left), perUnitY = v.height / (frame.bottom - frame.top);
  const double apartX = std::max(60.0, widestNumber(corner.x, v.width) + 12) * perUnitX;
  // One spacing for both, so that cells are square, unless the pixels are not.
  const Ticks xs = ticksOf(corner.x, v.width, apartX);
  const Ticks ys = ticksOf(corner.y, v.height, sheet.stretched ? 40 * perUnitY : apartX);
  std::string out;
  for (double x : xs.round) {
    const double at = sheet({x, corner.y}).x;
    out += svg::line(at, frame.top, at, frame.bottom, "class=\"grid\"");
  }
  for (double y : ys.round) {
    const double at = sheet({corner.x, y}).y;
    out += svg::line(frame.left, at, frame.right, at, "class=\"grid\"");
  }
  const double axis = down ? frame.top - 8 : frame.bottom + 18;
  for (double x : xs.labelled)
    out += svg::text(sheet({x, corner.y}).x, axis, pixelText(x), "class=\"axis\" text-anchor=\"middle\"");
  for (double y : ys.labelled) {
    // The numbers of the origin stand apart from each other: the one of y goes a little into the picture's side.
    const double shift = y == corner.y ? (down ? 5 : -5) : 0;
    out += svg::text(frame.left - 7, sheet({corner.x, y}).y + 0.36 * svg::kSmallText + shift, pixelText(y),
                     "class=\"axis\" text-anchor=\"end\"");
  }
  return out;
}

}  // namespace viewproj::cmd
