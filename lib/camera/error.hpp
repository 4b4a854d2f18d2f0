// The one exception of the library: a camera that cannot be built.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace viewproj {

/// Thrown while a camera is described, never while points are projected.
class CameraError : public std::invalid_argument {
 public:
  /// field: the parameter at fault, named as in a camera file ("up", "far", "viewport.width", ...).
  CameraError(std::string field, const std::string& message)
      : std::invalid_argument(field + ": " + message), field_(std::move(field)), message_(message) {}

  const std::string& field() const noexcept { return field_; }
  const std::string& message() const noexcept { return message_; }

 private:
  std::string field_;
  std::string message_;
};

/// Written so that NaN fails.
inline void requirePositive(double value, const char* field) {
  if (!(value > 0 && std::isfinite(value))) throw CameraError(field, "must be a finite number above 0");
}

inline void requireFinite(double value, const char* field) {
  if (!std::isfinite(value)) throw CameraError(field, "must be a finite number");
}

}  // namespace viewproj
