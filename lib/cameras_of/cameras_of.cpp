#include "viewproj/cameras_of.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "camera/pose.hpp"
#include "cameras_of/matrix_lens.hpp"

namespace viewproj {

using namespace detail;
namespace {

/// An affine matrix's last entry may be this many units in the last place, or twice its error, away from 1, as in a
/// computed inverse. The whole matrix is then divided by it.
constexpr double kUnits = 4;

/// A test of right angles that lets more pass is none. Of M^T M - I twice as much.
constexpr double kBlind = 0.2;

double largestOf(const std::array<double, 4>& row) noexcept { return std::max({row[0], row[1], row[2]}); }

// Poses

/// The largest entry of M^T M - I for the 3x3 part M.
double rigidity(const Mat4& m) noexcept {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      const double product = m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j];
      const double off = std::fabs(product - (i == j ? 1 : 0));
      if (!(off <= worst)) worst = off;
    }
  return worst;
}

/// The vectors; or where they are too far from right angles for a pose, the nearest ones that have them.
std::array<DDVec3, 3> squared(std::array<DDVec3, 3> v) noexcept {
  double residual = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) residual = std::max(residual, std::fabs(dot(v[i], v[j]).hi - (i == j ? 1 : 0)));
  constexpr double kNearEnough = 0.9 * kPoseOrthogonality;
  constexpr int kSteps = 6;  // each squares the distance
  for (int step = 0; step < kSteps && residual > kNearEnough; ++step) {
    const std::array<DDVec3, 3> inverted = inverse(v);
    for (std::size_t i = 0; i < 3; ++i) v[i] = (v[i] + inverted[i]) * DoubleDouble(0.5);
  }
  return v;
}

/// The point where three rows are 0, rounded at the end.
DDVec3 commonPoint(const Row& a, const Row& b, const Row& c) noexcept {
  const Vector3<Dyadic<2>> bc = crossOf(b.axis, c.axis), ca = crossOf(c.axis, a.axis), ab = crossOf(a.axis, b.axis);
  WideVec3 point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = -(bc[i] * a.last + ca[i] * b.last + ab[i] * c.last).rounded();
  return quotient(point, dot(a.axis, bc).rounded());
}

/// The pose of a view matrix or its inverse, after division by its last entry.
Pose poseOf(const Mat4& m, MatrixKind kind, CameraAxes axes) {
  const bool isView = kind == MatrixKind::view;
  if (m[3][3] == 1 && rigidity(m) <= kPoseOrthogonality)
    return isView ? poseFromCameraFromWorld(m, axes) : poseFromWorldFromCamera(m, axes);
  const Mat4 vectorRows = isView ? m : transposed(m);
  const DoubleDouble by = DoubleDouble(1) / DoubleDouble(m[3][3]);
  std::array<DDVec3, 3> vectors;
  for (std::size_t i = 0; i < 3; ++i) {
    const DDVec3 vector{vectorRows[i][0], vectorRows[i][1], vectorRows[i][2]};
    vectors[i] = vector * by;
  }
  if (!isView) return poseFromColumns(squared(vectors), DDVec3{m[0][3], m[1][3], m[2][3]} * by, axes);
  const Rows rows = rowsOf(m);
  return poseFromColumns(inverse(squared(vectors)), commonPoint(rows[0], rows[1], rows[2]), axes);
}

// One reading of the matrix

std::string text(const char* format, double number) {
  char out[200];
  std::snprintf(out, sizeof out, format, number);
  return out;
}

/// The fields of the convention that differ from c, among those that the camera's kind determines.
std::string differences(const MatrixCamera& camera, const Convention& c) {
  const Convention& actual = camera.convention;
  std::string names;
  const auto add = [&](bool differs, const char* name) {
    if (differs) names += (names.empty() ? "" : ", ") + std::string(name);
  };
  add(camera.pose && actual.world != c.world, "world");
  add(camera.kind != MatrixKind::viewProjection && actual.view != c.view, "view");
  const bool hasDepth = camera.lens && camera.lens->depthFault.empty();
  add(hasDepth && actual.ndcZ != c.ndcZ, "ndcZ");
  add(hasDepth && actual.reverseZ != c.reverseZ, "reverseZ");
  add(camera.lens && actual.ndcY != c.ndcY, "ndcY");
  return names;
}

