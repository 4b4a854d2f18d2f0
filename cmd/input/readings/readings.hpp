// Sixteen numbers read backwards: every camera, and every convention, that a matrix can have been written from.
//
// Nothing is guessed. Where the numbers admit several readings all are given, each with its parameters, and with the
// interval that the entries leave near and far.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "camera/pose.hpp"
#include "camera/projection.hpp"
#include "input/readings/estimate.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::cmd {

enum class MatrixKind {
  projection,      ///< clipFromView; determines view, ndcZ, reverseZ, ndcY, each given the others
  view,            ///< viewFromWorld; determines world and view, each given the other
  worldFromView,   ///< its inverse: a camera's pose
  viewProjection,  ///< clipFromWorld; determines ndcZ, reverseZ, and world and ndcY, each given the other
};

/// How the numbers, row by row as they are written, make the matrix M of y = M x.
enum class MatrixLayout {
  asWritten,   ///< row i of M is numbers 4 i to 4 i + 3: column vectors by rows, or row vectors by columns
  transposed,  ///< column i of M is: column vectors by columns, or row vectors by rows
  either,      ///< the matrix is symmetric
};

/// What the order of the numbers stands for.
enum class NumberOrder {
  memory,  ///< sixteen in a row: the order in memory
  rows,    ///< four rows of four: rows as on paper, or the order in memory
};

struct LensEstimate {
  bool orthographic = false;
  double left = 0, right = 0, bottom = 0, top = 0;  ///< as in Projection: at distance 1, or lengths
  double aspect = 1;                                ///< width / height of the window
  /// In perspective, in degrees: between the edges, and between the corners across from each other that are farther
  /// apart.
  std::optional<double> fovX, fovY, fovDiagonal;
  /// In perspective: the focal lengths in widths and in heights of the picture, and where the viewing axis meets it, in
  /// its widths from the left and its heights from the top.
  std::optional<std::array<double, 2>> focalLength, principalPoint;
  Estimate near, far;           ///< orthographic: with a view in it, counted from the world's origin
  bool beyondInfinity = false;  ///< infinite, and infinity a little inside the range ("tweaked")
};

struct PoseEstimate {
  bool eyeIsKnown = true;  ///< false in an orthographic view-projection: its edges are counted from the origin
  Vec3 eye;
  Vec3 right, up, forward;  ///< in the world; a view's rows, a pose's columns
  double residual = 0;      ///< how far the axes are from a rotation's: the largest entry of M^T M - I
};

struct Reading {
  MatrixKind kind = MatrixKind::projection;
  MatrixLayout layout = MatrixLayout::asWritten;
  Convention convention;  ///< only the axes that the kind determines mean something
  double scale = 1;       ///< all sixteen numbers are this times the usual ones: the picture is the same
  std::optional<LensEstimate> lens;
  std::optional<PoseEstimate> place;

  /// The camera, for what is to be written from it; no pose where only few digits let the axes count as one.
  std::optional<Projection> projection;
  std::optional<Pose> pose;
};

struct Inspection {
  std::vector<Reading> readings;
  /// Where there is no reading: what is wrong with the matrix, taken either way.
  std::string asWrittenFault, transposedFault;
};

/// Rows may be this far from right angles, and the w row this far from unit length, for the numbers to count as a view
/// or view-projection matrix: as for poses.
inline constexpr double kReadingOrthogonality = kPoseOrthogonality;

/// The last entry of an affine matrix may be this many units in the last place away from 1, as where an inverse was
/// computed: it is the scale of the whole, and all of the matrix is divided by it.
inline constexpr double kReadingUnit = 4;

/// A far plane beyond infinity by up to this share of 1/near counts as infinite ("tweaked" infinite projections).
inline constexpr double kReadingTweak = 0x1p-16;

/// Every reading of sixteen finite numbers of sizes between 2^-400 and 2^400, or 0; beyond, intervals may be too wide.
///
/// A perspective projection has a w row of exactly 0 0 +-1 0 and zeros where a projection has them; any other matrix
/// whose w row is not 0 0 0 1 (to kReadingUnit) is tried as a view-projection (that of a camera in the origin that
/// looks along z is its projection). An affine matrix with right angles is a view and a worldFromView if its axes are
/// of unit length, else an orthographic view-projection; if it is diagonal apart from the translation, an orthographic
/// projection too. Only where nothing fits are the numbers tried as a multiple of a matrix.
///
/// Intervals of near and far: a w row of 0 0 +-1 0 or 0 0 0 1 and zeros are exact; each other entry is moved to both
/// ends of its own interval, with all else computed in double-double; the changes of the depth's scale and offset add
/// up, and near and far follow in interval arithmetic. An entry is true to the precision, and no better than to its
/// number of `within`, which makes rows that are at right angles to that good. Depth is A + B / w, and near = B /
/// (D - A), where D is the NDC z at near: no digits are lost that the entries have. Exact to first order in an ulp.
///
/// Formulas: the closed forms of matrices.hpp, solved for their parameters.
Inspection inspectMatrix(const std::array<double, 16>& numbers, EntryPrecision precision = EntryPrecision::float64,
                         const std::array<double, 16>& within = {});

/// Whether a matrix of this reading would be written like that in this convention, apart from reverseZ and world, which
/// follow from the matrix and the rest: of one kind at most one reading fits, but of an orthographic view-projection
/// one for each handedness.
bool fits(const Reading& reading, const Convention& convention, NumberOrder order) noexcept;

/// The matrix of the same kind in another convention, for column vectors, from the recovered parameters. The world
/// stays the reading's. Throws CameraError where near or far is not determined well enough to be a camera's.
Mat4 converted(const Reading& reading, const Convention& convention);

}  // namespace viewproj::cmd
