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

// Intervals and estimates

Interval operator-(DoubleDouble a, Interval b) noexcept { return {a - b.high, a - b.low}; }
Interval operator-(Interval a) noexcept { return {-a.high, -a.low}; }
Estimate operator-(const Estimate& a) noexcept { return {0 - a.value, 0 - a.high, 0 - a.low}; }

struct Ends {
  Estimate estimate;
  DoubleDouble value;
};

Ends operator-(const Ends& a) noexcept { return {-a.estimate, -a.value}; }

/// (numerator - offset) / scale.
Ends windowEnd(double numerator, const Uncertain& offset, const Uncertain& scale) noexcept {
  const DoubleDouble value = quotient(DoubleDouble(numerator) - offset.value, scale.value);
  return {estimate(value, quotient(DoubleDouble(numerator) - offset.interval(), scale.interval())), value};
}

/// Between two edges of the window.
Estimate angleEstimate(const Uncertain& scale, const Uncertain& offset, const Ends& from, const Ends& to) noexcept {
  // Correct to an ulp, and so stepped outwards by one.
  if (!(std::fabs(offset.value.hi) <= offset.error))
    return {degreesAcross(from.value, to.value), std::nextafter(degreesAcross(from.estimate.high, to.estimate.low), 0),
            std::nextafter(degreesAcross(from.estimate.low, to.estimate.high), 180)};
  const Interval in = scale.interval();
  const auto half = [](DoubleDouble s) { return quotient(DoubleDouble(1), s); };
  return {degreesOfHalfTangent(half(scale.value)), std::nextafter(degreesOfHalfTangent(half(in.high)), 0),
          in.low.hi > 0 ? std::nextafter(degreesOfHalfTangent(half(in.low)), 180) : 180};
}

/// Of corners across from each other, whichever are farther apart.
Estimate diagonalEstimate(const Ends& left, const Ends& right, const Ends& bottom, const Ends& top) noexcept {
  const auto widest = [](const auto& between) { return std::max(between(false), between(true)); };
  Estimate angle;
  angle.value = widest([&](bool falling) {
    return degreesBetween(left.value, falling ? top.value : bottom.value, right.value,
                          falling ? bottom.value : top.value);
  });
  angle.low = angle.high = angle.value;
  // The ends of the intervals are so near that nothing between them is farther or nearer.
  for (unsigned i = 0; i < 16; ++i) {
    const auto end = [&](const Ends& edge, unsigned bit) {
      return DoubleDouble((i & bit) != 0 ? edge.estimate.high : edge.estimate.low);
    };
    const DoubleDouble l = end(left, 1), r = end(right, 2), b = end(bottom, 4), t = end(top, 8);
    const double there = widest([&](bool falling) { return degreesBetween(l, falling ? t : b, r, falling ? b : t); });
    angle.low = std::min(angle.low, std::nextafter(there, 0));
    angle.high = std::max(angle.high, std::nextafter(there, 180));
  }
  return angle;
}

/// (sign a + start) / 2.
Estimate shareOf(const Uncertain& a, double sign, double start) noexcept {
  const auto half = [&](DoubleDouble number) { return timesPowerOfTwo(number * sign + DoubleDouble(start), 0.5); };
  const Interval in = a.interval();
  const DoubleDouble ends[] = {half(in.low), half(in.high)};
  return estimate(half(a.value), {ends[sign < 0], ends[sign > 0]});
}

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
    const Ends end = windowEnd(d, p.depthOffset, p.depthScale);
    return against ? -end.estimate : end.estimate;
  };
  return {plane(z.atNear), plane(z.atFar), false};
}

