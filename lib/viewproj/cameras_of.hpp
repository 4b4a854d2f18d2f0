// Sixteen numbers read backwards: every camera, and every convention, that a matrix can have been written from.
//
// Nothing is guessed: where the numbers admit several cameras, all of them are given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewproj/camera.hpp"

namespace viewproj {

/// What a camera's matrix maps. Each determines some axes of the convention, and no others.
enum class MatrixKind {
  projection,      ///< clipFromView: view, ndcZ, reverseZ, ndcY
  view,            ///< viewFromWorld: world and view, each given the other
  worldFromView,   ///< the inverse of that: world and view
  viewProjection,  ///< clipFromWorld: ndcZ, reverseZ, and world and ndcY, each given the other
};

/// How sixteen numbers that stand in four rows make the matrix M of y = M x.
enum class MatrixLayout {
  asWritten,   ///< row i of M is row i
  transposed,  ///< column i of M is row i
  either,      ///< the matrix is symmetric
};

/// The distance of near or far, and the interval that the rounding of the matrix's entries leaves it. low and high are
/// infinite where far is; high alone is where the entries do not determine it.
struct PlaneDistance {
  double value = 0, low = 0, high = 0;
};

/// What a projection or a view-projection tells of the lens. That of an orthographic view-projection is counted from
/// the world's origin, for the eye is not in such a matrix.
struct MatrixLens {
  bool orthographic = false;
  double left = 0, right = 0, bottom = 0, top = 0;  ///< as in Projection
  PlaneDistance zNear, zFar;
  bool beyondInfinity = false;           ///< infinite, with infinity a little inside the range ("tweaked")
  std::optional<Projection> projection;  ///< none where near and far are not determined well enough to be a camera's
};

/// A camera that a matrix can be of.
struct MatrixCamera {
  MatrixKind kind = MatrixKind::projection;
  MatrixLayout layout = MatrixLayout::asWritten;
  Convention convention;  ///< of it the axes that the kind determines
  double scale = 1;       ///< all sixteen numbers are this times the usual ones; the picture is the same
  /// How far the axes are from right angles: of a view the largest entry of M^T M - I, else the largest cosine between
  /// two axes, or the part of the z row across the w row.
  double residual = 0;
  std::optional<Pose> pose;        ///< but of a projection
  std::optional<MatrixLens> lens;  ///< of a projection and a view-projection
};

/// What is known of a matrix beforehand.
struct MatrixQuery {
  std::optional<MatrixKind> kind{};
  std::optional<Convention>
      convention{};      ///< the matrix is one for column vectors; else the transpose is tried as well
  bool float32 = false;  ///< the entries are float32s; they are rounded to such first
};

struct MatrixCameras {
  std::vector<MatrixCamera> cameras;
  std::string fault, transposedFault;  ///< where there is no camera: what is wrong with the matrix and its transpose
};

/// Every camera of a matrix. Of a kind and a convention that are given there is one, with its pose and projection, or
/// none and a fault. A product of a projection and a view at the origin may be a projection itself: it counts as a
/// view-projection where that is the kind.
///
/// A perspective projection has a w row of exactly 0 0 +-1 0, and zeros where a projection has them; any other matrix
/// whose w row is not 0 0 0 1 (to 4 units in the last place, as an inverse has it) is tried as a view-projection. An
/// affine matrix within kPoseOrthogonality of a rotation is a view and its inverse; with right angles and axes of other
/// lengths it is an orthographic view-projection, and if it is diagonal apart from the translation an orthographic
/// projection. Only where nothing fits are the numbers tried as a multiple of a matrix.
///
/// A far plane beyond infinity by up to 2^-16 of 1/near counts as infinite. Pose and window come out within 2^-90 of
/// those of the entries taken as exact. For the intervals of near and far a w row of 0 0 +-1 0 or 0 0 0 1 and zeros are
/// exact, and each other entry is known to half a unit in its last place; they are right to first order in that.
///
/// Formulas: the closed forms of matrices.hpp, solved for their parameters.
MatrixCameras camerasOf(const Mat4& matrix, const MatrixQuery& query = {});

}  // namespace viewproj
