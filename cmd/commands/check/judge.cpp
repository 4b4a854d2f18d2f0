#include "commands/check/judge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "commands/check/families.hpp"
#include "commands/check/words.hpp"
#include "text/error.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kFloor = 1e-3;   // pixels: what is left is never told apart below this
constexpr double kThreshold = 7;  // of evidence that is told
const double kAsGood = std::log(100);

constexpr std::ptrdiff_t kPlain = 19;  // told as well where they bring all within the tolerance

std::ptrdiff_t placeOf(std::string_view mistake) {
  if (const std::size_t plus = mistake.find(" + "); plus != mistake.npos)
    return placeOf(mistake.substr(0, plus)) + placeOf(mistake.substr(plus + 3));
  const auto all = allMistakes();
  return std::find_if(all.begin(), all.end(), [&](const Mistake& each) { return each.name == mistake; }) - all.begin();
}
bool isPlain(std::string_view mistake) { return mistake.find(" + ") == mistake.npos && placeOf(mistake) < kPlain; }

template <class Each>
bool isIn(std::string_view mistake, const Each& names) {
  return std::find(std::begin(names), std::end(names), mistake) != std::end(names);
}

class Judge {
 public:
  Judge(const Trials& document, std::span<const Pair> pairs, double within)
      : document_(document), pairs_(pairs), within_(within) {
    for (const Pair& pair : pairs_) {
      const Vec2 at = pixelOf(document_.plain(), pair.point);
      before_.push_back({at.x - pair.pixel.x, at.y - pair.pixel.y});
    }
  }

  /// NaN where a point has no pixel.
  std::vector<Vec2> missesOf(const Hypothesis& h, std::vector<Vec2> mended) const;
  std::vector<Vec2> mendedPixels(const Hypothesis& h) const;
  /// Adds those of the hypotheses that explain something.
  void judge(std::vector<Hypothesis> hypotheses, Stage stage, double tries, std::vector<Explanation>& found) const;
  /// chosen: the pairs that count.
  double evidenceOf(const Hypothesis& h, const std::vector<Vec2>& misses, const std::vector<Vec2>& mended,
                    const std::vector<std::size_t>& chosen, double tries, double& rms) const;

 private:
  const Trials& document_;
  std::span<const Pair> pairs_;
  double within_;
  std::vector<Vec2> before_;
};

std::vector<Vec2> Judge::mendedPixels(const Hypothesis& h) const {
  std::vector<Vec2> all;
  for (const Pair& pair : pairs_) {
    Vec2 at = h.pixels(pair.pixel);
    const auto seenBy = [&](const Camera& from, const Camera& to) {
      const Vec3 d = screenToRay(from, at).direction;
      const ScreenPoint p = worldToScreen(to, Vec4{d.x, d.y, d.z, 0});
      at = {p.x, p.y};
    };
    const Camera& own = document_.camera();
    for (int i = 0; i > h.lensPasses; --i) seenBy(own, withoutLens(own));
    for (int i = 0; i < h.lensPasses; ++i) seenBy(withoutLens(own), own);
    all.push_back(at);
  }
  return all;
}

std::vector<Vec2> Judge::missesOf(const Hypothesis& h, std::vector<Vec2> mended) const {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Vec2 at = pixelOf(h.camera, h.point(pairs_[i].point));
    mended[i] = {at.x - mended[i].x, at.y - mended[i].y};
  }
  return mended;
}

