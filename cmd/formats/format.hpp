// Camera files of other programs. A format moves values into our camera document (viewproj help camera). Most are rows
// of a table (rows.cpp); a file of its own has a format that takes arithmetic, joins or binary data. What a row or a
// file computes is only what the document has no field for; the document's reader does the rest.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/camera_set.hpp"
#include "camera/document.hpp"

namespace viewproj::cmd {

struct Format {
  std::string_view name;                           ///< in help formats
  std::string_view form;                           ///< "a glTF file"
  std::string_view when;                           ///< what must be there, see claims.hpp
  Import (*open)(const Node& root);                ///< root must outlive the result; throws InputError
  std::string_view known = {};                     ///< members that say nothing about the picture, see unread.hpp
  bool (*recognises)(const Node& root) = nullptr;  ///< where conditions cannot say it
};

/// The formats that have a file.
extern const Format kGltf, kThreeJs, kTransforms, kMetashape, kMetashapeLens, kPix4d, kMeshroom, kOpenSfm,
    kOpenSfmLenses, kBundler, kExif, kOpenXr, kTable, kScanner, kUnity, kUnreal, kKalibr, kPoses, kMatrices;

// ---- Our document

using PictureSize = std::optional<std::array<double, 2>>;

/// A camera at the origin, in the convention opencv and with the pixels of the file's pictures. intrinsics: fx, fy, cx,
/// cy.
Json pinholeCamera(std::span<const double> intrinsics, const PictureSize& size, double pixelCenter = 0);
/// Replaces the pose of a camera.
void setPose(Json& camera, std::string_view field, Json pose);

/// The angle across the diagonal, in degrees, of a focal length that is told as on film of 36 x 24 mm. No length, as
/// the sensor that belongs to it is not the camera's.
double fovOfEquivalent(double focalLength);
inline constexpr double kFilmDiagonal = 43.266615305567875;  ///< of 36 x 24 mm

/// Sets the lens: its model by the name that other programs give it (empty: OpenCV's own list), and its coefficients in
/// their order or by name. A pinhole has none. Throws for an unknown model, and for a wrong number of coefficients.
using NamedNumbers = std::vector<std::pair<std::string, double>>;
void setLens(Json& camera, const Node& where, std::string_view model, std::vector<double> coefficients);
void setLens(Json& camera, const Node& where, std::string_view model, const NamedNumbers& named);
/// Whether a lens of this model is a pinhole if all its coefficients are 0 or there are none.
bool mayBePinhole(std::string_view model);

/// The rows of a matrix as JSON.
Json rowsOf(std::span<const double> numbers, std::size_t columns);

// ---- Matrices of other programs

/// fx, fy, cx, cy of a K of 9 numbers by rows, or of 12 or 16 with a fourth column of zeros. Throws if it is no K.
std::array<double, 4> intrinsicsOf(const Node& k, std::span<const double> byRows);
/// The camera of a 3x4 P = K [R | t] (12 numbers by rows). Throws for another matrix, and for a skew.
Json cameraOfMatrix(const Node& node, std::span<const double> p, const PictureSize& size);
/// The camera of P = [K | t] after the poses of a list. No rotation is made orthogonal on the way.
Json cameraBehind(const Node& node, std::span<const double> p, const PictureSize& size, Json poses);

// ---- Values

/// This many numbers; texts of numbers count. Marks them as read.
std::vector<double> numbersOf(const Node& node, std::size_t count = 0);
double numberOf(const Node& node);
/// Of a member that may be absent.
double numberAt(const Node& node, std::string_view member, double otherwise = 0);
/// The text of a member, or its JSON; empty if it is absent.
std::string textAt(const Node& node, std::string_view member);
/// The items of a list, or the one value that stands for a list of one; none if it is absent.
std::vector<Node> itemsAt(const Node& node, std::string_view member);

/// Members that must be absent, null, false, 0 or empty, because we do not support them. why: the rest of the sentence
/// after the member's name.
void refuse(const Node& node, std::string_view members, std::string_view why);

}  // namespace viewproj::cmd
