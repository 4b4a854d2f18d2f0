#include "commands/outline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>

#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kPi = std::numbers::pi;

/// A part of the boundary: of the picture's edge, or of the horizon.
struct Curve {
  std::function<std::optional<OutlineVertex>(double)> at;
  double from = 0, to = 0;
  OutlineVertex first = {}, last = {};
};
using Ring = std::vector<Curve>;

/// A part of the picture's edge that sees the ground, or does not, and that is drawn in to the lens's end, or is not.
struct Piece {
  double from, to;
  bool sees, isDrawnIn;
};

class Tracer {
 public:
  Tracer(const Camera& camera, const Ground& ground, double most)
      : camera_(camera), ground_(ground), most_(most), isFlat_(camera.projection().isOrthographic()) {
    const auto [first, last] = pictureCorners(camera.viewport());
    const bool fromTop = camera.viewport().origin == Origin::topLeft;
    topLeft_ = {first.x, fromTop ? first.y : last.y};
    bottomRight_ = {last.x, fromTop ? last.y : first.y};
    center_ = {(first.x + last.x) / 2, (first.y + last.y) / 2};
    const auto d = [&](double x, double y) { return screenToRay(camera, {center_.x + x, center_.y + y}).direction; };
    const double down = fromTop ? 1 : -1;
    isMirrored_ = detail::dot(detail::crossOf(d(0, 0), d(1, 0)), d(0, down)) < 0;
  }

  std::array<std::optional<Vec2>, 3> horizonPixels() {
    const auto [runs, areCut] = runsOf(pieces());
    std::array<std::optional<Vec2>, 3> pixels;
    double widest = 0;
    for (std::size_t i = 0; areCut && i < runs.size(); ++i) {
      const Link link = linkAfter(runs, i);
      if (link.span <= widest) continue;
      widest = link.span;
      const auto middle = ground_.farthest(link.azimuth + turning() * link.span / 2, most_);
      const ScreenPoint screen = middle ? worldToScreen(camera_, middle->point) : ScreenPoint{};
      pixels = {edge(runs[i].back().to).pixel, std::nullopt, edge(runs[link.next].front().from).pixel};
      if (middle && screen.status == PointStatus::inFront) pixels[1] = Vec2{screen.x, screen.y};
      if (turning() < 0) std::swap(pixels[0], pixels[2]);
    }
    return pixels;
  }

  Outline outline(double error) {
    Outline out;
    out.center = see(screenToRay(camera_, center_));
    const std::vector<Ring> rings = this->rings();
    if (rings.empty()) {
      seesBeyond_ = seesBeyond_ || horizonIsInPicture(std::numeric_limits<double>::infinity());
      out.cut.emplace_back(seesBeyond_ ? "distance" : "sky");
    } else {
      double extent = 0;
      for (const Ring& ring : rings) {
        const Traced rough = trace(ring, std::numeric_limits<double>::max());
        for (const OutlineVertex& v : rough.vertices) extent = std::max(extent, apart(v.point, ring[0].first.point));
      }
      constexpr double kShare = 1e-3, kAreaShare = 1e-5;
      out.error = error > 0 ? error : extent * kShare;
      for (std::size_t i = 0; i < rings.size(); ++i) {
        OutlineRing ring{trace(rings[i], out.error).vertices, trace(rings[i], extent * kAreaShare).area,
                         hasHole_ && i == 1};
        out.area += ring.isHole ? -ring.area : ring.area;
        out.rings.push_back(std::move(ring));
      }
      for (const char* kind : {"horizon", "distance", "lens"})
        if (cut_.contains(kind)) out.cut.emplace_back(kind);
    }
    out.gsd = sampling(center_);
    const double right = bottomRight_.x > topLeft_.x ? 0.5 : -0.5, down = bottomRight_.y > topLeft_.y ? 0.5 : -0.5;
    const double x0 = topLeft_.x + right, y0 = topLeft_.y + down, x1 = bottomRight_.x - right,
                 y1 = bottomRight_.y - down;
    out.cornerGsd = {sampling({x0, y0}), sampling({x1, y0}), sampling({x1, y1}), sampling({x0, y1})};
    return out;
  }

