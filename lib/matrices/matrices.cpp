#include "viewproj/matrices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "camera/camera.hpp"
#include "camera/convention.hpp"
#include "camera/lens.hpp"
#include "camera/require.hpp"
#include "camera/screen_map.hpp"
#include "projection/clip_point.hpp"

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

/// A point's or a direction's distances along right, up and forward, to 2^-90 of themselves however they cancel.
DDVec3 alongAxes(const PoseParts& pose, const Vec4& p) noexcept {
  constexpr double kKept = 0x1p-8;  // of the terms' 2^-98
  const AxisPoint<DoubleDouble> near = toAxes(pose, p);
  const double size = std::fabs(p.x - p.w * pose.eye.x) + std::fabs(p.y - p.w * pose.eye.y) +
                      std::fabs(p.z - p.w * pose.eye.z) + std::fabs(pose.residual.x.hi) +
                      std::fabs(pose.residual.y.hi) + std::fabs(pose.residual.z.hi);
  if (std::min({std::fabs(near.right.hi), std::fabs(near.up.hi), std::fabs(near.forward.hi)}) > kKept * size)
    return {near.right, near.up, near.forward};
  const AxisDistances exact = exactDistances(pose, p);
  return {toDoubleDouble(exact.right), toDoubleDouble(exact.up), toDoubleDouble(exact.forward)};
}

/// | right    that of the world's origin |
/// | up       ...                        |
/// | forward  ...                        |
/// | 0        1                          |
DDMat4 axesFromWorld(const PoseParts& p) noexcept {
  const Axes& r = p.rows;
  const DDVec3 origin = alongAxes(p, {0, 0, 0, 1});
  return {{{r.right.x, r.right.y, r.right.z, origin.x},
           {r.up.x, r.up.y, r.up.z, origin.y},
           {r.forward.x, r.forward.y, r.forward.z, origin.z},
           {0, 0, 0, 1}}};
}

/// Each column of the model's, as the axes see it.
DDMat4 axesFromModel(const PoseParts& p, const Mat4& model) noexcept {
  DDMat4 m{};
  for (std::size_t j = 0; j < 4; ++j) {
    const DDVec3 column = alongAxes(p, {model[0][j], model[1][j], model[2][j], j == 3 ? 1.0 : 0.0});
    for (std::size_t i = 0; i < 3; ++i) m[i][j] = column[i];
  }
  m[3][3] = 1;
  return m;
}

/// | right up forward eye |
/// | 0     0  0       1   |
DDMat4 worldFromAxes(const PoseParts& p) noexcept {
  const Axes& c = p.columns;
  const DDVec3 eye = unroundedEye(p);
  DDMat4 m{};
  for (std::size_t i = 0; i < 3; ++i) m[i] = {c.right[i], c.up[i], c.forward[i], eye[i]};
  m[3][3] = 1;
  return m;
}

/// | adjugate right / determinant  ...  adjugate (eye - translation) / determinant |
/// | 0                             ...  1                                          |
DDMat4 modelFromAxes(const DDMat4& worldFromAxes, const Mat4& model) {
  constexpr double kLargestEntry = 1e100;
  std::array<Vector3<Dyadic<1>>, 4> column;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) column[j][i] = model[i][j];
  const auto& [x, y, z, translation] = column;
  const std::array<Vector3<Dyadic<2>>, 3> adjugate = {crossOf(y, z), crossOf(z, x), crossOf(x, y)};
  const Wide determinant = dot(adjugate[0], x).rounded();
  if (determinant.sign() == 0) throw CameraError("model", "has no inverse: its axes lie in a plane");
  DDMat4 m{};
  for (std::size_t j = 0; j < 4; ++j) {
    Vector3<Dyadic<1>> v;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] = Dyadic<1>(worldFromAxes[i][j].hi) + Dyadic<1>(worldFromAxes[i][j].lo);
      if (j == 3) v[i] = v[i] - translation[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      m[i][j] = toDoubleDouble(dot(adjugate[i], v).rounded() / determinant);
      if (!(std::fabs(m[i][j].hi) < kLargestEntry))
        throw CameraError("model", "has an inverse with entries beyond 1e100");
    }
  }
  m[3][3] = 1;
  return m;
}