double Judge::evidenceOf(const Hypothesis& h, const std::vector<Vec2>& misses, const std::vector<Vec2>& mended,
                         const std::vector<std::size_t>& chosen, double tries, double& rms) const {
  const double n = static_cast<double>(chosen.size());
  double squares = 0;
  Vec2 mean, spread;
  for (const std::size_t i : chosen) {
    squares += misses[i].x * misses[i].x + misses[i].y * misses[i].y;
    mean = {mean.x + mended[i].x / n, mean.y + mended[i].y / n};
  }
  for (const std::size_t i : chosen)
    spread = {spread.x + (mended[i].x - mean.x) * (mended[i].x - mean.x),
              spread.y + (mended[i].y - mean.y) * (mended[i].y - mean.y)};
  rms = std::sqrt(squares / (2 * n));
  const double size = h.pixels.size() * h.scale, grow = size > 0 ? std::max(1.0, 1 / std::sqrt(size)) : 1;
  const double left = std::max(rms * grow, kFloor);
  const auto limit = [&](double sum) { return chosen.size() > 1 ? std::sqrt(sum / (n - 1)) * grow : 500; };
  const Vec2 most{limit(spread.x), limit(spread.y)};
  if (2 * left >= std::max(most.x, most.y)) return -std::log(std::max(tries, 1.0));
  std::vector<double> gains;
  const auto add = [&](double before, double limited) {
    const double miss = std::isfinite(before) ? std::min(std::fabs(before), limited) : limited;
    gains.push_back(std::max(0.0, std::log(std::max(miss, 1e-300) / (2 * left))));
  };
  for (const std::size_t i : chosen) {
    add(before_[i].x, most.x);
    add(before_[i].y, most.y);
  }
  const std::size_t kept = gains.size() - std::min(gains.size(), static_cast<std::size_t>(h.parameters));
  if (kept < gains.size())
    std::nth_element(gains.begin(), gains.begin() + static_cast<std::ptrdiff_t>(kept), gains.end());
  gains.resize(kept);
  return std::accumulate(gains.begin(), gains.end(), 0.0) - std::log(std::max(tries, 1.0));
}

void Judge::judge(std::vector<Hypothesis> hypotheses, Stage stage, double tries,
                  std::vector<Explanation>& found) const {
  if (tries == 0) tries = static_cast<double>(hypotheses.size());
  std::vector<std::size_t> all(pairs_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  for (Hypothesis& h : hypotheses) {
    const std::vector<Vec2> mended = mendedPixels(h);
    std::vector<Vec2> misses = missesOf(h, mended);
    double largest = 0;
    for (const Vec2& miss : misses) {
      const double distance = length(miss);
      largest = std::isnan(distance) ? HUGE_VAL : std::max(largest, distance);
    }
    if (!std::isfinite(largest)) continue;
    Explanation e{.hypothesis = std::move(h), .stage = stage, .largest = largest};
    e.evidence = evidenceOf(e.hypothesis, misses, mended, all, tries, e.rms);
    const bool isOld = stage == Stage::rows && largest <= within_ && isPlain(e.hypothesis.mistake);
    if (!(e.evidence > kThreshold) && !isOld) continue;
    e.misses = std::move(misses);
    found.push_back(std::move(e));
  }
}

/// The camera, the points and the pixels as a hypothesis leaves them; not all of many pairs.
Fit fitOf(const Trials& t, const Hypothesis& h, std::span<const Pair> pairs) {
  constexpr std::size_t kMost = 500;
  Fit fit{h.camera, t.up(), h.pixels(t.first()), t.file().worldIsEcef, {}};
  const std::size_t count = std::min(kMost, pairs.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Pair& pair = pairs[i * pairs.size() / count];
    fit.pairs.push_back({h.point(pair.point), h.pixels(pair.pixel)});
  }
  return fit;
}

/// first, and then second: of the points, the camera and the pixels as first leaves them.
Hypothesis both(const Hypothesis& first, Hypothesis second) {
  second.mistake = first.mistake + " + " + second.mistake;
  second.value = Json{first.value, second.value};
  second.pixels = second.pixels * first.pixels;
  second.points = second.points * first.points;
  second.sets.insert(second.sets.begin(), first.sets.begin(), first.sets.end());
  second.stretch |= first.stretch;
  second.isSolved |= first.isSolved;
  second.parameters += first.parameters;
  return second;
}

bool isDocuments(const Hypothesis& h) { return h.pixels == PixelMap{} && h.lensPasses == 0; }

/// Flips, mirrors, turns and exchanges of the pixels, one of each.
std::vector<Hypothesis> turnedPixels(const std::vector<Hypothesis>& pixels) {
  std::vector<Hypothesis> some;
  for (const Hypothesis& h : pixels)
    if (isIn(h.mistake, std::array{"y-flipped", "x-mirrored", "picture-turned", "row-column"}) &&
        std::none_of(some.begin(), some.end(), [&](const Hypothesis& other) {
          return other.pixels.xx == h.pixels.xx && other.pixels.xy == h.pixels.xy && other.pixels.yx == h.pixels.yx &&
                 other.pixels.yy == h.pixels.yy;
        }))
      some.push_back(h);
  return some;
}

/// Rounded, so that of two forms of a mistake the first one counts.
double weighted(const Explanation& e) {
  const double share = std::min(1.0, 100.0 / static_cast<double>(std::max<std::size_t>(e.misses.size(), 1)));
  return std::round(1e6 * e.evidence * share) / 1e6;
}

/// Whether they leave the same misses; with either sign, where one of them moves the pixels and one the camera.
bool isSame(const Explanation& a, const Explanation& b, bool anySign) {
  const auto of = [&](double miss) { return anySign ? std::fabs(miss) : miss; };
  for (std::size_t i = 0; i < a.misses.size(); ++i)
    if (!(std::fabs(of(a.misses[i].x) - of(b.misses[i].x)) < 1e-6 &&
          std::fabs(of(a.misses[i].y) - of(b.misses[i].y)) < 1e-6))
      return false;
  return true;
}

void moveToFront(std::vector<Explanation>& all, std::size_t which) {
  std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(which),
              all.begin() + static_cast<std::ptrdiff_t>(which) + 1);
}

