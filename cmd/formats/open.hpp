// Opens camera files: known by their content, or read by their parts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_set.hpp"
#include "formats/format.hpp"
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
  /// Files or texts of poses, of which the product is the camera's pose, and the field that it sets.
  std::vector<std::string> poses{};
  std::string direction{};
};

/// The cameras of a file; with --parts those that its line builds. Throws UnknownFile, InputError.
std::unique_ptr<CameraSet> openCameras(const std::string& file, const Opening& opening, CameraPatches patches);
/// The same of a file that is read.
std::unique_ptr<CameraSet> openDocument(Document file, const Opening& opening, CameraPatches patches);
/// The cameras of options alone, at the poses of a file.
std::unique_ptr<CameraSet> openPoses(const Opening& opening, CameraPatches patches);

/// Whether a camera's document has another pose than that of a file which gives none.
bool hasPose(const Json& camera);

/// Formats in the order of help: a row for each name.
struct FormatName {
  std::string_view name, form;
};
std::vector<FormatName> formatNames();

/// The names of all formats that claim a file. One, or none.
std::vector<std::string> claimants(const Document& file);

}  // namespace viewproj::cmd
