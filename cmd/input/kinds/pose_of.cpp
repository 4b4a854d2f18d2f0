#include "input/kinds/pose_of.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "input/convention_names.hpp"
#include "input/distortion_names.hpp"
#include "input/kinds/split_matrix.hpp"
#include "numbers/degrees.hpp"
#include "numbers/radians.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

std::array<DDVec3, 3> transposed(const std::array<DDVec3, 3>& m) {
  return {DDVec3{m[0].x, m[1].x, m[2].x}, DDVec3{m[0].y, m[1].y, m[2].y}, DDVec3{m[0].z, m[1].z, m[2].z}};
}

DDVec3 times(const std::array<DDVec3, 3>& columns, const DDVec3& v) {
  return columns[0] * v.x + columns[1] * v.y + columns[2] * v.z;
}

/// The columns of the rotation by a vector whose length is the angle in radians.
std::array<DDVec3, 3> columnsOfVector(const Vec3& r) {
  constexpr double kLargest = 1e6;  // radians: beyond, the angle is not known to its last digits
  constexpr DoubleDouble kTurn{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};
  std::array<DDVec3, 3> columns{DDVec3{1, 0, 0}, DDVec3{0, 1, 0}, DDVec3{0, 0, 1}};
  if (!(maxAbs(r) <= kLargest))
    throw CameraError("rotation", "is no rotation vector: its length is the angle in radians");
  if (!(maxAbs(r) > 0)) return columns;
  DDVec3 axis = normalized(toDoubleDouble(r));
  DoubleDouble angle = DoubleDouble(1) / inverseLength(toDoubleDouble(r));
  angle = angle - kTurn * DoubleDouble(std::round(angle.hi / kTurn.hi));
  if (angle.hi < 0) {
    angle = -angle;
    axis = -axis;
  }
  // From the tangent of a quarter of the angle, which is at most 1, by way of those of its half.
  const DoubleDouble q = angle.hi > 0 ? tanHalfRadians(timesPowerOfTwo(angle, 0.5)) : DoubleDouble();
  const DoubleDouble one = 1, qq = q * q, half = one / (one + qq);
  const DoubleDouble s = timesPowerOfTwo(q * half, 2), c = (one - qq) * half;  // of half the angle
  const DDVec3 v = axis * s;
  const auto twice = [](DoubleDouble a) { return timesPowerOfTwo(a, 2); };
  columns[0] = {one - twice(v.y * v.y + v.z * v.z), twice(v.x * v.y + v.z * c), twice(v.x * v.z - v.y * c)};
  columns[1] = {twice(v.x * v.y - v.z * c), one - twice(v.x * v.x + v.z * v.z), twice(v.y * v.z + v.x * c)};
  columns[2] = {twice(v.x * v.z + v.y * c), twice(v.y * v.z - v.x * c), one - twice(v.x * v.x + v.y * v.y)};
  return columns;
}

std::array<DDVec3, 3> columnsOfQuaternion(const Quaternion& q) {
  const DoubleDouble x = q.x, y = q.y, z = q.z, w = q.w;
  // Scaled so that squares neither vanish nor overflow.
  const double largest = std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z), std::fabs(q.w)});
  if (!(largest > 0) || !std::isfinite(largest))
    throw CameraError("rotation", "is no quaternion: expected finite numbers, not all 0");
  const int k = -std::ilogb(largest);
  const DoubleDouble a = scaleByPowerOfTwo(x, k), b = scaleByPowerOfTwo(y, k), c = scaleByPowerOfTwo(z, k),
                     d = scaleByPowerOfTwo(w, k);
  const DoubleDouble two = DoubleDouble(2) / (a * a + b * b + c * c + d * d), one = 1;
  return {DDVec3{one - two * (b * b + c * c), two * (a * b + c * d), two * (a * c - b * d)},
          DDVec3{two * (a * b - c * d), one - two * (a * a + c * c), two * (b * c + a * d)},
          DDVec3{two * (a * c + b * d), two * (b * c - a * d), one - two * (a * a + b * b)}};
}

