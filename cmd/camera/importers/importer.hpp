// Camera files of other programs. An importer moves values into our camera document (viewproj help camera). It computes
// only what the document has no field for, such as a chain of nodes or a 3x4 matrix; the document's reader does the
// rest. To add a format, add a file here and its row in kImporters (importer.cpp).
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera_set.hpp"
#include "camera/document.hpp"

namespace viewproj::cmd {

struct Importer {
  std::string_view name;  ///< name in help formats
  std::string_view form;  ///< "a glTF file"
  bool (*recognises)(const Json& root);
  Import (*open)(const Node& root);  ///< root must outlive the result; throws InputError
};

/// The cameras of a file of any format. source: as load() takes it; also a .glb, or a folder or file of COLMAP. Throws
/// InputError if the format is not known, or if it has another convention than patches.readAs.
std::unique_ptr<CameraSet> openCameras(const std::string& source, const std::string& option, CameraPatches patches);

/// Bare matrices: the only foreign files that --read-as applies to.
extern const Importer kMatrices;
/// What readColmap gives, and no other document.
extern const Importer kColmap;

/// All importers, in the order in which they are tried.
std::span<const Importer* const> importers();

/// Throws if the node has one of these members with a value other than null, false, 0 or empty, because we do not
/// support it. why: the rest of the sentence after the member's name.
void refuse(const Node& node, std::initializer_list<std::string_view> members, std::string_view why);

/// {"model": "brown", "k": ..., "p": ...}, {"model": "fisheye", "k": ...} or {"model": "fov", "omega": ...} from
/// coefficients in OpenCV's order; null if all of brown's are 0. model: its name in the file; empty for OpenCV's own
/// list. A known model that our document lacks is passed on, so that its reader can refuse or ignore it. Throws for an
/// unknown model.
Json distortionOf(const Node& coefficients, std::string_view model);

/// Whether a lens of this model is a pinhole if all its coefficients are 0 or there are none.
bool mayBePinhole(std::string_view model);

/// The rows of a matrix as JSON.
Json rowsOf(const Mat4& matrix);

/// Whether it is a folder with a cameras.txt, or a text file that begins like COLMAP's cameras.txt or images.txt.
bool isColmap(const std::string& name);
/// {"cameras": {"1": {...}}, "images": [...]} from a folder or one of its files. Throws InputError.
Json readColmap(const std::string& folderOrFile);

/// The text of a file, or the JSON of a .glb file. Throws InputError.
std::string readWithoutGlb(const std::string& name, std::size_t most);

}  // namespace viewproj::cmd
