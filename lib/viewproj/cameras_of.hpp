// Finds every camera, and every convention, that a 4x4 matrix can have been written from.
//
// A component of its own: link viewproj::cameras_of. Nothing is guessed: if several cameras fit the numbers, all of
// them are returned.
//
// Example:
//   const Mat4 pasted{{{{0.75, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1.02, -2.02}, {0, 0, -1, 0}}}};
//   const MatrixCameras found = camerasOf(pasted, {.kind = MatrixKind::projection, .convention = conventions::opengl});
//   const Projection& p = *found.cameras[0].lens->projection;
//   std::printf("%g degrees, near %.3f, far %.0f", p.fov(Fov::vertical), p.zNear(), p.zFar());
//   // prints 90 degrees, near 1.000, far 101
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewproj/camera.hpp"

namespace viewproj {

/// What a camera's matrix maps. The comments name the fields of the convention that each kind determines.
enum class MatrixKind {
  projection,      ///< clipFromView: view, ndcZ, reverseZ, ndcY
  view,            ///< viewFromWorld: world and view, each if the other is known
  worldFromView,   ///< the inverse of a view: world and view
  viewProjection,  ///< clipFromWorld: ndcZ, reverseZ, and world and ndcY, each if the other is known
};

/// How sixteen numbers, written in four rows, make the matrix M of y = M x.
enum class MatrixLayout {
  asWritten,   ///< row i of M is row i
  transposed,  ///< column i of M is row i
  either,      ///< the matrix is symmetric
};

/// The distance of near or far, and the interval it may lie in because of the errors of the matrix's entries. If far is
/// infinite, it is at least low; if it is infinite for sure, low is infinite too. Only high is infinite if the entries
/// do not determine it.
struct PlaneDistance {
  double value = 0, low = 0, high = 0;
};

/// The projection in a projection or view-projection matrix. An orthographic view-projection has no eye: its edges and
/// distances are counted from the world's origin.
struct MatrixLens {
  bool orthographic = false;
  double left = 0, right = 0, bottom = 0, top = 0;  ///< as in Projection
  PlaneDistance zNear, zFar;
  Vec2 fovError;                ///< how far the angles of view may be off, horizontal and vertical, in degrees
  bool beyondInfinity = false;  ///< infinite far, with depth at infinity slightly inside the range ("tweaked")
  std::string depthFault;       ///< if not empty: rows x, y and w are a camera's, and what the z row is instead
  /// Empty if near and far are not determined well enough for a camera. Without near if the z row is 0 0 0 0.
  std::optional<Projection> projection;
};

/// A camera that fits a matrix.
struct MatrixCamera {
  MatrixKind kind = MatrixKind::projection;
  MatrixLayout layout = MatrixLayout::asWritten;
  Convention convention;  ///< only the fields that the kind determines are meaningful
  double scale = 1;       ///< all sixteen numbers are the usual ones times this; the picture is the same
  /// How far the axes are from right angles. For a view or its inverse, the largest entry of M^T M - I. Otherwise the
  /// largest cosine between two axes, or the part of the z row that is not along the w row.
  double residual = 0;
  std::optional<Pose> pose;        ///< empty for a projection; of axes that are further off, the nearest right angles
  Vec3 eyeError;                   ///< how far each coordinate of the eye may be off
  std::optional<MatrixLens> lens;  ///< set for a projection and a view-projection
};

/// What is already known about a matrix.
struct MatrixQuery {
  std::optional<MatrixKind> kind{};
  std::optional<Convention> convention{};  ///< set: the matrix is for column vectors; else its transpose is tried too
  std::optional<MatrixLayout> layout{};    ///< asWritten or transposed: only this one is tried
  std::optional<Mat4> errors{};            ///< of each entry; else half a unit in its last place, and 0 of a zero
};

struct MatrixCameras {
  std::vector<MatrixCamera> cameras;
  std::string fault, transposedFault;  ///< if no camera fits: what is wrong with the matrix, and with its transpose
};

/// Returns every camera that fits the matrix. If kind and convention are given, there is one camera with its pose and
/// projection, or none and a fault. A projection times a view at the origin may look like a projection: it counts as a
/// view-projection only if that is the given kind.
///
/// A perspective projection has a w row of exactly 0 0 +-1 0, and zeros where a projection has zeros. Any other matrix
/// is tried as a view-projection unless its w row is 0 0 0 1 (to 4 units in the last place, as in a computed inverse).
/// An affine matrix within kPoseOrthogonality of a rotation is a view and its inverse. With right angles but other
/// lengths it is an orthographic view-projection, or an orthographic projection if it is diagonal apart from the
/// translation. Only if nothing fits is the matrix tried as a multiple of one, and then as one whose z row is no depth
/// (depthFault; there near, far, ndcZ and reverseZ mean nothing).
///
/// Errors of the entries widen what counts as a right angle, as 1 and as 0 0 0 1. Where they are so large that a right
/// angle cannot be told, nothing fits.
///
/// A far plane beyond infinity by up to 2^-16 of 1/near counts as infinite. Pose and window are within 2^-90 of those
/// of the entries taken as exact. A w row of 0 0 +-1 0 or 0 0 0 1 and the zeros of a projection are exact. The
/// intervals of near, far, eye and fields of view are right to first order, widened where the errors are large.
///
/// Formulas: the closed forms of matrices.cpp, solved for their parameters.
MatrixCameras camerasOf(const Mat4& matrix, const MatrixQuery& query = {});

}  // namespace viewproj
