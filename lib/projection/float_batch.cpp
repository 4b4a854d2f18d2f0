#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>

#include "projection/kernels/kernels.hpp"
#include "projection/left.hpp"
#include "viewproj/floats.hpp"

namespace viewproj {

using namespace detail;
namespace {

/// An array of each coordinate, or x, y and z after one another, some bytes apart.
template <class Float>
struct Shape {
  Float *x, *y, *z;
  std::size_t strideBytes;

  bool isTogether() const noexcept { return y == x + 1 && z == x + 2; }
  /// As a kernel takes them, if it does.
  std::optional<FloatShape> shape() const noexcept {
    for (const void* first : {static_cast<const void*>(x), static_cast<const void*>(y), static_cast<const void*>(z)})
      if (reinterpret_cast<std::uintptr_t>(first) % alignof(float) != 0) return std::nullopt;
    if (strideBytes == sizeof(float)) return FloatShape::columns;
    if (!isTogether() || strideBytes < 3 * sizeof(float)) return std::nullopt;
    if (strideBytes == 3 * sizeof(float)) return FloatShape::packed;
    return strideBytes % sizeof(float) != 0 ? std::nullopt : std::optional(FloatShape::vertices);
  }
  FloatColumns<Float> columns() const noexcept { return {x, y, z, *shape(), strideBytes}; }
};

Shape<const float> shapeOf(const FloatPoints& p) noexcept { return {p.x, p.y, p.z, p.strideBytes}; }
Shape<float> shapeOf(const FloatPositions& p) noexcept { return {p.x, p.y, p.depth, p.strideBytes}; }

/// At any address.
template <class Byte, class Float>
Byte* at(Float* p, std::size_t i, std::size_t strideBytes) noexcept {
  return reinterpret_cast<Byte*>(p) + i * strideBytes;
}

constexpr std::size_t kPoint = 3 * sizeof(float);

/// Points to x y z after one another, and back.
void gather(const Shape<const float>& from, std::size_t first, std::size_t size, float* packed) noexcept {
  for (std::size_t j = 0; j < size; ++j, packed += 3) {
    if (from.isTogether()) {
      std::memcpy(packed, at<const char>(from.x, first + j, from.strideBytes), kPoint);
      continue;
    }
    std::memcpy(packed, at<const char>(from.x, first + j, from.strideBytes), sizeof(float));
    std::memcpy(packed + 1, at<const char>(from.y, first + j, from.strideBytes), sizeof(float));
    std::memcpy(packed + 2, at<const char>(from.z, first + j, from.strideBytes), sizeof(float));
  }
}

void scatter(const float* packed, std::size_t size, const Shape<float>& to, std::size_t first) noexcept {
  for (std::size_t j = 0; j < size; ++j, packed += 3) {
    if (to.isTogether()) {
      std::memcpy(at<char>(to.x, first + j, to.strideBytes), packed, kPoint);
      continue;
    }
    std::memcpy(at<char>(to.x, first + j, to.strideBytes), packed, sizeof(float));
    std::memcpy(at<char>(to.y, first + j, to.strideBytes), packed + 1, sizeof(float));
    std::memcpy(at<char>(to.z, first + j, to.strideBytes), packed + 2, sizeof(float));
  }
}

/// Whether memory of the one may be the other's.
bool mayOverlap(const Shape<const float>& in, const Shape<float>& out, std::size_t count) noexcept {
  const auto touch = [&](const float* a, const float* b) {
    const auto from = reinterpret_cast<std::uintptr_t>(a), to = reinterpret_cast<std::uintptr_t>(b);
    return from < to + count * out.strideBytes && to < from + count * in.strideBytes;
  };
  for (const float* a : {in.x, in.y, in.z})
    for (const float* b : {out.x, out.y, out.z})
      if (touch(a, b)) return true;
  return false;
}

float rounded(double value) noexcept { return static_cast<float>(value); }

}  // namespace

BatchCounts worldToScreen(const Camera& camera, const FloatPoints& points, const FloatPositions& screen,
                          Precision precision) noexcept {
  if (points.count == 0) return {};
  const Shape<const float> from = shapeOf(points);
  const Shape<float> to = shapeOf(screen);
  const bool isFast = precision == Precision::fast;
  const bool reads = isFast && from.shape() && !mayOverlap(from, to, points.count);
  // A fourth float of the last vertex may be nobody's.
  const std::size_t readable = !reads ? 0 : from.shape() == FloatShape::vertices ? points.count - 1 : points.count;
  const bool writes = isFast && to.shape();
  BatchCounts counts;
  float given[3 * kBlock], results[3 * kBlock];
  for (std::size_t i = 0; i < points.count; i += kBlock) {
    const std::size_t size = std::min(kBlock, points.count - i);
    const bool isRead = i + size <= readable;
    if (!isRead) gather(from, i, size, given);
    const FloatColumns<const float> in =
        isRead ? from.columns().from(i) : packedColumns(static_cast<const float*>(given));
    const FloatColumns<float> out = writes ? to.columns().from(i) : packedColumns(results);
    const auto point = [&](std::size_t j) {
      const auto p = in.from(j);
      return Vec3{*p.x, *p.y, *p.z};
    };
    const auto put = [&](std::size_t j, double x, double y, double depth) {
      const auto p = out.from(j);
      *p.x = rounded(x);
      *p.y = rounded(y);
      *p.z = rounded(depth);
    };
    if (isFast) {
      Left left;
      kernels().floats(parts(camera).constants, in, out, size, left.bits);
      left.each([&](std::size_t j) {
        const ScreenPoint p = worldToScreen(camera, point(j), Precision::exact);
        put(j, p.x, p.y, p.depth);
        tally(counts, p);
      });
    } else {
      Vec3 block[kBlock];
      for (std::size_t j = 0; j < size; ++j) block[j] = point(j);
      const std::span<Vec3> both(block, size);
      const BatchCounts more = worldToScreen(camera, both, both, precision);
      for (std::size_t j = 0; j < size; ++j) put(j, block[j].x, block[j].y, block[j].z);
      counts.escalated += more.escalated;
      counts.uncertain += more.uncertain;
    }
    if (!writes) scatter(results, size, to, i);
  }
  return counts;
}

}  // namespace viewproj