/// What a solver takes a matrix for.
enum class Reading {
  usual,     ///< the sixteen numbers of a camera
  multiple,  ///< a multiple of them
  noDepth,   ///< with a z row that is none of a camera
};

class Solver {
 public:
  Solver(const Mat4& matrix, const Mat4& errors, MatrixLayout layout, const MatrixQuery& query)
      : m_(matrix), errors_(errors), layout_(layout), query_(query) {
    // Rounding may have left something in a last row of 0 0 0 1.
    constexpr double kLeft = 1e-6;
    const auto isLeft = [&](std::size_t j) { return std::fabs(m_[3][j]) <= std::min(errors_[3][j], kLeft); };
    if (m_[3][3] > 0.5 && isLeft(0) && isLeft(1) && isLeft(2)) m_[3] = {0, 0, 0, m_[3][3]};
    const auto& w = m_[3];
    const bool isAffine = w[0] == 0 && w[1] == 0 && w[2] == 0;
    if (w[0] == 0 && w[1] == 0 && std::fabs(w[2]) + std::fabs(w[3]) == 1) errors_[3] = {};
    // The zeros of a projection are no rounded numbers.
    if (!isAffine && hasZerosOfProjection()) {
      errors_[0][1] = errors_[0][3] = errors_[1][0] = errors_[1][3] = 0;
      errors_[3][0] = errors_[3][1] = errors_[3][3] = 0;
    }
  }

  /// Finds the cameras that match the query. Returns what is wrong if there is none.
  std::string solve(Reading reading) {
    reading_ = reading;
    const std::string fault = read();
    if (!cameras.empty() || !fault.empty()) return fault;
    return mismatch_.empty() ? "it is of another kind" : mismatch_;
  }

  std::vector<MatrixCamera> cameras;
  bool isRefuted = false;  ///< no scale would help: the w row is already as it should be

 private:
  std::string read() {
    const auto& w = m_[3];
    const bool affine = w[0] == 0 && w[1] == 0 && w[2] == 0;
    if (affine && w[3] == 0) return "its w row is 0 0 0 0";
    const bool isNearlyOne = std::fabs(w[3] - 1) <= kUnits * std::max(0x1p-52, 2 * errors_[3][3]);
    if (affine && !(isNearlyOne || (reading_ == Reading::multiple && w[3] > 0)))
      return text("its w row is 0 0 0 %.6g: w is the same for every point, and not 1", w[3]);
    return affine ? readAffine(isNearlyOne) : readPerspective();
  }

  bool isZero(std::initializer_list<std::size_t> entries) const {
    for (const std::size_t entry : entries)
      if (m_[entry / 4][entry % 4] != 0) return false;
    return true;
  }

  bool hasZerosOfProjection() const { return isZero({1, 3, 4, 7, 12, 13, 15}); }

  /// How much a cosine may be off 0, at so large an error of the entries.
  static double tolerance(double error) { return kPoseOrthogonality + 2 * std::numbers::sqrt3 * error; }