/// Of those that may stand first, the one with the fewest parameters, of the earliest stage, first in the order.
template <class May>
void promote(std::vector<Explanation>& all, const May& may) {
  std::optional<std::size_t> best;
  const auto rank = [&](std::size_t i) {
    const Explanation& e = all[i];
    return std::tuple(e.hypothesis.parameters, e.stage, placeOf(e.hypothesis.mistake));
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    if (may(all[i]) && (!best || rank(i) < rank(*best))) best = i;
  if (best) moveToFront(all, *best);
}

/// The best first; then at most five that are as good with no more parameters, one of each mistake.
std::vector<Explanation> listed(std::vector<Explanation> found, double within) {
  if (found.empty()) return found;
  std::stable_sort(found.begin(), found.end(),
                   [](const Explanation& a, const Explanation& b) { return weighted(a) > weighted(b); });
  {
    const Explanation top = found[0];
    promote(found, [&](const Explanation& e) {
      const bool isFewer = e.hypothesis.parameters < top.hypothesis.parameters;
      return weighted(e) > weighted(top) - (isFewer ? kAsGood : 1) &&
             e.hypothesis.parameters <= top.hypothesis.parameters && e.stage <= top.stage;
    });
  }
  if (found[0].rms <= kFloor) {
    const Explanation top = found[0];
    promote(found, [&](const Explanation& e) {
      return e.rms <= kFloor && e.stage <= top.stage && e.hypothesis.parameters < top.hypothesis.parameters &&
             e.evidence > kThreshold;
    });
  }
  if (found[0].stage >= Stage::rest)  // two mistakes only where one of as few parameters leaves half as much again
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Explanation& e = found[i];
      if (e.stage > Stage::families || e.hypothesis.parameters > found[0].hypothesis.parameters) continue;
      if (!(e.evidence > kThreshold && (e.rms <= kFloor || weighted(e) > weighted(found[0]) - 7))) continue;
      moveToFront(found, i);
      break;
    }
  std::vector<Explanation> out;
  for (Explanation& e : found) {
    const Hypothesis& h = e.hypothesis;
    const bool isOld = e.stage == Stage::rows && e.largest <= within && isPlain(h.mistake);
    if (std::any_of(out.begin(), out.end(), [&](const Explanation& o) {
          return (o.hypothesis.mistake == h.mistake && h.parameters >= o.hypothesis.parameters) ||
                 (!isPlain(h.mistake) && h.parameters >= o.hypothesis.parameters && isSame(e, o, true));
        }))
      continue;
    if (out.empty() ? e.evidence < kThreshold && !isOld : false) continue;
    if (!out.empty() && !isOld) {
      int fewest = out[0].hypothesis.parameters;
      for (const Explanation& o : out) fewest = std::min(fewest, o.hypothesis.parameters);
      if (weighted(e) < weighted(out[0]) - kAsGood || h.parameters > fewest ||
          (e.stage > Stage::families && out[0].stage <= Stage::families && weighted(e) < weighted(out[0]) + 3))
        continue;
    }
    out.push_back(std::move(e));
    if (out.size() == 6) break;
  }
  return out;
}

