#include "commands/outline.hpp"

#include <algorithm>
#include <functional>
#include <numbers>
#include <set>
#include <string_view>

#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "picture/rim.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kPi = std::numbers::pi;

/// A part of the boundary: of the picture's rim, of the horizon, or of what is as far as --max-distance.
struct Curve {
  std::function<std::optional<OutlineVertex>(double)> at;
  double from = 0, to = 1;
  OutlineVertex first = {}, last = {};
};
using Ring = std::vector<Curve>;

/// Of a part of the rim.
struct State {
  bool sees = false, isDrawnIn = false;
  friend bool operator==(const State&, const State&) = default;
};
struct Piece {
  double from, to;
  State state;
};

class Tracer {
 public:
  Tracer(const Camera& camera, const Ground& ground, double most)
      : camera_(camera), ground_(ground), rim_(camera), most_(most), isFlat_(camera.projection().isOrthographic()) {
    const Pose pose = camera.pose();
    const bool isMirrored = detail::dot(detail::crossOf(pose.right(), pose.up()), pose.forward()) > 0;
    turning_ = ground.turning() * (isMirrored ? -1 : 1);
  }

  std::array<std::optional<Vec2>, 3> horizonPixels(double heading) {
    if (isFlat_) return {};
    const auto [runs, areCut] = runsOf(pieces());
    if (!areCut) {
      if (!horizonIsInPicture(most_)) return {};
      const std::optional<Vec2> behind = horizonPixel(heading + kPi);
      return {behind, horizonPixel(heading), behind};
    }
    Link widest;
    std::size_t before = 0;
    for (std::size_t i = 0; i < runs.size(); ++i)
      if (const Link link = linkAfter(runs, i); link.span > widest.span) widest = link, before = i;
    const Vec2 enters = rim_.at(runs[before].back().to).pixel, leaves = rim_.at(runs[widest.next].front().from).pixel;
    const std::optional<Vec2> middle = horizonPixel(widest.azimuth + turning_ * widest.span / 2);
    if (turning_ < 0) return {leaves, middle, enters};
    return {enters, middle, leaves};
  }

  Outline outline(double error) {
    constexpr double kShare = 1e-3, kAreaShare = 1e-5;
    Outline out;
    out.center = see(screenToRay(camera_, rim_.center()));
    const std::vector<Ring> rings = this->rings();
    double extent = 0, finest = 0;
    for (const Ring& ring : rings)
      for (const OutlineVertex& v : trace(ring, HUGE_VAL).vertices) {
        extent = std::max(extent, apart(v.point, ring[0].first.point));
        finest = std::max(finest, roundingOf(v.point));
      }
    out.error = error > 0 ? error : extent * kShare;
    if (out.error < finest)
      throw InputError("the ground is known to " + formatNumber(toDigits(finest, 2)) +
                       " from there, and its outline is " + (error > 0 ? "asked" : "needed") + " within " +
                       formatNumber(toDigits(out.error, 2)) + "; --error takes a larger distance");
    for (const Ring& ring : rings) {
      const bool isHole = hasHole_ && &ring == &rings.back();
      const double area = trace(ring, std::max(finest, extent * kAreaShare)).area;
      out.area += isHole ? -area : area;
      out.rings.push_back({trace(ring, out.error).vertices, area, isHole});
    }
    for (const char* kind : {"horizon", "distance", "lens"})
      if (cut_.contains(kind)) out.cut.emplace_back(kind);
    if (rings.empty()) out.cut = {seesBeyond_ || horizonIsInPicture(HUGE_VAL) ? "distance" : "sky"};
    out.gsd = sampling(rim_.center());
    for (int i = 0; i < 4; ++i) out.cornerGsd[static_cast<std::size_t>(i)] = sampling(rim_.corner(i, 0.5));
    return out;
  }

 private:
  /// How far a point of the ground may be off: by the direction of its ray and the last digits of its coordinates.
  double roundingOf(const Vec3& point) const {
    return 2 * kRayDirectionBound * apart(point, camera_.pose().eye()) + 8 * detail::halfUlp(detail::maxAbs(point));
  }

  std::optional<Ground::Seen> see(const Ray& ray) {
    if (!std::isfinite(ray.direction.x)) return std::nullopt;
    const std::optional<Ground::Seen> seen = ground_.hit(ray);
    if (!seen && isFlat_)
      throw InputError("a part of the orthographic picture lies behind the plane; move the eye back");
    seesBeyond_ = seesBeyond_ || seen;
    return seen && seen->distance <= most_ ? seen : std::nullopt;
  }

