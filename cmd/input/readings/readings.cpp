#include "input/readings/readings.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "camera/convention.hpp"
#include "camera/depth.hpp"
#include "camera/require.hpp"
#include "input/field_of_view.hpp"
#include "input/readings/clip_rows.hpp"
#include "input/readings/matrix_parts.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr ViewAxes kViews[] = {ViewAxes::RUB, ViewAxes::RUF, ViewAxes::RDF};
constexpr NdcZ kNdcZs[] = {NdcZ::minusOneToOne, NdcZ::zeroToOne};
constexpr NdcY kNdcYs[] = {NdcY::up, NdcY::down};

// Intervals

Interval operator-(DoubleDouble a, Interval b) noexcept { return {a - b.high, a - b.low}; }
Interval operator-(Interval a) noexcept { return {-a.high, -a.low}; }

/// (numerator - offset) / scale.
DoubleDouble windowEnd(double numerator, DoubleDouble offset, DoubleDouble scale) noexcept {
  return quotient(DoubleDouble(numerator) - offset, scale);
}

/// The nearest double; never -0.
double plain(DoubleDouble number) noexcept { return number.hi + 0.0; }

Vec3 plain(const DDVec3& v) noexcept { return {plain(v.x), plain(v.y), plain(v.z)}; }

// Lenses

struct DepthPlanes {
  Estimate near, far;
  bool beyondInfinity = false;
};

Interval times(Interval a, double sign) noexcept { return sign < 0 ? -a : a; }

/// z / w = A + B / w is atNear at near: 1 / near = (atNear - A) / B, and so on, with 1 / near > 1 / far >= 0.
std::optional<DepthPlanes> perspectiveDepth(const ClipParts& p, DepthEnds z) noexcept {
  const double sign = z.atNear > z.atFar ? 1 : -1;  // of B
  Interval b = times(p.depthScale.interval(), sign);
  if (!(b.high.hi > 0)) return std::nullopt;
  if (b.low.hi < 0) b.low = 0;
  const auto below = [&](double d) { return (DoubleDouble(d) - p.depthOffset.value) * sign; };
  const auto belowIn = [&](double d) { return times(DoubleDouble(d) - p.depthOffset.interval(), sign); };
  const Interval toNear = belowIn(z.atNear), toFar = belowIn(z.atFar);
  DepthPlanes planes;
  const DoubleDouble scale =
      std::max(p.depthScale.value.hi * sign, 0.0) == 0 ? DoubleDouble() : p.depthScale.value * sign;
  planes.near = estimate(quotient(scale, below(z.atNear)), quotient(b, toNear));
  if (toFar.high.hi < 0) {
    if (!(-toFar.high.hi <= kReadingTweak * toNear.high.hi)) return std::nullopt;
    planes.far = {kInfinity, kInfinity, kInfinity};
    planes.beyondInfinity = true;
  } else {
    planes.far =
        estimate(below(z.atFar).hi > 0 ? quotient(scale, below(z.atFar)) : DoubleDouble(kInfinity), quotient(b, toFar));
  }
  return planes;
}

/// z = A + B W with B > 0 along p.forward; forward is that, or against it where depth is reversed.
DepthPlanes orthographicDepth(const ClipParts& p, DepthEnds z) noexcept {
  const bool against = z.atNear > z.atFar;
  const auto plane = [&](double d) {
    const Estimate e = estimate(windowEnd(d, p.depthOffset.value, p.depthScale.value),
                                quotient(DoubleDouble(d) - p.depthOffset.interval(), p.depthScale.interval()));
    return against ? Estimate{0 - e.value, 0 - e.high, 0 - e.low} : e;
  };
  return {plane(z.atNear), plane(z.atFar), false};
}

