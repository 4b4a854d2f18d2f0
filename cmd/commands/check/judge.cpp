#include "commands/check/judge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "commands/check/families.hpp"
#include "commands/check/words.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kFloor = 1e-3;  // pixels: what is left is never told apart below this
const double kAsGood = std::log(100);

// ---- Two mistakes at once

/// first, and then second: of the points, the camera and the pixels as first leaves them.
Hypothesis both(const Hypothesis& first, Hypothesis second) {
  second.mistake = first.mistake + " + " + second.mistake;
  second.value = Json{first.value, second.value};
  second.pixels = second.pixels * first.pixels;
  second.points = second.points * first.points;
  second.sets.insert(second.sets.begin(), first.sets.begin(), first.sets.end());
  second.stretch |= first.stretch;
  second.parameters += first.parameters;
  return second;
}

/// Each with the others that may follow it.
template <class Seconds>
std::vector<Hypothesis> inTwos(const std::vector<Hypothesis>& firsts, const Seconds& secondsOf) {
  std::vector<Hypothesis> all;
  for (const Hypothesis& first : firsts)
    for (Hypothesis& second : secondsOf(first))
      if (second.mistake != first.mistake) all.push_back(both(first, std::move(second)));
  return all;
}

template <class May>
std::vector<Hypothesis> someOf(const std::vector<Hypothesis>& all, const May& may) {
  std::vector<Hypothesis> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some), may);
  return some;
}

bool isIn(const Hypothesis& h, std::initializer_list<std::string_view> mistakes) {
  return std::find(mistakes.begin(), mistakes.end(), h.mistake) != mistakes.end();
}

/// Whether it is a --set by itself that turns or moves the camera.
bool setsPose(const Hypothesis& h) {
  return !h.sets.empty() && std::none_of(h.sets.begin(), h.sets.end(), [](const Set& set) {
    return set.first.starts_with("viewport") || set.first.starts_with("projection") || set.first == "distortion";
  });
}

/// Flips, mirrors, turns and exchanges of the pixels, one of each.
std::vector<Hypothesis> turnedPixels(const std::vector<Hypothesis>& pixels) {
  std::vector<Hypothesis> some;
  for (const Hypothesis& h : pixels) {
    const auto isLike = [&](const Hypothesis& other) {
      return PixelMap{h.pixels.xx, h.pixels.xy, other.pixels.x0, h.pixels.yx, h.pixels.yy, other.pixels.y0} ==
             other.pixels;
    };
    if (h.movesPixels() && isIn(h, {"y-flipped", "x-mirrored", "picture-turned", "row-column"}) &&
        std::none_of(some.begin(), some.end(), isLike))
      some.push_back(h);
  }
  return some;
}

/// So many times what a pixel counts that it leaves, where it makes the picture smaller.
double growthOf(const Hypothesis& h) {
  const double size = h.pixels.size() * h.scale;
  return size > 0 ? std::max(1.0, 1 / std::sqrt(size)) : 1;
}

// ---- Order

/// Rounded, so that of two forms of a mistake the first one counts.
double weighted(const Explanation& e) {
  const double share = std::min(1.0, 100.0 / static_cast<double>(std::max<std::size_t>(e.misses.size(), 1)));
  return std::round(1e6 * e.evidence * share) / 1e6;
}

/// Two at once count as one more.
int parametersOf(const Explanation& e) {
  return e.hypothesis.parameters + (e.hypothesis.mistake.find(" + ") != std::string::npos ? 1 : 0);
}

/// 0: a --set by itself, or the points; 1: a pose, of which fields are made; 2: the pixels are changed.
int detourOf(const Hypothesis& h) {
  return h.movesPixels() ? 2 : h.sets.empty() && h.points == kUnit && h.places == PlaceMap::none ? 1 : 0;
}

/// Whether it is told without evidence: a row that has long been known, and leaves no more than the tolerance.
bool bringsWithin(const Explanation& e, double within) {
  return e.stage == Stage::rows && !e.hypothesis.isRead && e.largest <= within && isLongKnown(e.hypothesis.mistake);
}

/// By how much less evidence it may stand in place of the best: if it is simpler.
double allowanceOf(const Explanation& e, const Explanation& best, double within) {
  const bool isOneOfTwo = best.stage >= Stage::rest && e.stage <= Stage::families;
  const int more = parametersOf(e) - parametersOf(best);
  if (more > 0 || e.stage > best.stage) return -HUGE_VAL;
  if (isOneOfTwo && growthOf(e.hypothesis) * e.largest <= within) return HUGE_VAL;
  if (more < 0 && best.rms <= kFloor && e.rms <= kFloor) return HUGE_VAL;
  if (isSame(e, best, true)) return HUGE_VAL;
  return isOneOfTwo ? 7 : more < 0 ? kAsGood : 1;
}

