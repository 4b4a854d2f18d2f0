// The cameras of a file, each as a camera document with the options laid over it.
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

/// "scene.gltf#Camera": the file and the camera picked in it. A file whose own name has a # is found first.
struct CameraSource {
  std::string file;  ///< as load takes it
  std::optional<std::string> pick;
};
CameraSource splitPick(const std::string& given);

/// How cameras are read, whatever file they come from.
struct CameraPatches {
  std::string readAs;  ///< a preset's name; empty: the file's convention
  std::vector<Patch> patches;
};

class CameraDocuments {
 public:
  /// Throws InputError where the file is of no known kind, and where it states a convention in spite of readAs.
  CameraDocuments(Document file, CameraPatches patches);
  /// Of options alone.
  explicit CameraDocuments(CameraPatches patches);
  CameraDocuments(const CameraDocuments&) = delete;
  CameraDocuments& operator=(const CameraDocuments&) = delete;

  std::size_t size() const { return import_.cameras.size(); }
  /// As the file calls it; empty where it does not.
  const std::string& nameOf(std::size_t which) const { return import_.cameras[which].name; }
  /// The shortest text after # that picks the camera and no other.
  std::string pickOf(std::size_t which) const;
  /// By name, id or number (## for the number alone); the only camera where there is no pick. Throws InputError.
  std::size_t choose(const std::optional<std::string>& pick) const;
  /// The camera's document as the options make it.
  Document document(std::size_t which) const;

 private:
  std::string someOf(const std::vector<std::size_t>& cameras) const;

  void countNames();

  Document file_;
  CameraPatches patches_;
  Import import_;
  std::unordered_map<std::string, std::size_t> names_, ids_;  ///< how often there is each
};

}  // namespace viewproj::cmd