  std::string readPerspective() {
    const auto parts = perspectiveParts(rowsOf(m_));
    if (!parts) return "x or y does not change across the picture";
    const bool hasZeros = isZero({1, 3, 4, 7, 8, 9, 12, 13, 15});
    const double scale = parts->scale.hi, wError = largestOf(errors_[3]) / scale;
    const bool isUnit = hasZeros ? scale == 1 : std::fabs(scale * scale - 1) <= tolerance(largestOf(errors_[3]));
    const bool isAnyScale = reading_ == Reading::multiple;
    if (!isUnit && !isAnyScale && !(reading_ == Reading::noDepth && isOfPixels(*parts)))
      return text("the first three numbers of its w row have length %.6g, not 1: no row of a view", scale);
    isRefuted = isUnit || isAnyScale;
    // A row's error turns it by that over its length across the view.
    const auto turn = [&](std::size_t i) {
      const double across = parts->lines[i].scale.hi * scale;
      return largestOf(errors_[i]) / across * std::max(1.0, lengthOf(m_[i]) / across);
    };
    const double allowed = tolerance(turn(0) + turn(1) + 2 * wError), length = std::max(scale, lengthOf(m_[2]));
    const double depthAllowed =
        tolerance(largestOf(errors_[2]) / length + std::fabs(parts->lines[2].offset.hi) * wError);
    const bool isAlong = parts->depthResidual <= depthAllowed;
    if (!(parts->residual <= allowed && (allowed <= kBlind || hasZerosOfProjection()) &&
          (isAlong || reading_ == Reading::noDepth)))
      return text(
          "its rows are not at right angles, or its z row not along its w row: off by %.2g, 0.001 is allowed; an "
          "oblique near plane or a sheared or stretched model does that",
          std::max(parts->residual, parts->depthResidual));
    if (reading_ == Reading::noDepth) {
      addWindow(*parts, hasZeros || hasZerosOfProjection(), depthFault(*parts, isAlong));
      return "";
    }
    if (addClip(*parts, hasZeros)) return "";
    return text("its depth is %.6g", parts->lines[2].offset.hi) + text(" %+.6g / w", parts->lines[2].scale.hi) +
           ", whose range in front of the eye is neither -1 to 1 nor 0 to 1; the matrix has a viewport in it, or "
           "is not a camera's";
  }

  /// Whether x and y are in square pixels, as a page's: then a w row may have any length.
  static bool isOfPixels(const ClipParts& parts) {
    constexpr double kFewest = 20, kSquare = 0.02;
    const double x = parts.lines[0].scale.hi, y = parts.lines[1].scale.hi;
    return std::min(x, y) > kFewest && std::fabs(x / y - 1) < kSquare;
  }

  /// What a z row is that is no camera's depth.
  std::string depthFault(const ClipParts& parts, bool isAlong) const {
    const auto& z = m_[2];
    if (z == std::array<double, 4>{0, 0, 0, 0}) return "its depth row is 0 0 0 0: depth is lost";
    if (lengthOf(z) <= 1e-9 * parts.scale.hi) return text("its depth row is 0 0 0 %.6g: depth is constant", z[3]);
    if (!isAlong)
      return "its depth row is not along the view: an oblique near plane, a page's perspective (CSS), or an error";
    const double offset = parts.lines[2].offset.hi, scale = parts.lines[2].scale.hi;
    return text("its depth is %.6g", offset) + text(" %+.6g / distance", scale) +
           ", which meets neither -1 to 1 nor 0 to 1 in front of the eye" +
           (offset > 1 && scale > 0 ? text(": its z row is the w row again, times %.6g", offset) : "");
  }

  std::string readAffine(bool isNearlyOne) {
    isRefuted = true;
    const auto parts = orthographicParts(rowsOf(m_));
    if (!parts) return "it flattens space: one of its rows has no x, y, z";
    const double rigid = rigidity(m_),
                 entryError = std::max({largestOf(errors_[0]), largestOf(errors_[1]), largestOf(errors_[2])});
    const double rigidAllowed = tolerance(entryError);
    const bool isPose = isNearlyOne && rigid <= rigidAllowed && rigidAllowed < 2 * kBlind;
    const bool isDiagonal = isZero({1, 2, 4, 6, 8, 9});
    if (isPose) addPoses(*parts, rigid);
    if (isPose && !(isDiagonal && m_[0][0] > 0) && query_.kind != MatrixKind::viewProjection) return "";
    double turn = 0;
    for (std::size_t i = 0; i < 3; ++i) turn = std::max(turn, largestOf(errors_[i]) / lengthOf(m_[i]));
    const double allowed = tolerance(turn);
    if (!(parts->residual <= allowed && (allowed <= kBlind || isDiagonal)))
      return text("its rows are not at right angles: the largest cosine is %.2g", parts->residual) +
             text(", %.2g is allowed", std::min(allowed, kBlind));
    addClip(*parts, isDiagonal);
    return "";
  }

