#include "formats/open.hpp"

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>

#include "formats/claims.hpp"
#include "formats/colmap.hpp"
#include "formats/parts.hpp"
#include "formats/poses.hpp"
#include "formats/rows.hpp"
#include "formats/tree.hpp"
#include "formats/unread.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The formats that have a file; the order does not matter, for one at most claims a file.
constexpr const Format* kFormats[] = {
    &kGltf, &kThreeJs, &kTransforms, &kMetashape, &kMetashapeLens, &kMeshroom, &kOpenSfm, &kOpenSfmLenses, &kBundler,
    &kExif, &kTable,   &kScanner,    &kKalibr,    &kKitti,         &kStereo,   &kPoses,   &kMatrices};

/// Our own form may have names of others, as fx and cx in a projection.
bool isOurs(const Json& root) {
  if (!root.is_object()) return false;
  const auto projection = root.find("projection");
  constexpr const char* kMembers[] = {"type",        "fovY",   "fovX", "fovDiagonal", "fx",    "left",
                                      "focalLength", "matrix", "near", "width",       "height"};
  return projection != root.end() && projection->is_object() &&
         (projection->empty() || std::any_of(std::begin(kMembers), std::end(kMembers),
                                             [&](const char* name) { return projection->contains(name); }));
}

bool claims(const Format& format, const Node& root) {
  return format.recognises ? format.recognises(root) : holds(root, format.when);
}

struct Claim {
  std::string_view name, form, known;
  std::function<Import()> open;
  bool mayBeMatrices = false;  ///< numbers alone: matrices, or poses
};

std::vector<Claim> claimsOf(const Node& root, bool all) {
  std::vector<Claim> found;
  if (isOurs(root.json())) return found;
  for (const Format* format : kFormats) {
    // Matrices in plain text may be anything: info and matrix read them with all that is beside them.
    if (format == &kMatrices && root.document().isPlainText) continue;
    if ((all || found.empty()) && claims(*format, root))
      found.push_back({format->name, format->form, format->known, [format, root] { return format->open(root); },
                       format == &kMatrices || format == &kPoses});
  }
  for (const Row& row : rows()) {
    if (!all && !found.empty()) break;
    if (const auto container = containerOf(row, root))
      found.push_back(
          {row.name, row.form, row.known, [&row, root, container] { return importRow(row, root, *container); }});
  }
  return found;
}

/// What no format has read is judged when a camera is asked for. Several threads may ask.
Import judged(const std::shared_ptr<Document>& file, Import result, std::string_view known) {
  struct State {
    std::mutex mutex;
    std::optional<Unread> unread;
    std::string note;
  };
  const auto state = std::make_shared<State>();
  state->unread.emplace(*file, result, known);
  const auto document = std::move(result.document);
  result.document = [file, state, document](std::size_t which) {
    const std::lock_guard lock(state->mutex);
    Json camera = document(which);
    state->note = state->unread->judge(which);
    return camera;
  };
  result.unread = [state](std::size_t) {
    const std::lock_guard lock(state->mutex);
    return state->note;
  };
  return result;
}

bool isInOtherWorld(const CameraEntry& camera) {
  for (const char* world : {"imu/", "body/", "velodyne/", "lidar/"})
    if (camera.name.starts_with(world)) return true;
  return false;
}

/// Keeps the cameras of the file's own world, or those of the world that is picked: the same cameras, seen from
/// elsewhere.
void keepWorld(Import& result, const std::optional<std::string>& pick) {
  const bool isOther = pick && isInOtherWorld({*pick, ""});
  const std::string world = isOther ? pick->substr(0, pick->find('/') + 1) : "";
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < result.cameras.size(); ++i)
    if (isOther ? result.cameras[i].name.starts_with(world) : !isInOtherWorld(result.cameras[i])) kept.push_back(i);
  if (kept.empty() || kept.size() == result.cameras.size()) return;
  std::vector<CameraEntry> cameras;
  for (const std::size_t i : kept) cameras.push_back(std::move(result.cameras[i]));
  result.cameras = std::move(cameras);
  if (result.own) result.own = [own = std::move(result.own), kept](std::size_t which) { return own(kept[which]); };
  result.document = [document = std::move(result.document), kept](std::size_t which) { return document(kept[which]); };
}

/// What makes no camera, in plain text or of numbers alone, may be matrices.
Import openClaimed(const Document& file, const Claim& claim) {
  try {
    return claim.open();
  } catch (const InputError& e) {
    if (file.isPlainText || claim.mayBeMatrices) throw UnknownFormat(e.what(), *file.text);
    throw;
  }
}

Import importFile(const std::shared_ptr<Document>& file, const Opening& opening, const std::string& preset) {
  const Node root(*file);
  if (opening.parts) {
    std::vector<Part> parts = parseParts(*opening.parts, "--parts");
    requireNames(parts, "--parts", false);
    if (parts.empty()) throw UsageError("--parts: expected name=path, as in K=camera_matrix");
    return importParts(root, std::move(parts), {}, "");
  }
  const std::vector<Claim> found = claimsOf(root, false);
  const auto requireOwnConvention = [&] {
    if (!preset.empty())
      throw InputError(file->name + ": is " + std::string(found.front().form) +
                       ", which has a convention of its own; leave out --read-as");
  };
  if (!found.empty() && !found.front().mayBeMatrices) requireOwnConvention();
  if (!preset.empty() && file->root->is_object()) readAs(*file, preset);
  if (!found.empty()) {
    Import result = openClaimed(*file, found.front());
    if (found.front().name == kPoses.name) requireOwnConvention();
    keepWorld(result, opening.pick);
    if (found.front().mayBeMatrices || file->isPlainText) result.matricesText = file->text;
    return judged(file, std::move(result), found.front().known);
  }
  if (!file->isPlainText && isCameraDocument(*file->root)) return openCameraDocument(*file);
  throw UnknownFile(file->name +
                        ": is not a camera file of a known kind; viewproj info FILE proposes --parts, viewproj help "
                        "formats lists the kinds",
                    *file);
}

