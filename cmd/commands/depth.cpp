#include "commands/depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "numbers/wide.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using detail::Wide;
namespace {

/// far / (far - near), 1 where far is infinite.
Wide farShare(const Projection& p) {
  return std::isinf(p.zFar()) ? Wide(1) : Wide(p.zFar()) / (Wide(p.zFar()) - Wide(p.zNear()));
}

/// Each end of the depth range by its share, so that the depth keeps its digits next to 0.
double depthAt(const DepthMapping& m, double distance) {
  const Projection& p = m.projection;
  const Wide w = distance, near = p.zNear(), far = p.zFar();
  Wide ofNear, ofFar;
  if (p.isOrthographic()) {
    ofNear = (far - w) / (far - near);
    ofFar = (w - near) / (far - near);
  } else {
    ofNear = std::isinf(p.zFar()) ? near / w : near * (far - w) / (far - near) / w;
    ofFar = farShare(p) * (w - near) / w;
  }
  return nearestDouble(Wide(m.atNear) * ofNear + Wide(m.atFar) * ofFar);
}

/// The change of depth per unit of distance is slope in orthographic, in perspective slope / distance^2.
Wide slope(const DepthMapping& m) {
  const Wide range = Wide(m.atFar) - Wide(m.atNear), near = m.projection.zNear();
  return m.projection.isOrthographic() ? range / (Wide(m.projection.zFar()) - near)
                                       : range * near * farShare(m.projection);
}

double distanceAt(const DepthMapping& m, double depth) {
  const Wide fromNear = Wide(depth) - Wide(m.atNear), toFar = Wide(m.atFar) - Wide(depth);
  const Wide range = Wide(m.atFar) - Wide(m.atNear), near = m.projection.zNear(), far = m.projection.zFar();
  if (m.projection.isOrthographic()) return nearestDouble((near * toFar + far * fromNear) / range);
  // near / distance
  const Wide share = std::isinf(m.projection.zFar()) ? toFar / range : (far * toFar + near * fromNear) / (far * range);
  return share.sign() == 0 ? kInfiniteFar : nearestDouble(near / share);
}

/// Of float32s in (2^k, 2^(k+1)], where the value lies.
double floatStep(double value) {
  if (value == 0) return 0x1p-149;
  int exponent;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  return std::max(std::ldexp(1.0, exponent - (fraction == 0.5 ? 2 : 1) - 23), 0x1p-149);
}

/// The larger depth of two surfaces decides the step: that of the farther one, or with reversed depth of the nearer
/// one, which is a step above. A depth made from NDC z of -1..1 was a float32 there: of such steps those within a step
/// of the depth, ends included, are stored alike.
double floatDepthStep(const DepthMapping& m, double distance) {
  const double depth = depthAt(m, distance), range = std::fabs(m.atFar - m.atNear);
  const bool reversed = m.atFar < m.atNear;
  double step = floatStep(depth);
  if (reversed) step = floatStep(std::min(depth + step, std::max(m.atNear, m.atFar)));
  if (m.ndcZ == NdcZ::zeroToOne) return step;
  const double ndcStep = range / 2 * floatStep(2 * (depth - std::min(m.atNear, m.atFar)) / range - 1);
  return ndcStep < step ? step + ndcStep : ndcStep;
}

/// A step of depth as a length. Surfaces at v < w differ in depth by slope (1/v - 1/w), in orthographic slope (w - v).
/// Nothing is known better than to half a step of the distance's own float32.
double lengthOf(const DepthMapping& m, double step, double distance) {
  const double rate = std::fabs(nearestDouble(slope(m)));
  const double gap = m.projection.isOrthographic() ? step / rate : distance / (1 + rate / distance / step);
  return std::max(gap, floatStep(distance) / 2);
}

/// Of buffers with so many bits: shares of 1, or whole numbers where the range goes beyond 1. NaN where they do not
/// hold it.
double unormStep(const DepthMapping& m, int bits) {
  const double largest = std::ldexp(1.0, bits) - 1, range = std::max(m.atNear, m.atFar);
  return range <= 1 ? 1 / largest : range <= largest ? 1 : NAN;
}

double floatStepOf(DepthMapping m, double distance, bool isReversed) {
  if (isReversed != (m.atFar < m.atNear)) std::swap(m.atNear, m.atFar);
  return floatDepthStep(m, distance);
}

struct Buffer {
  const char* name;
  double (*step)(const DepthMapping& m, double distance);
};
constexpr Buffer kBuffers[] = {
    {"d16", [](const DepthMapping& m, double) { return unormStep(m, 16); }},
    {"d24", [](const DepthMapping& m, double) { return unormStep(m, 24); }},
    {"f32", [](const DepthMapping& m, double distance) { return floatStepOf(m, distance, false); }},
    {"f32Reversed", [](const DepthMapping& m, double distance) { return floatStepOf(m, distance, true); }},
};

/// NaN where the camera does not see the distance, or the buffer does not hold its depths.
double gapOf(const Buffer& buffer, const DepthMapping& m, double distance) {
  if (!(distance >= m.projection.zNear() && distance <= m.projection.zFar())) return NAN;
  const double step = buffer.step(m, distance);
  return step > 0 ? lengthOf(m, step, distance) : NAN;
}

/// A near plane with which the buffer resolves the gap at the distance, and with a nearer one it does not: 0 where any
/// does, NaN where none does.
double nearFor(const Buffer& buffer, const DepthMapping& m, double gap, double distance) {
  const auto resolves = [&](double near) {
    DepthMapping there = m;
    there.projection = perspectiveWindow(-1, 1, -1, 1, near, m.projection.zFar());
    return gapOf(buffer, there, distance) <= gap;
  };
  double high = std::min(distance, m.projection.zFar() * (1 - 0x1p-20)), low = high * 0x1p-64;
  if (!resolves(high)) return NAN;
  if (resolves(low)) return 0;
  for (double middle = std::sqrt(low * high); low < middle && middle < high; middle = std::sqrt(low * high))
    (resolves(middle) ? high : low) = middle;
  return high;
}

OrderedJson reportOf(const DepthMapping& m) {
  return {{"projection", m.projection.isOrthographic() ? "orthographic" : "perspective"},
          {"near", m.projection.zNear()},
          {"far", m.projection.zFar()},
          {"depthAtNear", m.atNear},
          {"depthAtFar", m.atFar}};
}

}  // namespace

