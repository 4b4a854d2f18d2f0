#include "formats/writer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "camera/read_lens.hpp"
#include "camera/read_pose.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::uint32_t kPicture = kPixels | kSizePlace | kShapePlace, kCentresAtZero = kOffCentrePlace | kFirstAtZero,
                        kCentresAtHalf = kOffCentrePlace | kFirstAtHalf,
                        kOpenCvLens = kBrownPlace | kK3Place | kRationalPlace | kFisheyePlace,
                        kStatedPoses = kPosePlace | kNeedsPose | kSeveralPlace, kNamedPoses = kStatedPoses | kNamePlace;

constexpr Writer kWriters[] = {
    {"opencv", ".yml .xml", kPicture | kCentresAtZero | kOpenCvLens | kOmniPlace | kPosePlace | kSeveralPlace,
     writeOpenCv, 2},
    {"ros", "",
     kPicture | kCentresAtZero | kOpenCvLens | kNamePlace | kNeedsWholeSize | kStereoPosePlace | kSeveralPlace,
     writeRos},
    {"kalibr", "",
     kPicture | kCentresAtZero | kPosePlace | kSeveralPlace | kNeedsWholeSize | kBrownPlace | kFisheyePlace |
         kUnifiedPlace | kDoubleSpherePlace | kOmniPlace | kFovPlace,
     writeKalibr},
    {"colmap", "/",
     kPicture | kCentresAtHalf | kOpenCvLens | kUnifiedPlace | kFovPlace | kNamedPoses | kQuaternions | kNeedsWholeSize,
     writeColmap, SIZE_MAX, leftOutOfColmap},
    {"transforms", "transforms.json", kPicture | kCentresAtHalf | kBrownPlace | kK3Place | kFisheyePlace | kNamedPoses,
     writeTransforms},
    {"3dgs", "", kPicture | kFirstAtHalf | kNamedPoses | kNeedsWholeSize, writeSplats},
    {"gltf", ".gltf", kFirstAtHalf | kYIsUp | kNearPlace | kNeedsNear | kOrthographicPlace | kNamedPoses | kQuaternions,
     writeGltf},
    {"threejs", "",
     kFirstAtHalf | kYIsUp | kShapePlace | kOffCentrePlace | kNearPlace | kNeedsNear | kNeedsFar | kOrthographicPlace |
         kNamedPoses | kQuaternions,
     writeThreeJs},
    {"open3d", "", kPicture | kCentresAtZero | kStatedPoses | kNeedsWholeSize, writeOpen3d},
    {"kitti", "", kPixels | kShapePlace | kCentresAtZero | kStatedPoses, writeKitti, 4},
    {"kitti-poses", "", kPosesAlone | kStatedPoses, writeKittiPoses},
    {"tum", "", kPosesAlone | kNamedPoses | kQuaternions, writeTum},
    {"csv", ".csv",
     kPicture | kOffCentrePlace | kNearPlace | kOpenCvLens | kUnifiedPlace | kDoubleSpherePlace | kOmniPlace |
         kWholeOmniPlace | kFovPlace | kNamedPoses | kQuaternions | kEarthPlace,
     writeTable},
};

bool isWhole(double number) { return number == std::floor(number); }

Place placeOf(LensModel model) {
  return model == LensModel::brown          ? kBrownPlace
         : model == LensModel::fisheye      ? kFisheyePlace
         : model == LensModel::unified      ? kUnifiedPlace
         : model == LensModel::doubleSphere ? kDoubleSpherePlace
         : model == LensModel::omni         ? kOmniPlace
                                            : kFovPlace;
}

/// What a camera has, and a form may have no place for.
class Places {
 public:
  Places(const WrittenCamera& camera, const Writer& writer) : camera_(camera), file_(camera.file), writer_(writer) {}

  /// What the form has no place for; empty if there is nothing.
  std::string lacking() {
    requireParts();
    if (lacks(kPosesAlone)) requirePicture();
    if (lacks(kPosePlace) && !camera_.isAtOrigin() && (lacks(kStereoPosePlace) || !looksAlongZ()))
      lack(std::string("a pose") + (lacks(kStereoPosePlace) ? "; " : " (but for a rectified pair's); ") +
           (file_.convention.view == ViewAxes::RDF && !valueAt(*file_.document.root, "cameraAxes")
                ? "--world-from-camera 0,0,0"
                : "--position 0,0,0 --rotation 0,0,0,1 --set cameraAxes=RDF") +
           " writes the lens alone");
    return lacking_;
  }

