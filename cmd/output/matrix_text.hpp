// The matrices that a camera has, by name, and matrices in text formats. To add a matrix: a row of kCameraMatrices in
// matrix_text.cpp; a language: one of kLanguages.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/read_camera.hpp"
#include "text/form.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

/// What matrices are made of.
struct MatrixSource {
  const CameraFile& file;
  Convention convention;
  std::optional<Mat4> worldFromLocal = {};
  bool bakeViewport = false, relativeToEye = false;
};

struct NamedMatrix {
  std::string name;
  Mat4 matrix;  ///< for column vectors; the writer lays it out
  std::size_t rows = 4, columns = 4;
  std::string comment = {};  ///< empty: of the set's convention; else rows as they are, and what they are
};

struct CameraMatrix {
  std::string_view name;
  bool pose, projection, viewport, model;  ///< what it needs
  Space to, from;                          ///< to the screen in place of clip where the viewport is folded in
  /// In place of spaces: what it is, where axes are right, down, forward and no convention applies. One line.
  std::string_view ofCalibration = {};

  /// For column vectors. Throws InputError, or UsageError for the inverse of what has none.
  NamedMatrix make(const MatrixSource& source, bool inverse) const;
};

std::span<const CameraMatrix> cameraMatrices();

/// After the name of an inverse.
inline constexpr std::string_view kInverse = "Inverse";

struct MatrixSet {
  std::vector<NamedMatrix> matrices;
  std::optional<std::string> camera = {};  ///< of several: JSON is one line that names it
  Convention convention;
  std::optional<Vec3> eye;     ///< where the view was left without its translation
  bool asFloat = false;        ///< round to float32 and write its shortest text
  bool bakesViewport = false;  ///< projections go to the screen, not to clip space
};

/// A form is its name.
std::vector<FormRow<std::string_view>> matrixForms();

/// The edges of a window, in the order of OpenXR's XrFovf.
inline constexpr std::string_view kEdges[] = {"left", "right", "up", "down"};

/// format: one of matrixForms(). What its language knows only as float32 is rounded to that. Throws InputError, after
/// the source's name, for an entry too large for what is written, or where float32 leaves a row or column of 0.
std::string writeMatrices(MatrixSet set, std::string_view format, const std::string& source);

}  // namespace viewproj::cmd
