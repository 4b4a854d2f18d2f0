// Camera documents with a change to what they say: another world, another place, a wider lens. Each keeps the form of
// pose and lens that was read, where that form can hold the change.
#pragma once

#include <array>
#include <cstddef>

#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// A signed permutation of axes.
struct AxisMap {
  std::array<std::size_t, 3> from = {0, 1, 2};  ///< which of the old axes the new x, y, z are
  std::array<int, 3> signs = {1, 1, 1};         ///< -1: against it

  /// Whether it turns a right-handed world into a left-handed one.
  bool mirrors() const;
  friend bool operator==(const AxisMap&, const AxisMap&) = default;
};

/// With a value of its own: copies of a document share theirs.
Document copied(const Document& document);

/// What shows the same picture of the world so mapped, with lengths times scale > 0. Angles of the pose become a
/// rotation where the axes change, and a place on the Earth becomes x, y, z.
Document mapped(const CameraFile& camera, const AxisMap& map, double scale);

/// The same view from elsewhere: a target becomes the direction to it.
Document movedTo(const CameraFile& camera, const Vec3& eye);

/// Of a perspective: the window so many times as wide and high, about the viewing axis.
Document opened(const CameraFile& camera, double factor);

/// Orthographic, with these edges. A crop becomes a viewport of its own.
Document withWindow(const CameraFile& camera, double left, double right, double bottom, double top);

/// The projection without the document's shift and crop.
Projection plainProjection(const Document& document);
/// Gives projection.matrix, as the convention writes it on paper.
void setLensMatrix(Document& document, const Projection& projection, const Convention& convention);

}  // namespace viewproj::cmd
