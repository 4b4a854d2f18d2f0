// The matrices that a camera has, by name. To add one: a row in camera_matrices.cpp.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "camera/read_camera.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

/// What matrices are made of.
struct MatrixSource {
  const CameraFile& file;
  Convention convention;
  std::optional<Mat4> worldFromLocal = {};
  bool bakeViewport = false, relativeToEye = false;
};

struct CameraMatrix {
  std::string_view name;
  bool pose, projection, viewport, model;  ///< what it needs
  Space to, from;                          ///< to the screen in place of clip where the viewport is folded in

  /// For column vectors.
  Mat4 make(const MatrixSource& source, bool inverse) const;
};

std::span<const CameraMatrix> cameraMatrices();

/// After the name of an inverse.
inline constexpr std::string_view kInverse = "Inverse";

}  // namespace viewproj::cmd