DDMat4 product(const DDMat4& a, const DDMat4& b) noexcept {
  DDMat4 result{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        if (a[i][k].hi != 0 && b[k][j].hi != 0) result[i][j] += a[i][k] * b[k][j];
  return result;
}

constexpr DDMat4 kIdentity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

void requireModel(const Mat4& m) {
  for (const auto& row : m.m)
    for (const double entry : row)
      if (!isInDomain(entry))
        throw CameraError("model", "has an entry that is neither 0 nor between 1e-90 and 1e90 in magnitude");
  if (!(m[3] == std::array<double, 4>{0, 0, 0, 1})) throw CameraError("model", "has a last row that is not 0 0 0 1");
}

/// What a matrix is made of; of parts that it does not need, null.
struct Source {
  const Convention& convention;
  const PoseParts* pose = nullptr;
  const ProjectionParts* projection = nullptr;
  const Viewport* viewport = nullptr;
  const Mat4* model = nullptr;
};

Lens lensOf(const Source& s, Space space) {
  return space == Space::screen ? screenLens(*s.projection, *s.viewport, s.convention)
                                : ndcLens(*s.projection, s.convention);
}

/// From a space to distances along right, up and forward, and 1.
DDMat4 axesFrom(const Source& s, Space space) {
  if (space == Space::model) return axesFromModel(*s.pose, *s.model);
  if (space == Space::world) return axesFromWorld(*s.pose);
  if (space == Space::view) return fromViewAxes(kIdentity, s.convention.view);
  return inverseLensMatrix(lensOf(s, space));
}

DDMat4 fromAxes(const Source& s, Space space) {
  if (space == Space::model) return modelFromAxes(worldFromAxes(*s.pose), *s.model);
  if (space == Space::world) return worldFromAxes(*s.pose);
  if (space == Space::view) return toViewAxes(kIdentity, s.convention.view);
  return lensMatrix(lensOf(s, space));
}

DDMat4 between(const Source& s, Space to, Space from) {
  if (s.model) requireModel(*s.model);
  return product(fromAxes(s, to), axesFrom(s, from));
}

/// Whether what is a column for column vectors lies together in memory.
bool areColumnsTogether(const Convention& c) noexcept {
  return (c.vectors == Vectors::row) != (c.storage == Storage::columnMajor);
}

/// In the order in which the convention keeps a matrix in memory: row vectors and columns first are one transposition
/// each.
template <class Number, class Matrix>
std::array<Number, 16> stored(const Matrix& m, const Convention& c) noexcept {
  const bool byColumns = areColumnsTogether(c);
  std::array<Number, 16> flat{};
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

DDMat4 fromNdc(const Viewport& v, const Convention& c) noexcept {
  const ViewportMap map = viewportMap(v, c);
  DDMat4 m = kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    m[i][i] = map.scale[i];
    m[i][3] = map.offset[i];
  }
  return m;
}

DDMat4 toNdc(const Viewport& v, const Convention& c) noexcept {
  const ViewportMap map = viewportMap(v, c);
  DDMat4 m = kIdentity;
  for (std::size_t i = 0; i < 3; ++i) {
    m[i][i] = DoubleDouble(1) / map.scale[i];
    m[i][3] = -map.offset[i] / map.scale[i];
  }
  return m;
}

/// A matrix of a camera, and of a model where there is one.
DDMat4 matrixOf(const Camera& camera, Space to, Space from, const Mat4* model) {
  const CameraParts& c = parts(camera);
  const auto isOfScene = [](Space s) { return s == Space::model || s == Space::world; };
  const auto isClip = [](Space s) { return s == Space::clip || s == Space::ndc; };
  if (!model && (to == Space::model || from == Space::model)) throw CameraError("model", "is missing");
  if (to == from || (isClip(to) && isClip(from))) return kIdentity;
  if (to == Space::screen && isClip(from)) return fromNdc(c.viewport, c.convention);
  if (from == Space::screen && isClip(to)) return toNdc(c.viewport, c.convention);
  if (model) requireModel(*model);
  if (isOfScene(to) && isOfScene(from)) {
    if (to == Space::model) return modelFromAxes(kIdentity, *model);
    DDMat4 m = kIdentity;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = (*model)[i][j];
    return m;
  }
  return between({c.convention, &c.pose, &c.projection, &c.viewport, model}, to, from);
}

}  // namespace

