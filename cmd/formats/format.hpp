// Camera files of other programs. A format moves values into our camera document (viewproj help camera). Most are rows
// of a table (rows.cpp); a file of its own has a format that takes arithmetic, joins or binary data. What a row or a
// file computes is only what the document has no field for; the document's reader does the rest.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
extern const Format kGltf, kThreeJs, kTransforms, kMetashape, kMetashapeLens, kMeshroom, kOpenSfm, kOpenSfmLenses,
    kBundler, kExif, kTable, kScanner, kKalibr, kKitti, kStereo, kPoses, kMatrices;

/// fx, fy, cx, cy of a K of 9 numbers by rows, or of 12 or 16 with a fourth column of zeros. Throws if it is no K.
std::array<double, 4> intrinsicsOf(const Node& k, std::span<const double> byRows);

/// Our document of a camera at the origin, in the convention opencv and with the pixels of the file's pictures.
/// intrinsics: fx, fy, cx, cy.
Json pinholeCamera(std::span<const double> intrinsics, const std::optional<std::array<double, 2>>& size,
                   double pixelCenter = 0);

/// Replaces the pose of a camera.
void setPose(Json& camera, std::string_view field, Json pose);

/// The camera of a 3x4 P = K [R | t] (12 numbers by rows). Throws for another matrix, and for a skew.
Json cameraOfMatrix(const Node& node, std::span<const double> p, const std::optional<std::array<double, 2>>& size);

/// A lens: its model by the name that other programs give it (empty: OpenCV's own list), and its coefficients in their
/// order or by name. Null if it is a pinhole. Throws for an unknown model, and for a wrong number of coefficients.
Json lensOf(const Node& where, std::string_view model, std::vector<double> coefficients);
Json lensOf(const Node& where, std::string_view model, const std::vector<std::pair<std::string, double>>& named);
/// Whether a lens of this model is a pinhole if all its coefficients are 0 or there are none.
bool mayBePinhole(std::string_view model);

/// This many numbers; texts of numbers count. Marks them as read.
std::vector<double> numbersOf(const Node& node, std::size_t count = 0);
double numberOf(const Node& node);

/// The rows of a matrix as JSON.
Json rowsOf(std::span<const double> numbers, std::size_t columns);

/// A member that must be absent, null, false, 0 or empty, because we do not support it. why: the rest of the sentence
/// after the member's name.
void refuse(const Node& node, std::initializer_list<std::string_view> members, std::string_view why);

}  // namespace viewproj::cmd
