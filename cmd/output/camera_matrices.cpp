#include "output/camera_matrices.hpp"

namespace viewproj::cmd {
namespace {

Pose poseOf(const MatrixSource& s) { return s.relativeToEye ? relativeToEye(*s.file.pose) : *s.file.pose; }

Mat4 view(const MatrixSource& s, bool inverse) {
  return inverse ? worldFromView(poseOf(s), s.convention) : viewFromWorld(poseOf(s), s.convention);
}

Mat4 projection(const MatrixSource& s, bool inverse) {
  const CameraFile& f = s.file;
  if (s.bakeViewport)
    return inverse ? viewFromScreen(*f.projection, *f.viewport, s.convention)
                   : screenFromView(*f.projection, *f.viewport, s.convention);
  return inverse ? viewFromClip(*f.projection, s.convention) : clipFromView(*f.projection, s.convention);
}

Mat4 viewProjection(const MatrixSource& s, bool inverse) {
  const CameraFile& f = s.file;
  const Pose pose = poseOf(s);
  if (s.bakeViewport)
    return inverse ? worldFromScreen(pose, *f.projection, *f.viewport, s.convention)
                   : screenFromWorld(pose, *f.projection, *f.viewport, s.convention);
  return inverse ? worldFromClip(pose, *f.projection, s.convention) : clipFromWorld(pose, *f.projection, s.convention);
}

Mat4 modelView(const MatrixSource& s, bool inverse) {
  return inverse ? localFromView(*s.file.pose, *s.worldFromLocal, s.convention)
                 : viewFromLocal(*s.file.pose, *s.worldFromLocal, s.convention);
}

Mat4 modelViewProjection(const MatrixSource& s, bool inverse) {
  const CameraFile& f = s.file;
  const Mat4& model = *s.worldFromLocal;
  if (s.bakeViewport)
    return inverse ? localFromScreen(*f.pose, *f.projection, *f.viewport, model, s.convention)
                   : screenFromLocal(*f.pose, *f.projection, *f.viewport, model, s.convention);
  return inverse ? localFromClip(*f.pose, *f.projection, model, s.convention)
                 : clipFromLocal(*f.pose, *f.projection, model, s.convention);
}

Mat4 viewport(const MatrixSource& s, bool inverse) {
  return inverse ? ndcFromScreen(*s.file.viewport, s.convention) : screenFromNdc(*s.file.viewport, s.convention);
}

constexpr CameraMatrix kRows[] = {
    {"view", true, false, false, false, view},
    {"projection", false, true, false, false, projection},
    {"viewProjection", true, true, false, false, viewProjection},
    {"modelView", true, false, false, true, modelView},
    {"modelViewProjection", true, true, false, true, modelViewProjection},
    {"viewport", false, false, true, false, viewport},
};

}  // namespace

std::span<const CameraMatrix> cameraMatrices() { return kRows; }

}  // namespace viewproj::cmd
