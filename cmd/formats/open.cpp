#include "formats/open.hpp"

#include <nlohmann/json.hpp>

#include "formats/colmap.hpp"
#include "formats/pose_chain.hpp"
#include "formats/tree.hpp"

namespace viewproj::cmd {
namespace {

std::unique_ptr<CameraSet> cameraSet(const std::shared_ptr<Document>& file, Import cameras, const Opening& opening,
                                     CameraPatches patches) {
  std::string name = file->name;
  if (!opening.poses.empty()) cameras = atPoses(std::move(cameras), opening, name);
  return std::make_unique<CameraSet>(std::move(name), std::move(cameras), std::move(patches), file);
}

}  // namespace

std::unique_ptr<CameraSet> openDocument(Document document, const Opening& opening, CameraPatches patches) {
  const auto file = std::make_shared<Document>(std::move(document));
  file->marks = std::make_shared<std::unordered_set<const void*>>();
  Import cameras = importFile(file, opening, patches.readAs);
  return cameraSet(file, std::move(cameras), opening, std::move(patches));
}

std::unique_ptr<CameraSet> openCameras(const std::string& source, const Opening& opening, CameraPatches patches) {
  if (opening.parts && !patches.readAs.empty()) {
    const bool turns =
        (patches.readAs == "unreal" || patches.readAs == "unity") && opening.parts->find("euler") != std::string::npos;
    throw UsageError(
        "--parts makes a camera in the convention opencv; in place of --read-as, --set convention=" + patches.readAs +
        (turns ? " --set euler.order=" + patches.readAs : "") + " states the world and the axes of another");
  }
  const auto model = opening.parts ? std::nullopt : colmapModel(source);
  if (!model)
    return openDocument(
        readTree(source, opening.option, {.mayBeFaulty = true, .mayBeRefused = opening.parts.has_value()}), opening,
        std::move(patches));
  if (!patches.readAs.empty()) failPreset(source, "a reconstruction of COLMAP");
  const auto file = std::make_shared<Document>(Document{source, std::make_shared<Json>(readColmap(*model))});
  return cameraSet(file, openColmap(Node(*file)), opening, std::move(patches));
}

std::unique_ptr<CameraSet> openPoses(const Opening& opening, CameraPatches patches) {
  std::string name = splitPick(opening.poses.front()).file;
  const bool isGodots = isGodotPose(innermost(opening));
  const std::string preset = !patches.readAs.empty() ? patches.readAs : isGodots ? "opengl" : "opencv";
  Import result = Import::one([camera = Json{{"convention", preset}}] { return camera; });
  if (!isGodots) result.notes.emplace_back(kOpenCvNote);
  result = atPoses(std::move(result), opening, name, false);
  return std::make_unique<CameraSet>(std::move(name), std::move(result), std::move(patches));
}

}  // namespace viewproj::cmd
