#include <algorithm>
#include <cmath>
#include <numbers>

#include "camera/plain_vectors.hpp"
#include "camera/split_matrix.hpp"
#include "commands/pasted/reading_parts.hpp"
#include "numbers/vectors.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using detail::crossOf;
using detail::dot;
using detail::maxAbs;
namespace {

constexpr double kRightAngle = 1e-3;  ///< off by so much in a camera of exact entries
constexpr double kBlind = 0.2;        ///< a test of right angles that lets more pass is none

/// The largest entry of the 3x3 part of errors.
double largestOf(const Mat4& e) { return std::max({maxAbs(rowOf(e, 0)), maxAbs(rowOf(e, 1)), maxAbs(rowOf(e, 2))}); }

/// What the cosine of two rows, or an entry of M^T M - I, may be off, of errors of so much relative to the rows.
double tolerance(double error) { return kRightAngle + 2 * std::numbers::sqrt3 * error; }

/// The largest entry of M^T M - I.
double rigidity(const Mat4& m) {
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j)
      worst = std::max(worst, std::fabs(m[0][i] * m[0][j] + m[1][i] * m[1][j] + m[2][i] * m[2][j] - (i == j ? 1 : 0)));
  return worst;
}

class LayoutReader {
 public:
  LayoutReader(const PastedMatrix& pasted, const LaidOut& laid, bool isFloat, std::vector<Reading>& found)
      : pasted_(pasted), laid_(laid), m_(laid.m), isFloat_(isFloat), found_(found) {
    setErrors({});
  }

  void read() {
    if (laid_.rows == 3 && !laid_.isWide)
      readThree();
    else if (laid_.rows == 3 && !isRotation())
      readThreeByFour();
    else
      readFour();
  }

