// What a pasted matrix can be: a camera's matrix, a calibration, a rotation; the likeliest first.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/names.hpp"
#include "text/pasted_matrices.hpp"
#include "viewproj/cameras_of.hpp"

namespace viewproj::cmd {

enum class ReadingKind : std::uint8_t {
  projection,
  view,
  pose,
  viewProjection,
  k,
  p,
  rotation,
  projectionInverse,
  viewProjectionInverse
};

inline constexpr NameRow<ReadingKind> kReadingKinds[] = {{"projection", ReadingKind::projection},
                                                         {"view", ReadingKind::view},
                                                         {"pose", ReadingKind::pose},
                                                         {"viewProjection", ReadingKind::viewProjection},
                                                         {"K", ReadingKind::k},
                                                         {"P", ReadingKind::p},
                                                         {"rotation", ReadingKind::rotation},
                                                         {"projectionInverse", ReadingKind::projectionInverse},
                                                         {"viewProjectionInverse", ReadingKind::viewProjectionInverse}};

/// Focal lengths and principal point, in pixels or, below 20, in half widths. Their signs are axes.
struct PixelLens {
  double fx = 0, fy = 0, cx = 0, cy = 0, skew = 0;
  std::string_view axes;           ///< of a K: "RDF"
  std::array<double, 4> errors{};  ///< of fx, fy, cx, cy
};

struct Reading {
  ReadingKind kind = ReadingKind::projection;
  MatrixLayout layout = MatrixLayout::asWritten;
  std::optional<MatrixCamera> camera = {};  ///< but of K, P and rotation; of an inverse that of the matrix itself
  std::optional<PixelLens> pixels = {};     ///< of K and P
  std::array<Vec3, 3> rows = {};            ///< of a P: right, down, forward; of a rotation its own
  std::optional<Vec3> eye = {};             ///< of a P
  Vec3 eyeError = {};
  double axesError = 0;     ///< how far each number of right, up and forward, or of a rotation, may be off
  Vec2 edgeError = {};      ///< of a projection: how far tan of the angles to its edges may be off, across and up
  bool isMirrored = false;  ///< of a P or rotation
  double scaledBy = 1;      ///< of a view or pose: the rotation times this
  bool isCentred = false;   ///< of a view or pose: the camera looks at the world's origin
  double rise = 0;          ///< of a level camera's up along y or z, to which the picture's rows are at right angles
  bool isUniform = false;   ///< orthographic, of rows of one length, turned: likelier a scaled pose
  double cost = 0;
};

/// What a name, or the lines in front, say: of the kind, and of the axes of a view that programs with such names have.
struct KindHint {
  std::optional<ReadingKind> kind;
  double weight = 0;  ///< what a reading of another kind costs
  std::optional<ViewAxes> axes;
  bool areAxesOfK = false;    ///< no name says the axes, but a K in pixels is in the same text
  bool isTransposed = false;  ///< programs with such names have it transposed
};
inline constexpr double kSpoken = 20;
/// Fields of view, in degrees, beyond which a lens is unusual.
inline constexpr double kNarrowFov = 4, kWideFov = 120;
KindHint hintOf(const PastedMatrix& matrix);
/// Whether pixels begin at 1 in the programs that have its name.
bool countsFromOne(const PastedMatrix& matrix);

/// " --fov-y 70" of "fov = 70" in a text, else " --fov-y DEGREES".
std::string fovIn(const std::string& text);
/// Two whole numbers in a text, in either order, that are the size of a picture with its middle there, or else of this
/// aspect; nothing where there are none, or several.
std::optional<Vec2> sizeIn(const std::string& text, const std::optional<Vec2>& middle, double aspect);
/// " --viewport 1920x1080", or WIDTHxHEIGHT.
std::string viewportOption(const std::optional<Vec2>& size);

/// Keeps the readings that are better, where some are.
template <class IsBetter>
void prefer(std::vector<Reading>& readings, IsBetter isBetter) {
  if (std::any_of(readings.begin(), readings.end(), isBetter)) std::erase_if(readings, std::not_fn(isBetter));
}

struct MatrixReadings {
  bool isFloat = false;           ///< each entry prints like the float32 next to it
  std::vector<Reading> readings;  ///< names order them and never take one away
  std::string fault;              ///< where there are none
};
/// isBesideK: the text has a K in pixels, so that OpenCV's axes are usual.
MatrixReadings readingsOf(const PastedMatrix& matrix, bool isBesideK = false);

/// The matrix for column vectors in this layout, as four rows of four: rows of 3 and a third or fourth row are filled
/// up with 0 0 0 1. What rounding left of a 0 in the last row is 0.
Mat4 matrixOf(const PastedMatrix& matrix, MatrixLayout layout);

/// Whether a matrix of this camera would be written like that in this convention, apart from reverseZ and world, which
/// follow from the matrix and the rest. A calibration and a rotation have no convention.
bool fits(const Reading& reading, const Convention& convention, bool isInMemoryOrder);
/// But for its vectors and storage, in which shaders have matrices transposed.
bool fitsButVectors(const Reading& reading, const Convention& convention);

/// "world", "reverseZ": which of the two a convention has otherwise.
std::vector<std::string> differences(const Reading& reading, const Convention& convention);

/// The readings that a convention allows; of each kind those of its own world and depth alone where there are such.
/// Where there are none, those that differ in vectors alone.
std::vector<Reading> readingsIn(std::vector<Reading> readings, const Convention& convention, bool isInMemoryOrder);

/// The matrix of a reading, for column vectors, in another convention: by signs and the range of depth alone, so that
/// entries that do not change are copied. Throws CameraError for a reading that has no form in conventions.
Mat4 converted(const Reading& reading, const Mat4& matrix, const Convention& convention);

}  // namespace viewproj::cmd