  /// Between what two pixels see, from the eye's own rays, so that far coordinates cost no digits.
  std::optional<double> between(const Vec2& a, const Vec2& b) {
    const Ray p = screenToRay(camera_, a), q = screenToRay(camera_, b);
    const auto first = see(p), last = see(q);
    if (!first || !last) return std::nullopt;
    const Vec3 origins = sum(p.origin, -1, q.origin);
    return length(sum(sum(origins, first->distance, p.direction), -last->distance, q.direction));
  }
  GroundSampling sampling(const Vec2& at) {
    const auto across = between({at.x - 0.5, at.y}, {at.x + 0.5, at.y});
    const auto down = between({at.x, at.y - 0.5}, {at.x, at.y + 0.5});
    return across && down ? GroundSampling({*across, *down}) : std::nullopt;
  }

  OutlineVertex vertex(const Vec3& point, const std::optional<Vec2>& pixel = {}) const {
    return {point, ground_.placeOf(point), pixel};
  }
  static Curve withEnds(Curve curve) {
    curve.first = curve.at(curve.from).value();
    curve.last = curve.at(curve.to).value();
    return curve;
  }
  Curve alongRim(const Piece& piece) {
    const auto at = [this](double s) -> std::optional<OutlineVertex> {
      const Rim::Place place = rim_.at(s);
      const auto seen = see(place.ray);
      if (!seen) return std::nullopt;
      return vertex(seen->point, place.isDrawnIn ? std::nullopt : std::optional(place.pixel));
    };
    return withEnds({at, piece.from, piece.to});
  }
  /// Of the horizon from one azimuth, so far round.
  Curve arc(double azimuth, double span) {
    const auto at = [this, azimuth, span](double t) -> std::optional<OutlineVertex> {
      const auto limit = ground_.farthest(azimuth + turning_ * span * t, most_);
      if (!limit) return std::nullopt;
      if (!limit->cut) throw InputError("the picture reaches the horizon of the plane; --max-distance D cuts it there");
      cut_.insert(limit->cut);
      return vertex(limit->point);
    };
    return withEnds({at});
  }
  /// In an orthographic picture all cuts are straight.
  Curve chord(const Vec3& from, const Vec3& to) {
    cut_.insert("distance");
    return withEnds({[=, this](double t) { return std::optional(vertex(sum(from, t, sum(to, -1, from)))); }});
  }

  State stateAt(double s) {
    const Rim::Place place = rim_.at(s);
    return {see(place.ray).has_value(), place.isDrawnIn};
  }
  /// Adds the pieces of the rim between two places that have these states. A change is found to the last bit.
  void split(double a, const State& atA, double b, const State& atB, std::vector<Piece>& all) {
    if (atA == atB) {
      const bool isNew = a == std::floor(a) || all.empty() || all.back().to != a || all.back().state != atA;
      isNew ? all.push_back({a, b, atA}) : void(all.back().to = b);
    } else if (const double middle = a + (b - a) / 2; middle > a && middle < b) {
      const State state = stateAt(middle);
      split(a, atA, middle, state, all);
      split(middle, state, b, atB, all);
    }
  }
  /// Clockwise from the top left corner. What is narrower than two probes are apart may be missed.
  std::vector<Piece> pieces() {
    constexpr int kProbes = 64;  // of a side
    std::vector<Piece> all;
    State last = stateAt(0);
    for (int k = 0; k < 4 * kProbes; ++k) {
      const double from = static_cast<double>(k) / kProbes, to = static_cast<double>(k + 1) / kProbes;
      const State next = stateAt(to);
      split(from, last, to, next, all);
      last = next;
    }
    return all;
  }

