// A camera of a matrix in a convention: whether it is written so, and how it would be.
#pragma once

#include "input/written_matrix.hpp"
#include "viewproj/cameras_of.hpp"

namespace viewproj::cmd {

/// Whether a matrix of this camera would be written like that in this convention, apart from reverseZ and world, which
/// follow from the matrix and the rest: of one kind at most one camera fits, but of an orthographic view-projection
/// one for each handedness.
bool fits(const MatrixCamera& camera, const Convention& convention, NumberOrder order) noexcept;

/// The matrix of the same kind in another convention, for column vectors, from the recovered parameters. The world
/// stays the camera's. Throws CameraError where near or far is not determined well enough to be a camera's.
Mat4 converted(const MatrixCamera& camera, const Convention& convention);

}  // namespace viewproj::cmd