void setLens(Reading& reading, const ClipParts& p, const DepthPlanes& depth) noexcept {
  const DoubleDouble left = windowEnd(-1, p.offsetX, p.scaleX), right = windowEnd(1, p.offsetX, p.scaleX);
  const DoubleDouble low = windowEnd(-1, p.offsetY, p.scaleY), high = windowEnd(1, p.offsetY, p.scaleY);
  const bool down = reading.convention.ndcY == NdcY::down;
  const DoubleDouble bottom = down ? -high : low, top = down ? -low : high;
  LensEstimate lens;
  lens.orthographic = p.orthographic;
  lens.left = plain(left);
  lens.right = plain(right);
  lens.bottom = plain(bottom);
  lens.top = plain(top);
  lens.aspect = plain(quotient(p.scaleY, p.scaleX));
  if (!p.orthographic) {
    const auto angle = [](DoubleDouble offset, DoubleDouble from, DoubleDouble to) {
      return offset.hi == 0 ? degreesOfHalfTangent(to) : degreesAcross(from, to);
    };
    const auto half = [](DoubleDouble number) { return plain(timesPowerOfTwo(number, 0.5)); };
    lens.fovX = angle(p.offsetX, left, right);
    lens.fovY = angle(p.offsetY, bottom, top);
    lens.fovDiagonal = std::max(degreesBetween(left, bottom, right, top), degreesBetween(left, top, right, bottom));
    lens.focalLength = {half(p.scaleX), half(p.scaleY)};
    lens.principalPoint = {half(DoubleDouble(1) + p.offsetX), half(DoubleDouble(1) + (down ? p.offsetY : -p.offsetY))};
  }
  lens.near = depth.near;
  lens.far = depth.far;
  lens.beyondInfinity = depth.beyondInfinity;
  // Not checked: whether its numbers are a camera's is for who makes one of it.
  reading.projection = Access::whole<Projection, ProjectionParts>(std::make_shared<const ProjectionParts>(
      ProjectionParts{p.orthographic, left, right, bottom, top, depth.near.value, depth.far.value}));
  reading.lens = lens;
}

// Poses

/// The pose of exact rows, whose origin is the world's.
PoseParts poseOf(const ExactRows& exact, const Vec3& eye) noexcept {
  PoseParts pose;
  pose.exact = exact;
  pose.eye = eye;
  const ExactVec3* const rows[] = {&exact.right, &exact.up, &exact.forward};
  const DoubleDouble scales[] = {exact.rightScale, exact.upScale, exact.forwardScale};
  DDVec3* const axes[] = {&pose.rows.right, &pose.rows.up, &pose.rows.forward};
  for (std::size_t i = 0; i < 3; ++i) {
    Expansion<8 * 3 * 2 + 8> atEye;
    for (std::size_t j = 0; j < 3; ++j) {
      const Expansion<8>& entry = (*rows[i])[j];
      (*axes[i])[j] = entry.rounded() * scales[i];
      atEye.addScaled(entry, pose.eye[j]);
      for (std::size_t t = 0; t < entry.size(); ++t)
        if (std::fabs(entry.term(t)) < kSmallestTerm) pose.exact.isNarrow = false;
    }
    for (std::size_t t = 0; t < exact.translation[i].size(); ++t) atEye.add(exact.translation[i].term(t));
    pose.residual[i] = atEye.rounded() * scales[i];
  }
  const Axes& r = pose.rows;
  const DDVec3 across = cross(r.up, r.forward);
  const DoubleDouble one = DoubleDouble(1) / dot(r.right, across);
  pose.columns = {across * one, cross(r.forward, r.right) * one, cross(r.right, r.up) * one};
  return pose;
}

/// Up and forward along or against the parts' ndcUp and forward. The lens's numbers become those of the exact rows.
void setPose(Reading& reading, ClipParts& p, const Mat4& matrix, double up, double forward) {
  const ClipRows clip = p.orthographic ? orthographicRows(matrix, up, forward) : perspectiveRows(matrix, up);
  p.scaleX = clip.scaleX;
  p.offsetX = clip.offsetX;
  p.scaleY = clip.scaleY;
  p.offsetY = clip.offsetY;
  const Vec3 eye = plain(p.eye);
  reading.pose = made(poseOf(clip.rows, eye));
  const Axes& r = parts(*reading.pose).rows;
  reading.place = PoseEstimate{!p.orthographic, eye, rounded(r.right), rounded(r.up), rounded(r.forward), p.residual};
  reading.convention.world = dot(cross(r.right, r.up), r.forward).hi < 0 ? Handedness::right : Handedness::left;
}

