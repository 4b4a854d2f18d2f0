// Elements of an SVG, as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "picture/flat.hpp"

namespace viewproj::cmd::svg {

/// With one decimal, if it is not 0.
std::string number(double value);
/// "12,3.5"
std::string pair(const Vec2& at);
std::string escaped(std::string_view text);
/// The data of a path through these points.
std::string line(const std::vector<Vec2>& points, bool isClosed = false);

std::string path(std::string_view style, const std::string& data);
std::string circle(std::string_view style, const Vec2& center, double radius);
std::string rect(std::string_view style, const Rect& box);
/// anchor: "start", "middle" or "end". inner: elements and escaped text.
std::string text(std::string_view style, const Vec2& at, std::string_view anchor, const std::string& inner);

/// The styles of every picture, light and dark: blue is the world, vermilion what was measured or asked for, green the
/// ground, which the colour-blind tell apart too. Text is at least 4.9:1 against its ground.
extern const char* const kStyles;

}  // namespace viewproj::cmd::svg