/// Which of right, up and forward a letter is, and its sign.
std::pair<int, double> axisOf(char letter) {
  const std::size_t at = std::string_view("RLUDFB").find(letter);
  return {static_cast<int>(at / 2), at % 2 == 0 ? 1.0 : -1.0};
}

/// Axes that the library takes as they are, or else the place of each of RDF's or RUF's among them.
struct AxesOfKind {
  CameraAxes axes;
  bool isNative = true;
  std::array<std::size_t, 3> from{0, 1, 2};
  std::array<double, 3> sign{1, 1, 1};
};

AxesOfKind axesOf(const Kind& kind, const ConventionPreset& preset) {
  const auto named = kind.words.find("axes");
  if (named == kind.words.end()) return {preset.cameraAxes};
  for (const auto& [name, axes] : kCameraAxesNames)
    if (name == named->second) return {axes};
  AxesOfKind result{CameraAxes::RUB, false};
  const std::string_view target = preset.convention.world == Handedness::left ? "RUF" : "RUB";
  if (preset.convention.world == Handedness::left) result.axes = CameraAxes::RUF;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto [axis, sign] = axisOf(target[i]);
      const auto [other, otherSign] = axisOf(named->second[j]);
      if (axis != other) continue;
      result.from[i] = j;
      result.sign[i] = sign * otherSign;
    }
  return result;
}

std::array<DDVec3, 3> rearranged(const std::array<DDVec3, 3>& columns, const AxesOfKind& axes) {
  std::array<DDVec3, 3> result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = columns[axes.from[i]] * DoubleDouble(axes.sign[i]);
  return result;
}

/// A 3x4 or 4x4 matrix.
std::optional<Mat4> matrixOf(const CameraPlace& camera) {
  const auto found = camera.find("matrix");
  if (!found) return std::nullopt;
  std::vector<double> all;
  const bool isUpper = numbersOf(camera.document(), *found, all) && all.size() == 12;
  if (!isUpper && all.size() != 16) camera.document().fail(found->path, "expected 4 rows of 4 numbers, or the upper 3");
  const std::vector<double> n = *camera.matrix("matrix", isUpper ? 3 : 4, 4);
  Mat4 m{};
  m[3] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < n.size(); ++i) m[i / 4][i % 4] = n[i];
  return m;
}

/// A 3x3 matrix, in a larger one.
std::optional<Mat4> rotationOf(const CameraPlace& camera) {
  const auto n = camera.matrix("rotation", 3, 3);
  if (!n) return std::nullopt;
  Mat4 m{};
  m[3] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < 9; ++i) m[i / 3][i % 3] = (*n)[i];
  return m;
}

std::optional<Vec3> vectorOf(const CameraPlace& camera, std::string_view word) {
  const auto n = camera.numbers(word, 3);
  if (!n) return std::nullopt;
  return Vec3{(*n)[0], (*n)[1], (*n)[2]};
}

/// Throws where a field beside a rotation vector says that it is in degrees.
void requireRadians(const CameraPlace& camera) {
  const Found vector = *camera.find("rotationVector");
  const auto singular = [](std::string_view name) {
    const std::string plain = plainName(name);
    return plain.substr(0, plain.size() - (plain.ends_with('s') ? 1 : 0));
  };
  const std::string plain = singular(vector.path.back());
  for (const auto& item : camera.own().value->items()) {
    const std::string name = singular(item.key());
    if ((name != plain + "unit" && name != "rotationunit" && name != "angleunit") || !item.value().is_string())
      continue;
    if (!plainName(item.value().get_ref<const std::string&>()).starts_with("deg")) continue;
    Path path = camera.own().path;
    path.push_back(item.key());
    camera.document().fail(path,
                           "is degrees, and " + dotted(vector.path) + " is read in radians; multiply it by pi/180");
  }
}

