#include "viewproj/matrices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "camera/camera.hpp"
#include "camera/convention.hpp"
#include "camera/lens.hpp"
#include "camera/pose.hpp"
#include "camera/screen_map.hpp"
#include "numbers/dyadic.hpp"

namespace viewproj {

using namespace detail;

namespace {

Lens screenLens(const ProjectionParts& p, const Viewport& v, const Convention& c) {
  requireDepth(p);
  const ScreenMap map = screenMap(p, v);
  const DepthEnds ends = windowDepths(v, c.reverseZ);
  const DepthLine inverse = inverseDepthLine(p, ends);
  return {p.orthographic,
          map.scaleX,
          map.centerX,
          map.scaleY,
          map.centerY,
          DoubleDouble(1) / map.scaleX,
          -map.centerX / map.scaleX,
          DoubleDouble(1) / map.scaleY,
          -map.centerY / map.scaleY,
          depthLine(p, ends),
          inverse.offset,
          inverse.scale};
}

using DDMat4 = std::array<std::array<DoubleDouble, 4>, 4>;

/// Adding 0 turns -0 into 0.
Mat4 rounded(const DDMat4& a) noexcept {
  Mat4 result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) result[i][j] = a[i][j].hi + 0.0;
  return result;
}

/// Rounded once: a double-double next to the middle of two floats does not go by way of the double on it.
template <class Number>
Number entry(const DoubleDouble& a) noexcept {
  const Number nearest = static_cast<Number>(a.hi + 0.0);
  if constexpr (sizeof(Number) < sizeof(double)) {
    const double rest = a.hi - double{nearest};
    const Number other =
        std::nextafter(nearest, std::copysign(std::numeric_limits<Number>::infinity(), static_cast<Number>(rest)));
    // On the middle between the two, lo decides.
    if (rest != 0 && std::isfinite(other) && rest == double{other} - a.hi && a.lo != 0 && (a.lo > 0) == (rest > 0))
      return other;
  }
  return nearest;
}

/// From coordinates (X, Y, W, 1) along right, up, forward to the lens's output.
DDMat4 lensMatrix(const Lens& l) noexcept {
  if (l.orthographic)
    return {{
        {l.scaleX, 0, 0, l.offsetX},
        {0, l.scaleY, 0, l.offsetY},
        {0, 0, l.depth.scale, l.depth.offset},
        {0, 0, 0, 1},
    }};
  return {{
      {l.scaleX, 0, l.offsetX, 0},
      {0, l.scaleY, l.offsetY, 0},
      {0, 0, l.depth.offset, l.depth.scale},
      {0, 0, 1, 0},
  }};
}

DDMat4 inverseLensMatrix(const Lens& l) noexcept {
  if (l.orthographic)
    return {{
        {l.inverseScaleX, 0, 0, l.inverseOffsetX},
        {0, l.inverseScaleY, 0, l.inverseOffsetY},
        {0, 0, l.inverseDepthScale, l.inverseDepthOffset},
        {0, 0, 0, 1},
    }};
  return {{
      {l.inverseScaleX, 0, 0, l.inverseOffsetX},
      {0, l.inverseScaleY, 0, l.inverseOffsetY},
      {0, 0, 0, 1},
      {0, 0, l.inverseDepthScale, l.inverseDepthOffset},
  }};
}

/// From (X, Y, W, 1) to view space and back: view y and z run along or against up and forward.
DDMat4 fromViewAxes(DDMat4 m, ViewAxes axes) noexcept {
  const AxisSigns sign = axisSigns(axes);
  for (auto& row : m) {
    row[1] = timesPowerOfTwo(row[1], sign.up);
    row[2] = timesPowerOfTwo(row[2], sign.forward);
  }
  return m;
}

DDMat4 toViewAxes(DDMat4 m, ViewAxes axes) noexcept {
  const AxisSigns sign = axisSigns(axes);
  for (std::size_t j = 0; j < 4; ++j) {
    m[1][j] = timesPowerOfTwo(m[1][j], sign.up);
    m[2][j] = timesPowerOfTwo(m[2][j], sign.forward);
  }
  return m;
}

/// | right    -right . eye   + residual.x |
/// | up       -up . eye      + residual.y |
/// | forward  -forward . eye + residual.z |
/// | 0        1                           |
DDMat4 axesFromWorld(const PoseParts& p) noexcept {
  const int k = exponentToUnit(toDoubleDouble(p.eye));
  const DDVec3 eye = scaleByPowerOfTwo(toDoubleDouble(p.eye), k);
  const auto row = [&](const DDVec3& axis, DoubleDouble residual) {
    const DoubleDouble translation = scaleByPowerOfTwo(-dotOrZero(axis, eye), -k) + residual;
    return std::array<DoubleDouble, 4>{axis.x, axis.y, axis.z, translation};
  };
  return {
      {row(p.rows.right, p.residual.x), row(p.rows.up, p.residual.y), row(p.rows.forward, p.residual.z), {0, 0, 0, 1}}};
}

/// | right up forward eye |
/// | 0     0  0       1   |
DDMat4 worldFromAxes(const PoseParts& p) noexcept {
  DDMat4 m{};
  const DDVec3 eye = unroundedEye(p);
  for (std::size_t i = 0; i < 3; ++i) m[i] = {p.columns.right[i], p.columns.up[i], p.columns.forward[i], eye[i]};
  m[3] = {0, 0, 0, 1};
  return m;
}

template <class Number>
DDMat4 productIn(const DDMat4& a, const DDMat4& b) noexcept {
  DDMat4 result{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      Number sum;
      for (std::size_t k = 0; k < 4; ++k)
        if (a[i][k].hi != 0 && b[k][j].hi != 0) sum = sum + as<Number>(a[i][k]) * as<Number>(b[k][j]);
      if constexpr (std::is_same_v<Number, Wide>)
        result[i][j] = toDoubleDouble(sum);
      else
        result[i][j] = sum;
    }
  return result;
}

/// Whether products of entries keep all their digits.
bool isNarrow(const DDMat4& m) noexcept {
  for (const auto& row : m)
    for (const DoubleDouble& entry : row)
      if (const double size = std::fabs(entry.hi); size != 0 && !(size > 0x1p-400 && size < 0x1p400)) return false;
  return true;
}

/// In double-double, so that the rounded entries are those of the closed form; or in numbers of wider range.
DDMat4 product(const DDMat4& a, const DDMat4& b) noexcept {
  return isNarrow(a) && isNarrow(b) ? productIn<DoubleDouble>(a, b) : productIn<Wide>(a, b);
}

DDMat4 asGiven(const Mat4& a) noexcept {
  DDMat4 m{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = a[i][j];
  return m;
}

/// | adjugate / determinant  -adjugate translation / determinant |
/// | 0                       1                                   |
DDMat4 inverseAffine(const Mat4& a) {
  Dyadic m[3][4], cofactors[3][3], determinant;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) m[i][j] = a[i][j];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cofactors[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    }
  for (std::size_t j = 0; j < 3; ++j) determinant = determinant + cofactors[0][j] * m[0][j];
  if (determinant.sign() == 0) throw CameraError("model", "has no inverse: its axes lie in a plane");
  const Wide divisor = determinant.rounded();
  DDMat4 inverse{};
  for (std::size_t i = 0; i < 3; ++i) {
    Dyadic translation;
    for (std::size_t j = 0; j < 3; ++j) {
      inverse[i][j] = toDoubleDouble(cofactors[j][i].rounded() / divisor);
      translation = translation - cofactors[j][i] * m[j][3];
    }
    inverse[i][3] = toDoubleDouble(translation.rounded() / divisor);
  }
  inverse[3][3] = 1;
  return inverse;
}

/// The matrices before they are rounded.
namespace fine {
DDMat4 viewFromWorld(const PoseParts& pose, const Convention& c) noexcept {
  return toViewAxes(axesFromWorld(pose), c.view);
}
DDMat4 worldFromView(const PoseParts& pose, const Convention& c) noexcept {
  return fromViewAxes(worldFromAxes(pose), c.view);
}
DDMat4 clipFromView(const ProjectionParts& p, const Convention& c) {
  return fromViewAxes(lensMatrix(ndcLens(p, c)), c.view);
}
DDMat4 viewFromClip(const ProjectionParts& p, const Convention& c) {
  return toViewAxes(inverseLensMatrix(ndcLens(p, c)), c.view);
}
DDMat4 clipFromWorld(const PoseParts& pose, const ProjectionParts& p, const Convention& c) {
  return product(lensMatrix(ndcLens(p, c)), axesFromWorld(pose));
}
DDMat4 worldFromClip(const PoseParts& pose, const ProjectionParts& p, const Convention& c) {
  return product(worldFromAxes(pose), inverseLensMatrix(ndcLens(p, c)));
}
DDMat4 screenFromWorld(const PoseParts& pose, const ProjectionParts& p, const Viewport& v, const Convention& c) {
  return product(lensMatrix(screenLens(p, v, c)), axesFromWorld(pose));
}
DDMat4 worldFromScreen(const PoseParts& pose, const ProjectionParts& p, const Viewport& v, const Convention& c) {
  return product(worldFromAxes(pose), inverseLensMatrix(screenLens(p, v, c)));
}
}  // namespace fine

/// Whether what is a column for column vectors lies together in memory.
bool areColumnsTogether(const Convention& c) noexcept {
  return (c.vectors == Vectors::row) != (c.storage == Storage::columnMajor);
}

/// In the order in which the convention keeps a matrix in memory: row vectors and columns first are one transposition
/// each.
template <class Number, class Matrix>
StoredMatrix<Number> stored(const Matrix& m, const Convention& c) noexcept {
  const bool byColumns = areColumnsTogether(c);
  StoredMatrix<Number> flat{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) flat[4 * i + j] = entry<Number>(byColumns ? m[j][i] : m[i][j]);
  return flat;
}

template <class Numbers>
Mat4 unstored(const Numbers& flat, const Convention& c) noexcept {
  const bool byColumns = areColumnsTogether(c);
  Mat4 m;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) (byColumns ? m[j][i] : m[i][j]) = flat[4 * i + j];
  return m;
}

}  // namespace