  void addPoses(const ClipParts& parts, double residual) {
    constexpr std::pair<ViewAxes, CameraAxes> kAxes[] = {
        {ViewAxes::RUB, CameraAxes::RUB}, {ViewAxes::RUF, CameraAxes::RUF}, {ViewAxes::RDF, CameraAxes::RDF}};
    for (const MatrixKind kind : {MatrixKind::view, MatrixKind::worldFromView})
      for (const auto& [view, axes] : kAxes) {
        MatrixCamera camera;
        camera.kind = kind;
        camera.layout = layout_;
        camera.scale = m_[3][3];
        camera.residual = residual;
        camera.convention.view = view;
        camera.convention.world =
            (view == ViewAxes::RUF) == (determinant(parts.axes).hi < 0) ? Handedness::right : Handedness::left;
        add(camera, [&, axes = axes] {
          const Pose pose = poseOf(m_, kind, axes);
          camera.eyeError = kind == MatrixKind::view ? pointErrors(m_, errors_, {0, 1, 2}, pose.eye())
                                                     : Vec3{errors_[0][3], errors_[1][3], errors_[2][3]};
          return pose;
        });
      }
  }

  /// A camera of these parts in a convention without its view and NDC y.
  MatrixCamera clipCamera(const ClipParts& parts, bool hasZeros, const MatrixLens& lens, NdcZ ndcZ,
                          bool reverseZ) const {
    const bool isProjection = hasZeros && m_[0][0] > 0 && query_.kind != MatrixKind::viewProjection;
    const bool isScaled = reading_ == Reading::multiple || parts.orthographic;
    MatrixCamera camera;
    camera.kind = isProjection ? MatrixKind::projection : MatrixKind::viewProjection;
    camera.layout = layout_;
    camera.convention.ndcZ = ndcZ;
    camera.convention.reverseZ = reverseZ;
    camera.scale = isScaled ? parts.scale.hi : 1;
    camera.residual = std::max(parts.residual, parts.depthResidual);
    camera.lens = lens;
    const double more = secondOrder(m_, errors_);
    if (!parts.orthographic)
      camera.lens->fovError = {fovError(errors_, parts, 0) * more, fovError(errors_, parts, 1) * more};
    return camera;
  }

  /// Adds projections if the axes are those of a view, otherwise view-projections. False if near and far do not fit.
  bool addClip(const ClipParts& parts, bool hasZeros) {
    const DepthErrors errors = depthErrors(m_, errors_, parts);
    bool hasDepth = false;
    for (const NdcZ ndcZ : {NdcZ::minusOneToOne, NdcZ::zeroToOne})
      for (const bool reverseZ : {false, true}) {
        MatrixLens lens;
        lens.orthographic = parts.orthographic;
        const DepthEnds ends = ndcDepths({.ndcZ = ndcZ, .reverseZ = reverseZ});
        if (parts.orthographic)
          setOrthographicDepth(lens, parts.lines[2], errors, ends);
        else if (!setPerspectiveDepth(lens, parts.lines[2], errors, ends))
          continue;
        hasDepth = true;
        addViews(parts, clipCamera(parts, hasZeros, lens, ndcZ, reverseZ));
      }
    return hasDepth;
  }

  /// Adds the cameras of rows x, y and w.
  void addWindow(const ClipParts& parts, bool hasZeros, const std::string& depthFault) {
    MatrixLens lens;
    lens.depthFault = depthFault;
    if (m_[2] == std::array<double, 4>{}) lens.zFar.value = kInfiniteFar;
    addViews(parts, clipCamera(parts, hasZeros, lens, {}, false));
  }

