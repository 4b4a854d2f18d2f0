#include "commands/matrix_readings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <regex>

#include "camera/plain_vectors.hpp"
#include "commands/printed_digits.hpp"
#include "numbers/vectors.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

using detail::dot;
namespace {

constexpr double kRightAngle = 1e-3;  ///< off by so much in a camera of exact entries
constexpr double kBlind = 0.2;        ///< a test of right angles that lets more pass is none
constexpr double kFewestPixels = 20;  ///< a smaller focal length is in half widths

Vec3 times(const Vec3& v, double by) { return {v.x * by, v.y * by, v.z * by}; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 rowOf(const Mat4& m, std::size_t i) { return {m[i][0], m[i][1], m[i][2]}; }
double largestOf(const Mat4& e, std::size_t i) { return std::max({e[i][0], e[i][1], e[i][2]}); }

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

double determinant(const Mat4& m) { return dot(rowOf(m, 0), cross(rowOf(m, 1), rowOf(m, 2))); }

// ---- What names say

struct HintRow {
  ReadingKind kind;
  std::regex pattern;
  bool isLetter = false;  ///< a letter alone, which is a name but no word of prose
};

/// Of names in lower case, their words parted by _. Whatever is not the camera: imu, velo, world, w.
#define VIEWPROJ_ANY R"((?!cam|c\d?(?![a-z]))[a-z]+\d?)"
#define VIEWPROJ_CAM R"(c(?:am(?:era)?\d?)?)"
#define VIEWPROJ_START R"((?:^|[^a-z]))"
#define VIEWPROJ_END R"((?![a-z]))"

const std::vector<HintRow>& strongHints() {
  static const std::vector<HintRow> rows = [] {
    const auto row = [](ReadingKind kind, const char* pattern, bool isLetter = false) {
      return HintRow{kind, std::regex(pattern), isLetter};
    };
    using enum ReadingKind;
    return std::vector<HintRow>{
        row(viewProjection,
            "view_?proj|" VIEWPROJ_START "m?vp" VIEWPROJ_END
            R"(|world_?to_?clip|clip_?from_?world|proj\w*[ *@.]+\w*view|full_?proj|culling|camera_?to_?clip_?world)"),
        row(pose, VIEWPROJ_START VIEWPROJ_CAM
            "_?(?:2|to)_?" VIEWPROJ_ANY "|" VIEWPROJ_ANY "_?from_?" VIEWPROJ_CAM VIEWPROJ_END "|" VIEWPROJ_START
            "t_" VIEWPROJ_ANY "_?" VIEWPROJ_CAM VIEWPROJ_END "|" VIEWPROJ_START "t?_?wc" VIEWPROJ_END
            R"(|pose|view_?inv|inv\w*_?view|matrix_?world|local_?to_?world|eyetransform)"),
        row(view, "(?:^|^_|^f_|[^a-z_]|[^f]_|[^o]f_)view(?!port|_?proj|_?inv)|extrin|" VIEWPROJ_START VIEWPROJ_ANY
                  "_?(?:2|to)_?" VIEWPROJ_CAM VIEWPROJ_END "|world_?view|cam(?:era)?_?from_?" VIEWPROJ_ANY
                  "|look_?at|" VIEWPROJ_START "t_" VIEWPROJ_CAM "_?" VIEWPROJ_ANY VIEWPROJ_END "|" VIEWPROJ_START
                  "t_?cw" VIEWPROJ_END),
        row(projection, "proj|persp|frustum|ortho"),
        row(k, "intrin|(?:^|^_|^o_|[^_]|[^o]_|[^t]o_)camera_?matrix|(?:^|[^a-z_])mtx|linemod|calib"),
        row(k, "(?:^|[^a-z0-9])k(?![a-z0-9(])", true),
        row(rotation, VIEWPROJ_START "rot"),
        row(rotation, "(?:^|[^a-z0-9])r(?![a-z0-9(])", true)};
  }();
  return rows;
}

const std::vector<HintRow>& weakHints() {
  static const std::vector<HintRow> rows{
      {ReadingKind::pose, std::regex("world_?matrix|model_?matrix|" VIEWPROJ_START
                                     "model(?!_?view)|transform(?!_for|tocam)|" VIEWPROJ_START "root")},
      {ReadingKind::view, std::regex("model_?view")}};
  return rows;
}

/// worldToCamera and World to Camera as world_to_camera.
std::string underscored(std::string_view text) {
  std::string words;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool isUpper = c >= 'A' && c <= 'Z', isBlank = c == ' ' || c == '\t';
    const char last = i > 0 ? text[i - 1] : ' ';
    if (isUpper && ((last >= 'a' && last <= 'z') || isDigit(last))) words += '_';
    if (isBlank && (last == ' ' || last == '\t') && i > 0) continue;
    words += isBlank ? '_' : isUpper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

/// The kind that the last word of a table speaks of.
std::optional<ReadingKind> lastHint(const std::string& text, const std::vector<HintRow>& rows, bool isName) {
  std::optional<ReadingKind> kind;
  std::ptrdiff_t end = 0;
  for (const HintRow& row : rows)
    if (isName || !row.isLetter)
      for (std::sregex_iterator each(text.begin(), text.end(), row.pattern), none; each != none; ++each)
        if (const std::ptrdiff_t at = each->position() + each->length(); at > end) {
          end = at;
          kind = row.kind;
        }
  return kind;
}

// ---- Readings of one layout

struct Laid {
  MatrixLayout layout;
  Mat4 m, printed;  ///< for column vectors, and the errors of its digits
  std::size_t rows;
  bool isWide;  ///< has a fourth column
};

Laid laidOut(const PastedMatrix& pasted, const std::vector<double>& printed, MatrixLayout layout) {
  const bool isTurned = layout == MatrixLayout::transposed;
  Laid laid{layout, {}, {}, isTurned ? pasted.columns : pasted.rows, (isTurned ? pasted.rows : pasted.columns) == 4};
  for (std::size_t i = 0; i < pasted.rows; ++i)
    for (std::size_t j = 0; j < pasted.columns; ++j) {
      (isTurned ? laid.m[j][i] : laid.m[i][j]) = pasted.at(i, j);
      (isTurned ? laid.printed[j][i] : laid.printed[i][j]) = printed[i * pasted.columns + j] * std::fabs(pasted.factor);
    }
  if (laid.rows == 3) laid.m[3] = {0, 0, 0, 1};
  return laid;
}

class LayoutReader {
 public:
  LayoutReader(const PastedMatrix& pasted, const Laid& laid, bool isFloat, std::vector<Reading>& found)
      : pasted_(pasted), laid_(laid), m_(laid.m), isFloat_(isFloat), found_(found) {
    setErrors({});
  }

  void read() {
    if (laid_.rows == 3 && !laid_.isWide) return readThree();
    if (laid_.rows == 3) return readThreeByFour();
    readFour();
  }

  std::string fault;

 private:
  void setErrors(const Vec3& eye) {
    errors_ = laid_.printed;
    addRounding(errors_, m_, isFloat_, eye);
    if (laid_.rows == 3) errors_[3] = {};
  }

  double largestError() const {
    return std::max({largestOf(errors_, 0), largestOf(errors_, 1), largestOf(errors_, 2)});
  }

  bool isRotation() const {
    const double allowed = tolerance(largestError());
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
  }

  /// K: zeros below the diagonal, none on it. Signs are axes.
  bool addK() {
    const double largest =
        std::max({detail::maxAbs(rowOf(m_, 0)), detail::maxAbs(rowOf(m_, 1)), detail::maxAbs(rowOf(m_, 2))});
    const double below = std::max({std::fabs(m_[1][0]), std::fabs(m_[2][0]), std::fabs(m_[2][1])});
    if (!(below <= 1e-12 * largest && m_[0][0] != 0 && m_[1][1] != 0 && m_[2][2] != 0)) return false;
    static constexpr std::string_view kAxes[] = {"RDF", "RDB", "RUF", "RUB", "LDF", "LDB", "LUF", "LUB"};
    const double size = std::fabs(m_[2][2]);
    add(ReadingKind::k).pixels = PixelLens{std::fabs(m_[0][0]) / size,
                                           std::fabs(m_[1][1]) / size,
                                           m_[0][2] / m_[2][2],
                                           m_[1][2] / m_[2][2],
                                           m_[0][1] / size,
                                           kAxes[4 * (m_[0][0] < 0) + 2 * (m_[1][1] < 0) + (m_[2][2] < 0)]};
    return true;
  }

  /// P = K [R | t], with skew. The eye is the null vector.
  std::optional<Reading> readP() const {
    const double size = length(rowOf(m_, 2));
    const double lengths = length(rowOf(m_, 0)) * length(rowOf(m_, 1)) * size, volume = determinant(m_);
    if (!(std::fabs(volume) > 1e-9 * lengths)) return std::nullopt;
    const Vec3 forward = times(rowOf(m_, 2), 1 / size), x = times(rowOf(m_, 0), 1 / size),
               y = times(rowOf(m_, 1), 1 / size);
    Reading r;
    r.kind = ReadingKind::p;
    r.layout = laid_.layout;
    PixelLens& lens = r.pixels.emplace();
    lens.cx = dot(x, forward);
    lens.cy = dot(y, forward);
    const Vec3 down = minus(y, times(forward, lens.cy));
    lens.fy = length(down);
    lens.skew = dot(x, times(down, 1 / lens.fy));
    const Vec3 right = minus(minus(x, times(forward, lens.cx)), times(down, lens.skew / lens.fy));
    lens.fx = length(right);
    // P and -P are the same camera. One of the two has a rotation.
    const double sign = volume < 0 ? -1 : 1;
    r.rows = {times(right, sign / lens.fx), times(down, sign / lens.fy), times(forward, sign)};
    r.isMirrored = volume < 0 && m_[2] == std::array<double, 4>{0, 0, 1, 0};
    const Vec3 columns[] = {cross(rowOf(m_, 1), rowOf(m_, 2)), cross(rowOf(m_, 2), rowOf(m_, 0)),
                            cross(rowOf(m_, 0), rowOf(m_, 1))};
    Vec3 eye;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) eye[j] -= columns[i][j] * m_[i][3] / volume;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = errors_[i][0] * std::fabs(eye.x) + errors_[i][1] * std::fabs(eye.y) +
                         errors_[i][2] * std::fabs(eye.z) + errors_[i][3];
      for (std::size_t j = 0; j < 3; ++j) r.eyeError[j] += std::fabs(columns[i][j] / volume) * off;
    }
    const double more = 1 / std::max(1 - 4 * rowError(), 0.05);
    r.eyeError = times(r.eyeError, more);
    r.eye = eye;
    return r;
  }

  /// The largest error of a row over its length.
  double rowError() const {
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (const double size = length(rowOf(m_, i)); size > 0) error = std::max(error, length(rowOf(errors_, i)) / size);
    return error;
  }

  bool hasSkew(const PixelLens& lens, double share) const {
    const double size = std::max({lens.fx, lens.fy, std::fabs(lens.cx), std::fabs(lens.cy)});
    return std::fabs(lens.skew) >
           std::max(6 * std::numbers::sqrt3 * rowError() * size, share * std::max(lens.fx, lens.fy));
  }

  void readThree() {
    const bool isExact = rigidity(m_) < 1e-9;
    if (isRotation()) addRotation();
    if ((isExact && laid_.layout != MatrixLayout::either) || !addK())
      fault = "it is no rotation, and has numbers below its diagonal or zeros on it, as no K has";
  }

  void readThreeByFour() {
    if (isRotation()) return readFour();
    if (laid_.layout == MatrixLayout::transposed) return;
    const auto p = readP();
    // Twelve numbers in a row are many things: a P only where its third row is a unit vector and pixels are upright.
    if (p && (!pasted_.isInMemoryOrder || (std::fabs(length(rowOf(m_, 2)) - 1) <= 1e-3 && !hasSkew(*p->pixels, 1e-6))))
      found_.push_back(*p);
    else
      fault = "it is no K [R | t]: its left 3x3 has no inverse";
  }

  void addCamera(const MatrixCamera& camera, double scaledBy = 1) {
    constexpr ReadingKind kKinds[] = {ReadingKind::projection, ReadingKind::view, ReadingKind::pose,
                                      ReadingKind::viewProjection};
    Reading& r = add(kKinds[static_cast<std::size_t>(camera.kind)]);
    r.camera = camera;
    r.camera->layout = laid_.layout;
    r.scaledBy = scaledBy;
    if (r.kind == ReadingKind::view || r.kind == ReadingKind::pose) r.isCentred = scaledBy == 1 && isCentred(r.kind);
  }

  /// Whether the world's origin lies on the z axis of the camera, which is turned.
  bool isCentred(ReadingKind kind) const {
    Vec3 t{m_[0][3], m_[1][3], m_[2][3]};
    const double error =
        4 * (std::max({errors_[0][3], errors_[1][3], errors_[2][3]}) + largestError() * length(t)) + 1e-6 * length(t);
    if (kind == ReadingKind::pose) {
      Vec3 turned;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) turned[i] += m_[j][i] * t[j];
      t = turned;
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
    const bool isAffine = m_[3][0] == 0 && m_[3][1] == 0 && m_[3][2] == 0;
    const bool isPose = std::any_of(all.begin(), all.end(), [](const MatrixCamera& c) { return !c.lens; });
    if (isPose && m_[0][3] == 0 && m_[1][3] == 0 && m_[2][3] == 0) addRotation();
    const double scale = scaleOfPose(all);
    if (scale != 1) addScaledPoses(scale);
    for (const MatrixCamera& c : all) {
      addCamera(c);
      found_.back().isUniform = scale != 1;
    }
    if (isAffine && all.empty()) {
      const bool isPlaced = m_[0][3] != 0 || m_[1][3] != 0 || m_[2][3] != 0;
      if (!isPlaced && addK()) return;
      const auto p = readP();
      if (p && std::min(p->pixels->fx, p->pixels->fy) > kFewestPixels && rowError() < kBlind / 2 &&
          !hasSkew(*p->pixels, 1e-3) && p->pixels->fx < 5 * p->pixels->fy && p->pixels->fy < 5 * p->pixels->fx)
        found_.push_back(*p);
    }
    for (const MatrixCamera& c : all)
      if (addPixels(c)) break;
  }

  /// The length of rows that are at right angles and as long as each other, turned; else 1.
  double scaleOfPose(const std::vector<MatrixCamera>& all) const {
    if (all.empty() || all.front().kind != MatrixKind::viewProjection || !all.front().lens->orthographic) return 1;
    double least = HUGE_VAL, most = 0, turn = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double size = length(rowOf(m_, i));
      least = std::min(least, size);
      most = std::max(most, size);
      turn = std::max(turn, largestOf(errors_, i) / size);
    }
    const bool isDiagonal =
        m_[0][1] == 0 && m_[0][2] == 0 && m_[1][0] == 0 && m_[1][2] == 0 && m_[2][0] == 0 && m_[2][1] == 0;
    return !isDiagonal && most / least < 1 + tolerance(turn) && all.front().scale == 1
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
      for (const MatrixCamera& c : cameras(m, errors, kind)) addCamera(c, scale);
    }
  }

  /// The lens of rows x, y and w that count pixels.
  bool addPixels(const MatrixCamera& c) {
    if (!c.lens || c.lens->orthographic || c.convention.ndcY == NdcY::down) return false;
    const MatrixLens& lens = *c.lens;
    const double width = lens.right - lens.left, height = lens.top - lens.bottom;
    if (!(2 / width > kFewestPixels && 2 / height > kFewestPixels)) return false;
    if (c.scale != 1 && !(c.kind == MatrixKind::viewProjection && std::fabs(width / height - 1) < 0.02)) return false;
    Reading& r = add(c.kind == MatrixKind::projection ? ReadingKind::k : ReadingKind::p);
    r.pixels =
        PixelLens{2 / width, 2 / height, -(lens.left + lens.right) / width, -(lens.bottom + lens.top) / height, 0, {}};
    r.eye = c.pose ? c.pose->eye() : Vec3{};
    r.eyeError = c.eyeError;
    if (c.pose) r.rows = {c.pose->right(), c.pose->up(), c.pose->forward()};
    return true;
  }

  const PastedMatrix& pasted_;
  const Laid& laid_;
  const Mat4& m_;
  Mat4 errors_;
  bool isFloat_;
  std::vector<Reading>& found_;
};

