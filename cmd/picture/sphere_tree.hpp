// Finds the things that a ray may meet by spheres around them, so that nobody asks all of them.
#pragma once

#include <cstddef>
#include <vector>

#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

class SphereTree {
 public:
  SphereTree() = default;
  /// Some may be infinite.
  explicit SphereTree(std::vector<Sphere> spheres);

  /// Whether is(index) holds for one of those whose sphere a ray may meet, no farther away than this. In no particular
  /// order.
  template <class Is>
  bool any(const Ray& ray, double farthest, Is is) const {
    return !order_.empty() && any(ray, farthest, is, {0, 0, order_.size()});
  }

 private:
  static constexpr std::size_t kOfLeaf = 2;
  struct Node {
    std::size_t index, begin, end;  ///< of nodes_, and of order_

    bool isLeaf() const { return end - begin <= kOfLeaf; }
    Node first() const { return {2 * index + 1, begin, begin + (end - begin) / 2}; }
    Node second() const { return {2 * index + 2, begin + (end - begin) / 2, end}; }
  };
  void build(const Node& node);
  static bool mayMeet(const Sphere& sphere, const Ray& ray, double farthest);

  template <class Is>
  bool any(const Ray& ray, double farthest, Is is, const Node& node) const {
    if (!mayMeet(nodes_[node.index], ray, farthest)) return false;
    if (!node.isLeaf()) return any(ray, farthest, is, node.first()) || any(ray, farthest, is, node.second());
    for (std::size_t i = node.begin; i < node.end; ++i)
      if (mayMeet(spheres_[order_[i]], ray, farthest) && is(order_[i])) return true;
    return false;
  }

  std::vector<Sphere> spheres_, nodes_;  ///< a node's sphere holds those of its things
  std::vector<std::size_t> order_;
};

}  // namespace viewproj::cmd