/// What the library complains about, at the place of the word.
template <class Make>
auto locatedAt(const CameraPlace& camera, std::string_view rotation, std::string_view position, Make make) {
  try {
    return make();
  } catch (const CameraError& e) {
    const bool isPlace = e.field() == "position" && !position.empty();
    // Its advice is for files that can say which axes they use.
    const auto axes = camera.kind().words.find("axes");
    if (e.message().starts_with("is a mirroring") && axes != camera.kind().words.end())
      camera.fail(rotation, "with axes " + axes->second + " is a mirroring: one axis of these has the wrong sign");
    if (e.message().starts_with("is a mirroring"))
      camera.fail(rotation,
                  "mirrors (its determinant is negative): it is no rotation, or one of its axes has the "
                  "wrong sign");
    camera.fail(isPlace ? position : rotation, e.message());
  }
}

/// Turns one after the other, each about an axis as the ones before have turned it.
std::array<DDVec3, 3> columnsOfTurns(const CameraPlace& camera, const std::vector<double>& angles) {
  const std::string& order = camera.kind().words.at("euler");
  const bool inRadians = camera.kind().words.at("eulerUnit") == "radians";
  std::array<DDVec3, 3> columns{DDVec3{1, 0, 0}, DDVec3{0, 1, 0}, DDVec3{0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = static_cast<std::size_t>(order[i] - 'X'), a = (axis + 1) % 3, b = (axis + 2) % 3;
    DoubleDouble s, c;
    if (inRadians) {
      Vec3 about{};
      (axis == 0 ? about.x : axis == 1 ? about.y : about.z) = angles[i];
      const auto turn = locatedAt(camera, "euler", "", [&] { return columnsOfVector(about); });
      const auto at = [](const DDVec3& v, std::size_t j) { return j == 0 ? v.x : j == 1 ? v.y : v.z; };
      c = at(turn[a], a);
      s = at(turn[a], b);
    } else {
      if (!std::isfinite(angles[i])) camera.fail("euler", "expected finite numbers");
      const SinCos both = sinCosDegrees(angles[i]);
      s = scaleByPowerOfTwo(both.sine.rounded().value, both.sine.rounded().exponent);
      c = scaleByPowerOfTwo(both.cosine.rounded().value, both.cosine.rounded().exponent);
    }
    const DDVec3 first = columns[a], second = columns[b];
    columns[a] = first * c + second * s;
    columns[b] = second * c + -(first * s);
  }
  return columns;
}

/// All that the row says of the pose, read.
struct Parts {
  std::optional<Mat4> matrix;  ///< of 3x4 or 4x4, or of the rotation
  std::optional<std::array<DDVec3, 3>> columns;
  std::optional<Quaternion> quaternion;
  std::optional<Vec3> translation, position;
  std::string_view rotationWord, placeWord;
};

Parts readParts(const CameraPlace& camera) {
  Parts parts;
  const auto take = [&](std::string_view word) {
    if (!parts.rotationWord.empty())
      camera.fail(word, "says what " + camera.pathOf(parts.rotationWord).back() + " does; one of them is expected");
    parts.rotationWord = word;
  };
  if ((parts.matrix = matrixOf(camera))) {
    take("matrix");
    parts.placeWord = "matrix";
    return parts;
  }
  parts.translation = vectorOf(camera, "translation");
  parts.position = vectorOf(camera, "position");
  parts.placeWord = parts.translation ? "translation" : parts.position ? "position" : "";
  if (parts.translation && parts.position) camera.fail("position", "says what the translation does");
  if ((parts.matrix = rotationOf(camera))) take("rotation");
  if (const auto n = camera.numbers("quaternion", 4)) {
    take("quaternion");
    parts.quaternion = camera.kind().word("quaternionOrder") == "wxyz" ? Quaternion{(*n)[1], (*n)[2], (*n)[3], (*n)[0]}
                                                                       : Quaternion{(*n)[0], (*n)[1], (*n)[2], (*n)[3]};
    parts.columns = locatedAt(camera, "quaternion", "", [&] { return columnsOfQuaternion(*parts.quaternion); });
  }
  if (const auto v = vectorOf(camera, "rotationVector")) {
    take("rotationVector");
    requireRadians(camera);
    parts.columns = locatedAt(camera, "rotationVector", "", [&] { return columnsOfVector(*v); });
  }
  if (const auto n = camera.numbers("euler", 3)) {
    take("euler");
    parts.columns = columnsOfTurns(camera, *n);
  }
  if (parts.rotationWord.empty() && !parts.placeWord.empty()) {
    std::string names;
    for (const char* const word : {"rotation", "rotationVector", "quaternion", "euler"})
      for (const Steps& path : camera.kind().at(word).paths) names += (names.empty() ? "" : " or ") + dotted(path);
    camera.fail(parts.placeWord, names.empty() ? "needs a rotation beside it, and the row of its kind names none"
                                               : "needs " + names + " beside it");
  }
  if (!parts.rotationWord.empty() && parts.placeWord.empty()) {
    std::string name;
    for (const char* const word : {"translation", "position"})
      for (const Steps& path : camera.kind().at(word).paths)
        if (name.empty()) name = dotted(path);
    camera.fail(parts.rotationWord,
                name.empty() ? "needs a position or translation beside it, and the row of its kind names none"
                             : "needs " + name + " beside it");
  }
  return parts;
}

/// Rows or columns of the 3x3 of a matrix in double-double.
std::array<DDVec3, 3> columnsIn(const Mat4& m) {
  std::array<DDVec3, 3> columns;
  for (std::size_t j = 0; j < 3; ++j) columns[j] = {m[0][j], m[1][j], m[2][j]};
  return columns;
}

DDVec3 lastColumnIn(const Mat4& m) { return {m[0][3], m[1][3], m[2][3]}; }

/// The inverse of columns that are a rotation up to kPoseOrthogonality, which poseFromColumns tells.
std::array<DDVec3, 3> inverted(const std::array<DDVec3, 3>& c) {
  const DDVec3 r0 = cross(c[1], c[2]), r1 = cross(c[2], c[0]), r2 = cross(c[0], c[1]);
  const DoubleDouble one = 1, determinant = c[0].x * r0.x + c[0].y * r0.y + c[0].z * r0.z;
  return transposed({r0 * (one / determinant), r1 * (one / determinant), r2 * (one / determinant)});
}

bool isToWorld(const CameraPlace& camera) { return camera.kind().word("pose") == "worldFromCamera"; }

Placed placed(const CameraPlace& camera, const Parts& parts) {
  Placed result;
  const auto columns = parts.columns ? *parts.columns : columnsIn(*parts.matrix);
  const DDVec3 t = parts.rotationWord == "matrix" ? lastColumnIn(*parts.matrix)
                   : parts.translation            ? toDoubleDouble(*parts.translation)
                                                  : DDVec3{};
  if (isToWorld(camera)) {
    result.columns = columns;
    result.eye = t;
  } else {
    result.columns = parts.columns ? transposed(columns) : inverted(columns);
    result.eye = -times(result.columns, t);
  }
  if (parts.position) result.eye = toDoubleDouble(*parts.position);
  if (const auto scale = camera.kind().numbers.find("scale"); scale != camera.kind().numbers.end())
    result.eye = result.eye * DoubleDouble(scale->second);
  return result;
}

/// "cam" and 12 of cam12; nothing of a name that ends in no number.
struct Numbered {
  std::string_view stem;
  std::size_t digits;
  unsigned long number;
};

std::optional<Numbered> numberedKey(std::string_view key) {
  constexpr std::size_t kMostDigits = 6;
  const std::size_t stem = key.find_last_not_of("0123456789") + 1, digits = key.size() - stem;
  if (digits == 0 || digits > kMostDigits) return std::nullopt;
  return Numbered{key.substr(0, stem), digits, std::stoul(std::string(key.substr(stem)))};
}

/// The entry before it of a list, or of a chain of names that end in numbers, as in cam0, cam1. It need be no camera
/// that can be read.
std::optional<CameraPlace> previousOf(const CameraPlace& camera) {
  const auto key = numberedKey(camera.key());
  if (!key || key->number == 0) return std::nullopt;
  const std::string stem(key->stem), before = std::to_string(key->number - 1);
  if (auto found = camera.sibling(stem + before)) return found;
  return camera.sibling(stem + std::string(key->digits - std::min(key->digits, before.size()), '0') + before);
}

/// The same for no two paths.
std::string keyOf(const Path& path) {
  std::string key;
  for (const std::string& step : path) key += step + '\0';
  return key;
}

/// The same for those that are numbered together.
std::string chainOf(const CameraPlace& camera) {
  const auto key = numberedKey(camera.key());
  const Path& path = camera.own().path;
  return keyOf(Path(path.begin(), path.end() - (path.empty() ? 0 : 1))) + std::string(key ? key->stem : "");
}

Handedness worldOf(const Kind& kind) { return findPreset(kind.words.at("convention"))->convention.world; }

/// The second in the frame of the first's world.
Placed product(const Placed& a, const Placed& b) {
  Placed both;
  for (std::size_t i = 0; i < 3; ++i) both.columns[i] = times(a.columns, b.columns[i]);
  both.eye = times(a.columns, b.eye) + a.eye;
  return both;
}

}  // namespace