/// "row 2 has -2.241 where -0.241 would make it a rotation": of a 3x3 part in which two rows, or columns, are unit
/// vectors at a right angle and the third is their cross product but for one entry. Else empty.
std::string typedWrong(const Laid& laid) {
  if (laid.m[3] != std::array<double, 4>{0, 0, 0, 1}) return "";
  for (const bool byColumns : {false, true}) {
    const Mat4 m = byColumns ? transposed(laid.m) : laid.m, e = byColumns ? transposed(laid.printed) : laid.printed;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = rowOf(m, (k + 1) % 3), b = rowOf(m, (k + 2) % 3);
      const double allowed = tolerance(std::max({largestOf(e, 0), largestOf(e, 1), largestOf(e, 2)}));
      const double off = std::max({std::fabs(dot(a, b)), std::fabs(dot(a, a) - 1), std::fabs(dot(b, b) - 1)});
      if (!(allowed < kBlind && off <= allowed)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Vec3 right = times(cross(a, b), sign);
        std::size_t wrong = 3, count = 0;
        for (std::size_t j = 0; j < 3; ++j)
          if (std::fabs(m[k][j] - right[j]) > allowed) {
            wrong = j;
            ++count;
          }
        if (count == 1 && std::fabs(m[k][wrong] - right[wrong]) > 10 * allowed)
          return (byColumns ? "column " : "row ") + std::to_string(k + 1) + " has " + formatDigits(m[k][wrong], 6) +
                 " where " + formatDigits(right[wrong], 3) + " would make it a rotation";
      }
    }
  }
  return "";
}

