#include "picture/sphere_tree.hpp"

#include <algorithm>
#include <numeric>

#include "camera/plain_vectors.hpp"
#include "numbers/vectors.hpp"

namespace viewproj::cmd {

SphereTree::SphereTree(std::vector<Sphere> spheres)
    : spheres_(std::move(spheres)), nodes_(4 * spheres_.size()), order_(spheres_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!order_.empty()) build({0, 0, order_.size()});
}

/// Halves the things along the axis on which they lie farthest apart.
void SphereTree::build(const Node& node) {
  constexpr double kRounded = 1 + 1e-12;
  const auto at = [&](std::size_t i) -> const Sphere& { return spheres_[order_[i]]; };
  Vec3 least = at(node.begin).center, most = least;
  for (std::size_t i = node.begin; i < node.end; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], at(i).center[axis]);
      most[axis] = std::max(most[axis], at(i).center[axis]);
    }
  Sphere& around = nodes_[node.index];
  around = {sum(scaled(least, 0.5), 0.5, most), 0};
  for (std::size_t i = node.begin; i < node.end; ++i)
    around.radius = std::max(around.radius, (apart(at(i).center, around.center) + at(i).radius) * kRounded);
  if (node.isLeaf()) return;
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (most[axis] - least[axis] > most[widest] - least[widest]) widest = axis;
  const auto place = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(node.begin), place(node.second().begin), place(node.end), [&](std::size_t a, std::size_t b) {
    return spheres_[a].center[widest] < spheres_[b].center[widest];
  });
  build(node.first());
  build(node.second());
}

bool SphereTree::mayMeet(const Sphere& sphere, const Ray& ray, double farthest) {
  constexpr double kMore = 1e-9;
  const double radius = sphere.radius;
  const Vec3 way = sum(sphere.center, -1, ray.origin), aside = detail::crossOf(way, ray.direction);
  const double along = detail::dot(way, ray.direction), more = kMore * (std::fabs(along) + radius);
  const bool isBehind = along + radius<-more, isBeyond = along - radius> farthest + more;
  const bool isAside =
      detail::dot(aside, aside) > radius * radius * (1 + kMore) + kMore * kMore * detail::dot(way, way);
  return !(isBehind || isBeyond || isAside);
}

}  // namespace viewproj::cmd