OrderedJson depthReport(const DepthMapping& m, std::span<const double> distances) {
  OrderedJson report = reportOf(m), rows = OrderedJson::array();
  for (const double w : distances) {
    const Wide squared = m.projection.isOrthographic() ? Wide(1) : Wide(w) * Wide(w);
    rows.push_back({{"distance", w}, {"depth", depthAt(m, w)}, {"slope", nearestDouble(slope(m) / squared)}});
    for (const Buffer& buffer : kBuffers) rows.back()[buffer.name] = gapOf(buffer, m, w);
  }
  report["distances"] = std::move(rows);
  report["notes"] = {
      "d16, d24, f32: how far in front of a surface at this distance another must be for the buffer to tell them "
      "apart; at least half a float32 step of the distance, which a shader has. d16 and d24 resolve the same forward "
      "and reversed."};
  if (std::max(m.atNear, m.atFar) > 1)
    report["notes"].push_back("The depth range goes beyond 1: d16 and d24 store whole numbers, where they hold it.");
  if (m.ndcZ == NdcZ::minusOneToOne)
    report["notes"].push_back(
        "With NDC z of -1..1 (OpenGL) f32 is no finer than d24: z is a float32 near -1 first. --set "
        "convention.ndcZ=0..1, as Direct3D, Vulkan and glClipControl have it, keeps f32Reversed fine.");
  return report;
}

OrderedJson distanceReport(const DepthMapping& m, std::span<const double> depths) {
  OrderedJson report = reportOf(m), rows = OrderedJson::array();
  const auto [low, high] = std::minmax(m.atNear, m.atFar);
  for (const double depth : depths) {
    if (!(depth >= low && depth <= high))
      throw UsageError("--depth " + formatNumber(depth) + ": expected a window depth from " + formatNumber(low) +
                       " to " + formatNumber(high) + ", the camera's range");
    rows.push_back({{"depth", depth}, {"distance", distanceAt(m, depth)}});
  }
  report["depths"] = std::move(rows);
  return report;
}

OrderedJson nearReport(const DepthMapping& m, double gap, std::span<const double> distances) {
  OrderedJson rows = OrderedJson::array();
  for (const double w : distances) {
    if (!(w <= m.projection.zFar()))
      throw UsageError("--at " + formatNumber(w) + ": lies beyond far, " + formatNumber(m.projection.zFar()));
    rows.push_back({{"distance", w}});
    for (const Buffer& buffer : kBuffers) rows.back()[buffer.name] = nearFor(buffer, m, gap, w);
  }
  return {{"gap", gap},
          {"far", m.projection.zFar()},
          {"nears", std::move(rows)},
          {"notes",
           {"The near plane with which each buffer tells surfaces so far apart from one another at the distance; a "
            "nearer one does not. 0: any near does; none: no near does."}}};
}