 private:
  bool lacks(Place place) const { return (writer_.places & place) == 0; }
  void lack(const std::string& what) { lacking_ += (lacking_.empty() ? "" : "; nor for ") + what; }

  bool looksAlongZ() const {
    const Mat4& m = camera_.worldFromCamera;
    const bool isStraight = m[0][0] == 1 && m[1][1] == 1 && m[2][2] == 1;
    return m[0][0] > 0 && m[1][1] > 0 && m[2][2] > 0 &&
           (isStraight || std::fabs(m[2][3]) <= kRounding * std::hypot(m[0][3], m[1][3]));
  }

  void requirePicture() {
    const Projection& p = *file_.projection;
    if (p.isOrthographic() && lacks(kOrthographicPlace)) lack("an orthographic projection");
    if (file_.lens) requireLens(*file_.lens);
    const bool isCentred = std::fabs(p.left() + p.right()) <= kRounding * (p.right() - p.left()) &&
                           std::fabs(p.bottom() + p.top()) <= kRounding * (p.top() - p.bottom());
    if (!isCentred && lacks(kOffCentrePlace)) lack("a viewing axis off the middle of the picture" + centring());
    if (file_.viewport) requireViewport(*file_.viewport);
  }

  /// What moves the axis to the middle, where the document has it.
  std::string centring() const {
    const Document& document = file_.document;
    const bool isPoint = valueAt(*document.root, "projection.cx") || valueAt(*document.root, "projection.cy");
    return isPoint ? "; --set projection.cx=null --set projection.cy=null moves it there"
           : valueAt(*document.root, "projection.shift") ? "; --set projection.shift=null moves it there"
                                                         : "";
  }

  void requireViewport(const Viewport& v) {
    const double shape = file_.projection->aspect() * v.height / v.width;
    if (!(std::fabs(shape - 1) <= kRounding) && lacks(kShapePlace)) lack("pixels that are not square");
    if ((v.x != 0 || v.y != 0) && !lacks(kPixels))
      lack("the viewport's x and y; --set viewport.x=0 --set viewport.y=0 leaves them out");
    if ((writer_.places & kNeedsWholeSize) != 0 && !(isWhole(v.width) && isWhole(v.height)))
      lack("a picture of " + formatNumber(v.width) + "x" + formatNumber(v.height) + " pixels, a part of one");
  }

  void requireLens(const Lens& lens) {
    const std::string without = "; --ignore-distortion leaves out the whole distortion";
    const std::string model(nameOf(lens.model()));
    if (lacks(placeOf(lens.model()))) lack("the lens " + model + without);
    const auto& k = lens.k();
    const bool isRational = k[3] != 0 || k[4] != 0 || k[5] != 0;
    const bool isBrown = lens.model() == LensModel::brown;
    if (isBrown && k[2] != 0 && lacks(kK3Place)) lack("k3 of the lens" + without);
    if (isBrown && isRational && lacks(kRationalPlace)) lack("k4 to k6 of the lens" + without);
    if (lens.model() == LensModel::omni && lacks(kWholeOmniPlace) && (k[2] != 0 || isRational))
      lack("k3 to k6 of the lens omni" + without);
    if (lens.limitCause() == LimitCause::stated)
      lack("the limit of the lens; --set distortion.limit=null leaves it out");
  }

  /// Names a part that is missing.
  void requireParts() const {
    CameraFile whole = file_;
    if (lacks(kNeedsPose) && !whole.pose) whole.pose = lookAlong({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, Handedness::right);
    if (lacks(kPixels) && !whole.viewport) whole.viewport = Viewport{1, 1};
    if (!lacks(kPosesAlone)) whole.projection = orthographic(-1, 1, -1, 1, 0, 1), whole.lens = std::nullopt;
    (void)makeCamera(whole);
  }

  const WrittenCamera& camera_;
  const CameraFile& file_;
  const Writer& writer_;
  std::string lacking_;
};

}  // namespace

std::span<const Writer> writers() { return kWriters; }