/// Of the same eye, its distances divided by scale.
Pose dividedBy(double scale, const Pose& whole) {
  if (scale == 1) return whole;
  PoseParts pose = parts(whole);
  const DoubleDouble by = DoubleDouble(1) / DoubleDouble(scale);
  const auto times = [](const Axes& a, DoubleDouble k) { return Axes{a.right * k, a.up * k, a.forward * k}; };
  pose.rows = times(pose.rows, by);
  pose.columns = times(pose.columns, scale);
  pose.residual = pose.residual * by;
  ExactRows& exact = pose.exact;
  for (DoubleDouble* rowScale : {&exact.rightScale, &exact.upScale, &exact.forwardScale}) *rowScale = *rowScale * by;
  return made(pose);
}

/// The largest entry of M^T M - I of the 3x3.
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

/// How far its entries, each within of the other matrix's, may have moved that.
double rigidityError(const Mat4& m, const Mat4& within) noexcept {
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      double error = 0;
      for (std::size_t k = 0; k < 3; ++k)
        error += std::fabs(m[k][i]) * within[k][j] + std::fabs(m[k][j]) * within[k][i] + within[k][i] * within[k][j];
      most = std::max(most, error);
    }
  return most;
}

double determinant(const Mat4& m) noexcept {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// The matrix taken one way

constexpr const char* kBeyondRange = "its numbers are too large or too small to be taken apart in doubles";

std::string text(const char* format, double number) {
  char out[200];
  std::snprintf(out, sizeof out, format, number);
  return out;
}

bool zero(std::initializer_list<double> numbers) noexcept {
  for (double number : numbers)
    if (number != 0) return false;
  return true;
}

class Reader {
 public:
  Reader(const Mat4& matrix, MatrixLayout layout, const EntryErrors& errors, bool anyScale,
         std::vector<Reading>& readings)
      : m_(matrix), layout_(layout), errors_(errors), anyScale_(anyScale), readings_(readings) {}

  /// Of no use at any scale: the w row is as it should be, and something else is not.
  bool isRefuted() const { return refuted_; }

  /// Adds the readings; what is wrong where there is none.
  std::string read() {
    const bool affine = zero({m_[3][0], m_[3][1], m_[3][2]});
    if (affine && m_[3][3] == 0) return "its w row is 0 0 0 0";
    hasScale_ = anyScale_ || (affine && isNearlyOne(m_[3][3]));
    if (affine && !(hasScale_ && m_[3][3] > 0))
      return text("its w row is 0 0 0 %.6g: w is the same for every point, and not 1", m_[3][3]);
    return affine ? readAffine() : readPerspective();
  }

 private:
  Reading reading(MatrixKind kind, double scale) const {
    Reading r;
    r.kind = kind;
    r.layout = layout_;
    if (hasScale_) r.scale = scale;
    return r;
  }

  /// As where an inverse was computed in numbers of the precision: the whole matrix has that scale.
  bool isNearlyOne(double entry) const {
    const double ulp = errors_.precision == EntryPrecision::float32 ? 0x1p-23 : 0x1p-52;
    return std::fabs(entry - 1) <= kReadingUnit * ulp;
  }

  std::string readPerspective() {
    const bool zeros = zero({m_[0][1], m_[0][3], m_[1][0], m_[1][3], m_[2][0], m_[2][1], m_[3][0], m_[3][1], m_[3][3]});
    const auto parts = perspectiveParts(m_, zeros ? withExactZeros(2) : errors_);
    if (!parts) return "x or y does not change across the picture, as far as its digits show";
    double unitError = 0;  // of the squared length of the w row
    for (std::size_t j = 0; j < 3; ++j) unitError += 2 * std::fabs(m_[3][j]) * errors_.within[3][j];
    const bool unit =
        zeros ? parts->scale == 1 : std::fabs(parts->scale * parts->scale - 1) <= kReadingOrthogonality + unitError;
    if (!unit && !anyScale_)
      return text("the first three numbers of its w row have length %.6g, not 1: no row of a view", parts->scale);
    refuted_ = true;
    if (!std::isfinite(parts->residual)) return kBeyondRange;
    if (!(parts->residual - parts->residualError <= kReadingOrthogonality))
      return text(
          "its rows are not at right angles, or its z row not along its w row: off by %.2g, 0.001 is allowed; an "
          "oblique near plane or a sheared or stretched model does that",
          parts->residual);
    const std::size_t before = readings_.size();
    for (NdcZ ndcZ : kNdcZs)
      for (bool reverseZ : {false, true}) {
        Convention c;
        c.ndcZ = ndcZ;
        c.reverseZ = reverseZ;
        const auto depth = perspectiveDepth(*parts, ndcDepths(c));
        if (!depth) continue;
        if (zeros && m_[0][0] > 0)
          addProjections(*parts, c, *depth);
        else
          addViewProjections(*parts, c, *depth, 1);
      }
    if (readings_.size() > before) return "";
    if (!std::isfinite(parts->depthOffset.value.hi) || !std::isfinite(parts->depthScale.value.hi)) return kBeyondRange;
    return text("its depth is %.6g", parts->depthOffset.value.hi) + text(" %+.6g / w", parts->depthScale.value.hi) +
           ", which takes in neither -1 to 1 nor 0 to 1 in front of the eye; a viewport folded in does that, or a "
           "matrix that is none of a camera";
  }

  std::string readAffine() {
    refuted_ = true;
    const double rigid = rigidity(m_);
    const bool isPose = isNearlyOne(m_[3][3]) && rigid - rigidityError(m_, errors_.within) <= kReadingOrthogonality;
    const bool diagonal = zero({m_[0][1], m_[0][2], m_[1][0], m_[1][2], m_[2][0], m_[2][1]}) && m_[0][0] > 0;
    const auto parts = orthographicParts(m_, diagonal ? withExactZeros(3) : errors_);
    if (!parts) return "it flattens space: one of its rows has no x, y, z";
    if (isPose) addPoses(rigid);
    if (isPose && !diagonal) return "";
    if (!std::isfinite(parts->residual)) return kBeyondRange;
    if (!(parts->residual - parts->residualError <= kReadingOrthogonality))
      return text("its rows are not at right angles: the largest cosine is %.2g, 0.001 is allowed", parts->residual);
    for (NdcZ ndcZ : kNdcZs)
      for (bool reverseZ : {false, true}) {
        Convention c;
        c.ndcZ = ndcZ;
        c.reverseZ = reverseZ;
        const DepthPlanes depth = orthographicDepth(*parts, ndcDepths(c));
        if (diagonal)
          addProjections(*parts, c, depth);
        else
          addViewProjections(*parts, c, depth, reverseZ ? -1 : 1);
      }
    return "";
  }

  /// The view's axes are those along which forward and up lie as the parts say.
  void addProjections(const ClipParts& parts, const Convention& depthPart, const DepthPlanes& depth) {
    const double towards = parts.orthographic && depthPart.reverseZ ? -1 : 1;
    for (ViewAxes view : kViews) {
      const AxisSigns sign = axisSigns(view);
      if ((parts.forward.z.hi * towards > 0) != (sign.forward > 0)) continue;
      Reading r = reading(MatrixKind::projection, parts.scale);
      r.convention = depthPart;
      r.convention.view = view;
      r.convention.ndcY = (parts.ndcUp.y.hi > 0) == (sign.up > 0) ? NdcY::up : NdcY::down;
      setLens(r, parts, depth);
      readings_.push_back(r);
    }
  }

  void addViewProjections(ClipParts parts, const Convention& depthPart, const DepthPlanes& depth, double forward) {
    for (NdcY ndcY : kNdcYs) {
      Reading r = reading(MatrixKind::viewProjection, parts.scale);
      r.convention = depthPart;
      r.convention.ndcY = ndcY;
      setPose(r, parts, m_, ndcY == NdcY::up ? 1 : -1, forward);
      setLens(r, parts, depth);
      readings_.push_back(r);
    }
  }

  void addPoses(double residual) {
    const double scale = m_[3][3];
    const bool isRigid = residual <= kReadingOrthogonality;
    Mat4 unscaled = m_;
    unscaled[3][3] = 1;
    constexpr CameraAxes kAxes[] = {CameraAxes::RUB, CameraAxes::RUF, CameraAxes::RDF};
    const bool mirrored = determinant(m_) < 0;
    for (MatrixKind kind : {MatrixKind::view, MatrixKind::worldFromView})
      for (std::size_t i = 0; i < std::size(kViews); ++i) {
        Reading r = reading(kind, scale);
        r.convention.view = kViews[i];
        r.convention.world = mirrored == (kViews[i] == ViewAxes::RUF) ? Handedness::right : Handedness::left;
        PoseEstimate place;
        place.residual = residual;
        if (kind == MatrixKind::view) {
          if (isRigid) r.pose = dividedBy(scale, poseFromCameraFromWorld(unscaled, kAxes[i], r.convention.world));
          place.eye = plain(eyeOfView(m_));
        } else {
          if (isRigid)
            r.pose = scale == 1 ? poseFromWorldFromCamera(m_, kAxes[i], r.convention.world)
                                : scaledColumns(kAxes[i], r.convention.world);
          for (std::size_t k = 0; k < 3; ++k) place.eye[k] = plain(quotient(DoubleDouble(m_[k][3]), scale));
        }
        if (r.pose) {
          const Axes& axes = kind == MatrixKind::view ? parts(*r.pose).rows : parts(*r.pose).columns;
          place.right = rounded(axes.right);
          place.up = rounded(axes.up);
          place.forward = rounded(axes.forward);
        } else {
          // As rough as its digits are.
          const Mat4 rows = kind == MatrixKind::view ? m_ : transposed(m_);
          const AxisSigns sign = axisSigns(kViews[i]);
          place.right = {rows[0][0], rows[0][1], rows[0][2]};
          place.up = {rows[1][0] * sign.up, rows[1][1] * sign.up, rows[1][2] * sign.up};
          place.forward = {rows[2][0] * sign.forward, rows[2][1] * sign.forward, rows[2][2] * sign.forward};
        }
        r.place = place;
        readings_.push_back(r);
      }
  }

  /// Of a pose matrix, all of it divided by its last entry.
  Pose scaledColumns(CameraAxes axes, Handedness world) const {
    const auto column = [&](std::size_t j) {
      const auto entry = [&](std::size_t i) { return DoubleDouble(m_[i][j]) / DoubleDouble(m_[3][3]); };
      return DDVec3{entry(0), entry(1), entry(2)};
    };
    return poseFromColumns({column(0), column(1), column(2)}, column(3), axes, world);
  }

  /// The zeros that make the matrix what it is taken for. offsets: the column of the window's offsets, which are none.
  EntryErrors withExactZeros(std::size_t offsets) const {
    EntryErrors errors = errors_;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if ((i < 2 ? j != offsets : j < 2) && m_[i][j] == 0) errors.within[i][j] = 0;
    return errors;
  }

  const Mat4& m_;
  MatrixLayout layout_;
  EntryErrors errors_;
  bool anyScale_;
  std::vector<Reading>& readings_;
  bool hasScale_ = false;
  bool refuted_ = false;
};

}  // namespace