Poses::Poses(std::span<const CameraPlace> all) {
  for (const CameraPlace& camera : all) {
    if (camera.kind().word("pose") != "cameraFromPrevious") continue;
    cameras_.insert(keyOf(camera.own().path));
    const std::vector<Steps>& links = camera.kind().at("matrix").paths;
    hasLinks_ = hasLinks_ || std::any_of(links.begin(), links.end(),
                                         [&](const Steps& link) { return camera.find(link).has_value(); });
    const auto key = numberedKey(camera.key());
    if (!key) continue;
    const auto [first, isNew] = firsts_.try_emplace(chainOf(camera), key->number);
    if (!isNew) first->second = std::min(first->second, key->number);
  }
}

/// A camera before which there is none, of the file's or of its numbers.
bool Poses::startsChain(const CameraPlace& camera) const {
  const auto key = numberedKey(camera.key());
  if (!key || key->number == 0) return true;
  const auto first = firsts_.find(chainOf(camera));
  return !previousOf(camera) && first != firsts_.end() && first->second == key->number;
}

void Poses::requireLink(const CameraPlace& camera) const {
  const char* const wayOut = "; --position and --rotation place the camera";
  if (camera.find("matrix")) {
    const auto key = numberedKey(camera.key());
    if (key && key->number > 0 && !previousOf(camera))
      camera.fail("matrix", "counts from " + std::string(key->stem) + std::to_string(key->number - 1) +
                                ", which is no camera of the file" + wayOut);
  } else if (hasLinks_ && !startsChain(camera) && cameras_.count(keyOf(camera.own().path)) > 0) {
    camera.fail("has no " + dotted(camera.kind().at("matrix").paths.front()) +
                ", which says where it is from the camera before it" + wayOut);
  }
}