 private:
  struct Edge {
    Vec2 pixel;
    bool isDrawnIn;
    Ray ray;
  };
  struct Traced {
    double error = 0, sum = 0, turn = 0, area = 0;
    std::vector<OutlineVertex> vertices = {};
  };

  static bool isRay(const Ray& ray) { return std::isfinite(ray.direction.x); }

  /// The picture's outer edge, s from 0 to 4 clockwise from the top left corner; where the lens ends before, its end on
  /// the way to the picture's centre.
  Edge edge(double s) const {
    s = std::fmod(s, 4);
    const int side = static_cast<int>(s);
    const double t = s - side,
                 x = side == 0   ? t
                     : side == 1 ? 1
                     : side == 2 ? 1 - t
                                 : 0,
                 y = side == 0   ? 0
                     : side == 1 ? t
                     : side == 2 ? 1
                                 : 1 - t;
    const Vec2 pixel{x == 1 ? bottomRight_.x : topLeft_.x + x * (bottomRight_.x - topLeft_.x),
                     y == 1 ? bottomRight_.y : topLeft_.y + y * (bottomRight_.y - topLeft_.y)};
    if (const Ray ray = screenToRay(camera_, pixel); isRay(ray)) return {pixel, false, ray};
    const auto at = [&](double k) {
      return Vec2{center_.x + k * (pixel.x - center_.x), center_.y + k * (pixel.y - center_.y)};
    };
    double inside = 0, outside = 1;
    for (int i = 0; i < 50; ++i) {
      const double middle = (inside + outside) / 2;
      (isRay(screenToRay(camera_, at(middle))) ? inside : outside) = middle;
    }
    return {at(inside), true, screenToRay(camera_, at(inside))};
  }

  std::optional<Ground::Seen> see(const Ray& ray) {
    if (!isRay(ray)) return std::nullopt;
    const std::optional<Ground::Seen> seen = ground_.hit(ray);
    if (!seen && isFlat_)
      throw InputError("a part of the orthographic picture lies behind the plane; move the eye back");
    seesBeyond_ = seesBeyond_ || seen;
    return seen && seen->distance <= most_ ? seen : std::nullopt;
  }

  /// From the eye's own rays, so that far coordinates cost no digits.
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

  OutlineVertex vertex(const Vec3& point, std::optional<Vec2> pixel) const {
    return {point, ground_.placeOf(point), pixel};
  }
  std::optional<OutlineVertex> onEdge(double s) {
    const Edge e = edge(s);
    const auto seen = see(e.ray);
    if (!seen) return std::nullopt;
    return vertex(seen->point, e.isDrawnIn ? std::nullopt : std::optional(e.pixel));
  }
  std::optional<OutlineVertex> onLimit(double azimuth) {
    const auto limit = ground_.farthest(azimuth, most_);
    if (!limit) return std::nullopt;
    if (!limit->cut) throw InputError("the picture reaches the horizon of the plane; --max-distance D cuts it there");
    cut_.insert(limit->cut);
    return vertex(limit->point, std::nullopt);
  }

  /// The pieces of the edge, clockwise from the top left corner. Between two probes a change of state is found to the
  /// last bit; what is narrower than the probes are apart, and between them, may be missed.
  std::vector<Piece> pieces() {
    constexpr int kProbes = 64;  // of a side
    using State = std::pair<bool, bool>;
    const auto stateAt = [&](double s) {
      const Edge e = edge(s);
      return State{see(e.ray).has_value(), e.isDrawnIn};
    };
    std::vector<Piece> all;
    State state = stateAt(0);
    for (int k = 0; k < 4 * kProbes; ++k) {
      double a = static_cast<double>(k) / kProbes;
      const double end = static_cast<double>(k + 1) / kProbes;
      if (k % kProbes == 0) all.push_back({a, a, state.first, state.second});
      const State last = stateAt(end);
      while (state != last) {
        double b = end;
        State after = last;
        for (double m = a + (b - a) / 2; m > a && m < b; m = a + (b - a) / 2) {
          const State middle = stateAt(m);
          (middle == state ? a : b) = m;
          if (middle != state) after = middle;
        }
        all.back().to = a;
        all.push_back({b, b, after.first, after.second});
        a = b;
        state = after;
      }
      all.back().to = end;
    }
    return all;
  }