std::vector<Hypothesis> documentsOf(Trials& t) {
  addDocumentRows(t);
  addPoseRows(t);
  return t.take();
}

/// A mistake beside wrong pairs: each hypothesis, with the pairs left out that it does not explain.
std::vector<Explanation> besideWrongPairs(const Trials& t, const Judge& judge, std::vector<Hypothesis> hypotheses,
                                          std::span<const Pair> pairs, double within) {
  const std::size_t n = pairs.size(), most = std::max<std::size_t>(1, n / 4);
  std::vector<Explanation> found;
  if (n < 4) return found;
  const Fit fit = fitOf(t, t.next(""), pairs);
  if (n <= 500) {
    for (Hypothesis& h : families(fit, Table::simple, most)) hypotheses.push_back(std::move(h));
    if (n >= 8)
      for (Hypothesis& h : families(fit, Table::poses, most))
        if (h.parameters <= 6) hypotheses.push_back(std::move(h));
  }
  const double tries = static_cast<double>(hypotheses.size());
  for (Hypothesis& h : hypotheses) {
    const std::vector<Vec2> mended = judge.mendedPixels(h);
    std::vector<Vec2> misses = judge.missesOf(h, mended);
    std::vector<double> sorted, distances;
    for (const Vec2& miss : misses) {
      const double distance = length(miss);
      distances.push_back(std::isfinite(distance) ? distance : HUGE_VAL);
    }
    sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    sorted.resize(n - most);
    if (!std::isfinite(sorted.back())) continue;
    double squares = 0;
    for (const double distance : sorted) squares += distance * distance;
    const double limit =
        std::max(within, 4 * std::max(std::sqrt(squares / static_cast<double>(sorted.size())), kFloor));
    Explanation e{.hypothesis = std::move(h), .stage = Stage::wrongPairs};
    std::vector<std::size_t> right;
    for (std::size_t i = 0; i < n; ++i) {
      (distances[i] <= limit ? right : e.wrong).push_back(i);
      if (distances[i] <= limit) e.largest = std::max(e.largest, distances[i]);
    }
    if (e.wrong.empty() || e.wrong.size() > most) continue;
    const auto choices = [](std::size_t of, std::size_t some) {
      const auto gamma = [](std::size_t k) { return std::lgamma(static_cast<double>(k + 1)); };
      return gamma(of) - gamma(some) - gamma(of - some);
    };
    e.evidence = judge.evidenceOf(e.hypothesis, misses, mended, right, tries, e.rms) - choices(n, e.wrong.size());
    e.misses = std::move(misses);
    if (e.evidence > kThreshold) found.push_back(std::move(e));
  }
  std::stable_sort(found.begin(), found.end(), [](const Explanation& a, const Explanation& b) {
    return std::tuple(-weighted(a), a.hypothesis.parameters) < std::tuple(-weighted(b), b.hypothesis.parameters);
  });
  return found;
}

}  // namespace