/// The best first; then at most five that are as good with no more parameters, one of each mistake. keepsSame: also
/// those that leave the same.
std::vector<Explanation> listed(std::vector<Explanation> found, double within, bool keepsSame = false) {
  if (found.empty()) return found;
  std::stable_sort(found.begin(), found.end(),
                   [](const Explanation& a, const Explanation& b) { return weighted(a) > weighted(b); });
  const auto rank = [](const Explanation& e) {
    return std::tuple(parametersOf(e), e.stage, detourOf(e.hypothesis), placeOf(e.hypothesis.mistake));
  };
  auto best = found.begin();
  for (auto e = found.begin(); e != found.end(); ++e)
    if (weighted(*e) > weighted(found[0]) - allowanceOf(*e, found[0], within) && rank(*e) < rank(*best)) best = e;
  std::rotate(found.begin(), best, best + 1);
  std::vector<Explanation> out;
  std::set<std::string> hidden;  // mistakes of which the best form leaves the same under another name
  int fewest = parametersOf(found[0]);
  for (Explanation& e : found) {
    const int parameters = parametersOf(e);
    const bool isOld = isLongKnown(e.hypothesis.mistake), isRow = bringsWithin(e, within);
    const std::string& mistake = e.hypothesis.mistake;
    const auto tells = [&](const auto& isAlike) {
      return std::any_of(out.begin(), out.end(),
                         [&](const Explanation& o) { return parameters >= parametersOf(o) && isAlike(o); });
    };
    if (!keepsSame && tells([&](const Explanation& o) {
          return (!isOld || detourOf(e.hypothesis) > detourOf(o.hypothesis)) && isSame(e, o, true);
        }))
      hidden.insert(mistake);
    const bool isToldAlready =
        hidden.contains(mistake) || tells([&](const Explanation& o) { return o.hypothesis.mistake == mistake; });
    const auto isAsGood = [&] {
      const bool isOfTwo = e.stage > Stage::families && out[0].stage <= Stage::families;
      return parameters <= fewest && weighted(e) >= weighted(out[0]) + (isOfTwo ? 3 : -kAsGood);
    };
    if (isToldAlready || !(out.empty() || isRow || isAsGood())) continue;
    fewest = std::min(fewest, parameters);
    out.push_back(std::move(e));
    if (out.size() == (keepsSame ? 12 : 6)) break;
  }
  return out;
}

/// Of the components.
double rmsOf(std::span<const Vec2> misses) {
  double squares = 0;
  for (const Vec2& miss : misses) squares += miss.x * miss.x + miss.y * miss.y;
  return std::sqrt(squares / (2 * static_cast<double>(misses.size())));
}

// ---- The search

class Search {
 public:
  Search(const CameraFile& file, std::span<const Pair> pairs, double within)
      : trials_(file),
        pairs_(pairs),
        within_(within),
        nothing_{.mistake = "", .camera = trials_.plain()},
        rows_(rowsOf(file)),
        before_(missesOf(nothing_, pairs)) {}

