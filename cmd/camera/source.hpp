// The cameras of a file, each as a camera document with the options applied.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "camera/document.hpp"
#include "camera/patch.hpp"
#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// One of the cameras of a file. FILE#NAME, FILE#ID or FILE#NUMBER picks it.
struct CameraEntry {
  std::string name;  ///< the name in the file, or empty
  std::string id;    ///< a number or a second name, or empty
};

/// The cameras of a file, as a format finds them.
struct Import {
  std::vector<CameraEntry> cameras;
  /// Our document of a camera of the list. Throws InputError naming the file's own field.
  std::function<Json(std::size_t which)> document;
  /// What the file has of this camera alone.
  std::function<std::optional<Node>(std::size_t which)> own = nullptr;
  /// Parts of the file that are of other cameras, or none.
  std::vector<const Json*> apart = {};
  /// What the format has not read of a camera, for a note; or empty.
  std::function<std::string(std::size_t which)> unread = nullptr;
};

/// "scene.gltf#Camera": a file and the camera to pick in it. A file whose own name has a # is found first.
struct CameraSource {
  std::string file;  ///< in the form that load() accepts
  std::optional<std::string> pick;
};
CameraSource splitPick(const std::string& source);

/// The options that apply to every camera, from any file.
struct CameraPatches {
  std::string readAs;  ///< the name of a preset; empty: the file's convention
  std::vector<Patch> patches;
};

/// Whether a document is a camera in our own form: it has one of our members at the top (but "name" and "$schema"
/// alone), or no member at all.
bool isCameraDocument(const Json& root);
/// The camera of such a document.
Import openCameraDocument(const Document& file);
/// Sets the convention that a file does not state. Throws InputError if it states another one.
void readAs(Document& file, const std::string& preset);

class CameraDocuments {
 public:
  /// name: of the file, in messages. Throws InputError for an empty list.
  CameraDocuments(std::string name, Import cameras, CameraPatches patches);
  /// A camera from options only.
  explicit CameraDocuments(CameraPatches patches);
  CameraDocuments(const CameraDocuments&) = delete;
  CameraDocuments& operator=(const CameraDocuments&) = delete;

  std::size_t size() const { return import_.cameras.size(); }
  /// The name in the file; empty if it has none.
  const std::string& nameOf(std::size_t which) const { return import_.cameras[which].name; }
  /// The shortest text after # that picks only this camera.
  std::string pickOf(std::size_t which) const;
  /// Finds a camera by name, id or number (## for a number only); without a pick, the only camera. Throws InputError.
  std::size_t choose(const std::optional<std::string>& pick) const;
  /// The camera's document with the options applied.
  Document document(std::size_t which) const;
  /// What the file's format has not read of the camera; empty if there is nothing to say.
  std::string unreadOf(std::size_t which) const { return import_.unread ? import_.unread(which) : ""; }

 private:
  std::string someOf(const std::vector<std::size_t>& cameras) const;

  void countNames();

  std::string name_;
  bool isTyped_ = false;
  CameraPatches patches_;
  Import import_;
  std::unordered_map<std::string, std::size_t> names_, ids_;  ///< how often each occurs
};

}  // namespace viewproj::cmd
