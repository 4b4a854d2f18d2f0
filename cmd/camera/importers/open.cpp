// Opens a file of any format as a set of cameras.
#include <nlohmann/json.hpp>

#include "camera/importers/importer.hpp"
#include "text/error.hpp"
#include "text/file.hpp"

namespace viewproj::cmd {
namespace {

Document loadAny(const std::string& source, const std::string& option, bool wasColmap) {
  if (isInlineJson(source)) return load(source, option);
  if (wasColmap) return {shownName(source), std::make_shared<Json>(readColmap(source))};
  return parseDocument(shownName(source), readWithoutGlb(source, kMostDocumentBytes));
}

/// The importer for a document. Null for our own format (an object with a projection object) and for unknown formats.
const Importer* importerOf(const Json& root, bool wasColmap) {
  if (wasColmap) return &kColmap;
  const auto projection = root.find("projection");
  if (root.is_object() && projection != root.end() && projection->is_object()) return nullptr;
  for (const Importer* importer : importers())
    if (importer->recognises(root)) return importer;
  return nullptr;
}

}  // namespace

std::unique_ptr<CameraSet> openCameras(const std::string& source, const std::string& option, CameraPatches patches) {
  const bool wasColmap = !isInlineJson(source) && isColmap(source);
  const auto file = std::make_shared<Document>(loadAny(source, option, wasColmap));
  const Importer* const importer = importerOf(*file->root, wasColmap);
  if (!importer && !isCameraDocument(*file->root))
    throw InputError(file->name + ": is not a camera file of a known kind; viewproj help formats lists them");
  if (!patches.readAs.empty() && importer && importer != &kMatrices)
    throw InputError(file->name + ": is " + std::string(importer->form) +
                     ", which has a convention of its own; leave out --read-as");
  if (!patches.readAs.empty()) readAs(*file, patches.readAs);
  Import found = importer ? importer->open(Node(*file)) : openCameraDocument(*file);
  // The file must live as long as the functions that read it.
  found.document = [file, document = std::move(found.document)](std::size_t which) { return document(which); };
  return std::make_unique<CameraSet>(file->name, std::move(found), std::move(patches));
}

}  // namespace viewproj::cmd