  std::vector<Explanation> explanations(bool keepsSame) {
    const auto familiesAfter = [&](Table table) {
      return [this, table](const Hypothesis& first) { return families(fitOf(first), table); };
    };
    seek(rows_, Stage::rows);
    const std::vector<Hypothesis> simple = families(fitOf(nothing_), Table::simple);
    seek(simple, Stage::families);
    for (const Hypothesis& h : simple) addRatioRows(trials_, h);
    std::vector<Hypothesis> ratios = trials_.take();
    for (Hypothesis& h : ratios) h.isRead = true;
    seek(ratios, Stage::rows, static_cast<double>(rows_.size()));
    seekAmongNoise();
    const std::vector<Hypothesis> seconds = inTwos(bestRows(), [&](const Hypothesis& first) {
      std::vector<Hypothesis> all = families(fitOf(first), Table::simple);
      for (const double half : {0.5, -0.5}) {
        Hypothesis centre{.mistake = "pixel-centre", .camera = first.camera};
        centre.camera.centre = centre.camera.centre - Vec2{half, half};
        all.push_back(std::move(centre));
      }
      return all;
    });
    seek(seconds, Stage::rest, 60 * static_cast<double>(seconds.size()));
    std::vector<Hypothesis> turned = turnedPixels(rows_);
    if (!isExplained()) {
      const std::vector<Explanation> order = pixelOrder();
      if (!order.empty() && order[0].wrong.empty()) return order;
      seek(twoRows(), Stage::two);
      std::vector<Hypothesis> firsts =
          someOf(rows_, [](const Hypothesis& h) { return isIn(h, {"distortion-ignored"}); });
      firsts.insert(firsts.end(), turned.begin(), turned.end());
      seek(inTwos(firsts, familiesAfter(Table::simple)), Stage::flips);
    }
    const double poses = static_cast<double>(countOf(Table::poses));
    if (!isExplained()) seek(families(fitOf(nothing_), Table::poses), Stage::poses, poses);
    if (!isExplained()) {
      turned.resize(2, nothing_);
      seek(inTwos(turned, familiesAfter(Table::poses)), Stage::flippedPoses, 2 * poses);
    }
    if (!isExplained()) {
      const std::vector<Explanation> beside = listed(besideWrongPairs(), within_);
      const auto isWorse = [&](const Explanation& e) { return weighted(e) < weighted(beside[0]); };
      if (!beside.empty() && std::all_of(found_.begin(), found_.end(), isWorse)) return {beside[0]};
    }
    if (found_.empty()) found_ = pixelOrder();
    return listed(std::move(found_), within_, keepsSame);
  }

 private:
  /// Those of the hypotheses that explain something. wrong: how many pairs they may, and must, leave out.
  std::vector<Explanation> judged(std::vector<Hypothesis> hypotheses, Stage stage, double tries,
                                  std::size_t wrong = 0) const {
    const std::size_t n = pairs_.size();
    std::vector<Explanation> found;
    const bool areMany = n > 200 && wrong == 0;
    for (Hypothesis& h : hypotheses) {
      if (areMany && !mayExplain(h)) continue;
      Explanation e{.hypothesis = std::move(h), .stage = stage};
      e.misses = missesOf(e.hypothesis, pairs_);
      std::vector<double> distances;
      for (const Vec2& miss : e.misses) {
        const double distance = length(miss);
        distances.push_back(std::isnan(distance) ? HUGE_VAL : distance);
      }
      const double limit = wrong > 0 ? wrongFrom(distances, wrong, within_) : HUGE_VAL;
      double squares = 0;
      std::vector<std::size_t> right;
      for (std::size_t i = 0; i < n; ++i) {
        if (!(distances[i] <= limit)) {
          e.wrong.push_back(pairs_[i].line);
          continue;
        }
        right.push_back(i);
        squares += distances[i] * distances[i];
        e.largest = std::max(e.largest, distances[i]);
      }
      if (!std::isfinite(e.largest) || e.wrong.size() > wrong || e.wrong.empty() != (wrong == 0)) continue;
      e.rms = std::sqrt(squares / static_cast<double>(2 * right.size()));
      if (isLeftOut(e)) continue;
      e.evidence =
          evidenceOf(e.hypothesis, e.rms, right) - std::log(std::max(tries, 1.0)) - logChoices(n, e.wrong.size());
      if (e.evidence > kThreshold || bringsWithin(e, within_)) found.push_back(std::move(e));
    }
    return found;
  }

  /// Whether it has a unit so small or large that only the eye's distance from the origin vanishes.
  bool isLeftOut(const Explanation& e) const {
    if (!e.hypothesis.mistake.ends_with("unit")) return false;
    Hypothesis without = e.hypothesis;
    without.camera.eye = {};
    std::vector<Vec2> differences = missesOf(without, pairs_);
    for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = differences[i] - e.misses[i];
    return rmsOf(differences) <= std::max(e.rms, kFloor);
  }

