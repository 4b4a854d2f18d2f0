#include "commands/pair_check.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Explanations whose misses differ by less are as good as each other, in pixels.
constexpr double kSameMiss = 1e-6;

OrderedJson numberOrNull(double value) { return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr); }

/// The root of a mean that rounding may have left below 0.
double rootOf(DoubleDouble mean) { return std::sqrt(std::max(mean.hi, 0.0)); }

}  // namespace

void PairCheck::Misses::add(double miss, std::size_t line) {
  if (worst == 0 || miss > largest) {
    largest = miss;
    worst = line;
  }
  sum += miss;
}

PairCheck::PairCheck(const Camera& camera, std::vector<Hypothesis> hypotheses, double within)
    : camera_(camera), within_(within) {
  for (Hypothesis& hypothesis : hypotheses) trials_.push_back({std::move(hypothesis), {}});
}

void PairCheck::add(const Vec4& point, const Vec2& pixel, std::size_t line) {
  ++records_;
  const ScreenPoint own = worldToScreen(camera_, point);
  const auto missOf = [](const ScreenPoint& computed, double x, double y) {
    const double miss = std::hypot(computed.x - x, computed.y - y);
    return computed.status == PointStatus::inFront && !std::isnan(miss) ? miss : HUGE_VAL;
  };
  // One miss that is too large rules an explanation out for good.
  std::erase_if(trials_, [&](Trial& trial) {
    const Hypothesis& h = trial.hypothesis;
    const ScreenPoint there = h.hasCamera || h.movesPoints() ? worldToScreen(h.camera, h.point(point)) : own;
    const Vec2 given = h.pixel(pixel);
    trial.misses.add(missOf(there, given.x, given.y), line);
    return !(trial.misses.largest <= within_);
  });
  if (own.status != PointStatus::inFront) {
    ++noPixel_;
    return;
  }
  misses_.add(missOf(own, pixel.x, pixel.y), line);
  const std::array computed{own.x, own.y}, given{pixel.x, pixel.y};
  if (records_ - noPixel_ == 1) origin_ = computed;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const DoubleDouble c = twoDiff(computed[axis], origin_[axis]), g = twoDiff(given[axis], origin_[axis]);
    AxisSums& sums = sums_[axis];
    sums.computed += c;
    sums.given += g;
    sums.computedSquared += c * c;
    sums.givenSquared += g * g;
    sums.product += c * g;
  }
}

OrderedJson PairCheck::explanations() const {
  std::vector<const Trial*> best;  // the best of each mistake, of equals the first
  for (const Trial& trial : trials_) {
    const auto same = std::find_if(best.begin(), best.end(), [&](const Trial* other) {
      return other->hypothesis.mistake == trial.hypothesis.mistake;
    });
    if (same == best.end())
      best.push_back(&trial);
    else if (trial.misses.largest < (*same)->misses.largest - kSameMiss)
      *same = &trial;
  }
  std::stable_sort(best.begin(), best.end(),
                   [](const Trial* a, const Trial* b) { return a->misses.largest < b->misses.largest; });
  OrderedJson list = OrderedJson::array();
  for (const Trial* trial : best)
    list.push_back({{"mistake", trial->hypothesis.mistake},
                    {"value", OrderedJson(*trial->hypothesis.value)},
                    {"largestMiss", trial->misses.largest},
                    {"mend", trial->hypothesis.mend}});
  return list;
}

OrderedJson PairCheck::fit() const {
  const std::size_t count = records_ - noPixel_;
  const DoubleDouble n = static_cast<double>(count);
  std::array<double, 2> offset{}, scale{}, scaleOffset{};
  DoubleDouble shifted = 0, scaled = 0;  // the squares that are left, over both axes
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const AxisSums& s = sums_[axis];
    const DoubleDouble difference = s.given - s.computed;
    const DoubleDouble varianceOfComputed = s.computedSquared - s.computed * s.computed / n;
    const DoubleDouble varianceOfGiven = s.givenSquared - s.given * s.given / n;
    const DoubleDouble covariance = s.product - s.computed * s.given / n;
    offset[axis] = (difference / n).hi;
    shifted += varianceOfComputed + varianceOfGiven - DoubleDouble(2) * covariance;
    const DoubleDouble slope = covariance / varianceOfComputed;
    scale[axis] = slope.hi;
    scaleOffset[axis] =
        ((s.given - slope * s.computed) / n + DoubleDouble(origin_[axis]) - slope * DoubleDouble(origin_[axis])).hi;
    scaled += varianceOfGiven - slope * covariance;
  }
  const auto pairOrNull = [](bool there, const std::array<double, 2>& v) {
    return there && std::isfinite(v[0]) && std::isfinite(v[1]) ? OrderedJson(v) : OrderedJson(nullptr);
  };
  const auto rootOrNull = [&](bool there, DoubleDouble squares) {
    return there ? numberOrNull(rootOf(squares / n)) : OrderedJson(nullptr);
  };
  // Pixels in one column (row) say nothing of the scale across (down).
  const bool hasScale = count >= 3 && std::isfinite(scale[0]) && std::isfinite(scale[1]);
  return {{"offset", pairOrNull(count >= 2, offset)},
          {"offsetRms", rootOrNull(count >= 2, shifted)},
          {"scale", pairOrNull(hasScale, scale)},
          {"scaleOffset", pairOrNull(hasScale, scaleOffset)},
          {"scaleRms", rootOrNull(hasScale, scaled)}};
}

OrderedJson PairCheck::report() const {
  const std::size_t count = records_ - noPixel_;
  const bool hasMiss = count > 0;
  return {{"agrees", agrees()},
          {"records", records_},
          {"noPixel", noPixel_},
          {"within", within_},
          {"meanMiss", hasMiss ? numberOrNull(misses_.sum / static_cast<double>(count)) : OrderedJson(nullptr)},
          {"largestMiss", hasMiss ? numberOrNull(misses_.largest) : OrderedJson(nullptr)},
          {"worst", hasMiss ? OrderedJson(misses_.worst) : OrderedJson(nullptr)},
          {"explanations", agrees() ? OrderedJson::array() : explanations()},
          {"fit", agrees() ? OrderedJson(nullptr) : fit()}};
}

}  // namespace viewproj::cmd
