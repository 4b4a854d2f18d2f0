#include "commands/check/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands/check/mend.hpp"
#include "commands/check/words.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kStep = 1.001;
constexpr Kept kOfEach = {1000, 512};  ///< of each camera of a set

OrderedJson orNull(const std::string& text) { return text.empty() ? OrderedJson(nullptr) : OrderedJson(text); }

OrderedJson explained(const char* mistake, const std::string& sentence) {
  return {
      {"mistake", mistake},      {"sentence", sentence}, {"value", nullptr},       {"mend", nullptr},
      {"pairs", nullptr},        {"rmsMiss", nullptr},   {"largestMiss", nullptr}, {"wrongPairs", OrderedJson::array()},
      {"camerasMended", nullptr}};
}

/// A report of all pairs.
OrderedJson whole(bool agrees, std::size_t records, std::size_t noPixel, double within, const OrderedJson& statistics,
                  std::size_t judged, const std::vector<std::size_t>& wrong, const OrderedJson& list,
                  const OrderedJson& cameras) {
  OrderedJson report{{"agrees", agrees}, {"records", records}, {"noPixel", noPixel}, {"within", within}};
  report.update(statistics);
  const bool isOpen = !agrees && list.empty() && wrong.empty();
  report.update(OrderedJson{{"judged", judged},
                            {"wrongPairs", wrong},
                            {"explanations", list},
                            {"verdict", isOpen ? OrderedJson("no explanation found") : OrderedJson(nullptr)},
                            {"cameras", cameras}});
  return report;
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
  if (count_ <= most_) return exact_.push_back(miss);
  const auto step = [&](double each) {
    ++steps_[static_cast<int>(std::ceil(std::log(std::max(each, 1e-300)) / std::log(kStep)))];
  };
  for (const double each : exact_) step(each);
  exact_.clear();
  step(miss);
}

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

OrderedJson Misses::statistics() const {
  const bool has = count_ > 0;
  const auto n = static_cast<double>(count_);
  const auto orNone = [&](double value) {
    return has && std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
  };
  return {{"rmsMiss", orNone(std::sqrt(squares_ / n))},
          {"meanMiss", orNone(sum_ / n)},
          {"medianMiss", orNone(has ? (at((count_ - 1) / 2) + at(count_ / 2)) / 2 : NAN)},
          {"miss95", orNone(has ? at((95 * count_ + 99) / 100 - 1) : NAN)},
          {"largestMiss", orNone(largest_)},
          {"worst", has ? OrderedJson(worst_) : OrderedJson(nullptr)}};
}

// ---- One camera

PairReport::PairReport(const CameraFile& file, double within, const Kept& kept)
    : file_(file), camera_(makeCamera(file)), within_(within), most_(kept.pairs), misses_(kept.exact) {}

std::optional<double> PairReport::add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line) {
  const std::size_t index = records_++;
  const ScreenPoint at = worldToScreen(camera_, point);
  const bool isSeen = at.status == PointStatus::inFront;
  if (isSeen != pixel.has_value()) ++noPixel_;
  if (!pixel) return std::nullopt;
  std::optional<double> miss;
  if (isSeen) {
    miss = std::hypot(at.x - pixel->x, at.y - pixel->y);
    if (std::isnan(*miss)) miss = HUGE_VAL;
    misses_.add(*miss, line);
  }
  if (index % stride_ != 0) return miss;
  pairs_.push_back({point, *pixel});
  lines_.push_back(line);
  if (pairs_.size() <= most_) return miss;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs_.size(); i += 2, ++kept) {
    pairs_[kept] = pairs_[i];
    lines_[kept] = lines_[i];
  }
  pairs_.resize(kept);
  lines_.resize(kept);
  stride_ *= 2;
  return miss;
}

std::vector<std::size_t> PairReport::linesOf(const std::vector<std::size_t>& pairs) const {
  std::vector<std::size_t> lines;
  for (const std::size_t i : pairs) lines.push_back(lines_[i]);
  return lines;
}

std::vector<std::size_t> PairReport::wrongLines() const {
  std::vector<Vec2> misses;
  for (const Pair& pair : pairs_) {
    const ScreenPoint at = worldToScreen(camera_, pair.point);
    misses.push_back({at.x - pair.pixel.x, at.y - pair.pixel.y});
  }
  return linesOf(wrongPairs(misses, within_));
}

std::vector<Explanation> PairReport::explanations() const {
  return explain(file_.document, file_.reading, pairs_, within_);
}

Mend PairReport::mendOf(const Explanation& e) const { return mistakes::mendOf(file_, e, pairs_); }

OrderedJson PairReport::asJson(const Explanation& e, const Mend& mend) const {
  const std::vector<std::size_t> wrong = linesOf(e.wrong);
  OrderedJson one = explained(e.hypothesis.mistake.c_str(), sentenceOf(file_, e, wrong, within_));
  one["value"] = OrderedJson(e.hypothesis.value);
  one["mend"] = orNull(mend.options());
  one["pairs"] = orNull(wordsForPairs(e.hypothesis, mend.pixels));
  one["rmsMiss"] = std::numbers::sqrt2 * e.rms;
  one["largestMiss"] = e.largest;
  one["wrongPairs"] = wrong;
  return one;
}