  /// A projection or view-projection of which this is the inverse. Each entry of the inverse M may be off by
  /// |M| E |M|, to first order; to E comes what computing this matrix from M lost.
  void readInverse() {
    const std::optional<Mat4> inverse = inverseOf(m_);
    if (!inverse) return;
    const Mat4 size = absolute(*inverse), summed = product(absolute(m_), product(size, absolute(m_)));
    const double unit = 3 * (isFloat_ ? 0x1p-24 : 0x1p-53);
    Mat4 errors = laid_.printed;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool isExact = m_[i][0] == 0 && m_[i][1] == 0 && m_[i][2] == 0 && std::fabs(m_[i][3]) == 1;
      for (std::size_t j = 0; j < 4; ++j)
        errors[i][j] = isExact ? 0 : errors[i][j] + (m_[i][j] != 0 ? unit * summed[i][j] : 0);
    }
    const Mat4 share = product(size, errors);
    double most = 0;
    for (const auto& row : share.m) most = std::max(most, row[0] + row[1] + row[2] + row[3]);
    constexpr double kSure = 0.25;
    if (!(most < kSure)) return;
    const Mat4 rounded = product(size, product(absolute(m_), size));  // what our own inverse loses
    Mat4 each = product(share, size);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        each[i][j] = each[i][j] / (1 - most) + ((*inverse)[i][j] != 0 ? 0x1p-52 * rounded[i][j] : 0);
    for (const MatrixCamera& c : cameras(*inverse, each))
      if (c.lens)
        addCamera(c, *inverse, each).kind =
            c.pose ? ReadingKind::viewProjectionInverse : ReadingKind::projectionInverse;
  }

  std::string fault;

 private:
  void setErrors(const Vec3& eye) {
    errors_ = laid_.printed;
    addRounding(errors_, m_, isFloat_, eye);
    if (laid_.rows == 3) errors_[3] = {};
  }

  bool isRotation() const {
    const double allowed = tolerance(largestOf(errors_));
    return allowed < 2 * kBlind && rigidity(m_) <= allowed;
  }

  Reading& add(ReadingKind kind) {
    Reading& reading = found_.emplace_back();
    reading.kind = kind;
    reading.layout = laid_.layout;
    return reading;
  }

  void addRotation() {
    Reading& r = add(ReadingKind::rotation);
    r.rows = {rowOf(m_, 0), rowOf(m_, 1), rowOf(m_, 2)};
    r.isMirrored = determinant(m_) < 0;
    r.axesError = axesError(m_, errors_, 2);
  }

  /// K: zeros below the diagonal, none on it. Signs are axes.
  bool addK() {
    const double below = std::max({std::fabs(m_[1][0]), std::fabs(m_[2][0]), std::fabs(m_[2][1])});
    if (!(below <= 1e-12 * largestOf(absolute(m_)) && m_[0][0] != 0 && m_[1][1] != 0 && m_[2][2] != 0)) return false;
    static constexpr std::string_view kAxes[] = {"RDF", "RDB", "RUF", "RUB", "LDF", "LDB", "LUF", "LUB"};
    const bool isOne = std::fabs(std::fabs(m_[2][2]) - 1) <= laid_.printed[2][2];
    const double last = isOne ? std::copysign(1, m_[2][2]) : m_[2][2], size = std::fabs(last),
                 lastError = isOne ? 0 : laid_.printed[2][2];
    const auto errorOf = [&](std::size_t i, std::size_t j) {
      return (laid_.printed[i][j] + std::fabs(m_[i][j]) / size * lastError) / (size - lastError);
    };
    add(ReadingKind::k).pixels = PixelLens{std::fabs(m_[0][0]) / size,
                                           std::fabs(m_[1][1]) / size,
                                           m_[0][2] / last,
                                           m_[1][2] / last,
                                           m_[0][1] / size,
                                           kAxes[4 * (m_[0][0] < 0) + 2 * (m_[1][1] < 0) + (last < 0)],
                                           {errorOf(0, 0), errorOf(1, 1), errorOf(0, 2), errorOf(1, 2)}};
    return true;
  }

  /// P = K [R | t], with skew. The eye is the null vector.
  std::optional<Reading> readP() const {
    const double lengths = length(rowOf(m_, 0)) * length(rowOf(m_, 1)) * length(rowOf(m_, 2)), volume = determinant(m_);
    if (!(std::fabs(volume) > 1e-9 * lengths)) return std::nullopt;
    SplitMatrix split;
    try {
      split = splitMatrix(std::span(m_[0].data(), 12));
    } catch (const CameraError&) {  // rows whose numbers lie too far apart
      return std::nullopt;
    }
    Reading r;
    r.kind = ReadingKind::p;
    r.layout = laid_.layout;
    const double more = margin(m_, errors_), w = length(rowOf(m_, 2)), wError = length(rowOf(errors_, 2)) / w;
    const auto errorOf = [&](std::size_t i, double value) {
      return more * (length(rowOf(errors_, i)) / w + (length(rowOf(m_, i)) / w + 2 * std::fabs(value)) * wError);
    };
    const double fx = split.fx.hi, fy = split.fy.hi, cx = split.cx.hi, cy = split.cy.hi;
    r.pixels =
        PixelLens{fx, fy, cx, cy, split.skew.hi, {}, {errorOf(0, fx), errorOf(1, fy), errorOf(0, cx), errorOf(1, cy)}};
    r.axesError = axesError(m_, errors_, 2, true);
    for (std::size_t i = 0; i < 3; ++i) r.rows[i] = detail::rounded(split.columns[i]);
    r.isMirrored = volume < 0 && m_[2] == std::array<double, 4>{0, 0, 1, 0};
    r.eye = detail::rounded(split.eye);
    const Vec3 columns[] = {crossOf(rowOf(m_, 1), rowOf(m_, 2)), crossOf(rowOf(m_, 2), rowOf(m_, 0)),
                            crossOf(rowOf(m_, 0), rowOf(m_, 1))};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 e = rowOf(errors_, i), eye = *r.eye;
      const double off = dot(e, Vec3{std::fabs(eye.x), std::fabs(eye.y), std::fabs(eye.z)}) + errors_[i][3];
      for (std::size_t j = 0; j < 3; ++j) r.eyeError[j] += more * std::fabs(columns[i][j] / volume) * off;
    }
    return r;
  }

  /// The largest error of a number in a row over the row's length.
  static double rowError(const Mat4& m, const Mat4& errors) {
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (const double size = length(rowOf(m, i)); size > 0) error = std::max(error, maxAbs(rowOf(errors, i)) / size);
    return error;
  }
  /// What is more than first order in errors.
  static double margin(const Mat4& m, const Mat4& errors) { return 1 / std::max(1 - 7 * rowError(m, errors), 0.05); }

  /// How far each number of the axes may be off that rows x, y and w have: at right angles, or, where x and y have w in
  /// them, what is left of them.
  static double axesError(const Mat4& m, const Mat4& errors, std::size_t w, bool isLens = false) {
    const Vec3 along = rowOf(m, w);
    const double share = length(rowOf(errors, w)) / length(along);
    Vec3 each{0, 0, share};
    for (const std::size_t i : {0U, 1U}) {
      const Vec3 row = rowOf(m, i);
      const double size = isLens ? length(crossOf(row, along)) / length(along) : length(row);
      each[i] = (length(rowOf(errors, i)) + (isLens ? 2 * length(row) * share : 0)) / size;
    }
    return margin(m, errors) * length(each);
  }

  bool hasSkew(const PixelLens& lens, double share) const {
    const double size = std::max({lens.fx, lens.fy, std::fabs(lens.cx), std::fabs(lens.cy)});
    return std::fabs(lens.skew) > std::max(18 * rowError(m_, errors_) * size, share * std::max(lens.fx, lens.fy));
  }

  void readThree() {
    const bool isExact = rigidity(m_) < 1e-9;
    if (isRotation()) addRotation();
    if ((isExact && laid_.layout != MatrixLayout::either) || !addK())
      fault =
          "it is no rotation, and has numbers below its diagonal or zeros on it, as no K has; it may be the homography "
          "of a plane, which is not modelled";
  }

  void readThreeByFour() {
    if (laid_.layout == MatrixLayout::transposed) return;
    const auto p = readP();
    // Twelve numbers in a row are many things: a P only where its third row is a unit vector and pixels are upright.
    if (p && (!pasted_.isInMemoryOrder || (std::fabs(length(rowOf(m_, 2)) - 1) <= 1e-3 && !hasSkew(*p->pixels, 1e-6))))
      found_.push_back(*p);
    else
      fault = "it is no K [R | t]: its left 3x3 has no inverse";
  }

  Reading& addCamera(const MatrixCamera& camera, const Mat4& m, const Mat4& errors, double scaledBy = 1) {
    constexpr ReadingKind kKinds[] = {ReadingKind::projection, ReadingKind::view, ReadingKind::pose,
                                      ReadingKind::viewProjection};
    Reading& r = add(kKinds[static_cast<std::size_t>(camera.kind)]);
    r.camera = camera;
    r.camera->layout = laid_.layout;
    r.scaledBy = scaledBy;
    r.isCentred = scaledBy == 1 && !camera.lens && isCentred(r.kind);
    if (camera.pose) r.rise = riseOf(*camera.pose);
    const bool isLens = camera.lens && !camera.lens->orthographic;
    if (camera.pose) r.axesError = axesError(m, errors, isLens ? 3 : 2, isLens);
    // The edges are (-1 - m02) / m00 and (1 - m02) / m00, and likewise across y.
    if (!camera.pose && isLens) {
      const auto errorOf = [&](std::size_t i, double low, double high) {
        const double edge = std::max(std::fabs(low), std::fabs(high));
        return (errors[i][2] + edge * errors[i][i]) /
               std::max(std::fabs(m[i][i]) - errors[i][i], 0.05 * std::fabs(m[i][i]));
      };
      r.edgeError = {errorOf(0, camera.lens->left, camera.lens->right),
                     errorOf(1, camera.lens->bottom, camera.lens->top)};
    }
    return r;
  }

  /// Of up along y or z, the larger of those that the picture's rows do not follow.
  double riseOf(const Pose& pose) const {
    const double error = std::max(1e-6, 4 * rowError(m_, errors_));
    double rise = 0;
    for (const std::size_t axis : {1U, 2U})
      if (std::fabs(pose.right()[axis]) <= error && std::fabs(pose.up()[axis]) > std::fabs(rise))
        rise = pose.up()[axis];
    return rise;
  }

  /// Whether the world's origin lies on the z axis of the camera, which is turned.
  bool isCentred(ReadingKind kind) const {
    Vec3 t = lastColumn(m_);
    const double error = 4 * (maxAbs(lastColumn(errors_)) + largestOf(errors_) * length(t)) + 1e-6 * length(t);
    if (kind == ReadingKind::pose) {
      const Mat4 inverse = transposed(m_);
      t = {dot(rowOf(inverse, 0), t), dot(rowOf(inverse, 1), t), dot(rowOf(inverse, 2), t)};
    }
    return std::fabs(t.z) > 10 * error && std::hypot(t.x, t.y) <= error && std::fabs(m_[2][2]) < 1 - 1e-3;
  }

  std::vector<MatrixCamera> cameras(const Mat4& m, const Mat4& errors, std::optional<MatrixKind> kind = {}) {
    MatrixCameras all = camerasOf(m, {.kind = kind, .layout = MatrixLayout::asWritten, .errors = errors});
    if (!kind) fault = all.fault;
    std::erase_if(all.cameras, [](const MatrixCamera& c) {
      return c.lens && !c.lens->orthographic && c.lens->depthFault.empty() && !(c.lens->zNear.value > 0);
    });
    return all.cameras;
  }

  void readFour() {
    std::vector<MatrixCamera> all = cameras(m_, errors_);
    for (const MatrixCamera& c : all)
      if (c.kind == MatrixKind::viewProjection && !c.lens->orthographic) {  // what was summed has the size of the eye
        setErrors(c.pose->eye());
        all = cameras(m_, errors_);
        break;
      }
    if (laid_.rows == 3) std::erase_if(all, [](const MatrixCamera& c) { return c.lens.has_value(); });
    const bool isAffine = m_[3][0] == 0 && m_[3][1] == 0 && m_[3][2] == 0, isPlaced = maxAbs(lastColumn(m_)) > 0;
    const bool isPose = std::any_of(all.begin(), all.end(), [](const MatrixCamera& c) { return !c.lens; });
    if (isPose && !isPlaced) addRotation();
    const double scale = scaleOfPose(all);
    if (scale != 1) addScaledPoses(scale);
    for (const MatrixCamera& c : all) addCamera(c, m_, errors_).isUniform = scale != 1;
    if (isAffine && all.empty()) {
      if (!isPlaced && addK()) return;
      const auto p = readP();
      if (p && std::min(p->pixels->fx, p->pixels->fy) > kFewestPixels && rowError(m_, errors_) < kBlind / 4 &&
          !hasSkew(*p->pixels, 1e-3) && p->pixels->fx < 5 * p->pixels->fy && p->pixels->fy < 5 * p->pixels->fx)
        found_.push_back(*p);
    }
    for (const MatrixCamera& c : all)
      if (addPixels(c)) break;
  }

  /// The length of rows that are at right angles and as long as each other, turned; else 1.
  double scaleOfPose(const std::vector<MatrixCamera>& all) const {
    if (all.empty() || all.front().kind != MatrixKind::viewProjection || !all.front().lens->orthographic) return 1;
    const auto [least, most] = std::minmax({length(rowOf(m_, 0)), length(rowOf(m_, 1)), length(rowOf(m_, 2))});
    return !isDiagonal(m_) && most / least < 1 + tolerance(rowError(m_, errors_)) && all.front().scale == 1
               ? std::cbrt(std::fabs(determinant(m_)))
               : 1;
  }

  void addScaledPoses(double scale) {
    for (const MatrixKind kind : {MatrixKind::view, MatrixKind::worldFromView}) {
      Mat4 m = m_, errors = errors_;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < (kind == MatrixKind::view ? 4U : 3U); ++j) {
          m[i][j] /= scale;
          errors[i][j] /= scale;
        }
      for (const MatrixCamera& c : cameras(m, errors, kind)) addCamera(c, m, errors, scale);
    }
  }

  /// The lens of rows x, y and w that count pixels.
  bool addPixels(const MatrixCamera& c) {
    if (!c.lens || c.lens->orthographic || c.convention.ndcY == NdcY::down) return false;
    const MatrixLens& lens = *c.lens;
    const double width = lens.right - lens.left, height = lens.top - lens.bottom;
    if (!(2 / width > kFewestPixels && 2 / height > kFewestPixels)) return false;
    // Pixels count from a corner, which the axis of a projection does not meet.
    if (c.kind == MatrixKind::projection && lens.left == -lens.right && lens.bottom == -lens.top) return false;
    if (c.scale != 1 && !(c.kind == MatrixKind::viewProjection && std::fabs(width / height - 1) < 0.02)) return false;
    Reading& r = add(c.kind == MatrixKind::projection ? ReadingKind::k : ReadingKind::p);
    r.pixels = PixelLens{
        2 / width, 2 / height, -(lens.left + lens.right) / width, -(lens.bottom + lens.top) / height, 0, {}, {}};
    r.eye = c.pose ? c.pose->eye() : Vec3{};
    r.eyeError = c.eyeError;
    if (c.pose) r.rows = {c.pose->right(), c.pose->up(), c.pose->forward()};
    return true;
  }

  const PastedMatrix& pasted_;
  const LaidOut& laid_;
  const Mat4& m_;
  Mat4 errors_;
  bool isFloat_;
  std::vector<Reading>& found_;
};

}  // namespace