Inspection inspectMatrix(const std::array<double, 16>& numbers, EntryPrecision precision,
                         const std::array<double, 16>& within) {
  Mat4 written;
  EntryErrors errors{precision, {}};
  Inspection result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const double number = numbers[4 * i + j];
      written[i][j] = precision == EntryPrecision::float32 ? static_cast<double>(static_cast<float>(number)) : number;
      errors.within[i][j] = within[4 * i + j];
      if (!std::isfinite(written[i][j])) {
        result.asWrittenFault = result.transposedFault = "it has a number that is not finite";
        return result;
      }
    }
  const Mat4 turned = transposed(written);
  const EntryErrors turnedErrors{precision, transposed(errors.within)};
  const bool symmetric = written == turned;
  Reader rows(written, symmetric ? MatrixLayout::either : MatrixLayout::asWritten, errors, false, result.readings);
  Reader columns(turned, MatrixLayout::transposed, turnedErrors, false, result.readings);
  result.asWrittenFault = rows.read();
  result.transposedFault = symmetric ? result.asWrittenFault : columns.read();
  if (!result.readings.empty() || rows.isRefuted() || columns.isRefuted()) return result;
  Reader(written, symmetric ? MatrixLayout::either : MatrixLayout::asWritten, errors, true, result.readings).read();
  if (!symmetric) Reader(turned, MatrixLayout::transposed, turnedErrors, true, result.readings).read();
  return result;
}

}  // namespace viewproj::cmd
