// Camera files of other programs. An importer moves values into our camera document (help camera) and computes nothing
// but chains of nodes and the parts of a 3x4 matrix: the document's reader does all that follows.
// To add a format: a file here, and its row in kImporters (importer.cpp).
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// One of the cameras that a file holds. FILE#NAME, FILE#ID or FILE#NUMBER picks it.
struct CameraEntry {
  std::string name;  ///< as the file calls it, or empty
  std::string id;    ///< a number or another name of it, or empty
};

struct Import {
  std::vector<CameraEntry> cameras;
  /// Our document of the camera at a place in the list. Throws InputError naming the file's own field.
  std::function<Json(std::size_t which)> document;
};

struct Importer {
  std::string_view name;  ///< as help formats lists it
  std::string_view form;  ///< "a glTF file"
  bool (*recognises)(const Json& root);
  Import (*open)(const Node& root);  ///< root must outlive what is returned; throws InputError
};

/// Bare matrices: of foreign files the only ones that --read-as is for.
extern const Importer kMatrices;

/// In the order in which they are tried.
std::span<const Importer* const> importers();

/// Throws where the node has one of these members with a value that is not null, false, 0 or empty: what the format can
/// say and we cannot show. why: a sentence after the member's name.
void refuse(const Node& node, std::initializer_list<std::string_view> members, std::string_view why);

/// {"model": "brown", "k": ..., "p": ...} or {"model": "fisheye", "k": ...} of coefficients in OpenCV's order; null
/// where all of brown's are 0. model: as files name it; empty for OpenCV's own. A model that the document has not is
/// passed on for its reader to refuse, or to leave out. Throws for one that is not known.
Json distortionOf(const Node& coefficients, std::string_view model);

/// Rows of a matrix of numbers in JSON.
Json rowsOf(const Mat4& matrix);

/// Whether it is a folder with a cameras.txt, or a text file that begins as COLMAP's cameras.txt or images.txt do.
bool isColmap(const std::string& name);
/// {"cameras": {"1": {...}}, "images": [...]} of a folder or one of its files. Throws InputError.
Json readColmap(const std::string& folderOrFile);

/// The text of a file; of a .glb the JSON in it. Throws InputError.
std::string readWithoutGlb(const std::string& name, std::size_t most);

}  // namespace viewproj::cmd