LaidOut laidOut(const PastedMatrix& pasted, const std::vector<double>& printed, MatrixLayout layout) {
  const bool isTurned = layout == MatrixLayout::transposed;
  LaidOut laid{layout, {}, {}, isTurned ? pasted.columns : pasted.rows, (isTurned ? pasted.rows : pasted.columns) == 4};
  for (std::size_t i = 0; i < pasted.rows; ++i)
    for (std::size_t j = 0; j < pasted.columns; ++j) {
      (isTurned ? laid.m[j][i] : laid.m[i][j]) = pasted.at(i, j);
      (isTurned ? laid.printed[j][i] : laid.printed[i][j]) = printed[i * pasted.columns + j] * std::fabs(pasted.factor);
    }
  if (laid.rows == 3) laid.m[3] = {0, 0, 0, 1};
  // What rounding leaves of a 0 in the last row. Its size is that of the axes, or of the 1 of 0 0 0 1.
  double size = std::min(std::fabs(laid.m[3][3]), 1.0);
  for (std::size_t i = 0; i < 4; ++i) size = std::max(size, maxAbs(rowOf(laid.m, i)));
  for (std::size_t j = 0; j < 4; ++j)
    if (std::fabs(laid.m[3][j]) < 0x1p-52 * size) laid.m[3][j] = laid.printed[3][j] = 0;
  return laid;
}