std::vector<double> usualDistances(const Projection& p) {
  constexpr double kInfiniteReach = 1e8, kLargest = std::numeric_limits<double>::max();
  constexpr int kMostDecades = 24;
  // Without the noise of the last digits.
  const auto plain = [](double value) { return toDigits(value, 15); };
  std::vector<double> distances{p.zNear()};
  if (p.isOrthographic()) {
    for (int i = 1; i < 10; ++i) distances.push_back(plain(p.zNear() + (p.zFar() - p.zNear()) * i / 10));
    distances.push_back(p.zFar());
    return distances;
  }
  const bool isInfinite = std::isinf(p.zFar());
  const double end = isInfinite ? plain(std::min(p.zNear() * kInfiniteReach, kLargest)) : p.zFar();
  const bool isFine = end / p.zNear() < 1000;
  const int first = static_cast<int>(std::floor(std::log10(p.zNear())));
  const int last = static_cast<int>(std::ceil(std::log10(end)));
  for (int exponent = first; exponent < last; exponent += 1 + (last - first) / kMostDecades)
    for (const char* digit : {"1", "2", "5"}) {
      const double distance = parseNumber(digit + ("e" + std::to_string(exponent))).value_or(kInfiniteFar);
      if (distance > p.zNear() && distance < end && (isFine || *digit == '1')) distances.push_back(distance);
    }
  distances.push_back(end);
  return distances;
}

namespace {

struct DepthOptions {
  CameraOptions camera;
  std::optional<std::vector<double>> at, depths;
  std::optional<double> gap;
  ReportOptions report;
};

int runDepth(const DepthOptions& o) {
  const CameraFile file = o.camera.read();
  if (!file.projection) throw InputError(file.name + ": the camera has no projection");
  if (!o.gap) requireNear(file, "depth");
  const Viewport viewport = file.viewport.value_or(Viewport{});
  DepthMapping mapping{*file.projection, viewport.depthFirst, viewport.depthSecond, file.convention.ndcZ};
  if (file.convention.reverseZ) std::swap(mapping.atNear, mapping.atFar);
  if (std::min(mapping.atNear, mapping.atFar) < 0)
    throw InputError(file.name + ": viewport.depthRange: expected depths from 0 on for a depth buffer");
  if (o.depths) {
    o.report.write(distanceReport(mapping, *o.depths), "depths");
    return 0;
  }
  if (o.gap && file.projection->isOrthographic())
    throw UsageError("--gap is of a perspective: an orthographic camera resolves the same at every distance");
  for (const double distance : o.at.value_or(std::vector<double>()))
    if (!file.projection->isOrthographic() && !(distance > 0))
      throw UsageError("--at " + formatNumber(distance) + ": expected a distance above 0, in front of the eye");
  if (o.gap)
    o.report.write(nearReport(mapping, *o.gap, *o.at), "nears");
  else
    o.report.write(depthReport(mapping, o.at ? *o.at : usualDistances(*file.projection)), "distances");
  return 0;
}

}  // namespace

Action declareDepth(CLI::App& app) {
  const auto o = std::make_shared<DepthOptions>();
  describe(
      app,
      "What a depth buffer resolves: the window depth at each distance, its slope, and how far apart surfaces must be "
      "for d16, d24 and f32 (forward and reversed) to tell them apart. Lengths are in the camera's unit.",
      "Examples:\n"
      "  viewproj depth --near 0.1 --far 1000 --at 1,10,100\n"
      "  viewproj depth --far 5000 --gap 0.1 --at 2000\n"
      "  viewproj depth --near 0.1 --read-as webgpu --reverse-z --depth 0.5,0.001");
  CLI::Option* const at =
      addValue(app, "--at", "DISTANCES", o->at, numberList("distances separated by commas, as in 1,10,100"),
               "Distances along the viewing axis (default: decades from near to far)");
  exclude(addValue(app, "--depth", "DEPTHS", o->depths, numberList("depths separated by commas, as in 0.9,0.99"),
                   "Turn these window depths into distances along the viewing axis"),
          at);
  CLI::Option* const gap =
      addValue(app, "--gap", "LENGTH", o->gap, numberThat([](double length) { return length > 0; }, "a length above 0"),
               "Tell which near resolves this gap at --at's distances (in place of --near)");
  require(gap, at);
  o->report.add(app, 8);
  o->camera.addFile(app);
  o->camera.add(app);
  o->camera.addReversed(app);
  exclude(findOption(app, "--near"), gap);
  o->camera.takeAnyLens();
  return [o] { return runDepth(*o); };
}

}  // namespace viewproj::cmd
