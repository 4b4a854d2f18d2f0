// The elements that plots are drawn of, as SVG text: self-contained, no scripts, no fonts of its own, any width.
#pragma once

#include <string>
#include <string_view>

namespace viewproj::cmd::svg {

// Units of the viewBox. Text of 15 is 9 pixels high in a picture 400 wide.
inline constexpr double kWidth = 640, kHeight = 470;
inline constexpr double kText = 15, kSmallText = 13;

struct Box {
  double left, top, right, bottom;
};

/// The area that two boxes share.
double overlap(const Box& a, const Box& b);
Box around(double x, double y, double halfWidth, double halfHeight);

/// As the text of an element.
std::string escaped(std::string_view text);

/// A coordinate, to a tenth of a unit.
std::string at(double coordinate);

std::string line(double x1, double y1, double x2, double y2, const std::string& style);
/// words are escaped; style: attributes.
std::string text(double x, double y, std::string_view words, const std::string& style = "");
std::string frame(const Box& box);

/// The label of a power of ten.
std::string decade(int exponent);

/// From <svg> to the white ground with title and caption on it; "</svg>" ends it.
std::string beginPicture(std::string_view title, std::string_view caption);

}  // namespace viewproj::cmd::svg