Mat4 matrix(const Camera& camera, Space to, Space from) { return rounded(matrixOf(camera, to, from, nullptr)); }

Mat4 matrix(const Camera& camera, Space to, Space from, const Mat4& worldFromModel) {
  return rounded(matrixOf(camera, to, from, &worldFromModel));
}

template <class Number>
std::array<Number, 16> storedMatrix(const Camera& camera, Space to, Space from) {
  return stored<Number>(matrixOf(camera, to, from, nullptr), camera.convention());
}
template std::array<float, 16> storedMatrix<float>(const Camera&, Space, Space);
template std::array<double, 16> storedMatrix<double>(const Camera&, Space, Space);

Mat4 viewFromWorld(const Pose& pose, const Convention& c) noexcept {
  // cppcheck-suppress throwInNoexceptFunction  // a model alone can be at fault
  return rounded(between({c, &parts(pose)}, Space::view, Space::world));
}

Mat4 worldFromView(const Pose& pose, const Convention& c) noexcept {
  // cppcheck-suppress throwInNoexceptFunction  // as above
  return rounded(between({c, &parts(pose)}, Space::world, Space::view));
}

Mat4 clipFromView(const Projection& p, const Convention& c) {
  return rounded(between({c, nullptr, &parts(p)}, Space::clip, Space::view));
}

Mat4 viewFromClip(const Projection& p, const Convention& c) {
  return rounded(between({c, nullptr, &parts(p)}, Space::view, Space::clip));
}

Mat4 clipFromWorld(const Pose& pose, const Projection& p, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p)}, Space::clip, Space::world));
}

Mat4 worldFromClip(const Pose& pose, const Projection& p, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p)}, Space::world, Space::clip));
}

Mat4 screenFromView(const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(between({c, nullptr, &parts(p), &v}, Space::screen, Space::view));
}

Mat4 viewFromScreen(const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(between({c, nullptr, &parts(p), &v}, Space::view, Space::screen));
}

Mat4 screenFromWorld(const Pose& pose, const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p), &v}, Space::screen, Space::world));
}

Mat4 worldFromScreen(const Pose& pose, const Projection& p, const Viewport& v, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p), &v}, Space::world, Space::screen));
}

Mat4 viewFromLocal(const Pose& pose, const Mat4& m, const Convention& c) {
  return rounded(between({c, &parts(pose), nullptr, nullptr, &m}, Space::view, Space::model));
}

Mat4 localFromView(const Pose& pose, const Mat4& m, const Convention& c) {
  return rounded(between({c, &parts(pose), nullptr, nullptr, &m}, Space::model, Space::view));
}

Mat4 clipFromLocal(const Pose& pose, const Projection& p, const Mat4& m, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p), nullptr, &m}, Space::clip, Space::model));
}

Mat4 localFromClip(const Pose& pose, const Projection& p, const Mat4& m, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p), nullptr, &m}, Space::model, Space::clip));
}

Mat4 screenFromLocal(const Pose& pose, const Projection& p, const Viewport& v, const Mat4& m, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p), &v, &m}, Space::screen, Space::model));
}

Mat4 localFromScreen(const Pose& pose, const Projection& p, const Viewport& v, const Mat4& m, const Convention& c) {
  return rounded(between({c, &parts(pose), &parts(p), &v, &m}, Space::model, Space::screen));
}

Mat4 screenFromNdc(const Viewport& v, const Convention& c) noexcept { return rounded(fromNdc(v, c)); }
Mat4 ndcFromScreen(const Viewport& v, const Convention& c) noexcept { return rounded(toNdc(v, c)); }

Pose relativeToEye(const Pose& pose) {
  PoseParts relative = parts(pose);
  ExactPose exact = *relative.exact;
  relative.eye = exact.origin = exact.translation = {};
  relative.residual = {};
  relative.exact = std::make_shared<const ExactPose>(exact);
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

}  // namespace viewproj
