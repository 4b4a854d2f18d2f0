// What a picture shows of a curve, and whether the scene hides it: edges, outlines, horizons and grid lines.
#pragma once

#include <functional>
#include <vector>

#include "picture/view.hpp"

namespace viewproj::cmd {

struct Piece {
  bool isHidden = false;
  std::vector<Vec2> line;  ///< on the sheet
};
using Pieces = std::vector<Piece>;
std::vector<Vec2> pointsOf(const Pieces& pieces);
/// The pieces in their order, joined where one ends as the next begins, and at last the first.
std::vector<Line> joined(const Pieces& pieces);

struct CurveOptions {
  Extent extent = Extent::view;
  const SceneObject* except = nullptr;  ///< a shape that does not hide it
  bool findsHidden = true;              ///< else all of it is seen
};

/// The pieces of at(t), t from 0 to 1, from at least so many steps. Where a piece begins or ends is found by halving,
/// and a step that is long or bent on the sheet is halved too. Where the picture of a curve jumps, as behind a lens
/// that sees nearly all around, a piece ends.
Pieces piecesOf(const View& view, const std::function<Vec4(double)>& at, int steps, const CurveOptions& options = {});

/// Of a segment, by steps of equal angles at the eye, so that what is near the eye gets its share.
Pieces piecesOf(const View& view, const Vec3& a, const Vec3& b, const CurveOptions& options = {});

}  // namespace viewproj::cmd
