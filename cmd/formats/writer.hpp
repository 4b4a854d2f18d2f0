// Cameras written as files of other programs. A writer takes the plain numbers of cameras; what would move a pixel and
// the file cannot say is refused, and the rest that it cannot say is told. To add a form: a writer, and its row in
// writer.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/plain_camera.hpp"
#include "camera/read_camera.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

/// Where rounding is all that differs.
inline constexpr double kRounding = 1e-12;

/// The numbers of a camera that other programs' files can hold.
struct WrittenCamera {
  /// name: in its file, or empty. number: among those that are written. Throws InputError for a left-handed world.
  WrittenCamera(CameraFile file, std::string name, std::size_t number);

  CameraFile file;
  std::string name, number;
  /// Axes right, down, forward; without a pose at the origin. A pose that was read from a matrix of few digits is no
  /// exact rotation: matrices have it as it is, and pose has unit vectors.
  Mat4 worldFromCamera = kIdentity, cameraFromWorld = kIdentity;
  PlainPose pose{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  std::optional<Projection> calibration;  ///< with the focal lengths of the lens's own formula

  const std::string& label() const { return name.empty() ? number : name; }
  /// From the picture's top left corner, y down; whole numbers are centres of pixels if pixelCenter is 0. The camera
  /// must have a projection and a viewport.
  Intrinsics intrinsics(double pixelCenter) const;
  double width() const { return file.viewport->width; }
  double height() const { return file.viewport->height; }
  /// Whether it stands at the origin, along the axes right, down, forward.
  bool isAtOrigin() const { return cameraFromWorld == kIdentity; }

  static constexpr Mat4 kIdentity{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
};

/// The first three rows: 12 numbers.
std::array<double, 12> cameraFromWorld(const WrittenCamera& camera);
/// The same of the inverse, for axes RDF or RUB.
std::array<double, 12> worldFromCamera(const WrittenCamera& camera, CameraAxes axes);

/// 16 numbers by columns of such rows.
std::array<double, 16> columnsOf(const std::array<double, 12>& rows);

/// k1 k2 p1 p2 k3 [k4 k5 k6], a fisheye's k1 ... k4, xi and k1 k2 p1 p2 of omni, or a model's own numbers.
std::vector<double> coefficientsOf(const Lens& lens);

/// What a form has a place for, or needs.
enum Place : std::uint32_t {
  kPosePlace = 1,
  kPixels = 2,           ///< it counts in pixels, and needs a viewport
  kSizePlace = 4,        ///< of the picture
  kShapePlace = 8,       ///< pixels that are not square
  kOffCentrePlace = 16,  ///< a viewing axis off the picture's middle
  kNearPlace = 32,
  kOrthographicPlace = 64,
  kNamePlace = 128,
  kSeveralPlace = 256,
  kPosesAlone = 512,  ///< lens and picture are left out
  kNeedsWholeSize = 1024,
  kNeedsNear = 2048,
  kNeedsFar = 4096,
  kNeedsPose = 8192,     ///< it states one for each camera
  kQuaternions = 16384,  ///< its poses are rotations
  kBrownPlace = 1 << 16,
  kK3Place = 1 << 17,        ///< of a brown lens
  kRationalPlace = 1 << 18,  ///< k4, k5, k6
  kFisheyePlace = 1 << 19,
  kUnifiedPlace = 1 << 20,
  kDoubleSpherePlace = 1 << 21,
  kOmniPlace = 1 << 22,
  kFovPlace = 1 << 23,
  kWholeOmniPlace = 1 << 24,   ///< k3 to k6 of it
  kYIsUp = 1 << 25,            ///< in its world, and no form says otherwise
  kStereoPosePlace = 1 << 26,  ///< before rectification: it looks along z, from the plane z = 0 if it is turned
  kEarthPlace = 1 << 27,       ///< latitudes and longitudes
  kFirstAtZero = 1 << 28,      ///< cx, cy count the centre of the first pixel as 0
  kFirstAtHalf = 1 << 29,      ///< or as 0.5
};

struct WrittenFile {
  std::string name;  ///< in its folder; empty: the only file
  std::string text;
  std::string note = {};  ///< what a reader of the file must know, or empty
};

struct Writer {
  std::string_view name;
  std::string_view endings;  ///< names of files that are surely of this form, see FormRow; "/" is a folder
  std::uint32_t places;
  /// ending: of the file that is written.
  std::vector<WrittenFile> (*write)(std::span<const WrittenCamera> cameras, std::string_view ending);
  std::size_t most = SIZE_MAX;  ///< cameras, if kSeveralPlace
  /// What a source of this very form holds that is not written, for a note; or empty.
  std::string (*leftOut)(const std::string& source) = nullptr;
};
std::span<const Writer> writers();

/// near and far for a form that needs them: the usual ones where the camera has none.
std::array<double, 2> depthsFor(const Projection& projection);

/// Throws InputError for what would move a pixel and the form cannot say. Returns what else it cannot say, for a note;
/// or an empty text.
std::string requirePlaces(std::span<const WrittenCamera> cameras, const Writer& writer);

// ---- The forms, each beside its reader

using Write = std::vector<WrittenFile>(std::span<const WrittenCamera>, std::string_view);
Write writeOpenCv, writeRos, writeKalibr, writeColmap, writeTransforms, writeSplats, writeOpen3d, writeGltf,
    writeThreeJs, writeKitti, writeKittiPoses, writeTum, writeTable;

/// See Writer.
std::string leftOutOfColmap(const std::string& source);

/// A YAML number that no reader takes for an integer or a text.
std::string yamlNumber(double value);
/// "name: [1.0, 2.0]", in lines of YAML.
std::string yamlList(std::span<const double> numbers);
/// Rows of a matrix as JSON.
std::string jsonRows(std::span<const double> numbers, std::size_t columns);

}  // namespace viewproj::cmd
