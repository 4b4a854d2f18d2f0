// The cameras of a file, each as a camera document with the options applied.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "camera/document.hpp"
#include "camera/importers/importer.hpp"
#include "camera/patch.hpp"
#include "camera/read_camera.hpp"

namespace viewproj::cmd {

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

class CameraDocuments {
 public:
  /// Throws InputError if the file's format is not known, or if it states another convention than readAs.
  CameraDocuments(Document file, CameraPatches patches);
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
  /// Whether the file is one of bare matrices, whose text may have readings where it makes no camera.
  bool areMatrices() const;
  const std::string& text() const { return *file_.text; }
  /// The camera's document with the options applied.
  Document document(std::size_t which) const;

 private:
  std::string someOf(const std::vector<std::size_t>& cameras) const;

  void countNames();

  Document file_;
  CameraPatches patches_;
  Import import_;
  std::unordered_map<std::string, std::size_t> names_, ids_;  ///< how often each occurs
};

}  // namespace viewproj::cmd
