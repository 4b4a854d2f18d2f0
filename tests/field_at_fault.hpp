// What a camera is refused for.
#pragma once

#include <string>

#include "viewproj/camera.hpp"

/// The field that makeCamera and its parts complain of, or nothing.
template <class Build>
std::string fieldAtFault(Build build) {
  try {
    build();
  } catch (const viewproj::CameraError& error) {
    return error.field();
  }
  return "";
}
