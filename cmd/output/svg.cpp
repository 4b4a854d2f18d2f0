#include "output/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "text/number.hpp"

namespace viewproj::cmd::svg {

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";  // after ]] it must be
    else
      out += c;
  }
  return out;
}

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

Box around(double x, double y, double halfWidth, double halfHeight) {
  return {x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight};
}

std::string at(double coordinate) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", coordinate);
  return text;
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + at(x1) + "\" y1=\"" + at(y1) + "\" x2=\"" + at(x2) + "\" y2=\"" + at(y2) + "\" " + style +
         "/>\n";
}

std::string text(double x, double y, std::string_view words, const std::string& style) {
  return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\"" + (style.empty() ? "" : " " + style) + ">" + escaped(words) +
         "</text>\n";
}

std::string frame(const Box& box) {
  return "<rect x=\"" + at(box.left) + "\" y=\"" + at(box.top) + "\" width=\"" + at(box.right - box.left) +
         "\" height=\"" + at(box.bottom - box.top) + "\" fill=\"none\" stroke=\"#888\"/>\n";
}

std::string decade(int exponent) {
  return exponent >= -1 && exponent <= 3 ? formatNumber(std::pow(10, exponent)) : "1e" + std::to_string(exponent);
}

std::string beginPicture(std::string_view title, std::string_view caption) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + at(kWidth) + " " + at(kHeight) +
         "\" font-family=\"sans-serif\" font-size=\"15\" fill=\"#222\">\n<title>" + escaped(title) +
         "</title>\n<style>.grid{stroke:#eee}.decade{stroke:#d4d4d4}.small{font-size:13px}" +
         ".label{paint-order:stroke;stroke:#fff;stroke-width:3px}</style>\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + text(16, 26, title, "font-weight=\"bold\"") +
         text(16, 45, caption, "class=\"small\"");
}

}  // namespace viewproj::cmd::svg
