#include "output/camera_matrices.hpp"

namespace viewproj::cmd {

Mat4 CameraMatrix::make(const MatrixSource& s, bool inverse) const {
  const CameraFile& f = s.file;
  const Space destination = to == Space::clip && s.bakeViewport ? Space::screen : to;
  const std::optional<Pose> eyeAtOrigin = s.relativeToEye && f.pose && !model ? relativeToEye(*f.pose) : f.pose;
  const Camera camera = cameraIn(s.convention, eyeAtOrigin, f.projection, f.viewport);
  const Space first = inverse ? from : destination, second = inverse ? destination : from;
  return model ? matrix(camera, first, second, *s.worldFromLocal) : matrix(camera, first, second);
}

std::span<const CameraMatrix> cameraMatrices() {
  static constexpr CameraMatrix kRows[] = {
      {"view", true, false, false, false, Space::view, Space::world},
      {"projection", false, true, false, false, Space::clip, Space::view},
      {"viewProjection", true, true, false, false, Space::clip, Space::world},
      {"modelView", true, false, false, true, Space::view, Space::model},
      {"modelViewProjection", true, true, false, true, Space::clip, Space::model},
      {"viewport", false, false, true, false, Space::screen, Space::ndc},
  };
  return kRows;
}

}  // namespace viewproj::cmd