  double turning() const { return ground_.turning() * (isMirrored_ ? -1 : 1); }

  /// The horizon from one azimuth, so far round.
  Curve arc(double azimuth, double span) {
    const double turn = turning() * span;
    Curve curve{[this, azimuth, turn](double t) { return onLimit(azimuth + turn * t); }, 0, 1};
    setEnds(curve);
    return curve;
  }
  static void setEnds(Curve& curve) {
    curve.first = curve.at(curve.from).value();
    curve.last = curve.at(curve.to).value();
  }
  /// In an orthographic picture all cuts are straight.
  Curve chord(OutlineVertex from, OutlineVertex to) {
    cut_.insert("distance");
    from.pixel = to.pixel = std::nullopt;
    const auto at = [this, from, to](double t) {
      return std::optional(vertex(sum(from.point, t, sum(to.point, -1, from.point)), std::nullopt));
    };
    return {at, 0, 1, from, to};
  }

  /// Runs of pieces that see the ground, the first one that follows a cut first.
  struct Runs {
    std::vector<Ring> runs;
    bool areCut = false;
  };
  Runs runsOf(std::vector<Piece> all) {
    if (std::any_of(all.begin(), all.end(), [](const Piece& p) { return p.isDrawnIn; })) cut_.insert("lens");
    const auto begins = [&](std::size_t i) { return all[i].sees && !all[(i + all.size() - 1) % all.size()].sees; };
    std::size_t start = 0;
    while (start < all.size() && !begins(start)) ++start;
    Runs found{{}, start < all.size()};
    if (found.areCut) std::rotate(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(start), all.end());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i].sees) continue;
      if (found.runs.empty() || begins(i)) found.runs.emplace_back();
      Curve curve{[this](double s) { return onEdge(s); }, all[i].from, all[i].to};
      setEnds(curve);
      found.runs.back().push_back(std::move(curve));
    }
    return found;
  }

  std::vector<Ring> rings() {
    auto [runs, areCut] = runsOf(pieces());
    if (areCut) return linked(std::move(runs));
    // The edge sees the ground everywhere or nowhere: the horizon is all in the picture, or all outside of it.
    std::vector<Ring> rings;
    if (horizonIsInPicture(most_)) {
      rings.emplace_back();
      for (int k = 0; k < 4; ++k) rings.back().push_back(arc(turning() * k * kPi / 2, kPi / 2));
    }
    hasHole_ = !rings.empty() && !runs.empty();
    for (Ring& run : runs) rings.push_back(std::move(run));
    return rings;
  }
  bool horizonIsInPicture(double most) const {
    const auto limit = isFlat_ ? std::nullopt : ground_.farthest(0, most);
    if (!limit) return false;
    const ScreenPoint screen = worldToScreen(camera_, limit->point);
    return screen.status == PointStatus::inFront && sidesBeyond(camera_, {screen.x, screen.y}) == 0;
  }

  /// The horizon from where a run ends, in radians, to the next azimuth at which one begins.
  struct Link {
    double azimuth, span;
    std::size_t next;
  };
  Link linkAfter(const std::vector<Ring>& runs, std::size_t i) const {
    const auto azimuthAt = [&](double s) { return ground_.azimuthOf(edge(s).ray.direction); };
    Link link{azimuthAt(runs[i].back().to), 4 * kPi, i};
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const double ahead = turning() * (azimuthAt(runs[k].front().from) - link.azimuth);
      const double span = std::fmod(ahead + 4 * kPi, 2 * kPi);
      if (span >= link.span) continue;
      link.span = span;
      link.next = k;
    }
    return link;
  }

  std::vector<Ring> linked(std::vector<Ring> runs) {
    std::vector<std::size_t> next(runs.size());
    std::vector<Curve> arcs;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      next[i] = (i + 1) % runs.size();
      if (isFlat_) {
        arcs.push_back(chord(runs[i].back().last, runs[next[i]].front().first));
        continue;
      }
      const Link link = linkAfter(runs, i);
      next[i] = link.next;
      arcs.push_back(arc(link.azimuth, link.span));
    }
    std::vector<Ring> rings;
    std::vector<bool> isUsed(runs.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (isUsed[i]) continue;
      rings.emplace_back();
      for (std::size_t k = i; !isUsed[k]; k = next[k]) {
        isUsed[k] = true;
        runs[k].back().last = arcs[k].first;
        runs[next[k]].front().first = arcs[k].last;
        rings.back().insert(rings.back().end(), runs[k].begin(), runs[k].end());
        rings.back().push_back(arcs[k]);
      }
      // The last arc may end at a curve that is in the ring already.
      rings.back().front().first = rings.back().back().last;
    }
    return rings;
  }

  /// Where the ground between two ends of a curve is halved: near a horizon that is not half-way along the edge.
  struct Middle {
    double at;
    OutlineVertex vertex;
  };
  Middle middleOf(const Curve& curve, double a, double b, const OutlineVertex& p, const OutlineVertex& q) {
    Middle middle{a, p};
    for (int i = 0; i < 40; ++i) {
      middle.at = a + (b - a) / 2;
      middle.vertex = curve.at(middle.at).value_or(p);
      const double before = apart(middle.vertex.point, p.point), after = apart(middle.vertex.point, q.point);
      if (std::min(before, after) > 0.6 * std::max(before, after)) break;
      (before < after ? a : b) = middle.at;
    }
    return middle;
  }

  Traced trace(const Ring& ring, double error) {
    Traced traced{.error = error};
    for (const Curve& c : ring)
      halve(c, c.from, c.to, c.first, c.last, middleOf(c, c.from, c.to, c.first, c.last), 0, traced);
    traced.area = ground_.areaOf(traced.sum, traced.turn);
    return traced;
  }

  /// Halves a curve until its quarters lie on the line that a map draws.
  void halve(const Curve& curve, double a, double b, const OutlineVertex& p, const OutlineVertex& q, const Middle& m,
             int depth, Traced& traced) {
    constexpr int kDeepest = 40;
    constexpr std::size_t kMostVertices = 1'000'000;
    const Middle l = middleOf(curve, a, m.at, p, m.vertex), n = middleOf(curve, m.at, b, m.vertex, q);
    const Vec2 scale = ground_.scaleAt(m.vertex.place);
    const auto metres = [&](const OutlineVertex& to) {
      const Vec2 way = ground_.way(p.place, to.place);
      return Vec2{way.x * scale.x, way.y * scale.y};
    };
    const Vec2 whole = metres(q);
    const double length = std::hypot(whole.x, whole.y);
    double worst = 0;
    for (const OutlineVertex* v : {&l.vertex, &m.vertex, &n.vertex}) {
      const Vec2 w = metres(*v);
      worst = std::max(worst, length > 0 ? std::fabs(w.x * whole.y - w.y * whole.x) / length : std::hypot(w.x, w.y));
    }
    const double extent = std::max(apart(p.point, m.vertex.point), apart(m.vertex.point, q.point));
    if (worst > 0.8 * traced.error && extent > traced.error && depth < kDeepest) {
      halve(curve, a, m.at, p, m.vertex, l, depth + 1, traced);
      halve(curve, m.at, b, m.vertex, q, n, depth + 1, traced);
      return;
    }
    if (traced.vertices.size() >= kMostVertices)
      throw InputError("an outline within " + formatNumber(traced.error) +
                       " has more than a million vertices; --error takes a larger distance");
    traced.vertices.push_back(p);
    addArea(p, l.vertex, m.vertex, traced);
    addArea(m.vertex, n.vertex, q, traced);
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
  double most_;
  bool isFlat_, isMirrored_ = false, hasHole_ = false;
  bool seesBeyond_ = false;  ///< something is seen, be it too far
  Vec2 topLeft_, bottomRight_, center_;
  std::set<std::string_view> cut_;
};

}  // namespace

Outline outlineOf(const Camera& camera, const Ground& ground, double most, double error) {
  return Tracer(camera, ground, most).outline(error);
}

std::array<std::optional<Vec2>, 3> horizonPixels(const Camera& camera, const Ground& ground) {
  if (camera.projection().isOrthographic()) return {};
  return Tracer(camera, ground, std::numeric_limits<double>::infinity()).horizonPixels();
}

}  // namespace viewproj::cmd