void setLens(Reading& reading, const ClipParts& p, const DepthPlanes& depth) noexcept {
  const Ends left = windowEnd(-1, p.offsetX, p.scaleX), right = windowEnd(1, p.offsetX, p.scaleX);
  const Ends low = windowEnd(-1, p.offsetY, p.scaleY), high = windowEnd(1, p.offsetY, p.scaleY);
  const bool down = reading.convention.ndcY == NdcY::down;
  const Ends bottom = down ? -high : low, top = down ? -low : high;
  LensEstimate lens;
  lens.orthographic = p.orthographic;
  lens.left = left.estimate;
  lens.right = right.estimate;
  lens.bottom = bottom.estimate;
  lens.top = top.estimate;
  lens.aspect = estimate(quotient(p.scaleY.value, p.scaleX.value), quotient(p.scaleY.interval(), p.scaleX.interval()));
  if (!p.orthographic) {
    lens.fovX = angleEstimate(p.scaleX, p.offsetX, left, right);
    lens.fovY = angleEstimate(p.scaleY, p.offsetY, bottom, top);
    lens.fovDiagonal = diagonalEstimate(left, right, bottom, top);
    lens.focalLength = {shareOf(p.scaleX, 1, 0), shareOf(p.scaleY, 1, 0)};
    lens.principalPoint = {shareOf(p.offsetX, 1, 1), shareOf(p.offsetY, down ? 1 : -1, 1)};
  }
  lens.near = depth.near;
  lens.far = depth.far;
  lens.beyondInfinity = depth.beyondInfinity;
  // Not checked: whether its numbers are a camera's is for who makes one of it.
  reading.projection =
      Access::whole<Projection, ProjectionParts>(std::make_shared<const ProjectionParts>(ProjectionParts{
          p.orthographic, left.value, right.value, bottom.value, top.value, depth.near.value, depth.far.value}));
  reading.lens = lens;
}

// Poses

std::array<Estimate, 3> estimates(const std::array<Uncertain, 3>& eye) noexcept {
  std::array<Estimate, 3> result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = estimate(eye[i].value, eye[i].interval());
  return result;
}

/// The pose of exact rows, whose origin is the world's.
PoseParts poseOf(const ExactRows& exact, const std::array<Uncertain, 3>& eye) noexcept {
  PoseParts pose;
  pose.exact = exact;
  pose.eye = {eye[0].value.hi + 0.0, eye[1].value.hi + 0.0, eye[2].value.hi + 0.0};
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
  p.scaleX.value = clip.scaleX;
  p.offsetX.value = clip.offsetX;
  p.scaleY.value = clip.scaleY;
  p.offsetY.value = clip.offsetY;
  reading.pose = made(poseOf(clip.rows, p.eye));
  const Axes& r = parts(*reading.pose).rows;
  reading.place = PoseEstimate{!p.orthographic,    estimates(p.eye), rounded(r.right), rounded(r.up),
                               rounded(r.forward), p.axisErrors,     p.residual};
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
    const auto changes = [](const Uncertain& scale) { return scale.interval().low.hi > 0; };
    if (!parts || !changes(parts->scaleX) || !changes(parts->scaleY))
      return "x or y does not change across the picture, as far as its digits show";
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
    const HalfSteps scaleSteps = scale == 1 ? HalfSteps{} : stepsOf(3, 3);
    const Interval scaleIn{twoDiff(scale, scaleSteps.down), twoSum(scale, scaleSteps.up)};
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
        for (std::size_t k = 0; k < 9; ++k) {
          // An axis is a row of a view and a column of a pose.
          double& error = place.axisErrors[k / 3];
          const std::size_t row = kind == MatrixKind::view ? k / 3 : k % 3,
                            column = kind == MatrixKind::view ? k % 3 : k / 3;
          const HalfSteps steps = stepsOf(row, column);
          const double ofScale = std::fabs(m_[row][column]) * std::max(scaleSteps.down, scaleSteps.up);
          error = std::max(error, (std::max(steps.down, steps.up) + ofScale) / scale);
        }
        if (kind == MatrixKind::view) {
          if (isRigid) r.pose = dividedBy(scale, poseFromCameraFromWorld(unscaled, kAxes[i], r.convention.world));
          place.eye = estimates(eyeOfView(m_, errors_));
        } else {
          if (isRigid)
            r.pose = scale == 1 ? poseFromWorldFromCamera(m_, kAxes[i], r.convention.world)
                                : scaledColumns(kAxes[i], r.convention.world);
          for (std::size_t k = 0; k < 3; ++k) {
            const HalfSteps steps = stepsOf(k, 3);
            place.eye[k] = estimate(quotient(DoubleDouble(m_[k][3]), scale),
                                    quotient({twoDiff(m_[k][3], steps.down), twoSum(m_[k][3], steps.up)}, scaleIn));
          }
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

  HalfSteps stepsOf(std::size_t i, std::size_t j) const {
    return halfSteps(m_[i][j], errors_.precision, errors_.within[i][j]);
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
