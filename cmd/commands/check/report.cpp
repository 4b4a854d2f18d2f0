#include "commands/check/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "commands/check/mend.hpp"
#include "commands/check/words.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {
namespace {

OrderedJson orNull(const std::string& text) { return text.empty() ? OrderedJson(nullptr) : OrderedJson(text); }
OrderedJson orNull(double number) { return std::isfinite(number) ? OrderedJson(number) : OrderedJson(nullptr); }

double inStep(double miss) {
  const double step = std::log(1.001);
  return std::exp(std::ceil(std::log(std::max(miss, 1e-300)) / step) * step);
}

bool isWithin(const std::vector<Vec2>& misses, double within) {
  return std::all_of(misses.begin(), misses.end(), [&](const Vec2& miss) { return length(miss) <= within; });
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
  ++counts_[isInSteps_ ? inStep(miss) : miss];
  if (isInSteps_ || counts_.size() <= exact_) return;
  isInSteps_ = true;
  for (const auto& [each, count] : std::exchange(counts_, {})) counts_[inStep(each)] += count;
}

double Misses::at(std::size_t rank) const {
  std::size_t below = 0;
  for (const auto& [miss, count] : counts_)
    if ((below += count) > rank) return std::min(largest_, miss);
  return NAN;
}

OrderedJson Misses::statistics() const {
  const auto n = static_cast<double>(count_);
  return {{"rmsMiss", orNull(std::sqrt(squares_ / n))},
          {"meanMiss", orNull(sum_ / n)},
          {"medianMiss", orNull((at((count_ - 1) / 2) + at(count_ / 2)) / 2)},
          {"miss95", orNull(at((95 * count_ + 99) / 100 - 1))},
          {"largestMiss", orNull(count_ > 0 ? largest_ : NAN)},
          {"worst", count_ > 0 ? OrderedJson(worst_) : OrderedJson(nullptr)}};
}

// ---- A camera

CheckedCamera::CheckedCamera(const CameraFile& file, double within, std::size_t exact, std::size_t most)
    : file_(file), camera_(makeCamera(file)), within_(within), most_(most), misses_(exact) {}

std::optional<double> CheckedCamera::add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line) {
  const std::size_t index = records_++;
  const ScreenPoint at = worldToScreen(camera_, point);
  const bool isSeen = at.status == PointStatus::inFront;
  if (isSeen != pixel.has_value()) ++noPixel_;
  if (!pixel) return std::nullopt;
  const Vec2 miss = Vec2{at.x, at.y} - *pixel;
  if (index % stride_ == 0) pairs_.push_back({point, *pixel, line, miss});
  if (pairs_.size() > most_) {
    std::size_t place = 0;
    std::erase_if(pairs_, [&](const Pair&) { return place++ % 2 == 1; });
    stride_ *= 2;
  }
  if (!isSeen) return std::nullopt;
  const double distance = std::hypot(miss.x, miss.y);
  misses_.add(std::isnan(distance) ? HUGE_VAL : distance, line);
  return distance;
}

std::vector<std::size_t> CheckedCamera::wrongLines() const {
  std::vector<std::size_t> wrong;
  for (const Pair& pair : pairs_)
    if (!(length(pair.miss) <= within_)) wrong.push_back(pair.line);
  const bool areFew = pairs_.size() >= 4 && wrong.size() <= std::max<std::size_t>(1, pairs_.size() / 4);
  return areFew ? wrong : std::vector<std::size_t>{};
}

std::string CheckedCamera::pixelOrder() const {
  constexpr std::size_t kMost = 2000;
  std::string words;
  if (pairs_.size() > kMost) return words;
  std::set<std::size_t> taken;
  for (const Pair& pair : pairs_) {
    const Vec2 at{pair.pixel.x + pair.miss.x, pair.pixel.y + pair.miss.y};
    std::vector<std::size_t> near;
    for (const Pair& other : pairs_)
      if (length(at - other.pixel) <= within_) near.push_back(other.line);
    if (near.size() != 1 || !taken.insert(near[0]).second) return "";
    if (near[0] != pair.line)
      words += (words.empty() ? "give line " : ", line ") + std::to_string(pair.line) + " the pixel of line " +
               std::to_string(near[0]);
  }
  return words;
}

OrderedJson CheckedCamera::statistics() const {
  OrderedJson statistics{{"records", records_}, {"noPixel", noPixel_}};
  statistics.update(misses_.statistics());
  return statistics;
}

// ---- All

PairReport::PairReport(const CameraFile& file, double within) : within_(within), isSet_(false) {
  cameras_.emplace(0, std::pair("", CheckedCamera(file, within, kExact, kPairs)));
}

