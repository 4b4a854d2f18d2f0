// The objects of a camera file, and which of them a field is of.
#pragma once

#include <string>
#include <string_view>

#include "input/field.hpp"

namespace viewproj::cmd {

/// "; it belongs in projection", of a name that stands where it is none, but is a field of another object of a camera
/// file, or of another type of projection. Empty where form is no object of a camera file, or the name no field.
std::string whereItBelongs(std::string_view name, const ObjectForm& form);

}  // namespace viewproj::cmd
