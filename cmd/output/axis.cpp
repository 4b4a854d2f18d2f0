#include "output/axis.hpp"

#include <cmath>

#include "text/format_number.hpp"

namespace viewproj::cmd::svg {
namespace {

constexpr int kMostDecades = 9;
/// So many decades have room for more lines between them.
constexpr double kFewDecades = 3.2;
/// Of a decade, and of a step: what rounding leaves.
constexpr double kSlack = 1e-9;

}  // namespace

Axis::Axis(bool logarithmic, double least, double most, double low, double high)
    : logarithmic_(logarithmic), least_(place(least)), most_(place(most)), low_(low), high_(high) {
  if (!(most_ > least_)) most_ = least_ + 1;
}

double Axis::place(double value) const { return logarithmic_ ? std::log10(value) : value; }

double Axis::operator()(double value) const {
  return low_ + (place(value) - least_) / (most_ - least_) * (high_ - low_);
}

std::vector<Tick> Axis::ticks(bool finer) const {
  std::vector<Tick> result;
  if (logarithmic_) {
    const bool steps = finer && most_ - least_ < kFewDecades;
    const int first = static_cast<int>(std::floor(least_ - kSlack));
    const int last = static_cast<int>(std::floor(most_ + kSlack));
    int every = 1;
    for (int wider : {2, 3, 5, 10, 20, 50, 100})
      if ((last - first) / every > kMostDecades) every = wider;
    for (int exponent = first; exponent <= last; ++exponent)
      for (const double step : {1.0, 2.0, 5.0}) {
        const double value = step * std::pow(10, exponent), at = place(value);
        if (at < least_ - kSlack || at > most_ + kSlack || exponent % every != 0 || (step != 1 && !steps)) continue;
        result.push_back({value, step == 1 ? decade(exponent) : formatDigits(value, 4), step != 1});
      }
    return result;
  }
  const double span = most_ - least_;
  double step = std::pow(10, std::floor(std::log10(span)));
  for (double share : {0.5, 0.4})
    if (span / step < 4) step *= share;
  for (double value = std::ceil(least_ / step) * step; value <= most_ + step * kSlack; value += step)
    result.push_back({value, formatDigits(std::fabs(value) < step * kSlack ? 0 : value, 4)});
  return result;
}

std::string upright(const Box& area, double x, const Tick& tick) {
  return line(x, area.top, x, area.bottom, tick.minor ? "class=\"grid\"" : "class=\"decade\"") +
         text(x, area.bottom + 20, tick.label, "text-anchor=\"middle\"");
}

std::string level(const Box& area, double y, const Tick& tick) {
  return line(area.left, y, area.right, y, tick.minor ? "class=\"grid\"" : "class=\"decade\"") +
         text(area.left - 8, y + kText / 3, tick.label, "text-anchor=\"end\"");
}

std::string frameWithTitles(const Box& area, std::string_view x, std::string_view y) {
  const std::string turned = "translate(18 " + at((area.top + area.bottom) / 2) + ") rotate(-90)";
  return text((area.left + area.right) / 2, area.bottom + 44, x, "text-anchor=\"middle\"") +
         text(0, 0, y, "text-anchor=\"middle\" transform=\"" + turned + "\"") + frame(area);
}

}  // namespace viewproj::cmd::svg