// ---- Order

/// Significant digits of the roundest number in the interval.
double digitsWithin(const PlaneDistance& d) {
  if (std::isinf(d.value) || (d.low <= 0 && d.high >= 0)) return 0;
  for (int digits = 1; digits < 17; ++digits)
    if (const double round = toDigits(d.value, digits); d.low <= round && round <= d.high) return digits;
  return 17;
}

bool holdsPowerOfTen(const PlaneDistance& d) {
  for (int k = -6; k < 6; ++k)
    if (d.low <= std::pow(10.0, k) && std::pow(10.0, k) <= d.high) return true;
  return false;
}

double decimalsWithin(double value, double error) {
  constexpr int kMost = 12;
  for (int k = 0; k < kMost; ++k)
    if (std::fabs(std::round(value * std::pow(10.0, k)) / std::pow(10.0, k) - value) <= error) return k;
  return kMost;
}

double costOfDepth(const Reading& r) {
  const MatrixLens& lens = *r.camera->lens;
  const Convention& c = r.camera->convention;
  double cost = (c.reverseZ ? 4 : 0) + (lens.orthographic ? 1 : 0) + (r.isUniform ? 12 : 0);
  const double pixels = std::min(2 / (lens.right - lens.left), 2 / (lens.top - lens.bottom));
  if (!lens.orthographic && pixels > kFewestPixels) cost += 25;
  if (!lens.depthFault.empty()) return cost;
  cost += 0.5 * (digitsWithin(lens.zNear) + digitsWithin(lens.zFar));
  if (lens.zNear.value > 0 && !holdsPowerOfTen(lens.zNear)) cost += 0.4;
  // OpenGL's depth looks along -z, Direct3D's along +z.
  const bool isGl = c.ndcZ == NdcZ::minusOneToOne;
  return cost + (r.kind == ReadingKind::projection ? ((c.view == ViewAxes::RUB) != isGl ? 0.6 : 0) : isGl ? 0 : 0.3);
}

