// The pose of a camera as the row of its kind describes it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "input/kinds/lookup.hpp"
#include "numbers/vectors.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// The columns of a rotation from the camera to the world, and the eye.
struct Placed {
  std::array<detail::DDVec3, 3> columns{detail::DDVec3{1, 0, 0}, detail::DDVec3{0, 1, 0}, detail::DDVec3{0, 0, 1}};
  detail::DDVec3 eye{};
};

/// The poses of a file's cameras. Each link of a chain is read once.
class Poses {
 public:
  /// all: the cameras of the file, which stay the caller's.
  explicit Poses(std::span<const CameraPlace> all);

  /// Of one of them. Throws InputError.
  Pose of(const CameraPlace& camera);
  /// Throws InputError where that would, of what stands in the camera itself.
  void require(const CameraPlace& camera);

 private:
  Pose inChain(const CameraPlace& camera);
  bool startsChain(const CameraPlace& camera) const;
  /// Throws where it does not say where it is from the one before, or there is none.
  void requireLink(const CameraPlace& camera) const;

  std::unordered_set<std::string> cameras_;                     ///< of a chain: their paths
  std::unordered_map<std::string, unsigned long> firsts_ = {};  ///< the lowest number of each chain
  bool hasLinks_ = false;                                       ///< one of its cameras says where it is
  std::unordered_map<std::string, Placed> placed_ = {};         ///< by paths
};

/// What says where the camera is; nothing where the row finds nothing.
std::optional<Found> poseField(const CameraPlace& camera);

}  // namespace viewproj::cmd
