#include "formats/writer.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/read_lens.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::uint32_t kPicture = kPixels | kSizePlace | kShapePlace,
                        kOpenCvLens = kBrownPlace | kK3Place | kRationalPlace | kFisheyePlace,
                        kStatedPoses = kPosePlace | kNeedsPose | kSeveralPlace, kNamedPoses = kStatedPoses | kNamePlace;

constexpr Writer kWriters[] = {
    {"opencv", ".yml .xml", kPicture | kOffCentrePlace | kOpenCvLens | kOmniPlace | kPosePlace | kSeveralPlace,
     writeOpenCv, 2},
    {"ros", "",
     kPicture | kOffCentrePlace | kOpenCvLens | kNamePlace | kNeedsWholeSize | kStereoPosePlace | kSeveralPlace,
     writeRos},
    {"kalibr", "",
     kPicture | kOffCentrePlace | kPosePlace | kSeveralPlace | kNeedsWholeSize | kBrownPlace | kFisheyePlace |
         kUnifiedPlace | kDoubleSpherePlace | kOmniPlace | kFovPlace,
     writeKalibr},
    {"colmap", "/",
     kPicture | kOffCentrePlace | kOpenCvLens | kUnifiedPlace | kFovPlace | kNamedPoses | kQuaternions |
         kNeedsWholeSize,
     writeColmap, SIZE_MAX, leftOutOfColmap},
    {"transforms", "transforms.json", kPicture | kOffCentrePlace | kBrownPlace | kK3Place | kFisheyePlace | kNamedPoses,
     writeTransforms},
    {"3dgs", "", kPicture | kNamedPoses | kNeedsWholeSize, writeSplats},
    {"gltf", ".gltf", kYIsUp | kNearPlace | kNeedsNear | kOrthographicPlace | kNamedPoses | kQuaternions, writeGltf},
    {"threejs", "",
     kYIsUp | kShapePlace | kOffCentrePlace | kNearPlace | kNeedsNear | kNeedsFar | kOrthographicPlace | kNamedPoses |
         kQuaternions,
     writeThreeJs},
    {"open3d", "", kPicture | kOffCentrePlace | kStatedPoses | kNeedsWholeSize, writeOpen3d},
    {"kitti", "", kPixels | kShapePlace | kOffCentrePlace | kStatedPoses, writeKitti, 4},
    {"kitti-poses", "", kPosesAlone | kStatedPoses, writeKittiPoses},
    {"tum", "", kPosesAlone | kNamedPoses | kQuaternions, writeTum},
    {"csv", ".csv",
     kPicture | kOffCentrePlace | kNearPlace | kOpenCvLens | kUnifiedPlace | kDoubleSpherePlace | kOmniPlace |
         kWholeOmniPlace | kFovPlace | kNamedPoses | kQuaternions,
     writeTable},
};

/// Where rounding is all that differs.
constexpr double kRounding = 1e-12;

bool isWhole(double number) { return number == std::floor(number); }

/// The largest entry of M^T M - I of the cameras' matrices.
double rotationError(std::span<const WrittenCamera> cameras) {
  double largest = 0;
  for (const WrittenCamera& camera : cameras)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        double product = i == j ? -1 : 0;
        for (std::size_t k = 0; k < 3; ++k) product += camera.worldFromCamera[k][i] * camera.worldFromCamera[k][j];
        largest = std::max(largest, std::fabs(product));
      }
  return largest;
}

std::uint32_t placeOf(const Lens& lens) {
  switch (lens.model()) {
    case LensModel::brown:
      return kBrownPlace;
    case LensModel::fisheye:
      return kFisheyePlace;
    case LensModel::unified:
      return kUnifiedPlace;
    case LensModel::doubleSphere:
      return kDoubleSpherePlace;
    case LensModel::omni:
      return kOmniPlace;
    default:
      return kFovPlace;
  }
}

/// What a camera has, and a form may have no place for.
class Places {
 public:
  Places(const WrittenCamera& camera, const Writer& writer) : camera_(camera), file_(camera.file), writer_(writer) {}

  void require() {
    requireParts();
    if (lacks(kPosesAlone)) requirePicture();
    if (lacks(kPosePlace) && !camera_.isAtOrigin() && (lacks(kStereoPosePlace) || !looksAlongZ()))
      lack(std::string("a pose") +
           (lacks(kStereoPosePlace) ? "; " : " that does not look along z, from the plane z = 0; ") +
           (file_.convention.view == ViewAxes::RDF && !valueAt(*file_.document.root, "cameraAxes")
                ? "--world-from-camera 0,0,0"
                : "--position 0,0,0 --rotation 0,0,0,1 --set cameraAxes=RDF") +
           " leaves it out");
    if (!lacking_.empty()) file_.fail(file_.name + ": " + std::string(writer_.name) + " has no place for " + lacking_);
  }