OrderedJson PairReport::pixelOrderExplained() const {
  OrderedJson list = OrderedJson::array();
  const std::vector<std::size_t> order = pixelOrder(camera_, pairs_, within_);
  if (order.empty()) return list;
  std::string words;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (order[i] != i)
      words += (words.empty() ? "give line " : ", line ") + std::to_string(lines_[i]) + " the pixel of line " +
               std::to_string(lines_[order[i]]);
  list.push_back(explained("pixel-order", "the pixels are in another order"));
  list[0]["pairs"] = words;
  return list;
}

bool PairReport::isWithin(const PlainCamera& camera, const Hypothesis& h, const PixelMap& pixels) const {
  return std::all_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    const Vec2 at = pixelOf(camera, h.point(pair.point)), given = pixels(pair.pixel);
    return length(Vec2{at.x - given.x, at.y - given.y}) <= within_;
  });
}

bool PairReport::isMendedBy(const PairReport& other, const Explanation& e) const {
  const std::vector<Hypothesis> all = madeAnew(e.hypothesis, other.file_, file_);
  return std::any_of(all.begin(), all.end(), [&](const Hypothesis& h) { return isWithin(h.camera, h, h.pixels); });
}

bool PairReport::isMendedBy(const Mend& mend, const Hypothesis& h) const {
  const auto camera = plainWith(file_, mend.patches(), mend.stretch);
  return camera && isWithin(*camera, h, mend.pixels);
}

OrderedJson PairReport::statistics() const {
  OrderedJson statistics{{"records", records_}, {"noPixel", noPixel_}};
  statistics.update(misses_.statistics());
  return statistics;
}

OrderedJson PairReport::report() const {
  OrderedJson list = OrderedJson::array();
  const std::vector<std::size_t> wrong = agrees() ? std::vector<std::size_t>{} : wrongLines();
  if (!agrees() && !pairs_.empty() && wrong.empty()) {
    for (const Explanation& e : explanations()) list.push_back(asJson(e, mendOf(e)));
    if (list.empty()) list = pixelOrderExplained();
  }
  return whole(agrees(), records_, noPixel_, within_, misses_.statistics(), pairs_.size(), wrong, list, nullptr);
}

// ---- A set

void SetReport::add(std::size_t camera, const std::function<std::pair<std::string, CameraFile>()>& read,
                    const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line) {
  auto found = cameras_.find(camera);
  if (found == cameras_.end()) {
    auto [name, file] = read();
    found = cameras_.emplace(camera, Named{std::move(name), PairReport(file, within_, kOfEach)}).first;
  }
  ++records_;
  if (const auto miss = found->second.report.add(point, pixel, line)) misses_.add(*miss, line);
}

bool SetReport::agrees() const {
  return std::all_of(cameras_.begin(), cameras_.end(), [](const auto& each) { return each.second.report.agrees(); });
}

OrderedJson SetReport::report() const {
  OrderedJson cameras = OrderedJson::array(), list = OrderedJson::array();
  std::vector<std::size_t> wrong;
  std::vector<std::pair<double, const PairReport*>> disagreeing;
  std::size_t noPixel = 0, judged = 0;
  for (const auto& [which, each] : cameras_) {
    OrderedJson row{{"name", each.name}};
    row.update(each.report.statistics());
    noPixel += each.report.noPixel();
    if (!each.report.agrees()) {
      const std::vector<std::size_t> lines = each.report.wrongLines();
      wrong.insert(wrong.end(), lines.begin(), lines.end());
      if (lines.empty() && each.report.judged() > 0)
        disagreeing.emplace_back(row["rmsMiss"].is_null() ? HUGE_VAL : row["rmsMiss"].get<double>(), &each.report);
    }
    cameras.push_back(std::move(row));
  }
  std::sort(wrong.begin(), wrong.end());
  std::sort(disagreeing.begin(), disagreeing.end());
  if (!disagreeing.empty()) {  // sought for the one in the middle, and tried on all
    const PairReport& middle = *disagreeing[disagreeing.size() / 2].second;
    judged = middle.judged();
    wrong.clear();
    for (const Explanation& e : middle.explanations()) {
      const auto count = [&](const auto& isMended) {
        return std::count_if(cameras_.begin(), cameras_.end(),
                             [&](const auto& each) { return isMended(each.second.report); });
      };
      const Mend mend = middle.mendOf(e);
      const auto anew = count([&](const PairReport& each) { return each.isMendedBy(middle, e); });
      const auto asIs = count([&](const PairReport& each) { return each.isMendedBy(mend, e.hypothesis); });
      OrderedJson one = middle.asJson(e, mend);
      one["camerasMended"] = std::max(anew, asIs);
      if (asIs < anew) one["mend"] = nullptr;  // in each camera it is another
      list.push_back(std::move(one));
    }
  }
  return whole(agrees(), records_, noPixel, within_, misses_.statistics(), judged, wrong, list, cameras);
}

}  // namespace viewproj::cmd::mistakes