double costOf(const Reading& r, const std::vector<Reading>& all, const KindHint& hint, const PastedMatrix& m) {
  using enum ReadingKind;
  constexpr double kUsual[] = {0, 1, 2, 3, 0, 0, 4};  // in the order of ReadingKind
  double cost = kUsual[static_cast<std::size_t>(r.kind)];
  const bool isHinted = r.kind == hint.kind || (r.kind == p && (hint.kind == k || hint.kind == projection));
  if (hint.kind && !isHinted) cost += hint.weight;
  if (r.kind == k && r.pixels->fx < kFewestPixels && hint.kind != k) cost += 5;
  if (m.isByColumns && r.layout == MatrixLayout::asWritten) cost += 6;
  if (r.camera && r.camera->lens) cost += costOfDepth(r);
  if (r.isCentred) cost -= 3;
  if (r.scaledBy != 1 && r.kind == view) cost += 3;
  if ((r.kind == view || r.kind == pose) && !((hint.kind == view || hint.kind == pose) && hint.weight > 10)) {
    double error = 1e-300;
    for (const Reading& other : all)
      if ((other.kind == view || other.kind == pose) && other.layout == r.layout)
        error =
            std::max({error, detail::maxAbs(other.camera->eyeError), 1e-9 * detail::maxAbs(other.camera->pose->eye())});
    const Vec3 eye = r.camera->pose->eye();
    for (std::size_t i = 0; i < 3; ++i) cost += 0.34 * decimalsWithin(eye[i], error);
  }
  return cost;
}