  /// Of what the pairs that it is of miss by before, and the rms that it leaves.
  double evidenceOf(const Hypothesis& h, double rms, const std::vector<std::size_t>& right) const {
    const auto n = static_cast<double>(right.size());
    std::vector<Vec2> mended;
    Vec2 mean, squares;
    for (const std::size_t i : right) {
      mended.push_back(h.pixel(pairs_[i].pixel));
      mean = {mean.x + mended.back().x / n, mean.y + mended.back().y / n};
    }
    for (const Vec2& at : mended)
      squares = {squares.x + (at.x - mean.x) * (at.x - mean.x), squares.y + (at.y - mean.y) * (at.y - mean.y)};
    const double grow = growthOf(h);
    const double left = std::max(rms * grow, kFloor);
    const auto deviation = [&](double sum) { return right.size() > 1 ? std::sqrt(sum / (n - 1)) * grow : 500; };
    const Vec2 most{deviation(squares.x), deviation(squares.y)};
    if (2 * left >= std::max(most.x, most.y)) return 0;
    std::vector<double> gains;
    const auto add = [&](double before, double limit) {
      const double miss = std::isfinite(before) ? std::min(std::fabs(before), limit) : limit;
      gains.push_back(std::max(0.0, std::log(std::max(miss, 1e-300) / (2 * left))));
    };
    for (const std::size_t i : right) {
      add(before_[i].x, most.x);
      add(before_[i].y, most.y);
    }
    const auto kept = gains.end() - std::min(std::ssize(gains), std::ptrdiff_t{h.parameters});
    std::nth_element(gains.begin(), kept, gains.end());
    return std::accumulate(gains.begin(), kept, 0.0);
  }

  /// Whether it has evidence in a few of many pairs.
  bool mayExplain(const Hypothesis& h) const {
    constexpr std::size_t kFew = 64;
    std::vector<std::size_t> few;
    double squares = 0;
    for (std::size_t i = 0; i < pairs_.size(); i += pairs_.size() / kFew) {
      const double distance = length(missOf(h, pairs_[i]));
      squares += distance * distance;
      few.push_back(i);
    }
    const double rms = std::sqrt(squares / (2 * static_cast<double>(few.size())));
    return std::isfinite(rms) && evidenceOf(h, rms, few) > 0;
  }

  void seek(const std::vector<Hypothesis>& hypotheses, Stage stage, double tries) {
    for (Explanation& e : judged(hypotheses, stage, tries)) found_.push_back(std::move(e));
  }

  void seek(const std::vector<Hypothesis>& hypotheses, Stage stage) {
    seek(hypotheses, stage, static_cast<double>(hypotheses.size()));
  }
  bool isExplained() const {
    return std::any_of(found_.begin(), found_.end(), [&](const Explanation& e) {
      const double grow = growthOf(e.hypothesis);
      return e.evidence > kThreshold && (grow * e.largest <= within_ || grow * e.rms <= 1);
    });
  }

  /// The camera, the points and the pixels as a hypothesis leaves them; not all of many pairs.
  Fit fitOf(const Hypothesis& h) const {
    const CameraFile& file = trials_.file();
    Fit fit{h.camera,         worldAt(file, trials_.plain().eye),
            trials_.up(),     h.pixels(trials_.corners().first),
            file.worldIsEcef, {}};
    const std::size_t count = std::min<std::size_t>(500, pairs_.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Pair& pair = pairs_[i * pairs_.size() / count];
      fit.pairs.push_back({h.point(pair.point), h.pixel(pair.pixel)});
    }
    return fit;
  }

  /// Mistakes that leave something, which a second one may explain.
  std::vector<Hypothesis> bestRows() const {
    std::vector<Explanation> best = found_, apart;
    std::erase_if(best, [](const Explanation& e) {
      const Hypothesis& h = e.hypothesis;
      return h.parameters > 0 || !(e.rms > 1e-2) || !(e.evidence > 0) || h.lensPasses != 0 ||
             h.places != PlaceMap::none;
    });
    std::stable_sort(best.begin(), best.end(),
                     [](const Explanation& a, const Explanation& b) { return a.evidence > b.evidence; });
    std::vector<Hypothesis> rows;
    for (const Explanation& e : best) {
      if (std::any_of(apart.begin(), apart.end(), [&](const Explanation& other) { return isSame(e, other, false); }))
        continue;
      apart.push_back(e);
      rows.push_back(e.hypothesis);
      if (rows.size() == 6) break;
    }
    return rows;
  }