  /// Adds a camera in each view and NDC y that fit.
  void addViews(const ClipParts& parts, MatrixCamera camera) {
    const bool isProjection = camera.kind == MatrixKind::projection, orthographic = parts.orthographic;
    DDVec3 eye;
    if (!isProjection && !orthographic) {
      const Rows rows = rowsOf(m_);
      eye = commonPoint(rows[0], rows[1], rows[3]);
      camera.eyeError = pointErrors(m_, errors_, {0, 1, 3}, rounded(eye));
    }
    Convention& c = camera.convention;
    for (const ViewAxes view : {ViewAxes::RUB, ViewAxes::RUF, ViewAxes::RDF})
      for (const NdcY ndcY : {NdcY::up, NdcY::down}) {
        std::array<DDVec3, 3> axes = parts.axes;
        if (ndcY == NdcY::down) axes[1] = -axes[1];
        if (orthographic && c.reverseZ) axes[2] = -axes[2];
        const AxisSigns sign = axisSigns(view);
        if (isProjection ? !(axes[1].y.hi * sign.up > 0 && axes[2].z.hi * sign.forward > 0) : view != ViewAxes::RUB)
          continue;
        c.view = view;
        c.ndcY = ndcY;
        if (!isProjection) c.world = determinant(axes).hi < 0 ? Handedness::right : Handedness::left;
        setWindow(*camera.lens, parts, ndcY);
        add(camera, [&]() -> std::optional<Pose> {
          if (isProjection) return std::nullopt;
          return poseFromColumns(inverse(squared(axes)), eye, CameraAxes::RUF);
        });
      }
  }

  /// Adds the camera with its pose if it matches the query; otherwise remembers why not.
  template <class MakePose>
  void add(MatrixCamera& camera, MakePose makePose) {
    if (query_.kind && *query_.kind != camera.kind) return;
    std::string fault;
    try {
      camera.pose = makePose();
      const std::string other = query_.convention ? differences(camera, *query_.convention) : "";
      if (!other.empty())
        fault = "it is of a convention with another " + other;
      else if (query_.convention && camera.lens && !camera.lens->projection)
        fault = "it does not determine near and far";
    } catch (const CameraError& e) {
      fault = e.message();
    }
    if (fault.empty())
      cameras.push_back(camera);
    else if (mismatch_.empty() || fault.size() < mismatch_.size())
      mismatch_ = fault;
  }

  Mat4 m_, errors_;
  MatrixLayout layout_;
  const MatrixQuery& query_;
  std::string mismatch_;
  Reading reading_ = Reading::usual;
};

}  // namespace

MatrixCameras camerasOf(const Mat4& m, const MatrixQuery& query) {
  for (const auto& row : m.m)
    for (const double entry : row) {
      const char* const fault = !std::isfinite(entry)               ? "it has a number that is not finite"
                                : std::fabs(entry) > kLargestNumber ? "it has a number beyond 1e45"
                                                                    : nullptr;
      if (fault) return {{}, fault, fault};
    }
  const bool isSymmetric = m == transposed(m);
  const Mat4 errors = query.errors.value_or(roundingErrors(m));
  Solver written(m, errors, isSymmetric ? MatrixLayout::either : MatrixLayout::asWritten, query);
  Solver turned(transposed(m), transposed(errors), MatrixLayout::transposed, query);
  const bool isWrittenTried = isSymmetric || query.layout != MatrixLayout::transposed;
  const bool isTurnedTried = !isSymmetric && query.layout != MatrixLayout::asWritten;
  MatrixCameras result;
  if (isWrittenTried) result.fault = written.solve(Reading::usual);
  result.transposedFault = isTurnedTried ? turned.solve(Reading::usual) : result.fault;
  const auto again = [&](Reading reading) {
    if (isWrittenTried) written.solve(reading);
    if (isTurnedTried && !query.convention) turned.solve(reading);
  };
  const auto mayBeMultiple = [](const Solver& solver) { return solver.cameras.empty() && !solver.isRefuted; };
  if (mayBeMultiple(written) && (query.convention || mayBeMultiple(turned))) again(Reading::multiple);
  const bool lacksDepth = m[2] == std::array<double, 4>{};
  if (written.cameras.empty() && turned.cameras.empty() && (!query.convention || lacksDepth)) again(Reading::noDepth);
  result.cameras = written.cameras;
  if (!query.convention)
    result.cameras.insert(result.cameras.end(), turned.cameras.begin(), turned.cameras.end());
  else if (result.cameras.empty() && !turned.cameras.empty())
    result.fault += "; its transpose fits";
  return result;
}

}  // namespace viewproj