std::vector<Explanation> explain(const Document& document, const ReadOptions& reading, std::span<const Pair> pairs,
                                 double within) {
  Trials t(document, reading);
  const Judge judge(t, pairs, within);
  std::vector<Explanation> found;
  const std::vector<Hypothesis> documents = documentsOf(t);
  addPixelRows(t);
  const std::vector<Hypothesis> pixels = t.take();
  std::vector<Hypothesis> rows = documents;
  rows.insert(rows.end(), pixels.begin(), pixels.end());
  judge.judge(rows, Stage::rows, 0, found);
  const auto familiesOf = [&](const Hypothesis& first, Table table) { return families(fitOf(t, first, pairs), table); };
  judge.judge(familiesOf(t.next(""), Table::simple), Stage::families, 0, found);

  // A second mistake in what the best rows leave.
  std::vector<Explanation> tops;
  {
    std::vector<const Explanation*> order;
    for (const Explanation& e : found)
      if (e.hypothesis.parameters == 0 && e.rms > 1e-2 && e.evidence > 0 && e.hypothesis.lensPasses == 0 &&
          e.hypothesis.places == PlaceMap::none)
        order.push_back(&e);
    std::stable_sort(order.begin(), order.end(),
                     [](const Explanation* a, const Explanation* b) { return a->evidence > b->evidence; });
    for (const Explanation* e : order)
      if (tops.size() < 6 &&
          std::none_of(tops.begin(), tops.end(), [&](const Explanation& o) { return isSame(o, *e, false); }))
        tops.push_back(*e);
  }
  std::vector<Hypothesis> seconds;
  for (const Explanation& top : tops) {
    std::vector<Hypothesis> all = familiesOf(top.hypothesis, Table::simple);
    for (const double half : {0.5, -0.5}) {
      Hypothesis centre = t.next("pixel-centre");
      centre.camera = top.hypothesis.camera;
      centre.camera.centre = {centre.camera.centre.x + half, centre.camera.centre.y + half};
      centre.isSolved = true;
      all.push_back(std::move(centre));
    }
    for (Hypothesis& h : all) seconds.push_back(both(top.hypothesis, std::move(h)));
  }
  judge.judge(seconds, Stage::rest, std::max<double>(60 * static_cast<double>(seconds.size()), 1), found);

  const auto isExplained = [&] {
    return std::any_of(found.begin(), found.end(), [&](const Explanation& e) {
      return e.evidence > kThreshold && (e.largest <= within || e.rms <= 1);
    });
  };
  if (!isExplained()) {
    std::vector<Hypothesis> two;
    constexpr std::array kPixels = {"y-flipped",      "y-flipped-index", "x-mirrored", "pixel-centre", "pixel-ratio",
                                    "picture-turned", "row-column",      "normalized", "ndc"};
    for (const Hypothesis& a : pixels) {
      if (!isIn(a.mistake, kPixels)) continue;
      for (const Hypothesis& b : documents)
        if (isDocuments(b) && a.mistake != b.mistake) two.push_back(both(a, b));
      for (const Hypothesis& b : pixels)
        if (isIn(b.mistake, kPixels) && a.mistake != b.mistake && b.mistake == "pixel-centre")
          two.push_back(both(a, b));
    }
    for (const Hypothesis& a : documents) {
      if (a.sets.empty() || std::any_of(a.sets.begin(), a.sets.end(), [](const Set& set) {
            return set.first.starts_with("viewport") || set.first.starts_with("projection") ||
                   set.first == "distortion";
          }))
        continue;
      Trials second(changed(t.file(), patchesOf(a.sets), a.stretch).document, reading);
      for (Hypothesis& b : documentsOf(second))
        if (isDocuments(b) && b.mistake != a.mistake) two.push_back(both(a, std::move(b)));
    }
    judge.judge(std::move(two), Stage::two, 0, found);
    std::vector<Hypothesis> flipped;
    for (const Hypothesis& a : turnedPixels(pixels))
      for (Hypothesis& h : familiesOf(a, Table::simple)) flipped.push_back(both(a, std::move(h)));
    judge.judge(std::move(flipped), Stage::flips, 0, found);
  }
  if (!isExplained()) {
    judge.judge(familiesOf(t.next(""), Table::poses), Stage::poses, static_cast<double>(countOf(Table::poses)), found);
    if (!isExplained()) {
      const std::vector<Hypothesis> turned = turnedPixels(pixels);
      for (std::size_t i = 0; i < std::min<std::size_t>(2, turned.size()); ++i) {
        std::vector<Hypothesis> all;
        for (Hypothesis& h : familiesOf(turned[i], Table::poses)) all.push_back(both(turned[i], std::move(h)));
        judge.judge(std::move(all), Stage::flippedPoses, 2 * static_cast<double>(countOf(Table::poses)), found);
      }
    }
  }
  if (!isExplained()) {
    std::vector<Explanation> beside = besideWrongPairs(t, judge, std::move(rows), pairs, within);
    const bool isBetter = !beside.empty() && std::all_of(found.begin(), found.end(), [&](const Explanation& e) {
      return weighted(e) < weighted(beside[0]);
    });
    if (isBetter) return {beside[0]};
  }
  return listed(std::move(found), within);
}

