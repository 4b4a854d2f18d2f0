// What peers do with the same camera and points.
#pragma once

#include <span>

#include "viewproj/viewproj.hpp"

namespace benchmark {

struct PeerCamera {
  viewproj::Mat4 view, projection;
  double width, height;
};

struct Vec3f {
  float x, y, z;
};

/// The peers as one set of compiler options makes them.
struct Peers {
  void (*glmProjectDouble)(const PeerCamera&, std::span<const viewproj::Vec3>, std::span<viewproj::Vec3>);
  void (*glmProjectFloat)(const PeerCamera&, std::span<const Vec3f>, std::span<Vec3f>);
  void (*eigenCachedDouble)(const PeerCamera&, std::span<const viewproj::Vec3>, std::span<viewproj::Vec3>);
  void (*glmUnProjectTwice)(const PeerCamera&, std::span<const viewproj::Vec2>, std::span<viewproj::Vec3>);
};

extern const Peers peersO2, peersO3;

}  // namespace benchmark