Mat4 viewFromWorld(const Pose& pose, const Convention& c) noexcept {
  return rounded(fine::viewFromWorld(parts(pose), c));
}

Mat4 worldFromView(const Pose& pose, const Convention& c) noexcept {
  return rounded(fine::worldFromView(parts(pose), c));
}

Mat4 viewFromLocal(const Pose& pose, const Mat4& model, const Convention& c) noexcept {
  return rounded(toViewAxes(product(axesFromWorld(parts(pose)), asGiven(model)), c.view));
}

Mat4 localFromView(const Pose& pose, const Mat4& model, const Convention& c) {
  return rounded(fromViewAxes(product(inverseAffine(model), worldFromAxes(parts(pose))), c.view));
}

Mat4 clipFromLocal(const Pose& pose, const Projection& p, const Mat4& model, const Convention& c) {
  return rounded(product(lensMatrix(ndcLens(parts(p), c)), product(axesFromWorld(parts(pose)), asGiven(model))));
}

Mat4 localFromClip(const Pose& pose, const Projection& p, const Mat4& model, const Convention& c) {
  return rounded(
      product(product(inverseAffine(model), worldFromAxes(parts(pose))), inverseLensMatrix(ndcLens(parts(p), c))));
}

Mat4 screenFromLocal(const Pose& pose, const Projection& p, const Viewport& v, const Mat4& model, const Convention& c) {
  return rounded(product(lensMatrix(screenLens(parts(p), v, c)), product(axesFromWorld(parts(pose)), asGiven(model))));
}

