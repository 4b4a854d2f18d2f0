#include "reference/scene.hpp"

#include <sstream>
#include <stdexcept>

#include "internals.hpp"

namespace reference {

using namespace viewproj;
using namespace viewproj::detail;

namespace {

Pose buildPose(const Scene& s) {
  const Handedness world = s.convention.world;
  switch (s.poseKind) {
    case PoseKind::target:
      return lookAt(s.position, s.target, s.up, world);
    case PoseKind::direction:
      return lookAlong(s.position, s.target, s.up, world);
    case PoseKind::rotation:
      return poseFromRotation(s.position, s.rotation, s.axes);
    case PoseKind::worldFromCamera:
      return poseFromWorldFromCamera(s.matrix, s.axes);
    case PoseKind::cameraFromWorld:
      return poseFromCameraFromWorld(s.matrix, s.axes);
  }
  throw std::logic_error("a pose of no kind");
}

Projection buildLens(const Scene& s) {
  const Aspect aspect = s.viewport;
  switch (s.lensKind) {
    case LensKind::fovY:
      return perspective(s.fov, aspect, s.near, s.far);
    case LensKind::fovX:
      return perspective(s.fov, aspect, s.near, s.far, Fov::horizontal);
    case LensKind::fovDiagonal:
      return perspective(s.fov, aspect, s.near, s.far, Fov::diagonal);
    case LensKind::nearSize:
      return frustum(-s.right / 2, s.right / 2, -s.top / 2, s.top / 2, s.near, s.far);
    case LensKind::sensorBoth:
      return perspectiveFocalLength(s.focalLength, {s.sensorWidth, s.sensorHeight}, 1, s.near, s.far);
    case LensKind::sensorWidth:
      return perspectiveFocalLength(s.focalLength, {.width = s.sensorWidth}, aspect, s.near, s.far);
    case LensKind::sensorHeight:
      return perspectiveFocalLength(s.focalLength, {.height = s.sensorHeight}, aspect, s.near, s.far);
    case LensKind::sensorDiagonal:
      return perspectiveFocalLength(s.focalLength, {.diagonal = s.sensorWidth}, aspect, s.near, s.far);
    case LensKind::frustum:
      return frustum(s.left, s.right, s.bottom, s.top, s.near, s.far);
    case LensKind::intrinsics:
      return intrinsics(s.fx, s.fy, s.cx, s.cy, s.viewport, s.near, s.far);
    case LensKind::orthographic:
      return orthographic(s.left, s.right, s.bottom, s.top, s.near, s.far);
  }
  throw std::logic_error("a lens of no kind");
}

Real3 rotate(const Quaternion& q, const Real3& v) {
  // q v q* / |q|^2 = v + 2 w (a x v) + 2 a x (a x v), all over |q|^2 with a the vector part
  const Real3 a{q.x, q.y, q.z};
  const Real w = q.w;
  const Real norm = dot(a, a) + w * w;
  const Real3 av = cross(a, v);
  return v + (av * w + cross(a, av)) * (Real(2) / norm);
}

struct Columns {
  Real3 x, y, z;
};

/// From camera x, y, z to right, up, forward.
struct Named {
  Real3 right, up, forward;
};
Named named(const Columns& c, CameraAxes axes) {
  switch (axes) {
    case CameraAxes::RUB:
      return {c.x, c.y, c.z * Real(-1)};
    case CameraAxes::RUF:
      return {c.x, c.y, c.z};
    case CameraAxes::RDF:
      return {c.x, c.y * Real(-1), c.z};
    case CameraAxes::FRU:
      return {c.y, c.z, c.x};
    case CameraAxes::FLU:
      return {c.y * Real(-1), c.z, c.x};
    case CameraAxes::FRD:
      return {c.y, c.z * Real(-1), c.x};
  }
  return {};
}

TruePose truePose(const Scene& s) {
  TruePose p;
  if (s.poseKind == PoseKind::target || s.poseKind == PoseKind::direction) {
    p.eye = toReal(s.position);
    p.forward = unit(s.poseKind == PoseKind::target ? toReal(s.target) - p.eye : toReal(s.target));
    const bool rightHanded = s.convention.world == Handedness::right;
    p.right = unit(rightHanded ? cross(p.forward, toReal(s.up)) : cross(toReal(s.up), p.forward));
    p.up = rightHanded ? cross(p.right, p.forward) : cross(p.forward, p.right);
  } else if (s.poseKind == PoseKind::rotation) {
    p.eye = toReal(s.position);
    const Named n =
        named({rotate(s.rotation, {1, 0, 0}), rotate(s.rotation, {0, 1, 0}), rotate(s.rotation, {0, 0, 1})}, s.axes);
    p.right = n.right;
    p.up = n.up;
    p.forward = n.forward;
  } else {
    const auto column = [&](std::size_t j) { return Real3{s.matrix[0][j], s.matrix[1][j], s.matrix[2][j]}; };
    const Columns m{column(0), column(1), column(2)};
    const Real determinant = dot(m.x, cross(m.y, m.z));
    const Real k = Real(1) / determinant;
    const Columns inverseRows{cross(m.y, m.z) * k, cross(m.z, m.x) * k, cross(m.x, m.y) * k};
    const auto transposed = [](const Columns& c) {
      return Columns{{c.x[0], c.y[0], c.z[0]}, {c.x[1], c.y[1], c.z[1]}, {c.x[2], c.y[2], c.z[2]}};
    };
    const bool toWorld = s.poseKind == PoseKind::worldFromCamera;
    const Named rows = named(toWorld ? inverseRows : transposed(m), s.axes);
    const Named columns = named(toWorld ? m : transposed(inverseRows), s.axes);
    const Real3 t = column(3);
    p.eye = toWorld ? t : Real3{-dot(inverseRows.x, t), -dot(inverseRows.y, t), -dot(inverseRows.z, t)};
    p.right = rows.right;
    p.up = rows.up;
    p.forward = rows.forward;
    p.rightColumn = columns.right;
    p.upColumn = columns.up;
    p.forwardColumn = columns.forward;
    return p;
  }
  p.rightColumn = p.right;
  p.upColumn = p.up;
  p.forwardColumn = p.forward;
  return p;
}

TrueLens trueLens(const Scene& s) {
  const Viewport& v = s.viewport;
  const Real aspect = Real(v.width) / Real(v.height);
  const auto symmetric = [](const Real& w, const Real& h) { return TrueLens{false, -w, w, -h, h}; };
  const Real tangent = tanDegrees(Real(s.fov) / Real(2));
  switch (s.lensKind) {
    case LensKind::fovY:
      return symmetric(tangent * aspect, tangent);
    case LensKind::fovX:
      return symmetric(tangent, tangent / aspect);
    case LensKind::fovDiagonal: {
      const Real diagonal = sqrt(Real(v.width) * Real(v.width) + Real(v.height) * Real(v.height));
      return symmetric(tangent * Real(v.width) / diagonal, tangent * Real(v.height) / diagonal);
    }
    case LensKind::nearSize:
      return symmetric(Real(s.right) / Real(s.near) / Real(2), Real(s.top) / Real(s.near) / Real(2));
    case LensKind::sensorBoth:
    case LensKind::sensorWidth:
    case LensKind::sensorHeight:
    case LensKind::sensorDiagonal: {
      Real w = Real(s.sensorWidth), h = Real(s.sensorHeight);
      if (s.lensKind == LensKind::sensorDiagonal) {
        h = w / sqrt(aspect * aspect + Real(1));
        w = h * aspect;
      }
      if (s.lensKind == LensKind::sensorWidth) h = w / aspect;
      if (s.lensKind == LensKind::sensorHeight) w = h * aspect;
      return symmetric(w / Real(s.focalLength) / Real(2), h / Real(s.focalLength) / Real(2));
    }
    case LensKind::frustum:
      return {false, Real(s.left) / Real(s.near), Real(s.right) / Real(s.near), Real(s.bottom) / Real(s.near),
              Real(s.top) / Real(s.near)};
    case LensKind::intrinsics: {
      // From the principal point, counted from the picture's corner.
      const Real half = Real(0.5) - Real(v.pixelCenter);
      const Real cx = Real(s.cx) - Real(v.x) + half;
      const Real cy = Real(s.cy) - Real(v.y) + half;
      const Real below = v.origin == Origin::topLeft ? Real(v.height) - cy : cy;
      return {false, -cx / Real(s.fx), (Real(v.width) - cx) / Real(s.fx), -below / Real(s.fy),
              (Real(v.height) - below) / Real(s.fy)};
    }
    case LensKind::orthographic:
      return {true, s.left, s.right, s.bottom, s.top};
  }
  return {};
}

}  // namespace

Camera build(const Scene& s) {
  const Camera whole = makeCamera(buildPose(s), shifted(buildLens(s), s.shiftX, s.shiftY), s.viewport, s.convention);
  return s.hasCrop ? cropped(whole, s.crop) : whole;
}

Truth::Truth(const Scene& s) : scene(s), pose(truePose(s)), lens(trueLens(s)) {}

Truth::View Truth::view(const Real3& point) const {
  const Real3 d = point - pose.eye;
  return {dot(pose.right, d), dot(pose.up, d), dot(pose.forward, d)};
}

Truth::Screen Truth::screen(const View& v) const {
  const Viewport& port = scene.viewport;
  const Real h = lens.orthographic ? v.right : v.right / v.forward;
  const Real u = lens.orthographic ? v.up : v.up / v.forward;
  const Real ndcX = (Real(2) * h - lens.right - lens.left) / (lens.right - lens.left);
  const Real ndcY = (Real(2) * u - lens.top - lens.bottom) / (lens.top - lens.bottom);
  const bool down = port.origin == Origin::topLeft;
  const Real half = Real(port.pixelCenter) - Real(0.5);
  const Real W = port.width, H = port.height;
  Screen s;
  s.x = (ndcX + Real(1)) * W / Real(2) + Real(scene.shiftX) * W / Real(2) + half;
  s.y = (down ? Real(1) - ndcY : ndcY + Real(1)) * H / Real(2) +
        Real(down ? -scene.shiftY : scene.shiftY) * H / Real(2) + half;
  s.x = s.x + Real(port.x) - Real(scene.hasCrop ? scene.crop.x : 0);
  s.y = s.y + Real(port.y) - Real(scene.hasCrop ? scene.crop.y : 0);
  // 0 at near, 1 at far.
  const Real n = scene.near, f = scene.far, w = v.forward;
  Real z;
  if (lens.orthographic)
    z = (w - n) / (f - n);
  else if (std::isinf(scene.far))
    z = (w - n) / w;
  else
    z = f * (w - n) / (w * (f - n));
  const Real first = scene.convention.reverseZ ? port.depthSecond : port.depthFirst;
  const Real second = scene.convention.reverseZ ? port.depthFirst : port.depthSecond;
  s.depth = first + (second - first) * z;
  return s;
}

Truth::Window Truth::window(const Real& x, const Real& y) const {
  const Viewport& port = scene.viewport;
  const bool down = port.origin == Origin::topLeft;
  const Real half = Real(port.pixelCenter) - Real(0.5);
  const Real W = port.width, H = port.height;
  Real fromLeft = x - half - Real(scene.shiftX) * W / Real(2);
  Real fromStart = y - half - Real(down ? -scene.shiftY : scene.shiftY) * H / Real(2);
  fromLeft = fromLeft - Real(port.x) + Real(scene.hasCrop ? scene.crop.x : 0);
  fromStart = fromStart - Real(port.y) + Real(scene.hasCrop ? scene.crop.y : 0);
  const Real right = lens.left + (lens.right - lens.left) * fromLeft / W;
  const Real up = down ? lens.top - (lens.top - lens.bottom) * fromStart / H
                       : lens.bottom + (lens.top - lens.bottom) * fromStart / H;
  return {right, up};
}

Real3 Truth::direction(const Window& w) const {
  if (lens.orthographic) return pose.forwardColumn;
  return pose.forwardColumn + pose.rightColumn * w.right + pose.upColumn * w.up;
}

Real3 Truth::pointAt(const Window& w, const Real& distance) const {
  const Real spread = lens.orthographic ? Real(1) : distance;
  return pose.eye + pose.forwardColumn * distance + pose.rightColumn * (w.right * spread) +
         pose.upColumn * (w.up * spread);
}

Real Truth::distanceAt(const Real& depth) const {
  const Viewport& port = scene.viewport;
  const Real first = scene.convention.reverseZ ? port.depthSecond : port.depthFirst;
  const Real second = scene.convention.reverseZ ? port.depthFirst : port.depthSecond;
  const Real z = (depth - first) / (second - first);
  const Real n = scene.near, f = scene.far;
  if (lens.orthographic) return n + z * (f - n);
  if (std::isinf(scene.far)) return n / (Real(1) - z);
  return n * f / (f - z * (f - n));
}

std::array<TruePlane, 6> Truth::planes(const Viewport& v) const {
  const Real half = Real(v.pixelCenter) - Real(0.5), x = Real(v.x) + half, y = Real(v.y) + half;
  const Window start = window(x, y), end = window(x + Real(v.width), y + Real(v.height));
  const bool down = v.origin == Origin::topLeft;
  const auto plane = [&](const Real3& axis, const Real& inward, const Real& edge, bool isOfWindow) {
    // Inside: inward * (axis . d - edge * W) >= 0, d from the eye; W is 1 but for a window in perspective.
    const bool isThroughEye = isOfWindow && !lens.orthographic;
    const Real3 normal = (isThroughEye ? axis - pose.forward * edge : axis) * inward;
    const Real size = length(normal);
    const Real offset = -dot(normal, pose.eye) - (isThroughEye ? Real(0) : inward * edge);
    return TruePlane{normal * (Real(1) / size), offset / size};
  };
  return {plane(pose.right, 1, start.right, true),
          plane(pose.right, -1, end.right, true),
          plane(pose.up, 1, down ? end.up : start.up, true),
          plane(pose.up, -1, down ? start.up : end.up, true),
          plane(pose.forward, 1, scene.near, false),
          plane(pose.forward, -1, std::isinf(scene.far) ? Real(0) : Real(scene.far), false)};
}

Scene randomScene(Random& r, double reach) {
  Scene s;
  const auto presets = conventionPresets();
  s.convention = presets[static_cast<std::size_t>(r.uniform(0, double(presets.size())))].convention;
  if (r.chance(0.3)) s.convention.reverseZ = !s.convention.reverseZ;

  Viewport& v = s.viewport;
  v = {std::floor(r.logUniform(1, 8000)), std::floor(r.logUniform(1, 8000))};
  if (r.chance(0.3)) v.x = std::floor(r.uniform(-500, 500)), v.y = std::floor(r.uniform(-500, 500));
  if (r.chance(0.5)) v.origin = Origin::bottomLeft;
  if (r.chance(0.3)) v.pixelCenter = 0;
  if (r.chance(0.3)) v.depthFirst = r.uniform(-1, 1), v.depthSecond = v.depthFirst + r.sign() * r.logUniform(1e-3, 1e7);

  s.lensKind = r.oneOf(kLensKinds);
  s.near = r.logUniform(1e-6, 1e6);
  s.far = r.chance(0.3) ? kInfiniteFar : s.near * (1 + r.logUniform(1e-9, 1e15));
  s.fov = r.uniform(1, 170);
  s.sensorWidth = r.logUniform(0.1, 100), s.sensorHeight = r.logUniform(0.1, 100), s.focalLength = r.logUniform(1, 100);
  s.left = r.uniform(-2, 1) * s.near, s.right = s.left + r.logUniform(0.01, 4) * s.near;
  s.bottom = r.uniform(-2, 1) * s.near, s.top = s.bottom + r.logUniform(0.01, 4) * s.near;
  if (s.lensKind == LensKind::nearSize)
    s.right = r.logUniform(0.01, 4) * s.near, s.top = r.logUniform(0.01, 4) * s.near;
  s.fx = r.logUniform(0.3, 10) * v.width, s.fy = r.logUniform(0.3, 10) * v.height;
  s.cx = v.x + r.uniform(0, 1) * v.width, s.cy = v.y + r.uniform(0, 1) * v.height;
  if (s.lensKind == LensKind::orthographic) {
    const double size = r.logUniform(1e-3, 1e6);
    s.left = r.uniform(-2, 1) * size, s.right = s.left + size * r.uniform(0.1, 2);
    s.bottom = r.uniform(-2, 1) * size, s.top = s.bottom + size * r.uniform(0.1, 2);
    s.near = r.uniform(-1, 1) * size;
    s.far = s.near + size * r.logUniform(1e-3, 1e6);
  }
  if (r.chance(0.3)) s.shiftX = r.uniform(-2, 2), s.shiftY = r.uniform(-2, 2);
  if (r.chance(0.2)) {
    s.hasCrop = true;
    s.crop = {std::floor(r.uniform(0, v.width)), std::floor(r.uniform(0, v.height)),
              std::floor(r.logUniform(1, v.width + 1)), std::floor(r.logUniform(1, v.height + 1))};
  }

  s.poseKind = r.oneOf(kPoseKinds);
  s.position = r.vector(reach * r.logUniform(1e-3, 1));
  const Vec3 way = r.vector(r.logUniform(1e-3, 1e3) * std::max(1.0, reach));
  s.target =
      s.poseKind == PoseKind::target ? Vec3{s.position.x + way.x, s.position.y + way.y, s.position.z + way.z} : way;
  s.up = r.vector(r.logUniform(1e-3, 1e3));
  s.rotation = {r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(-1, 1)};
  const bool rightHanded = s.convention.world == Handedness::right;
  s.axes = rightHanded ? (r.chance(0.5) ? CameraAxes::RUB : CameraAxes::RDF)
                       : (r.chance(0.5) ? CameraAxes::RUF : CameraAxes::FRU);
  // A nearly orthogonal matrix; mirrored with the axes of the other handedness now and then.
  for (std::size_t j = 0; j < 3; ++j) {
    const Real3 column = rotate(s.rotation, {j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0, j == 2 ? 1.0 : 0.0});
    for (std::size_t i = 0; i < 3; ++i) s.matrix[i][j] = double(column[i]) + r.uniform(-1e-4, 1e-4);
  }
  s.matrix[0][3] = s.position.x, s.matrix[1][3] = s.position.y, s.matrix[2][3] = s.position.z;
  s.matrix[3] = {0, 0, 0, 1};
  const bool isMatrix = s.poseKind == PoseKind::worldFromCamera || s.poseKind == PoseKind::cameraFromWorld;
  if (isMatrix && r.chance(0.3)) {
    for (std::size_t i = 0; i < 3; ++i)
      (s.poseKind == PoseKind::worldFromCamera ? s.matrix[i][0] : s.matrix[0][i]) *= -1;
    s.axes = rightHanded ? CameraAxes::RUF : CameraAxes::RUB;
  }
  return s;
}

Vec3 pointInView(Random& r, const Truth& truth, double overscan) {
  const Scene& s = truth.scene;
  const double w = s.hasCrop ? s.crop.width : s.viewport.width;
  const double h = s.hasCrop ? s.crop.height : s.viewport.height;
  const double x0 = s.hasCrop ? 0 : s.viewport.x, y0 = s.hasCrop ? 0 : s.viewport.y;
  const Truth::Window at =
      truth.window(x0 + w * (0.5 + overscan * r.uniform(-0.5, 0.5)), y0 + h * (0.5 + overscan * r.uniform(-0.5, 0.5)));
  const double far = std::isinf(s.far) ? s.near * 1e6 : s.far;
  const double distance = truth.lens.orthographic ? r.uniform(s.near, far) : r.logUniform(s.near, far);
  const Real3 p = truth.pointAt(at, distance);
  return {double(p[0]), double(p[1]), double(p[2])};
}

std::string describe(const Scene& s) {
  std::ostringstream out;
  out.precision(17);
  out << "pose kind " << int(s.poseKind) << ", lens kind " << int(s.lensKind) << ", position " << s.position.x << " "
      << s.position.y << " " << s.position.z << ", target " << s.target.x << " " << s.target.y << " " << s.target.z
      << ", up " << s.up.x << " " << s.up.y << " " << s.up.z << ", fov " << s.fov << ", near " << s.near << ", far "
      << s.far << ", viewport " << s.viewport.width << "x" << s.viewport.height << " at " << s.viewport.x << " "
      << s.viewport.y << ", crop " << s.hasCrop << ", shift " << s.shiftX << " " << s.shiftY;
  return out.str();
}

}  // namespace reference
