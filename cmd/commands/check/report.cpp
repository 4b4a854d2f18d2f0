#include "commands/check/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "commands/check/mend.hpp"
#include "commands/check/words.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {
namespace {

OrderedJson orNull(const std::string& text) { return text.empty() ? OrderedJson(nullptr) : OrderedJson(text); }
OrderedJson orNull(double number) { return std::isfinite(number) ? OrderedJson(number) : OrderedJson(nullptr); }

}  // namespace

/// Distances of pixels: exact, or where these are too many, counted in steps of a thousandth.
struct Misses {
  std::size_t most;  ///< exact ones
  std::size_t count = 0, worst = 0;
  double sum = 0, squares = 0, largest = 0;
  bool isInSteps = false;
  std::map<double, std::size_t> counts = {};

  static double inStep(double miss) {
    const double step = std::log(1.001);
    return std::exp(std::ceil(std::log(std::max(miss, 1e-300)) / step) * step);
  }

  void add(double miss, std::size_t line) {
    ++count;
    sum += miss;
    squares += miss * miss;
    if (worst == 0 || miss > largest) {
      largest = miss;
      worst = line;
    }
    ++counts[isInSteps ? inStep(miss) : miss];
    if (isInSteps || counts.size() <= most) return;
    isInSteps = true;
    for (const auto& [each, times] : std::exchange(counts, {})) counts[inStep(each)] += times;
  }

  /// The miss that so many are below, of all in order.
  double at(std::size_t rank) const {
    std::size_t below = 0;
    for (const auto& [miss, times] : counts)
      if ((below += times) > rank) return std::min(largest, miss);
    return NAN;
  }

  OrderedJson statistics() const {
    const auto n = static_cast<double>(count);
    return {{"rmsMiss", orNull(std::sqrt(squares / n))},
            {"meanMiss", orNull(sum / n)},
            {"medianMiss", orNull((at((count - 1) / 2) + at(count / 2)) / 2)},
            {"miss95", orNull(at((95 * count + 99) / 100 - 1))},  // the smallest that at least 95 % do not exceed
            {"largestMiss", orNull(count > 0 ? largest : NAN)},
            {"worst", count > 0 ? OrderedJson(worst) : OrderedJson(nullptr)}};
  }
};

namespace {

bool areWithin(std::span<const Vec2> misses, double within) {
  return std::all_of(misses.begin(), misses.end(), [&](const Vec2& miss) { return length(miss) <= within; });
}

/// Infinite where one has no pixel.
double squaresOf(std::span<const Vec2> misses) {
  double squares = 0;
  for (const Vec2& miss : misses) squares += miss.x * miss.x + miss.y * miss.y;
  return std::isnan(squares) ? HUGE_VAL : squares;
}

}  // namespace

/// A camera with the pairs that are of it.
struct CheckedCamera {
  std::string name;
  std::optional<CameraFile> file;
  double within;
  std::size_t most;  ///< pairs that are kept: the first, and every 2^j-th after it
  Misses misses;
  std::size_t records = 0, noPixel = 0, stride = 1;
  std::optional<Camera> camera = file ? std::optional(makeCamera(*file)) : std::nullopt;
  std::vector<Pair> pairs = {};

  /// Returns by how much the pair misses, where both have a pixel.
  std::optional<double> add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line) {
    const std::size_t index = records++;
    const ScreenPoint at = worldToScreen(*camera, point);
    const bool isSeen = at.status == PointStatus::inFront;
    if (isSeen != pixel.has_value()) ++noPixel;
    const Vec2 given = pixel.value_or(Vec2{NAN, NAN});
    Vec2 miss = Vec2{at.x, at.y} - given;
    if (!isSeen && !pixel) miss = {};
    if (index % stride == 0) pairs.push_back({point, given, line, miss});
    if (pairs.size() > most) {
      std::size_t place = 0;
      std::erase_if(pairs, [&](const Pair&) { return place++ % 2 == 1; });
      stride *= 2;
    }
    if (!isSeen || !pixel) return std::nullopt;
    const double distance = std::hypot(miss.x, miss.y);
    misses.add(std::isnan(distance) ? HUGE_VAL : distance, line);
    return distance;
  }

  bool agrees() const { return noPixel == 0 && misses.largest <= within; }
  double rms() const {
    return misses.count == 0 ? HUGE_VAL : std::sqrt(misses.squares / static_cast<double>(misses.count));
  }

  /// The lines of those pairs, at most a quarter, that miss by several times more than the others, which chance does
  /// not explain; whether the others agree but for noise.
  struct Wrong {
    bool othersAgree = false;
    std::vector<std::size_t> lines = {};
  };
  Wrong wrong() const {
    const std::size_t quarter = std::max<std::size_t>(1, pairs.size() / 4);
    if (pairs.size() < 4) return {};
    std::vector<double> distances;
    for (const Pair& pair : pairs) distances.push_back(std::isnan(length(pair.miss)) ? HUGE_VAL : length(pair.miss));
    const double limit = wrongFrom(distances, quarter, within);
    Wrong found;
    double squares = 0, least = HUGE_VAL;  // of the others, of the wrong ones
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!(distances[i] > limit)) {
        squares += distances[i] * distances[i];
        continue;
      }
      found.lines.push_back(pairs[i].line);
      least = std::min(least, distances[i]);
    }
    const auto lines = static_cast<double>(found.lines.size()), others = static_cast<double>(pairs.size()) - lines;
    found.othersAgree = lines <= static_cast<double>(quarter) && std::sqrt(squares / others) <= within;
    // Of normal noise so many miss by as much with the probability (1 + lines least^2 / squares)^-others a choice.
    const double evidence =
        others * std::log1p(lines * least * least / squares) - logChoices(pairs.size(), found.lines.size());
    if (!found.othersAgree && !(lines <= static_cast<double>(quarter) && evidence > kThreshold)) return {};
    return found;
  }

  /// In which mistakes are sought.
  std::vector<Pair> pairsWithPixel() const {
    std::vector<Pair> some = pairs;
    std::erase_if(some, [](const Pair& pair) { return std::isnan(pair.pixel.x); });
    return some;
  }
};