bool isTurned(Vectors vectors, Storage storage) {
  return (vectors == Vectors::row) != (storage == Storage::columnMajor);
}

}  // namespace

KindHint hintOf(const PastedMatrix& m) {
  for (const char* mark : {"<Matrix ", " O: (", "matrix3 ["})
    if (m.context.find(mark) != std::string::npos) return {ReadingKind::pose, 20};
  constexpr std::size_t kMost = 300;
  const std::string name = m.name.substr(0, kMost);
  std::size_t part = 0;  // transform of scene.camera.transform
  for (std::size_t i = 1; i + 1 < name.size(); ++i)
    if (name[i] == '.' && (isLetter(name[i + 1]) || name[i + 1] == '_') && name[i - 1] != ' ') part = i + 1;
  const std::string tail = name.substr(part);
  for (const std::string* text : {&tail, &name, &m.context}) {
    const std::string words = underscored(*text);
    if (const auto kind = lastHint(words, strongHints(), text != &m.context)) return {kind, 20};
    if (const auto kind = lastHint(words, weakHints(), true)) return {kind, 3};
  }
  return {};
}

Mat4 matrixOf(const PastedMatrix& pasted, MatrixLayout layout) {
  return laidOut(pasted, std::vector<double>(pasted.numbers.size()), layout).m;
}