WrittenCamera::WrittenCamera(CameraFile read, std::string itsName, std::size_t itsNumber)
    : file(std::move(read)), name(std::move(itsName)), number(std::to_string(itsNumber)) {
  if (file.convention.world == Handedness::left)
    file.fail(file.name + ": its world is left-handed, and other programs' are right-handed; --map x,y,-z mirrors it");
  if (file.pose) {
    Convention rightDownForward;
    rightDownForward.view = ViewAxes::RDF;
    const Camera camera = cameraIn(rightDownForward, file.pose);
    worldFromCamera = matrix(camera, Space::world, Space::view);
    cameraFromWorld = matrix(camera, Space::view, Space::world);
    pose = plainPose(*file.pose);
  }
  calibration = file.projection;
  if (!file.lens || !file.projection) return;
  if (valueAt(*file.document.root, "projection.fx")) {  // as the document has them
    Document plain = copied(file.document);
    plain.root->erase("distortion");
    calibration = readCamera(plain, file.reading).projection;
    return;
  }
  calibration = asCalibrated(file, *file.projection);
}

Intrinsics WrittenCamera::intrinsics(double pixelCenter) const {
  Viewport picture{width(), height()};
  picture.pixelCenter = pixelCenter;
  return cameraIn(file.convention, {}, calibration, picture).intrinsics();
}

std::array<double, 12> cameraFromWorld(const WrittenCamera& camera) {
  std::array<double, 12> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = camera.cameraFromWorld[i / 4][i % 4] + 0.0;
  return rows;
}

std::array<double, 12> worldFromCamera(const WrittenCamera& camera, CameraAxes axes) {
  std::array<double, 12> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool isOther = axes == CameraAxes::RUB && (i % 4 == 1 || i % 4 == 2);
    rows[i] = (isOther ? -1 : 1) * camera.worldFromCamera[i / 4][i % 4] + 0.0;
  }
  return rows;
}

std::array<double, 16> columnsOf(const std::array<double, 12>& rows) {
  std::array<double, 16> columns{};
  for (std::size_t i = 0; i < 16; ++i) columns[i] = i % 4 < 3 ? rows[i % 4 * 4 + i / 4] : i < 15 ? 0 : 1;
  return columns;
}

std::vector<double> coefficientsOf(const Lens& lens) {
  const auto& k = lens.k();
  const auto& p = lens.p();
  switch (lens.model()) {
    case LensModel::fisheye:
      return {k.begin(), k.begin() + 4};
    case LensModel::unified:
      return {lens.alpha(), lens.beta()};
    case LensModel::doubleSphere:
      return {lens.xi(), lens.alpha()};
    case LensModel::fov:
      return {lens.omega()};
    case LensModel::omni:
      return {lens.xi(), k[0], k[1], p[0], p[1]};
    default:
      break;
  }
  std::vector<double> c{k[0], k[1], p[0], p[1], k[2]};
  if (k[3] != 0 || k[4] != 0 || k[5] != 0) c.insert(c.end(), k.begin() + 3, k.end());
  return c;
}

std::array<double, 2> depthsFor(const Projection& p) {
  constexpr double kNear = 0.1, kFar = 2000;  // of three.js
  const double near = hasDepth(p) ? p.zNear() : std::min(kNear, p.zFar() / 2);
  return {near, std::isfinite(p.zFar()) ? p.zFar() : std::max(kFar, 2 * near)};
}