/// What the cameras of a set then miss by, and how many of them are within the tolerance by the mistake's mend.
struct Left {
  std::size_t mended = 0, count = 0;
  double squares = 0, largest = 0;
  double cost = 0;  ///< the squares; infinite where a point has no pixel

  void add(std::span<const Vec2> misses) {
    cost += squaresOf(misses);
    for (const Vec2& miss : misses) {
      const double distance = length(miss);
      if (std::isnan(distance)) continue;
      ++count;
      squares += distance * distance;
      largest = std::max(largest, distance);
    }
  }
};

PairReport::PairReport(double within)
    : within_(within), isSet_(true), all_(new CheckedCamera{"", std::nullopt, within, 0, {10'000}}) {}

PairReport::PairReport(const CameraFile& file, double within) : PairReport(within) {
  isSet_ = false;
  cameras_.emplace(0, new CheckedCamera{"", file, within, 4096, {10'000}});
}

void PairReport::add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line, std::size_t camera,
                     const std::function<std::pair<std::string, CameraFile>()>& read) {
  std::shared_ptr<CheckedCamera>& of = cameras_[camera];
  if (!of) {
    const auto [name, file] = read();
    of.reset(new CheckedCamera{name, file, within_, 512, {1000}});
  }
  ++all_->records;
  if (const auto miss = of->add(point, pixel, line)) all_->misses.add(*miss, line);
}

std::size_t PairReport::records() const { return all_->records; }

OrderedJson PairReport::explanations(const CheckedCamera& of, const Others& others) const {
  const std::vector<Pair> judged = of.pairsWithPixel();
  std::vector<Explanation> found = explain(*of.file, judged, within_, isSet_), ofOthers;
  // In place of few wrong lines a mistake needs evidence, and leaves none that is wrong.
  if (const auto few = of.wrong(); few.othersAgree && !few.lines.empty())
    std::erase_if(found, [&, left = of](const Explanation& e) mutable {
      if (!(e.evidence > kThreshold)) return true;
      left.pairs = judged;
      for (std::size_t i = 0; i < judged.size(); ++i) left.pairs[i].miss = e.misses[i];
      const auto [agree, lines] = left.wrong();
      return !agree || !lines.empty();
    });
  // A mistake without a number is simpler than another camera.
  if (others && (found.empty() || found[0].hypothesis.parameters > 0 || found[0].largest > within_))
    for (const auto& [pick, file] : others()) {
      const auto camera = plainWith(file, {}, false);
      if (!camera) continue;
      Explanation e{.hypothesis = {.mistake = "camera-of-file", .value = pick, .camera = *camera}};
      e.misses = missesOf(e.hypothesis, judged);
      const auto isSame = [&](const Explanation& other) { return other.misses == e.misses; };
      if (!areWithin(e.misses, within_) || std::any_of(ofOthers.begin(), ofOthers.end(), isSame)) continue;
      e.rms = std::sqrt(squaresOf(e.misses) / static_cast<double>(2 * judged.size()));
      for (const Vec2& miss : e.misses) e.largest = std::max(e.largest, length(miss));
      ofOthers.push_back(std::move(e));
    }
  const bool isOfOther = !ofOthers.empty();  // it is picked, and no field is mended
  if (isOfOther) found = std::move(ofOthers);
  struct Told {
    Mend mend;
    Left anew = {}, asItIs = {};  ///< made for each camera, or one mend for all
    bool isHarmless = true;       ///< all cameras that agree do so with the mend
  };
  std::vector<Told> told;
  for (const Explanation& e : found) told.push_back({isOfOther ? Mend{} : mendOf(*of.file, e, judged)});
  for (const auto& [place, camera] : cameras_) {
    if (!isSet_) break;
    const std::vector<Hypothesis> rows = rowsOf(*camera->file);
    const std::vector<Pair> pairs = camera->pairsWithPixel();
    for (std::size_t i = 0; i < found.size(); ++i) {
      auto& [mend, anew, asItIs, isHarmless] = told[i];
      std::vector<Vec2> best;
      for (const Pair& pair : pairs) best.push_back(pair.miss);
      bool isAnew = false;
      for (const Hypothesis& its : madeAnew(found[i].hypothesis, *of.file, *camera->file, rows))
        if (std::vector<Vec2> misses = missesOf(its, pairs); squaresOf(misses) < squaresOf(best)) {
          best = std::move(misses);
          isAnew = true;
        }
      anew.mended += isAnew && areWithin(best, within_);
      anew.add(best);
      const auto misses = missesWith(*camera->file, mend, found[i].hypothesis, pairs);
      const bool isMended = misses && areWithin(*misses, within_);
      if (misses) asItIs.add(*misses);
      asItIs.mended += isMended;
      isHarmless &= misses && (isMended || !camera->agrees());
    }
  }
  std::size_t most = 0;
  for (const Told& each : told) most = std::max({most, each.anew.mended, each.asItIs.mended});
  OrderedJson list = OrderedJson::array();
  std::vector<const Explanation*> shown;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [mend, anew, asItIs, isHarmless] = told[i];
    Explanation& e = found[i];
    const bool isOneMend = isHarmless && asItIs.mended >= anew.mended && asItIs.cost <= 1.01 * anew.cost + 1e-6;
    const std::size_t mended = std::max(anew.mended, asItIs.mended);
    if (mended < most) continue;
    // Of the cameras, too, it is the same under another name.
    if (isSet_ && std::any_of(shown.begin(), shown.end(), [&](const auto* other) { return isSame(*other, e, true); }))
      continue;
    shown.push_back(&e);
    if (isSet_) {  // what is told is of all cameras
      const Left& left = isOneMend ? asItIs : anew;
      e.rms = std::sqrt(left.squares / static_cast<double>(2 * left.count));
      e.largest = left.largest;
    }
    const bool isOfOne = isSet_ && mended <= 1 && cameras_.size() > 1;
    list.push_back({{"mistake", e.hypothesis.mistake},
                    {"sentence", sentenceOf(*of.file, e, within_) + (isOfOne ? " (" + of.name + " alone)" : "")},
                    {"value", e.hypothesis.value},
                    {"mend", orNull(isOneMend ? mend.options() : "")},
                    {"pairs", orNull(wordsForPairs(e.hypothesis, mend.pixels))},
                    {"rmsMiss", std::numbers::sqrt2 * e.rms},
                    {"largestMiss", e.largest},
                    {"wrongPairs", e.wrong},
                    {"camerasMended", isSet_ ? OrderedJson(mended) : OrderedJson(nullptr)}});
  }
  return list;
}

OrderedJson PairReport::report(const Others& others) const {
  OrderedJson cameras = OrderedJson::array(), list = OrderedJson::array();
  std::vector<std::size_t> wrong;
  std::vector<const CheckedCamera*> open, noisy, few;  // that disagree: by many pairs, by noise, by few pairs
  std::size_t noPixel = 0, judged = isSet_ ? 0 : cameras_.at(0)->pairsWithPixel().size();
  bool agrees = true;
  for (const auto& [place, camera] : cameras_) {
    noPixel += camera->noPixel;
    OrderedJson row{{"name", camera->name}, {"records", camera->records}, {"noPixel", camera->noPixel}};
    row.update(camera->misses.statistics());
    cameras.push_back(std::move(row));
    if (camera->agrees()) continue;
    agrees = false;
    const auto [othersAgree, lines] = camera->wrong();
    wrong.insert(wrong.end(), lines.begin(), lines.end());
    const std::vector<Pair> pairs = camera->pairsWithPixel();
    const bool agree =
        std::all_of(pairs.begin(), pairs.end(), [&](const Pair& p) { return length(p.miss) <= within_; });
    if (!agree) (!othersAgree ? open : lines.empty() ? noisy : few).push_back(camera.get());
  }
  for (const auto& next : {noisy, few})
    if (open.empty()) open = next;
  std::sort(wrong.begin(), wrong.end());
  std::stable_sort(open.begin(), open.end(), [](const auto* a, const auto* b) { return a->rms() < b->rms(); });
  if (!open.empty()) {  // sought for the one in the middle, and tried on all
    const CheckedCamera& middle = *open[open.size() / 2];
    judged = middle.pairsWithPixel().size();
    list = explanations(middle, others);
    if (!list.empty()) wrong.clear();
  }
  const bool isFound = agrees || !list.empty() || !wrong.empty();
  OrderedJson report{{"agrees", agrees}, {"records", all_->records}, {"noPixel", noPixel}, {"within", within_}};
  report.update(all_->misses.statistics());
  report.update(OrderedJson{{"judged", judged},
                            {"wrongPairs", wrong},
                            {"explanations", list},
                            {"verdict", isFound ? OrderedJson(nullptr) : OrderedJson("no explanation found")},
                            {"cameras", isSet_ ? cameras : OrderedJson(nullptr)}});
  return report;
}

}  // namespace viewproj::cmd::mistakes