  /// Runs of pieces that see the ground, the first one that follows a cut first.
  struct Runs {
    std::vector<Ring> runs;
    bool areCut = false;
  };
  Runs runsOf(std::vector<Piece> all) {
    if (std::any_of(all.begin(), all.end(), [](const Piece& p) { return p.state.isDrawnIn; })) cut_.insert("lens");
    const auto isCut = [](const Piece& before, const Piece& after) { return !before.state.sees && after.state.sees; };
    auto start = isCut(all.back(), all.front()) ? all.begin() : std::adjacent_find(all.begin(), all.end(), isCut);
    Runs found{{}, start != all.end()};
    if (found.areCut && !start->state.sees) ++start;
    if (found.areCut) std::rotate(all.begin(), start, all.end());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].state.sees) continue;
      if (found.runs.empty() || isCut(all[i - 1], all[i])) found.runs.emplace_back();
      found.runs.back().push_back(alongRim(all[i]));
    }
    return found;
  }

  std::optional<Vec2> horizonPixel(double azimuth, double most = HUGE_VAL) const {
    const auto limit = ground_.farthest(azimuth, most);
    const ScreenPoint screen = limit ? worldToScreen(camera_, limit->point) : ScreenPoint{};
    return limit && screen.status == PointStatus::inFront ? std::optional(Vec2{screen.x, screen.y}) : std::nullopt;
  }
  bool horizonIsInPicture(double most) const {
    const auto pixel = isFlat_ ? std::nullopt : horizonPixel(0, most);
    return pixel && sidesBeyond(camera_, *pixel) == 0;
  }

  /// The horizon from where a run ends, in radians, to the next azimuth at which one begins.
  struct Link {
    double azimuth = 0, span = 0;
    std::size_t next = 0;
  };
  Link linkAfter(const std::vector<Ring>& runs, std::size_t i) const {
    const auto azimuthAt = [&](double s) { return ground_.azimuthOf(rim_.at(s).ray.direction); };
    Link link{azimuthAt(runs[i].back().to), 4 * kPi, i};
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const double ahead = turning_ * (azimuthAt(runs[k].front().from) - link.azimuth);
      if (const double span = std::fmod(ahead + 4 * kPi, 2 * kPi); span < link.span) link.span = span, link.next = k;
    }
    return link;
  }

  std::vector<Ring> rings() {
    auto [runs, areCut] = runsOf(pieces());
    if (areCut) return linked(std::move(runs));
    // The rim sees the ground everywhere or nowhere: the horizon is all in the picture, or all outside of it.
    std::vector<Ring> rings;
    if (horizonIsInPicture(most_)) {
      rings.emplace_back();
      for (int k = 0; k < 4; ++k) rings.back().push_back(arc(turning_ * k * kPi / 2, kPi / 2));
    }
    hasHole_ = !rings.empty() && !runs.empty();
    rings.insert(rings.end(), runs.begin(), runs.end());
    return rings;
  }

  /// Runs and what lies between them. Where they meet is where the arc says.
  std::vector<Ring> linked(std::vector<Ring> runs) {
    std::vector<std::size_t> next(runs.size());
    std::vector<Curve> arcs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Link link = isFlat_ ? Link{0, 0, (i + 1) % runs.size()} : linkAfter(runs, i);
      next[i] = link.next;
      arcs.push_back(isFlat_ ? chord(runs[i].back().last.point, runs[next[i]].front().first.point)
                             : arc(link.azimuth, link.span));
    }
    std::vector<Ring> rings;
    std::vector<bool> isUsed(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (isUsed[i]) continue;
      rings.emplace_back();
      Ring& ring = rings.back();
      for (std::size_t k = i; !isUsed[k]; k = next[k]) {
        isUsed[k] = true;
        if (!ring.empty()) runs[k].front().first = ring.back().last;
        runs[k].back().last = arcs[k].first;
        ring.insert(ring.end(), runs[k].begin(), runs[k].end());
        ring.push_back(arcs[k]);
      }
      ring.front().first = ring.back().last;
    }
    return rings;
  }

  /// Where the ground between two ends of a curve is halved: near a horizon that is not half-way along the rim.
  struct Middle {
    double at;
    OutlineVertex vertex;
  };
  static Middle middleOf(const Curve& curve, double a, double b, const OutlineVertex& p, const OutlineVertex& q) {
    constexpr int kSteps = 40;
    constexpr double kEven = 0.6;
    Middle middle{a, p};
    for (int i = 0; i < kSteps; ++i) {
      middle.at = a + (b - a) / 2;
      middle.vertex = curve.at(middle.at).value_or(p);
      const double before = apart(middle.vertex.point, p.point), after = apart(middle.vertex.point, q.point);
      if (std::min(before, after) > kEven * std::max(before, after)) break;
      (before < after ? a : b) = middle.at;
    }
    return middle;
  }

  struct Traced {
    double error, sum = 0, turn = 0, area = 0;
    std::vector<OutlineVertex> vertices = {};
  };
  Traced trace(const Ring& ring, double error) const {
    Traced traced{error};
    for (const Curve& c : ring)
      halve(c, c.from, c.to, c.first, c.last, middleOf(c, c.from, c.to, c.first, c.last), 0, traced);
    auto& vertices = traced.vertices;
    if (vertices.size() > 1 && areOne(vertices.back(), vertices.front(), error)) vertices.pop_back();
    traced.area = ground_.areaOf(traced.sum, traced.turn);
    return traced;
  }
  /// As where the rim stays at one end of the lens.
  static bool areOne(const OutlineVertex& a, const OutlineVertex& b, double error) {
    constexpr double kShare = 1e-3;
    return std::isfinite(error) && apart(a.point, b.point) <= kShare * error;
  }

  /// Halves a curve until its quarters lie on the line that a map draws.
  void halve(const Curve& curve, double a, double b, const OutlineVertex& p, const OutlineVertex& q, const Middle& m,
             int depth, Traced& traced) const {
    constexpr int kDeepest = 40;
    constexpr double kOfError = 0.8;  // quarters are not the farthest from the line
    constexpr std::size_t kMostVertices = 1'000'000;
    const Middle l = middleOf(curve, a, m.at, p, m.vertex), n = middleOf(curve, m.at, b, m.vertex, q);
    const Vec2 scale = ground_.scaleAt(m.vertex.place);
    const auto metres = [&](const OutlineVertex& to) {
      const Vec2 way = ground_.way(p.place, to.place);
      return Vec2{way.x * scale.x, way.y * scale.y};
    };
    double worst = 0;
    for (const Middle* each : {&l, &m, &n}) worst = std::max(worst, distanceToLine(metres(each->vertex), metres(q)));
    const double extent = std::max(apart(p.point, m.vertex.point), apart(m.vertex.point, q.point));
    if (worst > kOfError * traced.error && extent > traced.error && depth < kDeepest) {
      halve(curve, a, m.at, p, m.vertex, l, depth + 1, traced);
      halve(curve, m.at, b, m.vertex, q, n, depth + 1, traced);
      return;
    }
    if (traced.vertices.size() >= kMostVertices)
      throw InputError("an outline within " + formatNumber(traced.error) +
                       " has more than a million vertices; --error takes a larger distance");
    if (traced.vertices.empty() || !areOne(traced.vertices.back(), p, traced.error)) traced.vertices.push_back(p);
    addArea(p, l.vertex, m.vertex, traced);
    addArea(m.vertex, n.vertex, q, traced);
  }
  /// From the line through 0 and `to`.
  static double distanceToLine(const Vec2& at, const Vec2& to) {
    const double length = std::hypot(to.x, to.y);
    return length > 0 ? std::fabs(at.x * to.y - at.y * to.x) / length : std::hypot(at.x, at.y);
  }

  /// The integral along the parabola through three places.
  void addArea(const OutlineVertex& p, const OutlineVertex& q, const OutlineVertex& r, Traced& traced) const {
    const double first = ground_.areaBelow(p.place), half = ground_.areaBelow(q.place),
                 last = ground_.areaBelow(r.place);
    const double toHalf = ground_.way(p.place, q.place).x, across = ground_.way(p.place, r.place).x;
    traced.turn += across;
    if (across == 0) return;
    const double x = toHalf / across, bulge = x > 0.05 && x < 0.95 ? 1 / (6 * x * (1 - x)) : 0;
    traced.sum += (first + last) / 2 * across + ((half - first) * across - (last - first) * toHalf) * bulge;
  }

  const Camera& camera_;
  const Ground& ground_;
  Rim rim_;
  double most_, turning_ = 1;
  bool isFlat_, hasHole_ = false;
  bool seesBeyond_ = false;  ///< something is seen, be it too far
  std::set<std::string_view> cut_;
};

}  // namespace

Outline outlineOf(const Camera& camera, const Ground& ground, double most, double error) {
  return Tracer(camera, ground, most).outline(error);
}

std::array<std::optional<Vec2>, 3> horizonPixels(const Camera& camera, const Ground& ground, double heading) {
  return Tracer(camera, ground, HUGE_VAL).horizonPixels(heading);
}

}  // namespace viewproj::cmd
