#include "viewproj/matrices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/camera.hpp"
#include "camera/depth.hpp"
#include "camera/require.hpp"
#include "camera/viewport.hpp"
#include "projection/exact_point.hpp"

namespace viewproj {

using namespace detail;
namespace {

using DDMat4 = std::array<std::array<DoubleDouble, 4>, 4>;

constexpr DDMat4 kIdentity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

// ---- What a projection does to distances X, Y, W along right, up, forward

/// out = scale h + offset and h = inverseScale out + inverseOffset, with h = X/W or Y/W (in orthographic X or Y).
struct AffineMap {
  DoubleDouble scale, offset, inverseScale, inverseOffset;
};

AffineMap byInverse(DoubleDouble half, DoubleDouble middle) noexcept {
  return {DoubleDouble(1) / half, -middle / half, half, middle};
}

AffineMap byScale(DoubleDouble scale, DoubleDouble offset) noexcept {
  return {scale, offset, DoubleDouble(1) / scale, -offset / scale};
}

/// Maps to normalised device coordinates.
AffineMap ndcX(const ProjectionParts& p) noexcept {
  return byInverse(timesPowerOfTwo(p.right - p.left, 0.5), timesPowerOfTwo(p.right + p.left, 0.5));
}

AffineMap ndcY(const ProjectionParts& p, NdcY direction) noexcept {
  return byInverse(timesPowerOfTwo(p.top - p.bottom, direction == NdcY::up ? 0.5 : -0.5),
                   timesPowerOfTwo(p.top + p.bottom, 0.5));
}

/// Maps to NDC or to the screen. depth is linear in 1/W, in orthographic in W.
struct Lens {
  AffineMap x, y;
  DepthLine depth, inverseDepth;
};

Lens lensOf(const CameraParts& c, Space space) {
  const ProjectionParts& p = c.projection;
  if (!hasDepth(p)) throw CameraError("near", "needs near: without a near plane there is no depth, and no clip space");
  if (space != Space::screen) {
    const DepthEnds ends = ndcDepths(c.convention);
    return {ndcX(p), ndcY(p, c.convention.ndcY), depthLine(p, ends), inverseDepthLine(p, ends)};
  }
  const DepthEnds ends = windowDepths(c.viewport, c.convention.reverseZ);
  return {byScale(c.screen.scaleX, c.screen.centerX), byScale(c.screen.scaleY, c.screen.centerY), depthLine(p, ends),
          inverseDepthLine(p, ends)};
}

/// The matrix from (X, Y, W, 1).
DDMat4 lensFromAxes(const CameraParts& c, Space space) {
  const auto& [x, y, depth, inverse] = lensOf(c, space);
  if (c.projection.orthographic)
    return {{
        {x.scale, 0, 0, x.offset},
        {0, y.scale, 0, y.offset},
        {0, 0, depth.scale, depth.offset},
        {0, 0, 0, 1},
    }};
  return {{
      {x.scale, 0, x.offset, 0},
      {0, y.scale, y.offset, 0},
      {0, 0, depth.offset, depth.scale},
      {0, 0, 1, 0},
  }};
}

DDMat4 axesFromLens(const CameraParts& c, Space space) {
  const auto& [x, y, depth, inverse] = lensOf(c, space);
  if (c.projection.orthographic)
    return {{
        {x.inverseScale, 0, 0, x.inverseOffset},
        {0, y.inverseScale, 0, y.inverseOffset},
        {0, 0, inverse.scale, inverse.offset},
        {0, 0, 0, 1},
    }};
  return {{
      {x.inverseScale, 0, 0, x.inverseOffset},
      {0, y.inverseScale, 0, y.inverseOffset},
      {0, 0, 0, 1},
      {0, 0, inverse.scale, inverse.offset},
  }};
}

/// The matrix from (X, Y, W, 1) to view space, and back. View y and z are up and forward with a sign.
DDMat4 viewAxes(const Convention& convention) noexcept {
  const AxisSigns sign = axisSigns(convention.view);
  return {{{1, 0, 0, 0}, {0, sign.up, 0, 0}, {0, 0, sign.forward, 0}, {0, 0, 0, 1}}};
}

/// From NDC to the screen: screen = scale ndc + offset, for each of x, y, z.
std::array<AffineMap, 3> viewportMaps(const Viewport& v, const Convention& c) noexcept {
  const ScreenCorner corner = screenCorner(v);
  const DoubleDouble halfWidth = v.width / 2, halfHeight = v.height / 2;
  const bool flipped = (v.origin == Origin::topLeft) == (c.ndcY == NdcY::up);
  const DoubleDouble range = twoDiff(v.depthSecond, v.depthFirst), half = timesPowerOfTwo(range, 0.5);
  const DoubleDouble first = v.depthFirst;
  return {byScale(halfWidth, corner.x + halfWidth), byScale(flipped ? -halfHeight : halfHeight, corner.y + halfHeight),
          c.ndcZ == NdcZ::minusOneToOne ? byScale(half, first + half) : byScale(range, first)};
}

// ---- Points, directions and models

/// Distances along right, up and forward. A sum that cancels to less than its own error is 0.
DDVec3 alongAxes(const PoseParts& pose, const Vec4& p) noexcept {
  const Vec3 xyz{p.x, p.y, p.z};
  DDVec3 d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = DoubleDouble(xyz[i]) + twoProd(-pose.eye[i], p.w);
  const auto along = [&](const DDVec3& axis, DoubleDouble residual) {
    return sumOrZero(dotOrZero(axis, d), residual * DoubleDouble(p.w));
  };
  return {along(pose.rows.right, pose.residual.x), along(pose.rows.up, pose.residual.y),
          along(pose.rows.forward, pose.residual.z)};
}

/// The same distances within 2^-90 relative, even if they cancel.
DDVec3 preciselyAlongAxes(const PoseParts& pose, const Vec4& p) noexcept {
  constexpr double kKept = 0x1p-8;  // of the terms, which are within 2^-98
  const DDVec3 near = alongAxes(pose, p);
  const Vec3& eye = pose.eye;
  const double size = std::fabs(p.x - p.w * eye.x) + std::fabs(p.y - p.w * eye.y) + std::fabs(p.z - p.w * eye.z) +
                      std::fabs(pose.residual.x.hi) + std::fabs(pose.residual.y.hi) + std::fabs(pose.residual.z.hi);
  if (std::min({std::fabs(near.x.hi), std::fabs(near.y.hi), std::fabs(near.z.hi)}) > kKept * size) return near;
  const AxisDistances exact = exactDistances(pose, p);
  return {toDoubleDouble(exact.right), toDoubleDouble(exact.up), toDoubleDouble(exact.forward)};
}

/// | right    distance of the world's origin along right |
/// | up       ...                                        |
/// | forward  ...                                        |
/// | 0        1                                          |
DDMat4 axesFromWorld(const PoseParts& p) noexcept {
  const DDVec3 &x = p.rows.right, &y = p.rows.up, &z = p.rows.forward;
  const DDVec3 origin = preciselyAlongAxes(p, {0, 0, 0, 1});
  return {{{x.x, x.y, x.z, origin.x}, {y.x, y.y, y.z, origin.y}, {z.x, z.y, z.z, origin.z}, {0, 0, 0, 1}}};
}

/// | right up forward eye |
/// | 0     0  0       1   |
DDMat4 worldFromAxes(const PoseParts& p) noexcept {
  const Axes& c = p.columns;
  const DDVec3 eye = unroundedEye(p);
  DDMat4 m = kIdentity;
  for (std::size_t i = 0; i < 3; ++i) m[i] = {c.right[i], c.up[i], c.forward[i], eye[i]};
  return m;
}

/// Each column of the model's matrix in distances along the axes.
DDMat4 axesFromModel(const PoseParts& p, const Mat4& model) noexcept {
  DDMat4 m = kIdentity;
  for (std::size_t j = 0; j < 4; ++j) {
    const DDVec3 column = preciselyAlongAxes(p, {model[0][j], model[1][j], model[2][j], j == 3 ? 1.0 : 0.0});
    for (std::size_t i = 0; i < 3; ++i) m[i][j] = column[i];
  }
  return m;
}

/// | adjugate right / determinant  ...  adjugate (eye - translation) / determinant |
/// | 0                             ...  1                                          |
DDMat4 modelFrom(const DDMat4& world, const Mat4& model) {
  constexpr double kLargestEntry = 1e100;
  std::array<Vector3<Dyadic<1>>, 4> column;
  for (std::size_t j = 0; j < 4; ++j) column[j] = {model[0][j], model[1][j], model[2][j]};
  const auto& [x, y, z, translation] = column;
  const std::array<Vector3<Dyadic<2>>, 3> adjugate = {crossOf(y, z), crossOf(z, x), crossOf(x, y)};
  const Wide determinant = dot(adjugate[0], x).rounded();
  if (determinant.sign() == 0) throw CameraError("model", "has no inverse: its axes lie in a plane");
  DDMat4 m = kIdentity;
  for (std::size_t j = 0; j < 4; ++j) {
    Vector3<Dyadic<1>> v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = Dyadic<1>(world[i][j].hi) + Dyadic<1>(world[i][j].lo);
      if (j == 3) v[i] = v[i] - translation[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      m[i][j] = toDoubleDouble(dot(adjugate[i], v).rounded() / determinant);
      if (!(std::fabs(m[i][j].hi) < kLargestEntry))
        throw CameraError("model", "has an inverse with entries beyond 1e100");
    }
  }
  return m;
}

Mat4 checkedModel(const Mat4& worldFromModel) {
  const Mat4 m = checkedEntries(worldFromModel, "model");
  if (!(m[3] == std::array<double, 4>{0, 0, 0, 1})) throw CameraError("model", "has a last row that is not 0 0 0 1");
  return m;
}

// ---- Put together

DDMat4 product(const DDMat4& a, const DDMat4& b) noexcept {
  DDMat4 result{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        if (a[i][k].hi != 0 && b[k][j].hi != 0) result[i][j] += a[i][k] * b[k][j];
  return result;
}

DDMat4 axesFrom(const CameraParts& c, Space space, const Mat4* model) {
  if (space == Space::model) return axesFromModel(c.pose, *model);
  if (space == Space::world) return axesFromWorld(c.pose);
  return space == Space::view ? viewAxes(c.convention) : axesFromLens(c, space);
}

DDMat4 fromAxes(const CameraParts& c, Space space, const Mat4* model) {
  if (space == Space::model) return modelFrom(worldFromAxes(c.pose), *model);
  if (space == Space::world) return worldFromAxes(c.pose);
  return space == Space::view ? viewAxes(c.convention) : lensFromAxes(c, space);
}

DDMat4 matrixOf(const Camera& camera, Space to, Space from, const Mat4* model) {
  const CameraParts& c = parts(camera);
  const auto isOfScene = [](Space s) { return s == Space::model || s == Space::world; };
  const auto isClip = [](Space s) { return s == Space::clip || s == Space::ndc; };
  if (!model && (to == Space::model || from == Space::model)) throw CameraError("model", "is missing");
  DDMat4 m = kIdentity;
  if (to == from || (isClip(to) && isClip(from))) return m;
  if ((to == Space::screen && isClip(from)) || (from == Space::screen && isClip(to))) {
    const std::array<AffineMap, 3> maps = viewportMaps(c.viewport, c.convention);
    for (std::size_t i = 0; i < 3; ++i) {
      m[i][i] = to == Space::screen ? maps[i].scale : maps[i].inverseScale;
      m[i][3] = to == Space::screen ? maps[i].offset : maps[i].inverseOffset;
    }
    return m;
  }
  if (!isOfScene(to) || !isOfScene(from)) return product(fromAxes(c, to, model), axesFrom(c, from, model));
  if (to == Space::model) return modelFrom(m, *model);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = (*model)[i][j];
  return m;
}

/// Adding 0 turns -0 into 0.
Mat4 rounded(const DDMat4& a) noexcept {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = a[i][j].hi + 0.0;
  return result;
}

/// Rounds once. A double-double close to the middle of two floats must not be rounded to double first.
template <class Number>
Number entry(const DoubleDouble& a) noexcept {
  const Number nearest = static_cast<Number>(a.hi + 0.0);
  if constexpr (sizeof(Number) < sizeof(double)) {
    const double rest = a.hi - double{nearest};
    const Number other =
        std::nextafter(nearest, std::copysign(std::numeric_limits<Number>::infinity(), static_cast<Number>(rest)));
    // Exactly in the middle of the two, lo decides.
    if (rest != 0 && std::isfinite(other) && rest == double{other} - a.hi && a.lo != 0 && (a.lo > 0) == (rest > 0))
      return other;
  }
  return nearest;
}

/// Calls use(row, column, place) for each entry and its place in memory. Row vectors transpose the matrix, and
/// column-major order transposes it too.
template <class Use>
void eachStored(const Convention& c, const Use& use) noexcept {
  const bool byColumns = (c.vectors == Vectors::row) != (c.storage == Storage::columnMajor);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) byColumns ? use(j, i, 4 * i + j) : use(i, j, 4 * i + j);
}

template <class Numbers>
Mat4 unstored(const Numbers& flat, const Convention& c) noexcept {
  Mat4 m;
  eachStored(c, [&](std::size_t i, std::size_t j, std::size_t place) { m[i][j] = flat[place]; });
  return m;
}

}  // namespace

Mat4 matrix(const Camera& camera, Space to, Space from) { return rounded(matrixOf(camera, to, from, nullptr)); }

Mat4 matrix(const Camera& camera, Space to, Space from, const Mat4& worldFromModel) {
  const Mat4 model = checkedModel(worldFromModel);
  return rounded(matrixOf(camera, to, from, &model));
}

template <class Number>
std::array<Number, 16> storedMatrix(const Camera& camera, Space to, Space from) {
  const DDMat4 m = matrixOf(camera, to, from, nullptr);
  std::array<Number, 16> flat{};
  eachStored(camera.convention(),
             [&](std::size_t i, std::size_t j, std::size_t place) { flat[place] = entry<Number>(m[i][j]); });
  return flat;
}
template std::array<float, 16> storedMatrix<float>(const Camera&, Space, Space);
template std::array<double, 16> storedMatrix<double>(const Camera&, Space, Space);

std::array<double, 16> inStorageOrder(const Mat4& matrix, const Convention& convention) noexcept {
  std::array<double, 16> flat{};
  eachStored(convention, [&](std::size_t i, std::size_t j, std::size_t place) { flat[place] = matrix[i][j]; });
  return flat;
}

Mat4 fromStorageOrder(std::span<const double, 16> numbers, const Convention& c) noexcept {
  return unstored(numbers, c);
}
Mat4 fromStorageOrder(std::span<const float, 16> numbers, const Convention& c) noexcept { return unstored(numbers, c); }

Mat4 laidOut(const Mat4& matrix, const Convention& c) noexcept {
  return c.vectors == Vectors::row ? transposed(matrix) : matrix;
}

Vec4 worldTo(const Camera& camera, Space to, const Vec4& point, const Convention& convention) noexcept {
  constexpr Vec4 kNone{kNaN, kNaN, kNaN, kNaN};
  const CameraParts& c = parts(camera);
  if (!isInDomain(c.pose.eye, point)) return kNone;
  const bool isDirection = point.w == 0;
  const DDVec3 a = alongAxes(c.pose, point) * (DoubleDouble(1) / DoubleDouble(isDirection ? 1 : point.w));
  const double weight = isDirection ? 0 : 1;
  if (to == Space::view) {
    const AxisSigns sign = axisSigns(convention.view);
    return {rounded(a.x), sign.up * rounded(a.y) + 0.0, sign.forward * rounded(a.z) + 0.0, weight};
  }
  if (to != Space::clip && to != Space::ndc) return kNone;
  const ProjectionParts& p = c.projection;
  const AffineMap mapX = ndcX(p), mapY = ndcY(p, convention.ndcY);
  const DepthEnds ends = hasDepth(p) ? ndcDepths(convention) : DepthEnds{kNaN, kNaN};
  const DepthShares shares = depthShares(p, a.z, weight);
  const Wide w = p.orthographic ? Wide(weight) : Wide(a.z);
  const auto across = [&](const AffineMap& map, DoubleDouble h) {
    return sumOrZero(Wide(map.scale) * Wide(h), Wide(map.offset) * w);
  };
  const Wide x = across(mapX, a.x), y = across(mapY, a.y);
  const Wide z = Wide(ends.atNear) * shares.ofNear + Wide(ends.atFar) * shares.ofFar;
  if (to == Space::clip) return {rounded(x), rounded(y), rounded(z), rounded(w)};
  return w.sign() > 0 ? Vec4{rounded(x / w), rounded(y / w), rounded(z / w), 1} : kNone;
}

SplitVec3 alongAxes(const Camera& camera, const Vec4& point) noexcept {
  const PoseParts& pose = parts(camera).pose;
  if (!isInDomain(pose.eye, point)) return {{kNaN, kNaN, kNaN}, {}};
  const DDVec3 d = preciselyAlongAxes(pose, point);
  return split(point.w == 0 || point.w == 1 ? d : d * (DoubleDouble(1) / DoubleDouble(point.w)));
}

}  // namespace viewproj