  std::vector<Hypothesis> twoRows() const {
    const auto isOfPixels = [](const Hypothesis& h) {
      return h.movesPixels() && isIn(h, {"y-flipped", "y-flipped-index", "x-mirrored", "pixel-centre", "pixel-ratio",
                                         "picture-turned", "row-column", "normalized", "ndc"});
    };
    const std::vector<Hypothesis> others =
        someOf(rows_, [](const Hypothesis& h) { return !h.movesPixels() || isIn(h, {"pixel-centre"}); });
    std::vector<Hypothesis> all = inTwos(someOf(rows_, isOfPixels), [&](const Hypothesis&) { return others; });
    const auto ofPoints = [&](bool isUnit) {
      return someOf(rows_, [&](const Hypothesis& h) { return h.points != kUnit && isIn(h, {"unit"}) == isUnit; });
    };
    const std::vector<Hypothesis> units = ofPoints(true);
    for (Hypothesis& two : inTwos(ofPoints(false), [&](const Hypothesis&) { return units; }))
      all.push_back(std::move(two));
    for (Hypothesis& two : inTwos(someOf(rows_, setsPose), [&](const Hypothesis& first) {
           Trials after(changed(trials_.file(), patchesOf(first.sets), first.stretch));
           addPoseRows(after);
           std::vector<Hypothesis> seconds = after.take();
           for (Hypothesis h : rows_) {  // a window is the same behind each pose
             if (h.sets.empty() || setsPose(h)) continue;
             h.camera.axes = first.camera.axes;
             h.camera.eye = first.camera.eye;
             seconds.push_back(std::move(h));
           }
           return seconds;
         }))
      all.push_back(std::move(two));
    return all;
  }

  /// A mistake beside wrong pairs, at most a quarter, which are left out.
  std::vector<Explanation> besideWrongPairs() const {
    const std::size_t n = pairs_.size(), wrong = std::max<std::size_t>(1, n / 4);
    if (n < 4) return {};
    std::vector<Hypothesis> all = rows_;
    const auto add = [&](const std::vector<Hypothesis>& some) { all.insert(all.end(), some.begin(), some.end()); };
    const Fit fit = fitOf(nothing_);
    if (fit.pairs.size() == n) add(families(fit, Table::simple, wrong));
    if (fit.pairs.size() == n && n >= 8)
      add(someOf(families(fit, Table::poses, wrong), [](const Hypothesis& h) { return h.parameters <= 6; }));
    const double tries = static_cast<double>(all.size());
    return judged(std::move(all), Stage::wrongPairs, tries, wrong);
  }

  /// A mistake without a number that leaves noise, and makes misses of the noise's size smaller together.
  void seekAmongNoise() {
    constexpr double kLess = 1.25, kMuchLess = 4;  // times the rms
    const double n = static_cast<double>(pairs_.size()), before = rmsOf(before_);
    if (!(before <= kMuchLess)) return;  // pixels: what it leaves is less than one
    for (const Hypothesis& h : rows_) {
      Explanation e{.hypothesis = h, .misses = missesOf(h, pairs_)};
      e.rms = rmsOf(e.misses);
      e.evidence = 2 * n * std::log(before / (kLess * e.rms)) - std::log(rows_.size());
      if (!(e.evidence > kThreshold && growthOf(h) * e.rms <= 1 && before <= kMuchLess * e.rms)) continue;
      const auto leavesLess = [&](const Explanation& other) {
        return other.evidence > kThreshold && kLess * other.rms < e.rms;
      };
      if (std::any_of(found_.begin(), found_.end(), leavesLess)) continue;  // it leaves more than noise
      for (const Vec2& miss : e.misses) e.largest = std::max(e.largest, length(miss));
      found_.push_back(std::move(e));
    }
  }

  /// Most pairs have the pixel of one line, and not all their own.
  std::vector<Explanation> pixelOrder() const {
    constexpr std::size_t kMost = 2000, kShown = 10;
    const std::size_t n = pairs_.size();
    if (n > kMost) return {};
    Explanation e{.hypothesis = nothing_};
    e.hypothesis.mistake = "pixel-order";
    std::vector<std::string> others;               // that have the pixel of another line
    std::set<std::ptrdiff_t> taken, places, sums;  // how many places further down it is, and both places together
    double squares = 0;
    for (const Pair& pair : pairs_) {
      const Vec2 at = pixelOf(trials_.plain(), pair.point);
      const auto isNear = [&](const Pair& other) { return length(at - other.pixel) <= within_; };
      const auto near = std::find_if(pairs_.begin(), pairs_.end(), isNear);
      if (near == pairs_.end() || std::any_of(near + 1, pairs_.end(), isNear) ||
          !taken.insert(near - pairs_.begin()).second) {
        e.wrong.push_back(pair.line);
        continue;
      }
      const double miss = length(at - near->pixel);
      squares += miss * miss;
      e.largest = std::max(e.largest, miss);
      places.insert(&*near - &pair);
      sums.insert((near - pairs_.begin()) + (&pair - pairs_.data()));
      if (near->line != pair.line)
        others.push_back("line " + std::to_string(pair.line) + " the pixel of line " + std::to_string(near->line));
    }
    if (others.empty() || 4 * e.wrong.size() > n) return {};
    e.rms = std::sqrt(squares / static_cast<double>(2 * (n - e.wrong.size())));
    std::string& words = e.hypothesis.words;
    if (places.size() == 1 && n > 2) {
      const std::ptrdiff_t down = *places.begin(), far = std::abs(down);
      words = "give each line the pixel of the line " + (far == 1 ? "" : std::to_string(far) + " lines ") +
              (down > 0 ? "after it" : "before it");
      return {e};
    }
    if (sums.size() == 1 && e.wrong.empty() && n > 2) {
      e.hypothesis.value = "reversed";
      words = "reverse the order of the pixels";
      return {e};
    }
    for (std::size_t i = 0; i < std::min(others.size(), kShown); ++i) words += (i == 0 ? "give " : ", ") + others[i];
    if (others.size() > kShown) words += ", and " + std::to_string(others.size() - kShown) + " more";
    return {e};
  }