Pose Poses::inChain(const CameraPlace& camera) {
  const AxesOfKind axes = axesOf(camera.kind(), *findPreset(camera.kind().words.at("convention")));
  const Handedness world = worldOf(camera.kind());
  struct Link {
    std::string path;
    Placed own;
  };
  std::vector<Link> links;  // from the camera on, to what is known
  Placed sum;
  for (std::optional<CameraPlace> at = camera; at;) {
    std::string path = keyOf(at->own().path);
    if (const auto known = placed_.find(path); known != placed_.end()) {
      sum = known->second;
      break;
    }
    requireLink(*at);
    const Parts parts = readParts(*at);
    if (!parts.matrix) {
      if (!startsChain(*at) && hasLinks_)
        camera.fail("matrix", "counts from " + dotted(at->own().path) + ", which does not say where it is");
      break;
    }
    std::optional<CameraPlace> before = previousOf(*at);
    links.push_back({std::move(path), placed(*at, parts)});
    if (links.size() == 1 && before && axes.isNative && !readParts(*before).matrix && startsChain(*before))  // exact
      return locatedAt(camera, "matrix", "matrix",
                       [&] { return poseFromCameraFromWorld(*parts.matrix, axes.axes, world); });
    at = std::move(before);
  }
  for (auto link = links.rbegin(); link != links.rend(); ++link) {
    sum = product(sum, link->own);
    placed_.emplace(std::move(link->path), sum);
  }
  return locatedAt(camera, "matrix", "matrix",
                   [&] { return poseFromColumns(rearranged(sum.columns, axes), sum.eye, axes.axes, world); });
}

