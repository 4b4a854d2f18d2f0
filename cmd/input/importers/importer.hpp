// Cameras that people already have, in files that no row of input/kinds can describe. A form of file is a file here
// that ends in CameraFile, the few numbers that every camera is, and a row in camera_source.cpp, which tells the forms
// apart.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/camera_file.hpp"
#include "input/document.hpp"
#include "input/viewport_fields.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// One of the cameras that a file holds. What the file says stays the document's: many may share a long name.
struct HeldCamera {
  std::string_view name;   ///< as the file calls it, or empty
  std::string id;          ///< a number or a text that picks it too, or empty
  std::string number;      ///< its place in the file: picks it where nothing else does
  std::string_view alias;  ///< another name, or empty
  std::string_view kind;   ///< perspective, orthographic, ...
  std::string note;        ///< a few words: what the file says of it
};

/// A perspective camera whose file knows no near plane (a camera of the real world) gets this one, and no far plane.
inline constexpr double kDefaultNear = 0.01;

/// Noted where --ignore-distortion was needed.
inline constexpr const char* kDistortionLeftOut =
    "distorts the picture and is left out: pixels are those of an ideal lens";

/// Reads one of the cameras of a document. which: its place in the list.
using CameraReader = std::function<CameraFile(std::size_t which, const CameraReading& reading)>;

struct Importer {
  std::string_view name;  ///< as help lists it
  std::string_view form;  ///< "a glTF file"
  bool (*recognises)(const nlohmann::json& root);
  std::vector<HeldCamera> (*list)(const Document&);
  /// What all cameras have in common is read once. The document must outlive the reader.
  CameraReader (*open)(const Document&);
};

extern const Importer kGltf, kThreeJs, kMatrices;

/// What make gives. What the library complains about is at `at`, under the file's own name for the field.
template <class Make>
auto located(const ObjectReader& at, std::initializer_list<std::pair<std::string_view, std::string_view>> names,
             Make make) {
  try {
    return make();
  } catch (const CameraError& e) {
    for (const auto& [field, name] : names)
      if (field == e.field() && !name.empty()) at.fail(name, e.message());
    at.fail(e.message());
  }
}

/// The viewport as the options, or the file in the words of a camera file, give it. Throws InputError.
std::optional<ReadViewport> importedViewport(const Document& document, const ViewportDefaults& defaults = {});

/// projection is of the whole frame, not yet cut to its tile.
CameraFile imported(const Document& document, const Convention& convention, const std::optional<Pose>& pose,
                    const std::optional<Projection>& projection, const std::optional<ReadViewport>& viewport);

/// "0.785": for notes.
std::string shortNumber(double value);

/// ", near 0.1, far 100": the numbers of these fields, where they are there, for notes.
std::string shortNumbers(const ObjectReader& fields, std::initializer_list<std::string_view> keys);

/// So many numbers (0: any) in arrays of any nesting, as in [[1,2],[3,4]] or [1,2,3,4].
std::optional<std::vector<double>> flatNumbers(const ObjectReader& fields, std::string_view key, std::size_t count);

}  // namespace viewproj::cmd