void PairReport::add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line, std::size_t camera,
                     const std::function<std::pair<std::string, CameraFile>()>& read) {
  auto found = cameras_.find(camera);
  if (found == cameras_.end()) {
    const auto [name, file] = read();
    found = cameras_.emplace(camera, std::pair(name, CheckedCamera(file, within_, kExactOfEach, kPairsOfEach))).first;
  }
  ++records_;
  if (const auto miss = found->second.second.add(point, pixel, line)) misses_.add(*miss, line);
}

bool PairReport::agrees() const {
  return std::all_of(cameras_.begin(), cameras_.end(), [](const auto& each) { return each.second.second.agrees(); });
}

OrderedJson PairReport::explanations(const CheckedCamera& of) const {
  OrderedJson list = OrderedJson::array();
  const auto add = [&](const std::string& mistake, const std::string& sentence, const Json& value,
                       const std::string& mend, const std::string& pairs, double rms, double largest,
                       const std::vector<std::size_t>& wrong, const OrderedJson& mended) {
    list.push_back({{"mistake", mistake},
                    {"sentence", sentence},
                    {"value", value},
                    {"mend", orNull(mend)},
                    {"pairs", orNull(pairs)},
                    {"rmsMiss", orNull(rms)},
                    {"largestMiss", orNull(largest)},
                    {"wrongPairs", wrong},
                    {"camerasMended", mended}});
  };
  for (const Explanation& e : explain(of.file(), of.pairs(), within_)) {
    const Hypothesis& h = e.hypothesis;
    const Mend mend = mendOf(of.file(), e, of.pairs());
    std::size_t anew = 0, asIs = 0;  // cameras that it mends, made anew for each or as it stands
    for (const auto& [place, each] : cameras_) {
      const CheckedCamera& camera = each.second;
      if (!isSet_) continue;
      const auto forIt = madeAnew(h, of.file(), camera.file());
      anew += std::any_of(forIt.begin(), forIt.end(),
                          [&](const Hypothesis& its) { return isWithin(missesOf(its, camera.pairs()), within_); });
      const auto misses = missesWith(camera.file(), mend, h, camera.pairs());
      asIs += misses && isWithin(*misses, within_);
    }
    add(h.mistake, sentenceOf(of.file(), e, within_), h.value, asIs < anew ? "" : mend.options(),
        wordsForPairs(h, mend.pixels), std::numbers::sqrt2 * e.rms, e.largest, e.wrong,
        isSet_ ? OrderedJson(std::max(anew, asIs)) : OrderedJson(nullptr));
  }
  if (const std::string order = list.empty() ? of.pixelOrder() : ""; !order.empty())
    add("pixel-order", "the pixels are in another order", nullptr, "", order, NAN, NAN, {}, nullptr);
  return list;
}

OrderedJson PairReport::report() const {
  OrderedJson cameras = OrderedJson::array(), list = OrderedJson::array();
  std::vector<std::size_t> wrong;
  std::vector<std::pair<double, const CheckedCamera*>> disagreeing;  // with their rms
  std::size_t noPixel = 0;
  for (const auto& [place, each] : cameras_) {
    const auto& [name, camera] = each;
    OrderedJson row{{"name", name}};
    row.update(camera.statistics());
    noPixel += camera.noPixel();
    const std::vector<std::size_t> lines = camera.agrees() ? std::vector<std::size_t>{} : camera.wrongLines();
    wrong.insert(wrong.end(), lines.begin(), lines.end());
    if (!camera.agrees() && lines.empty() && !camera.pairs().empty())
      disagreeing.emplace_back(row["rmsMiss"].is_null() ? HUGE_VAL : row["rmsMiss"].get<double>(), &camera);
    cameras.push_back(std::move(row));
  }
  std::sort(wrong.begin(), wrong.end());
  std::sort(disagreeing.begin(), disagreeing.end());
  std::size_t judged = isSet_ ? 0 : cameras_.at(0).second.pairs().size();
  if (!disagreeing.empty()) {  // sought for the one in the middle, and tried on all
    const CheckedCamera& middle = *disagreeing[disagreeing.size() / 2].second;
    judged = middle.pairs().size();
    wrong.clear();
    list = explanations(middle);
  }
  const bool isOpen = !agrees() && list.empty() && wrong.empty();
  OrderedJson report{{"agrees", agrees()}, {"records", records_}, {"noPixel", noPixel}, {"within", within_}};
  report.update(misses_.statistics());
  report.update(OrderedJson{{"judged", judged},
                            {"wrongPairs", wrong},
                            {"explanations", list},
                            {"verdict", isOpen ? OrderedJson("no explanation found") : OrderedJson(nullptr)},
                            {"cameras", isSet_ ? cameras : OrderedJson(nullptr)}});
  return report;
}

}  // namespace viewproj::cmd::mistakes