Mat4 localFromScreen(const Pose& pose, const Projection& p, const Viewport& v, const Mat4& model, const Convention& c) {
  return rounded(product(product(inverseAffine(model), worldFromAxes(parts(pose))),
                         inverseLensMatrix(screenLens(parts(p), v, c))));
}

Mat4 clipFromView(const Projection& p, const Convention& c) { return rounded(fine::clipFromView(parts(p), c)); }

Mat4 viewFromClip(const Projection& p, const Convention& c) { return rounded(fine::viewFromClip(parts(p), c)); }

Mat4 clipFromWorld(const Pose& pose, const Projection& p, const Convention& c) {
  return rounded(fine::clipFromWorld(parts(pose), parts(p), c));
}

Mat4 worldFromClip(const Pose& pose, const Projection& p, const Convention& c) {
  return rounded(fine::worldFromClip(parts(pose), parts(p), c));
}

Mat4 screenFromView(const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(fromViewAxes(lensMatrix(screenLens(parts(p), v, c)), c.view));
}

Mat4 viewFromScreen(const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(toViewAxes(inverseLensMatrix(screenLens(parts(p), v, c)), c.view));
}

Mat4 screenFromWorld(const Pose& pose, const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(fine::screenFromWorld(parts(pose), parts(p), v, c));
}

Mat4 worldFromScreen(const Pose& pose, const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(fine::worldFromScreen(parts(pose), parts(p), v, c));
}

namespace {

/// screen = offset + scale * ndc, for each of x, y, z.
struct ViewportMap {
  std::array<DoubleDouble, 3> offset, scale;
};

ViewportMap viewportMap(const Viewport& v, const Convention& c) noexcept {
  const ScreenCorner corner = screenCorner(v);
  const DoubleDouble halfWidth = v.width / 2;
  const DoubleDouble halfHeight = v.height / 2;
  const bool flipped = (v.origin == Origin::topLeft) == (c.ndcY == NdcY::up);
  const DoubleDouble range = twoDiff(v.depthSecond, v.depthFirst);
  const bool halved = c.ndcZ == NdcZ::minusOneToOne;
  const DoubleDouble first = v.depthFirst;
  return {{corner.x + halfWidth, corner.y + halfHeight, halved ? first + timesPowerOfTwo(range, 0.5) : first},
          {halfWidth, flipped ? -halfHeight : halfHeight, halved ? timesPowerOfTwo(range, 0.5) : range}};
}

}  // namespace

