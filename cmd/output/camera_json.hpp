// JSON fields of a camera file, and the forms of its pose. Internal to camera_text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "input/camera_file.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {

/// Fields in the order given; values are JSON.
class Fields {
 public:
  void add(std::string_view name, const std::string& json) {
    text_ += (text_.empty() ? "\"" : ", \"") + std::string(name) + "\": " + json;
  }
  void add(std::string_view name, double number) { add(name, formatNumber(number)); }
  void add(std::string_view name, DoubleDouble number) { add(name, number.hi); }
  void addName(std::string_view name, std::string_view value) { add(name, "\"" + std::string(value) + "\""); }
  const std::string& text() const { return text_; }
  std::string object() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

/// A pose in the forms that a file has for one, what people read most easily first. Any rotation fits into that but for
/// its last bits, which count in a very narrow field of view; the others hold to the last bit what was given in their
/// form. One empty form where the camera has no pose.
std::vector<std::string> poseForms(const CameraFile& camera, const ConventionPreset& preset);

}  // namespace viewproj::cmd