/// One of the poses whose product is a camera's, or several in turn.
struct PoseFactor {
  std::shared_ptr<Document> file;
  PosesOfFile poses;
  std::vector<std::size_t> picked;
};

PoseFactor factorOf(const std::string& source, const Opening& opening) {
  if (const auto pose = poseOfText(source)) {
    const auto same = [pose = *pose](std::size_t) { return pose; };
    return {nullptr, {std::vector<CameraEntry>(1), same, ""}, {0}};
  }
  const auto [name, pick] = splitPick(source);
  PoseFactor factor{std::make_shared<Document>(readTree(name, "--" + opening.option)), {}, {}};
  factor.poses = posesOf(Node(*factor.file));
  const std::string& direction = factor.poses.direction;
  if (!direction.empty() && direction != opening.direction)
    throw InputError(factor.file->name + ": holds poses of the other direction, " + direction);
  factor.picked = CameraSet(factor.file->name, {.cameras = factor.poses.names, .noun = "pose"}, {}).chooseAll(pick);
  return factor;
}

/// Each camera at the pose, or one camera at each pose. name: of the cameras' file; several poses set it to their own.
Import atPoses(Import result, const Opening& opening, std::string& name) {
  std::vector<PoseFactor> factors;
  const PoseFactor* several = nullptr;
  factors.reserve(opening.poses.size());
  for (const std::string& source : opening.poses) {
    factors.push_back(factorOf(source, opening));
    if (factors.back().picked.size() == 1) continue;
    if (several || result.cameras.size() > 1)
      throw InputError(factors.back().file->name + ": holds " + std::to_string(factors.back().picked.size()) +
                       (several ? " poses, and another file does too" : " poses for several cameras") +
                       "; pick one of either");
    several = &factors.back();
  }
  Import moved = result;
  if (several) {
    moved.cameras.clear();
    for (const std::size_t i : several->picked) moved.cameras.push_back(several->poses.names[i]);
    moved.unread = nullptr;
    name = several->file->name;
  }
  moved.document = [factors, result, isSeveral = several != nullptr, direction = opening.direction](std::size_t which) {
    Json camera = result.document(isSeveral ? 0 : which);
    for (const char* field : {"position", "rotation", "target", "direction", "up", "euler", "heading", "pitch", "roll",
                              "worldFromCamera", "cameraFromWorld"})
      camera.erase(field);
    Json poses = Json::array();
    for (const PoseFactor& factor : factors)
      poses.push_back(factor.poses.pose(factor.picked[factor.picked.size() > 1 ? which : 0]));
    camera[direction] = poses.size() == 1 ? poses.front() : poses;
    return camera;
  };
  return moved;
}

}  // namespace

std::unique_ptr<CameraSet> openCameras(const std::string& source, const Opening& opening, CameraPatches patches) {
  std::shared_ptr<Document> file;
  Import result;
  if (opening.parts && !patches.readAs.empty())
    throw UsageError("--parts makes a camera in the convention opencv; leave out --read-as");
  if (const auto model = opening.parts ? std::nullopt : colmapModel(source)) {
    if (!patches.readAs.empty())
      throw InputError(source +
                       ": is a reconstruction of COLMAP, which has a convention of its own; leave out --read-as");
    file = std::make_shared<Document>(Document{source, std::make_shared<Json>(readColmap(*model))});
    result = openColmap(Node(*file));
    result.document = [file, document = std::move(result.document)](std::size_t which) { return document(which); };
  } else {
    file = std::make_shared<Document>(readTree(source, opening.option));
    file->marks = std::make_shared<std::unordered_set<const void*>>();
    result = importFile(file, opening, patches.readAs);
    result.document = [file, document = std::move(result.document)](std::size_t which) { return document(which); };
  }
  std::string name = file->name;
  if (!opening.poses.empty()) result = atPoses(std::move(result), opening, name);
  return std::make_unique<CameraSet>(std::move(name), std::move(result), std::move(patches));
}

std::unique_ptr<CameraSet> openPoses(const Opening& opening, CameraPatches patches) {
  Json camera{{"convention", patches.readAs.empty() ? "opencv" : patches.readAs}};
  Import result{{CameraEntry{}}, [camera](std::size_t) { return camera; }};
  std::string name = splitPick(opening.poses.front()).file;
  result = atPoses(std::move(result), opening, name);
  return std::make_unique<CameraSet>(std::move(name), std::move(result), std::move(patches));
}

std::vector<FormatName> formatNames() {
  std::vector<FormatName> names;
  const auto add = [&](std::string_view name, std::string_view form) {
    if (!form.empty()) names.push_back({name, form});
  };
  add("colmap", "a reconstruction of COLMAP");
  for (const Format* format : kFormats) add(format->name, format->form);
  for (const Row& row : rows()) add(row.name, row.form);
  return names;
}

std::vector<std::string> claimants(const Document& file) {
  std::vector<std::string> names;
  for (const Claim& claim : claimsOf(Node(file), true)) names.emplace_back(claim.name);
  return names;
}

}  // namespace viewproj::cmd