Mat4 screenFromNdc(const Viewport& v, const Convention& c) noexcept {
  const ViewportMap map = viewportMap(v, c);
  DDMat4 m{};
  for (std::size_t i = 0; i < 3; ++i) {
    m[i][i] = map.scale[i];
    m[i][3] = map.offset[i];
  }
  m[3][3] = 1;
  return rounded(m);
}

Mat4 ndcFromScreen(const Viewport& v, const Convention& c) noexcept {
  const ViewportMap map = viewportMap(v, c);
  DDMat4 m{};
  for (std::size_t i = 0; i < 3; ++i) {
    m[i][i] = DoubleDouble(1) / map.scale[i];
    m[i][3] = -map.offset[i] / map.scale[i];
  }
  m[3][3] = 1;
  return rounded(m);
}

Pose relativeToEye(const Pose& pose) {
  PoseParts relative = parts(pose);
  relative.eye = relative.exact.origin = {};
  relative.exact.translation = {};
  relative.residual = {};
  return made(relative);
}

Mat4 laidOut(const Mat4& matrix, const Convention& c) noexcept {
  return c.vectors == Vectors::row ? transposed(matrix) : matrix;
}

std::array<double, 16> inStorageOrder(const Mat4& matrix, const Convention& c) noexcept {
  return stored<double>(matrix.m, c);
}

Mat4 fromStorageOrder(std::span<const double, 16> numbers, const Convention& c) noexcept {
  return unstored(numbers, c);
}
Mat4 fromStorageOrder(std::span<const float, 16> numbers, const Convention& c) noexcept { return unstored(numbers, c); }

template <class Number>
StoredMatrix<Number> viewFromWorld(const Camera& camera) noexcept {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::viewFromWorld(c.pose, c.convention), c.convention);
}
template StoredMatrix<float> viewFromWorld<float>(const Camera&) noexcept;
template StoredMatrix<double> viewFromWorld<double>(const Camera&) noexcept;

template <class Number>
StoredMatrix<Number> worldFromView(const Camera& camera) noexcept {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::worldFromView(c.pose, c.convention), c.convention);
}
template StoredMatrix<float> worldFromView<float>(const Camera&) noexcept;
template StoredMatrix<double> worldFromView<double>(const Camera&) noexcept;

template <class Number>
StoredMatrix<Number> clipFromView(const Camera& camera) {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::clipFromView(c.projection, c.convention), c.convention);
}
template StoredMatrix<float> clipFromView<float>(const Camera&);
template StoredMatrix<double> clipFromView<double>(const Camera&);

template <class Number>
StoredMatrix<Number> viewFromClip(const Camera& camera) {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::viewFromClip(c.projection, c.convention), c.convention);
}
template StoredMatrix<float> viewFromClip<float>(const Camera&);
template StoredMatrix<double> viewFromClip<double>(const Camera&);

template <class Number>
StoredMatrix<Number> clipFromWorld(const Camera& camera) {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::clipFromWorld(c.pose, c.projection, c.convention), c.convention);
}
template StoredMatrix<float> clipFromWorld<float>(const Camera&);
template StoredMatrix<double> clipFromWorld<double>(const Camera&);

template <class Number>
StoredMatrix<Number> worldFromClip(const Camera& camera) {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::worldFromClip(c.pose, c.projection, c.convention), c.convention);
}
template StoredMatrix<float> worldFromClip<float>(const Camera&);
template StoredMatrix<double> worldFromClip<double>(const Camera&);

template <class Number>
StoredMatrix<Number> screenFromWorld(const Camera& camera) {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::screenFromWorld(c.pose, c.projection, c.viewport, c.convention), c.convention);
}
template StoredMatrix<float> screenFromWorld<float>(const Camera&);
template StoredMatrix<double> screenFromWorld<double>(const Camera&);

template <class Number>
StoredMatrix<Number> worldFromScreen(const Camera& camera) {
  const CameraParts& c = parts(camera);
  return stored<Number>(fine::worldFromScreen(c.pose, c.projection, c.viewport, c.convention), c.convention);
}
template StoredMatrix<float> worldFromScreen<float>(const Camera&);
template StoredMatrix<double> worldFromScreen<double>(const Camera&);

}  // namespace viewproj
