// The textbook way from world to screen and back, as the baseline to measure against: one 4x4 product and a division;
// for a ray the inverse matrix, twice. Plain loops over arrays, as a careful programmer would write them.
#pragma once

#include <array>
#include <span>

#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The view-projection matrix and the viewport's map, rounded to T. The matrix is the library's closed form, which is
/// nearer the true one than a product of rounded matrices.
template <class T>
struct TextbookCamera {
  std::array<std::array<T, 4>, 4> clipFromWorld;
  std::array<T, 3> scale, offset;  ///< screen x, y and depth of NDC
};

template <class T>
TextbookCamera<T> textbookCamera(const Camera& camera);

/// Screen x, y and window depth of each point; NaN where clip w is not positive. T is double or float.
template <class T>
void projectByMatrix(const TextbookCamera<T>& camera, std::span<const Vector3<T>> points, std::span<Vector3<T>> screen);

/// The inverse of the above, in double.
struct TextbookInverse {
  Mat4 worldFromClip;
  std::array<double, 2> scale, offset;  ///< NDC of screen x and y
  double ndcNear = 0, ndcFar = 1;
};

TextbookInverse textbookInverse(const Camera& camera);

/// The unit direction from the unprojected near point to the unprojected far point of each pixel. With an infinite far
/// plane the far point is a division by zero, and the direction NaN.
void castByInverse(const TextbookInverse& inverse, std::span<const Vec2> pixels, std::span<Vec3> directions);

}  // namespace viewproj::cmd