std::string requirePlaces(std::span<const WrittenCamera> cameras, const Writer& writer) {
  const auto lacks = [&](std::uint32_t place) { return (writer.places & place) == 0; };
  const std::size_t most = lacks(kSeveralPlace) ? 1 : writer.most;
  if (cameras.size() > most)
    throw InputError("there are " + std::to_string(cameras.size()) + " cameras, and a file of " +
                     std::string(writer.name) + " holds " + (most == 1 ? "one" : std::to_string(most)) +
                     "; pick with FILE#NAME");
  bool hasPicture = false, hasSize = false, hasNear = false, hasFar = false, hasDepths = false, hasName = false;
  bool isOffCorner = false, isFromBottom = false, isOnEarth = false;
  double moved = 0;             // cx and cy
  double off = 0;               // a rotation
  std::set<std::string> given;  // that a camera lacks
  std::vector<std::string> fitting;
  std::pair<const CameraFile*, std::string> unfit{};  // the first, and what it lacks
  for (const WrittenCamera& camera : cameras) {
    const CameraFile& file = camera.file;
    std::string lacking = Places(camera, writer).lacking();
    if (lacking.empty())
      fitting.push_back(inShell(file.name));
    else if (!unfit.first)
      unfit = {&file, std::move(lacking)};
    hasPicture = hasPicture || file.projection;
    hasSize = hasSize || file.viewport;
    hasNear = hasNear || (file.projection && hasDepth(*file.projection));
    hasFar = hasFar || (file.projection && std::isfinite(file.projection->zFar()));
    if (!lacks(kNeedsNear) && !hasDepth(*file.projection))
      given.insert("near " + formatNumber(depthsFor(*file.projection)[0]));
    if (!lacks(kNeedsFar) && !std::isfinite(file.projection->zFar()))
      given.insert("far " + formatNumber(depthsFor(*file.projection)[1]));
    hasDepths = hasDepths || (file.viewport && (file.viewport->depthFirst != 0 || file.viewport->depthSecond != 1));
    isOnEarth = isOnEarth || file.worldIsEcef;
    if (!(lacks(kFirstAtZero) && lacks(kFirstAtHalf)) &&
        (!file.isTyped || valueAt(*file.document.root, "projection.cx")))
      moved = (lacks(kFirstAtZero) ? 0.5 : 0) - file.viewport->pixelCenter;
    isOffCorner = isOffCorner || (file.viewport && (file.viewport->x != 0 || file.viewport->y != 0));
    isFromBottom = isFromBottom || (file.viewport && file.viewport->origin == Origin::bottomLeft);
    hasName = hasName || !camera.name.empty();
    off = std::max(off, lacks(kQuaternions) || !file.pose ? 0 : rotationError(*file.pose));
  }
  const std::string form(writer.name);
  constexpr std::size_t kMost = 8;
  if (unfit.first)
    unfit.first->fail(unfit.first->name + ": " + form + " has no place for " + unfit.second +
                      (fitting.empty() ? "" : "; it has for " + someOf(fitting, kMost)));
  std::vector<std::string_view> left;
  if (hasPicture && !lacks(kPosesAlone)) left.push_back("lens");
  if (hasSize && lacks(kSizePlace)) left.push_back("size");
  if (isOffCorner && lacks(kPixels)) left.push_back("the viewport's x and y");
  if (hasNear && lacks(kNearPlace)) left.push_back("near");
  if (hasFar && lacks(kNearPlace)) left.push_back("far");
  if (hasDepths) left.push_back("depthRange");
  if (hasName && lacks(kNamePlace)) left.push_back(cameras.size() == 1 ? "name" : "names");
  std::string told = left.empty() ? "" : form + " has no place for " + together(left) + ": left out";
  if (off > kRounding)
    told += (told.empty() ? form : "; it") + " has quaternions, and a matrix is " + formatDigits(off, 2) +
            " off a rotation: the nearest is written";
  if (!given.empty())
    told += (told.empty() ? form : "; it") + " is given " + joined(std::vector(given.begin(), given.end())) +
            ", which moves no pixel";
  if (moved != 0 && lacks(kPixels))
    told += (told.empty() ? form : "; it") + " has no pixels: where it is read again, the first one's centre is at " +
            (lacks(kFirstAtZero) ? "0.5" : "0");
  else if (moved != 0)
    told += (told.empty() ? form : "; it") + " counts the centre of the first pixel as " +
            (lacks(kFirstAtZero) ? "0.5" : "0") + ": cx, cy and pixels are " + formatNumber(std::fabs(moved)) +
            (moved > 0 ? " larger" : " smaller");
  if (isFromBottom) told += (told.empty() ? form : "; it") + " counts pixels' y from the top, not the bottom";
  if (isOnEarth && lacks(kEarthPlace) && !lacks(kPosePlace))
    told += (told.empty() ? form : "; it") +
            " has positions in metres from the Earth's centre, which a program with float32 rounds to half a metre";
  return told;
}

std::string yamlNumber(double value) {
  std::string text = formatNumber(value);
  const std::size_t exponent = std::min(text.find('e'), text.size());
  if (text.find('.') == std::string::npos) text.insert(exponent, ".0");
  if (const std::size_t e = text.find('e'); e != std::string::npos && text[e + 1] != '-' && text[e + 1] != '+')
    text.insert(e + 1, "+");
  return text;
}

std::string yamlList(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + yamlNumber(number);
  return "[" + text + "]";
}

std::string jsonRows(std::span<const double> numbers, std::size_t columns) {
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < numbers.size(); i += columns) rows.push_back(jsonListOf(numbers.subspan(i, columns)));
  return jsonList(rows);
}

}  // namespace viewproj::cmd
