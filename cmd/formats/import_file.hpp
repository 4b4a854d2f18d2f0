// Knows a camera file by its content, and finds its cameras.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera_set.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

/// A tree that no format claims.
struct UnknownFile : UnknownFormat {
  UnknownFile(const std::string& message, Document tree, bool ours = false)
      : UnknownFormat(message, tree.text && !ours ? *tree.text : ""), file(std::move(tree)), isOurs(ours) {}
  Document file;
  bool isOurs;  ///< it is read as our own, and has members that ours has not
};

/// What is typed beside the file.
struct Opening {
  std::string option;                  ///< the name of inline JSON in messages
  std::optional<std::string> pick{};   ///< what stands after #
  std::optional<std::string> parts{};  ///< of --parts
  bool takesAll = false;               ///< without a pick, what is of another camera too
  /// Files or texts of poses, of which the product is the camera's pose, and the field that it sets.
  std::vector<std::string> poses{};
  std::string direction{};
  std::string cameraAxes{};  ///< that --set gives; or empty
};

/// The cameras of a file, by its format or by the line of --parts. preset: of --read-as, or empty. Throws UnknownFile,
/// InputError.
Import importFile(const std::shared_ptr<Document>& file, const Opening& opening, const std::string& preset);

/// Where --read-as is given for a form that has a convention.
[[noreturn]] void failPreset(const std::string& name, std::string_view form);

/// Formats in the order of help: a row for each name.
struct FormatName {
  std::string_view name, form;
};
std::vector<FormatName> formatNames();

/// The names of all formats that claim a file. One, or none.
std::vector<std::string> claimants(const Document& file);

}  // namespace viewproj::cmd