std::string addReadings(const PastedMatrix& pasted, const LaidOut& laid, bool isFloat, std::vector<Reading>& found) {
  LayoutReader reader(pasted, laid, isFloat, found);
  reader.read();
  return reader.fault;
}

void addInverses(const PastedMatrix& pasted, const LaidOut& laid, bool isFloat, std::vector<Reading>& found) {
  LayoutReader(pasted, laid, isFloat, found).readInverse();
}

std::string typedWrong(const LaidOut& laid) {
  if (laid.m[3] != std::array<double, 4>{0, 0, 0, 1}) return "";
  const double allowed = tolerance(largestOf(laid.printed));
  if (!(allowed < kBlind)) return "";
  for (const bool byColumns : {false, true}) {
    const Mat4 m = byColumns ? transposed(laid.m) : laid.m;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = rowOf(m, (k + 1) % 3), b = rowOf(m, (k + 2) % 3);
      const double off = std::max({std::fabs(dot(a, b)), std::fabs(dot(a, a) - 1), std::fabs(dot(b, b) - 1)});
      for (const double sign : {1.0, -1.0}) {
        const Vec3 right = scaled(crossOf(a, b), sign), away = sum(rowOf(m, k), -1, right);
        const auto isOff = [&](std::size_t j, double least) { return std::fabs(away[j % 3]) > least; };
        for (std::size_t j = 0; j < 3; ++j)
          if (off <= allowed && isOff(j, 10 * allowed) && !isOff(j + 1, allowed) && !isOff(j + 2, allowed))
            return (byColumns ? "column " : "row ") + std::to_string(k + 1) + " has " + formatDigits(m[k][j], 6) +
                   " where " + formatDigits(right[j], 3) + " would make it a rotation";
      }
    }
  }
  return "";
}

std::string disparityOf(const Mat4& m) {
  //     | 1 0  0   -cx |
  // Q = | 0 1  0   -cy |
  //     | 0 0  0    f  |
  //     | 0 0 1/b   c  |
  const bool isQ = m[0][0] == 1 && m[1][1] == 1 && isDiagonal(m) && m[2][2] == 0 && m[3][0] == 0 && m[3][1] == 0 &&
                   m[3][2] != 0 && -m[0][3] > kFewestPixels && -m[1][3] > kFewestPixels && m[2][3] > kFewestPixels;
  const auto shown = [](double value) { return formatDigits(value, 6); };
  return isQ ? "it is Q of OpenCV's stereoRectify, which makes depths of disparities, and no camera's matrix: f " +
                   shown(m[2][3]) + ", cx " + shown(-m[0][3]) + ", cy " + shown(-m[1][3]) +
                   " of its rectified cameras, " + "baseline " + shown(std::fabs(1 / m[3][2])) +
                   "; P1 and P2 are their matrices"
             : "";
}

}  // namespace viewproj::cmd