 private:
  bool lacks(Place place) const { return (writer_.places & place) == 0; }
  void lack(const std::string& what) { lacking_ += (lacking_.empty() ? "" : "; nor for ") + what; }

  bool looksAlongZ() const {
    const Mat4& m = camera_.worldFromCamera;
    return m[0][0] > 0 && m[1][1] > 0 && m[2][2] > 0 && std::fabs(m[2][3]) <= kRounding * std::hypot(m[0][3], m[1][3]);
  }

  void requirePicture() {
    const Projection& p = *file_.projection;
    if (p.isOrthographic() && lacks(kOrthographicPlace)) lack("an orthographic projection");
    if (file_.lens) requireLens(*file_.lens);
    const bool isCentred = std::fabs(p.left() + p.right()) <= kRounding * (p.right() - p.left()) &&
                           std::fabs(p.bottom() + p.top()) <= kRounding * (p.top() - p.bottom());
    if (!isCentred && lacks(kOffCentrePlace)) lack("a viewing axis off the middle of the picture" + centring());
    if (file_.viewport) requireViewport(*file_.viewport);
    if ((writer_.places & kNeedsNear) != 0 && !hasDepth(p)) lack("a camera without near; --near gives it");
    if ((writer_.places & kNeedsFar) != 0 && !std::isfinite(p.zFar()))
      lack("a far plane at infinity; --far gives another");
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
    const std::string without = "; --ignore-distortion leaves it out";
    const std::string model(nameOf(lens.model()));
    if (lacks(static_cast<Place>(placeOf(lens)))) lack("the lens " + model + without);
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
  const Projection& p = *file.projection;
  const double slope = 1 / calibrated(perspectiveWindow(-1, 1, -1, 1, 0, kInfiniteFar), *file.lens).right();
  if (slope != 1)
    calibration =
        perspectiveWindow(p.left() * slope, p.right() * slope, p.bottom() * slope, p.top() * slope, 0, kInfiniteFar);
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

std::string requirePlaces(std::span<const WrittenCamera> cameras, const Writer& writer) {
  const auto lacks = [&](std::uint32_t place) { return (writer.places & place) == 0; };
  const std::size_t most = lacks(kSeveralPlace) ? 1 : writer.most;
  if (cameras.size() > most)
    throw InputError("there are " + std::to_string(cameras.size()) + " cameras, and a file of " +
                     std::string(writer.name) + " holds " + (most == 1 ? "one" : std::to_string(most)) +
                     "; pick with FILE#NAME");
  bool hasPicture = false, hasSize = false, hasNear = false, hasFar = false, hasDepths = false, hasName = false;
  bool isFromBottom = false;
  for (const WrittenCamera& camera : cameras) {
    Places(camera, writer).require();
    const CameraFile& file = camera.file;
    hasPicture = hasPicture || file.projection;
    hasSize = hasSize || file.viewport;
    hasNear = hasNear || (file.projection && hasDepth(*file.projection));
    hasFar = hasFar || (file.projection && std::isfinite(file.projection->zFar()));
    hasDepths = hasDepths || (file.viewport && (file.viewport->depthFirst != 0 || file.viewport->depthSecond != 1));
    isFromBottom = isFromBottom || (file.viewport && file.viewport->origin == Origin::bottomLeft);
    hasName = hasName || !camera.name.empty();
  }
  std::vector<std::string_view> left;
  if (hasPicture && !lacks(kPosesAlone)) left.push_back("lens");
  if (hasSize && lacks(kSizePlace)) left.push_back("size");
  if (hasNear && lacks(kNearPlace)) left.push_back("near");
  if (hasFar && lacks(kNearPlace)) left.push_back("far");
  if (isFromBottom) left.push_back("origin");
  if (hasDepths) left.push_back("depthRange");
  if (hasName && lacks(kNamePlace)) left.push_back(cameras.size() == 1 ? "name" : "names");
  const std::string form(writer.name);
  std::string told = left.empty() ? "" : form + " has no place for " + together(left) + ": left out";
  if (const double error = lacks(kQuaternions) ? 0 : rotationError(cameras); error > kRounding)
    told += (told.empty() ? form : "; it") + " has quaternions, and a matrix is " + formatDigits(error, 2) +
            " off a rotation: the nearest is written";
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