MatrixReadings readingsOf(const PastedMatrix& pasted) {
  MatrixReadings result;
  for (const PrintedNumber& n : pasted.numbers)
    if (!std::isfinite(n.value)) {
      result.fault = "it has " + n.text + ", which is not a finite number";
      return result;
    }
  result.isFloat = areFloats(pasted.numbers);
  const std::vector<double> printed = printedErrors(pasted.numbers);
  const Mat4 written = matrixOf(pasted, MatrixLayout::asWritten);
  using enum MatrixLayout;
  std::vector<MatrixLayout> layouts{asWritten, transposed};
  if (pasted.rows == pasted.columns && written == viewproj::transposed(written)) layouts = {either};
  if (pasted.rows != pasted.columns) layouts = {pasted.rows < pasted.columns ? asWritten : transposed};
  if (pasted.isCss && pasted.rows == 4) layouts = {transposed};
  for (const MatrixLayout layout : layouts) {
    const Laid laid = laidOut(pasted, printed, layout);
    LayoutReader reader(pasted, laid, result.isFloat, result.readings);
    reader.read();
    if (result.fault.empty()) result.fault = reader.fault;
    if (const std::string typed = typedWrong(laid); !typed.empty() && layout == layouts.front()) result.fault = typed;
  }
  // A camera without depth, and then a multiple of one, only where nothing else fits.
  const auto hasNoDepth = [](const Reading& r) {
    return r.camera && r.camera->lens && !r.camera->lens->depthFault.empty();
  };
  const auto isMultiple = [](const Reading& r) {
    return r.camera && r.camera->lens && !r.camera->lens->orthographic && r.camera->scale != 1;
  };
  if (!std::all_of(result.readings.begin(), result.readings.end(), hasNoDepth))
    std::erase_if(result.readings, hasNoDepth);
  if (!std::all_of(result.readings.begin(), result.readings.end(), isMultiple))
    std::erase_if(result.readings, isMultiple);
  if (!result.readings.empty()) result.fault.clear();
  const KindHint hint = hintOf(pasted);
  for (Reading& r : result.readings) r.cost = costOf(r, result.readings, hint, pasted);
  std::stable_sort(result.readings.begin(), result.readings.end(),
                   [](const Reading& a, const Reading& b) { return a.cost < b.cost; });
  return result;
}

