#include "commands/check/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands/check/mend.hpp"
#include "commands/check/words.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr std::size_t kExact = 10'000, kMostPairs = 4096;
constexpr double kStep = 1.001;

int stepOf(double miss) { return static_cast<int>(std::ceil(std::log(std::max(miss, 1e-300)) / std::log(kStep))); }

OrderedJson orNull(bool has, double value) {
  return has && std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}
OrderedJson orNull(const std::string& text) { return text.empty() ? OrderedJson(nullptr) : OrderedJson(text); }

double missOf(const ScreenPoint& at, const Vec2& pixel) {
  const double miss = std::hypot(at.x - pixel.x, at.y - pixel.y);
  return at.status == PointStatus::inFront && !std::isnan(miss) ? miss : HUGE_VAL;
}

}  // namespace

void Misses::add(double miss, std::size_t line) {
  ++count_;
  sum_ += miss;
  squares_ += miss * miss;
  if (worst_ == 0 || miss > largest_) {
    largest_ = miss;
    worst_ = line;
  }
  if (count_ <= kExact) return exact_.push_back(miss);
  for (const double each : exact_) ++steps_[stepOf(each)];
  exact_.clear();
  ++steps_[stepOf(miss)];
}

double Misses::rms() const { return std::sqrt(squares_ / static_cast<double>(count_)); }
double Misses::mean() const { return sum_ / static_cast<double>(count_); }

double Misses::at(std::size_t rank) const {
  if (!exact_.empty()) {
    std::vector<double> sorted = exact_;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
    return sorted[rank];
  }
  std::size_t below = 0;
  for (const auto& [step, count] : steps_)
    if ((below += count) > rank) return std::min(largest_, std::pow(kStep, step));
  return largest_;
}

double Misses::median() const { return (at((count_ - 1) / 2) + at(count_ / 2)) / 2; }
double Misses::most() const { return at((95 * count_ + 99) / 100 - 1); }

PairReport::PairReport(const CameraFile& file, double within)
    : file_(file), camera_(makeCamera(file)), within_(within) {}

void PairReport::add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line) {
  const std::size_t index = records_++;
  const ScreenPoint at = worldToScreen(camera_, point);
  const bool isSeen = at.status == PointStatus::inFront;
  if (isSeen != pixel.has_value()) ++noPixel_;
  if (!pixel) return;
  if (isSeen) misses_.add(missOf(at, *pixel), line);
  if (index % stride_ != 0) return;
  pairs_.push_back({point, *pixel});
  lines_.push_back(line);
  if (pairs_.size() <= kMostPairs) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs_.size(); i += 2, ++kept) {
    pairs_[kept] = pairs_[i];
    lines_[kept] = lines_[i];
  }
  pairs_.resize(kept);
  lines_.resize(kept);
  stride_ *= 2;
}

OrderedJson PairReport::explanations(OrderedJson& wrong) const {
  OrderedJson list = OrderedJson::array();
  const auto linesOf = [&](const std::vector<std::size_t>& which) {
    OrderedJson lines = OrderedJson::array();
    for (const std::size_t i : which) lines.push_back(lines_[i]);
    return lines;
  };
  std::vector<Vec2> misses;
  for (const Pair& pair : pairs_) {
    const ScreenPoint at = worldToScreen(camera_, pair.point);
    misses.push_back({at.x - pair.pixel.x, at.y - pair.pixel.y});
  }
  if (const auto alone = wrongPairs(misses, within_); !alone.empty()) {
    wrong = linesOf(alone);
    return list;
  }
  for (const Explanation& e : explain(file_.document, file_.reading, pairs_, within_)) {
    const Mend mend = mendOf(file_, e, pairs_);
    std::vector<std::size_t> wrongLines;
    for (const std::size_t i : e.wrong) wrongLines.push_back(lines_[i]);
    list.push_back({{"mistake", e.hypothesis.mistake},
                    {"sentence", sentenceOf(file_, e, wrongLines, within_)},
                    {"value", OrderedJson(e.hypothesis.value)},
                    {"mend", orNull(mend.options())},
                    {"pairs", orNull(wordsForPairs(e.hypothesis, mend.pixels))},
                    {"rmsMiss", std::numbers::sqrt2 * e.rms},
                    {"largestMiss", e.largest},
                    {"wrongPairs", wrongLines},
                    {"camerasMended", nullptr}});
  }
  if (!list.empty()) return list;
  const std::vector<std::size_t> order = pixelOrder(camera_, pairs_, within_);
  if (order.empty()) return list;
  std::string words;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != i)
      words += (words.empty() ? "give line " : ", line ") + std::to_string(lines_[i]) + " the pixel of line " +
               std::to_string(lines_[order[i]]);
  list.push_back({{"mistake", "pixel-order"},
                  {"sentence", "the pixels are in another order"},
                  {"value", nullptr},
                  {"mend", nullptr},
                  {"pairs", words},
                  {"rmsMiss", orNull(false, 0)},
                  {"largestMiss", orNull(false, 0)},
                  {"wrongPairs", OrderedJson::array()},
                  {"camerasMended", nullptr}});
  return list;
}

OrderedJson PairReport::report() const {
  const bool has = misses_.count() > 0;
  OrderedJson wrong = OrderedJson::array(), list = OrderedJson::array();
  if (!agrees() && !pairs_.empty()) list = explanations(wrong);
  const bool isOpen = !agrees() && list.empty() && wrong.empty();
  return {{"agrees", agrees()},
          {"records", records_},
          {"noPixel", noPixel_},
          {"within", within_},
          {"rmsMiss", orNull(has, has ? misses_.rms() : 0)},
          {"meanMiss", orNull(has, has ? misses_.mean() : 0)},
          {"medianMiss", orNull(has, has ? misses_.median() : 0)},
          {"miss95", orNull(has, has ? misses_.most() : 0)},
          {"largestMiss", orNull(has, misses_.largest())},
          {"worst", has ? OrderedJson(misses_.worst()) : OrderedJson(nullptr)},
          {"judged", pairs_.size()},
          {"wrongPairs", wrong},
          {"explanations", list},
          {"verdict", isOpen ? OrderedJson("no explanation found") : OrderedJson(nullptr)},
          {"cameras", nullptr}};
}

}  // namespace viewproj::cmd::mistakes