  Trials trials_;
  std::span<const Pair> pairs_;
  double within_;
  Hypothesis nothing_;  ///< is wrong
  std::vector<Hypothesis> rows_;
  std::vector<Vec2> before_;  ///< the misses without an explanation
  std::vector<Explanation> found_;
};

}  // namespace

double logChoices(std::size_t all, std::size_t some) {
  double sum = 0;
  for (std::size_t i = 1; i <= some; ++i) sum += std::log(static_cast<double>(all - some + i) / static_cast<double>(i));
  return sum;
}

double wrongFrom(std::vector<double> distances, std::size_t wrong, double within) {
  std::sort(distances.begin(), distances.end());
  distances.resize(distances.size() - wrong);
  const double squares = std::inner_product(distances.begin(), distances.end(), distances.begin(), 0.0);
  return std::max(within, 4 * std::max(std::sqrt(squares / static_cast<double>(distances.size())), kFloor));
}

bool isSame(const Explanation& a, const Explanation& b, bool anySign) {
  const double sizeOfA = std::sqrt(a.hypothesis.pixels.size()), sizeOfB = std::sqrt(b.hypothesis.pixels.size());
  const auto isLike = [&](double x, double y) {
    x /= sizeOfA;
    y /= sizeOfB;
    return std::fabs(anySign ? std::fabs(x) - std::fabs(y) : x - y) < 1e-6;
  };
  return std::equal(a.misses.begin(), a.misses.end(), b.misses.begin(),
                    [&](const Vec2& p, const Vec2& q) { return isLike(p.x, q.x) && isLike(p.y, q.y); });
}

std::vector<Explanation> explain(const CameraFile& file, std::span<const Pair> pairs, double within, bool keepsSame) {
  return Search(file, pairs, within).explanations(keepsSame);
}

std::vector<Hypothesis> madeAnew(const Hypothesis& h, const CameraFile& from, const CameraFile& to,
                                 const std::vector<Hypothesis>& rows) {
  if (h.parameters == 0) return someOf(rows, [&](const Hypothesis& row) { return row.mistake == h.mistake; });
  const Trials t(to);
  const PlainCamera was = plainOf(makeCamera(from)), &own = t.plain();
  Hypothesis anew = h;
  PlainCamera& camera = anew.camera;
  const Vec2 times{h.camera.focal.x / was.focal.x, h.camera.focal.y / was.focal.y};
  camera.focal = {own.focal.x * times.x, own.focal.y * times.y};
  // About the picture's corner, if it is resized.
  const Vec2 corner = t.corners().first, off = own.centre - corner, centre = h.camera.centre - was.centre;
  camera.centre = h.isResized ? Vec2{corner.x + off.x * times.x, corner.y + off.y * times.y}
                              : Vec2{own.centre.x + centre.x, own.centre.y + centre.y};
  const Rows inWorld = transposed(was.axes) * h.camera.axes, inCamera = h.camera.axes * transposed(was.axes);
  camera.axes = h.mistake == "heading" ? own.axes * inWorld : inCamera * own.axes;
  camera.eye = h.mistake == "unit" && h.points == kUnit ? scaled(own.eye, h.value[1])
                                                        : sum(own.eye, 1, sum(h.camera.eye, -1, was.eye));
  camera.lensOfFile = own.lensOfFile;
  if (h.camera.lens == was.lens) camera.lens = own.lens;
  return {anew};
}

}  // namespace viewproj::cmd::mistakes