std::optional<Found> poseField(const CameraPlace& camera) {
  for (const char* const word : {"matrix", "translation", "position", "P"})
    if (auto found = camera.find(word)) return found;
  return std::nullopt;
}

void Poses::require(const CameraPlace& camera) {
  // Behind a link that is wrong every camera would come upon it.
  if (camera.kind().word("pose") == "cameraFromPrevious") {
    requireLink(camera);
    (void)readParts(camera);
  } else {
    (void)of(camera);
  }
}

Pose Poses::of(const CameraPlace& camera) {
  const Kind& kind = camera.kind();
  const Handedness world = worldOf(kind);
  const AxesOfKind axes = axesOf(kind, *findPreset(kind.words.at("convention")));
  if (const auto p = camera.matrix("P", 3, 4)) {
    const SplitMatrix split = locatedAt(camera, "P", "P", [&] { return splitMatrix(*p); });
    return locatedAt(camera, "P", "P",
                     [&] { return poseFromColumns(split.columns, split.eye, CameraAxes::RDF, world); });
  }
  if (kind.word("pose") == "cameraFromPrevious") return inChain(camera);
  const Parts parts = readParts(camera);
  if (parts.rotationWord.empty()) return poseFromColumns(rearranged(Placed{}.columns, axes), {}, axes.axes, world);
  return locatedAt(camera, parts.rotationWord, parts.placeWord, [&] {
    const bool isScaled = kind.numbers.count("scale") > 0;
    if (parts.matrix && axes.isNative && !isScaled && !parts.position) {  // exact
      Mat4 m = *parts.matrix;
      if (parts.translation) {
        m[0][3] = parts.translation->x;
        m[1][3] = parts.translation->y;
        m[2][3] = parts.translation->z;
      }
      return isToWorld(camera) ? poseFromWorldFromCamera(m, axes.axes, world)
                               : poseFromCameraFromWorld(m, axes.axes, world);
    }
    if (parts.matrix && isToWorld(camera) && axes.isNative && !isScaled && parts.position) {
      Mat4 m = *parts.matrix;
      m[0][3] = parts.position->x;
      m[1][3] = parts.position->y;
      m[2][3] = parts.position->z;
      return poseFromWorldFromCamera(m, axes.axes, world);
    }
    if (parts.quaternion && isToWorld(camera) && axes.isNative && !isScaled) {
      const std::optional<Vec3>& eye = parts.position ? parts.position : parts.translation;
      return poseFromRotation(*eye, *parts.quaternion, axes.axes, world);
    }
    // A matrix is checked as it stands.
    if (parts.matrix) {
      Mat4 m = *parts.matrix;
      if (!axes.isNative)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            (isToWorld(camera) ? m[j][i] : m[i][j]) =
                axes.sign[i] *
                (isToWorld(camera) ? (*parts.matrix)[j][axes.from[i]] : (*parts.matrix)[axes.from[i]][j]);
      for (std::size_t i = 0; i < 3; ++i) m[i][3] = 0;
      (void)(isToWorld(camera) ? poseFromWorldFromCamera(m, axes.axes, world)
                               : poseFromCameraFromWorld(m, axes.axes, world));
    }
    const Placed place = placed(camera, parts);
    return poseFromColumns(rearranged(place.columns, axes), place.eye, axes.axes, world);
  });
}

}  // namespace viewproj::cmd