std::vector<Hypothesis> madeAnew(const Hypothesis& h, const CameraFile& from, const CameraFile& to) {
  Trials t(to.document, to.reading);
  if (h.parameters == 0) {
    std::vector<Hypothesis> rows = documentsOf(t);
    addPixelRows(t);
    for (Hypothesis& row : t.take()) rows.push_back(std::move(row));
    std::erase_if(rows, [&](const Hypothesis& row) { return row.mistake != h.mistake; });
    return rows;
  }
  const PlainCamera was = plainOf(makeCamera(from)), &own = t.plain();
  Hypothesis anew = h;
  PlainCamera& camera = anew.camera;
  const Vec2 times{h.camera.focal.x / was.focal.x, h.camera.focal.y / was.focal.y}, corner = t.first();
  camera.focal = {own.focal.x * times.x, own.focal.y * times.y};
  camera.centre =
      h.scale != 1
          ? Vec2{corner.x + (own.centre.x - corner.x) * times.x, corner.y + (own.centre.y - corner.y) * times.y}
          : Vec2{own.centre.x + h.camera.centre.x - was.centre.x, own.centre.y + h.camera.centre.y - was.centre.y};
  const Rows inWorld = transposed(was.axes) * h.camera.axes, inCamera = h.camera.axes * transposed(was.axes);
  camera.axes = h.mistake == "heading" ? own.axes * inWorld : inCamera * own.axes;
  camera.eye = h.mistake == "unit" && h.points == kUnit ? scaled(own.eye, h.value[1].get<double>())
                                                        : sum(own.eye, 1, sum(h.camera.eye, -1, was.eye));
  camera.lens = own.lens;
  return {anew};
}

std::vector<std::size_t> wrongPairs(std::span<const Vec2> misses, double within) {
  std::vector<std::size_t> wrong;
  for (std::size_t i = 0; i < misses.size(); ++i)
    if (!(length(misses[i]) <= within)) wrong.push_back(i);
  if (misses.size() < 4 || wrong.size() > std::max<std::size_t>(1, misses.size() / 4)) wrong.clear();
  return wrong;
}

std::vector<std::size_t> pixelOrder(const Camera& camera, std::span<const Pair> pairs, double within) {
  constexpr std::size_t kMost = 2000;
  std::vector<std::size_t> order;
  if (pairs.size() < 2 || pairs.size() > kMost) return order;
  std::set<std::size_t> taken;
  bool isOther = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ScreenPoint p = worldToScreen(camera, pairs[i].point);
    std::vector<std::size_t> near;
    for (std::size_t j = 0; j < pairs.size(); ++j)
      if (length(Vec2{p.x - pairs[j].pixel.x, p.y - pairs[j].pixel.y}) <= within) near.push_back(j);
    if (near.size() != 1 || !taken.insert(near[0]).second) return {};
    isOther |= near[0] != i;
    order.push_back(near[0]);
  }
  return isOther ? order : std::vector<std::size_t>{};
}

}  // namespace viewproj::cmd::mistakes
