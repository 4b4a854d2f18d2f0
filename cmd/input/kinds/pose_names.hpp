// Names under which files say where a camera stands: put together from the words of one table.
#pragma once

#include <string_view>

namespace viewproj::cmd {

enum class PoseName {
  none,
  vague,    ///< the camera's place, or that of a part of a machine; or several poses
  certain,  ///< a pose: extrinsics, rvec, T_cam_world, c2w
};

/// In any case, with or without underscores, hyphens and blanks.
PoseName poseName(std::string_view name);

/// Whether a single number under the name says something, as under yaw.
bool isTurnName(std::string_view name);

}  // namespace viewproj::cmd