bool fits(const Reading& reading, const Convention& c, bool isInMemoryOrder) {
  if (!reading.camera) return true;
  const MatrixCamera& r = *reading.camera;
  if (r.lens && ((r.lens->depthFault.empty() && c.ndcZ != r.convention.ndcZ) || c.ndcY != r.convention.ndcY))
    return false;
  if (r.kind != MatrixKind::viewProjection && c.view != r.convention.view) return false;
  const bool turned = reading.layout == MatrixLayout::transposed;
  return reading.layout == MatrixLayout::either || isTurned(c.vectors, c.storage) == turned ||
         (!isInMemoryOrder && (c.vectors == Vectors::row) == turned);
}

std::vector<Reading> readingsIn(std::vector<Reading> readings, const Convention& c, bool isInMemoryOrder) {
  std::erase_if(readings, [&](const Reading& r) { return !fits(r, c, isInMemoryOrder); });
  const auto isOwn = [&](const Reading& r) {
    return !r.camera || ((!r.camera->lens || r.camera->convention.reverseZ == c.reverseZ) &&
                         (r.kind == ReadingKind::projection || r.camera->convention.world == c.world));
  };
  for (const auto& [name, kind] : kReadingKinds) {
    const auto isOfKind = [kind = kind](const Reading& r) { return r.kind == kind; };
    if (std::any_of(readings.begin(), readings.end(), [&](const Reading& r) { return isOfKind(r) && isOwn(r); }))
      std::erase_if(readings, [&](const Reading& r) { return isOfKind(r) && !isOwn(r); });
  }
  return readings;
}

Mat4 converted(const Reading& reading, const Mat4& matrix, const Convention& to) {
  if (!reading.camera) {
    const bool isRotation = reading.kind == ReadingKind::rotation;
    throw CameraError("", isRotation ? "is a rotation, which is the same in every convention"
                                     : "is a calibration in pixels, and has no form in other conventions; matrix FILE "
                                       "reads one in a file of its format");
  }
  const Convention& from = reading.camera->convention;
  Mat4 m = matrix;
  const auto negateRow = [&](std::size_t i) {
    for (double& entry : m[i]) entry = 0 - entry;
  };
  const auto negateColumn = [&](std::size_t j) {
    for (auto& row : m.m) row[j] = 0 - row[j];
  };
  // V' = X V, P' = P X, (V^-1)' = V^-1 X, with X the signs of the view's axes.
  const auto isDown = [](const Convention& c) { return c.view == ViewAxes::RDF; };
  const auto isBack = [](const Convention& c) { return c.view == ViewAxes::RUB; };
  const bool flipsY = isDown(from) != isDown(to), flipsZ = isBack(from) != isBack(to);
  if (reading.kind == ReadingKind::view) {
    if (flipsY) negateRow(1);
    if (flipsZ) negateRow(2);
    return m;
  }
  if (reading.kind != ReadingKind::viewProjection) {
    if (flipsY) negateColumn(1);
    if (flipsZ) negateColumn(2);
  }
  if (reading.kind == ReadingKind::pose) return m;
  if (from.ndcY != to.ndcY) negateRow(1);
  if (!reading.camera->lens->depthFault.empty()) throw CameraError("", reading.camera->lens->depthFault);
  const auto ends = [](const Convention& c) {
    const double first = c.ndcZ == NdcZ::zeroToOne ? 0 : -1;
    return c.reverseZ ? std::pair(1.0, first) : std::pair(first, 1.0);
  };
  const auto [nearFrom, farFrom] = ends(from);
  const auto [nearTo, farTo] = ends(to);
  const double byZ = (farTo - nearTo) / (farFrom - nearFrom), byW = nearTo - byZ * nearFrom;
  for (std::size_t j = 0; j < 4; ++j) m[2][j] = byZ * m[2][j] + byW * m[3][j] + 0.0;
  return m;
}

}  // namespace viewproj::cmd
