#include "formats/open.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/names.hpp"
#include "camera/plain_camera.hpp"
#include "camera/read_convention.hpp"
#include "camera/read_pose.hpp"
#include "formats/claims.hpp"
#include "formats/colmap.hpp"
#include "formats/finder/finder.hpp"
#include "formats/parts.hpp"
#include "formats/poses.hpp"
#include "formats/rows.hpp"
#include "formats/tree.hpp"
#include "formats/unread.hpp"
#include "text/file.hpp"
#include "text/pasted_matrices.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The formats that have a file; the order does not matter, for one at most claims a file.
constexpr const Format* kFormats[] = {
    &kGltf, &kThreeJs, &kTransforms, &kMetashape, &kMetashapeLens, &kMeshroom, &kOpenSfm, &kOpenSfmLenses, &kBundler,
    &kExif, &kTable,   &kScanner,    &kOpenXr,    &kUnity,         &kUnreal,   &kKalibr,  &kPoses,         &kMatrices};

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

struct Claim {
  std::string_view name, form, known;
  std::function<Import()> open;
  bool mayBeMatrices = false;  ///< numbers alone: matrices, or poses
};

/// The formats that claim a file: one, or none. all: looks for others too.
std::vector<Claim> claimsOf(const Node& root, bool all) {
  std::vector<Claim> found;
  if (isOurs(root.json()) || !root.document().fault.empty()) return found;
  for (const Format* format : kFormats) {
    // Matrices in plain text may be anything: info and matrix read them with all that is beside them.
    if (format == &kMatrices && root.document().isPlainText) continue;
    if (!(format->recognises ? format->recognises(root) : holds(root, format->when))) continue;
    found.push_back({format->name, format->form, format->known, [format, root] { return format->open(root); },
                     format == &kMatrices || format == &kPoses});
    if (!all) return found;
  }
  for (const Row& row : rows())
    if (const auto container = containerOf(row, root)) {
      found.push_back(
          {row.name, row.form, row.known, [&row, root, container] { return importRow(row, root, *container); }});
      if (!all) return found;
    }
  return found;
}

/// "velodyne/" of velodyne/P2: a camera of another world than the file's own. Other slashes belong to names.
std::string worldOf(std::string_view name) {
  for (const char* world : {"imu/", "body/", "velodyne/", "lidar/"})
    if (name.starts_with(world)) return world;
  return "";
}

/// Keeps the cameras of the file's own world, or those of the world that is picked: the same cameras, seen from
/// elsewhere.
void keepWorld(Import& file, const std::string& pick) {
  const std::string world = worldOf(pick + "/");
  const auto isLeftOut = [&](const CameraEntry& camera) { return worldOf(camera.name) != world; };
  if (std::all_of(file.cameras.begin(), file.cameras.end(), isLeftOut)) {  // it has one world, which needs no name
    for (CameraEntry& camera : file.cameras)
      if (world.empty() && !pick.empty()) camera.name.erase(0, worldOf(camera.name).size());
    return;
  }
  for (const CameraEntry& camera : file.cameras)
    if (isLeftOut(camera) &&
        std::find(file.worlds.begin(), file.worlds.end(), worldOf(camera.name)) == file.worlds.end())
      file.worlds.push_back(worldOf(camera.name));
  std::erase(file.worlds, "");
  std::erase_if(file.cameras, isLeftOut);
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

Import importParts(const Node& root, const std::string& line) {
  std::vector<Part> parts = parseParts(line, "--parts");
  requireNames(parts, "--parts", false);
  if (parts.empty()) throw UsageError("--parts: expected name=path, as in K=camera_matrix");
  return {camerasOfParts(root, std::move(parts), {}, "")};
}

[[noreturn]] void failPreset(const std::string& name, std::string_view form) {
  throw InputError(name + ": is " + std::string(form) + ", which has a convention of its own; leave out --read-as");
}

[[noreturn]] void failUnknown(const Document& file) {
  throw UnknownFile(file.name +
                        ": is not a camera file of a known kind; viewproj info FILE tells what is in it, viewproj help "
                        "formats lists the kinds",
                    file);
}

/// Whether info has more to say of a text than what is wrong with it.
bool holdsParts(const Document& file) {
  return !proposeParts(file).lines.empty() || (file.text && !findMatrices(*file.text).matrices.empty());
}

/// A pose of ours beside members that are not may be another program's. Where most are not, it is; else the reader's
/// message tells, and info proposes too.
void requireOwnMembers(const Document& file) {
  const auto isOf = [](std::string_view key) {
    return key == "cameras" || std::any_of(std::begin(kFields), std::end(kFields), [&](const Field& field) {
             return key == topName(field) || key == field.alias;
           });
  };
  for (const char* ours : {"convention", "projection", "viewport"})
    if (file.root->contains(ours)) return;
  const std::size_t count = file.root->size();
  std::size_t known = 0;
  for (const auto& member : file.root->items()) known += isOf(member.key()) ? 1 : 0;
  if (known == count) return;
  if (2 * known < count) failUnknown(file);
  try {
    Document copy{file.name, std::make_shared<Json>(*file.root)};
    normalize(copy);
    (void)readValues(copy);
  } catch (const InputError& e) {
    throw UnknownFile(e.what(), file, true);
  }
}

Import importFile(const std::shared_ptr<Document>& file, const Opening& opening, const std::string& preset) {
  const Node root(*file);
  if (opening.parts) return importParts(root, *opening.parts);
  const std::vector<Claim> found = claimsOf(root, false);
  const bool isTable = !found.empty() && found.front().name == kTable.name;
  if (!preset.empty() && !found.empty() && !found.front().mayBeMatrices && !isTable)
    failPreset(file->name, found.front().form);
  if (!preset.empty() && file->root->is_object()) readAs(*file, preset);
  if (!found.empty()) {
    const Claim& claim = found.front();
    Import result = openClaimed(*file, claim);
    if (!preset.empty() && claim.name == kPoses.name) failPreset(file->name, claim.form);
    if (!preset.empty() && isTable)
      for (CameraEntry& camera : result.cameras)
        camera.document = [file, document = camera.document, preset] {
          Document row{file->name, std::make_shared<Json>(document())};
          readAs(row, preset);
          return std::move(*row.root);
        };
    keepWorld(result, opening.pick.value_or(""));
    result.mayLackPose = true;
    if (claim.mayBeMatrices || file->isPlainText) result.matricesText = file->text;
    return judged(file, std::move(result), claim.known);
  }
  if (!file->isPlainText && isCameraDocument(*file->root)) {
    requireOwnMembers(*file);
    return openCameraDocument(*file);
  }
  if (!file->fault.empty())
    throw UnknownFile(file->fault + (holdsParts(*file) ? "; viewproj info FILE tells what it has as text" : ""), *file);
  failUnknown(*file);
}

/// One of the poses whose product is a camera's, or several in turn.
struct PoseFactor {
  std::shared_ptr<Document> file;
  std::vector<CameraEntry> cameras;  ///< that have the pose
  std::string field;
  bool isOfCamera = false;  ///< of axes that its file states
};

/// A pose that is typed, or printed in a file of no form.
PoseFactor factorOf(Json pose, const std::string& field) {
  CameraEntry camera;
  camera.document = [pose = std::move(pose), field] { return Json{{field, pose}}; };
  return {nullptr, {camera}, field};
}

PoseFactor factorOf(const std::string& source, const Opening& opening) {
  const std::string& field = opening.direction;
  if (const auto pose = poseOfText(source)) return factorOf(*pose, field);
  const auto [name, pick] = splitPick(source);
  const auto file = std::make_shared<Document>();
  PosesOfFile read;
  bool isOfCamera = false;
  try {
    *file = readTree(name, field == "worldFromCamera" ? "--world-from-camera" : "--camera-from-world");
    file->marks = std::make_shared<std::unordered_set<const void*>>();
    read = posesOf(Node(*file));
    isOfCamera = read.poses.cameras.empty();
    if (isOfCamera) read = {importFile(file, {.option = opening.option, .pick = pick}, ""), field, true};
  } catch (const UnknownFormat& unknown) {
    if (const auto pose = file->root ? jointPose(*file->root, pick) : std::nullopt) return factorOf(*pose, field);
    const std::vector<Json> printed = printedPoses(unknown.text);
    if (printed.empty() && isInlineJson(name)) throw;
    if (printed.empty())
      throw InputError(
          shownName(name) +
          ": holds no pose: expected 4 rows of 4 numbers, 12 or 16 numbers a line, time x y z qx qy qz qw, "
          "or {\"rotation\": [x, y, z, w] or 3 rows of 3, \"translation\"}" +
          (unknown.text.find("<origin") == std::string::npos ? "" : "; FILE#NAME picks the origin of a joint"));
    *file = {shownName(name), nullptr};
    isOfCamera = false;
    read = {{}, field, false};
    read.poses.noun = "pose";
    for (const Json& pose : printed) read.poses.add("", "", [pose, field] { return Json{{field, pose}}; });
  }
  if (read.isDirected && read.field != field)
    throw InputError(file->name + ": holds poses of the other direction, " + read.field);
  PoseFactor factor{file, {}, read.field, isOfCamera};
  for (const std::size_t i : CameraSet(file->name, read.poses, {}).chooseAll(pick))
    factor.cameras.push_back(read.poses.cameras[i]);
  return factor;
}

constexpr const char* kPoseFields[] = {"position", "rotation",        "target",         "direction",
                                       "up",       "euler",           "heading",        "pitch",
                                       "roll",     "worldFromCamera", "cameraFromWorld"};

/// What a document says of its axes, and where its camera stands.
struct Stand {
  CameraAxes axes;
  Handedness world;
  std::optional<Pose> pose;

  explicit Stand(Document document) {
    normalize(document);
    const FieldValues values = readValues(document);
    const DocumentConvention stated = readConvention(values);
    axes = cameraAxesOf(values, *stated.preset);
    world = stated.convention.world;
    pose = readPose(values, stated);
  }
};

/// The pose of another camera, in the axes of this one. field: the direction.
Json poseIn(const Json& camera, const Document& file, const Json& other, const std::string& field) {
  const Stand to(Document{file.name, std::make_shared<Json>(camera)});
  const Stand from(Document{file.name, std::make_shared<Json>(other)});
  if (to.world != from.world)
    throw InputError(file.name + ": its world is " + std::string(nameOf(kWorldNames, from.world)) +
                     "-handed, unlike the camera's");
  if (other.contains(field) && to.axes == from.axes) return other[field];
  if (!from.pose) throw InputError(file.name + ": has no pose");
  const PlainPose pose = plainPose(*from.pose);
  const auto [c, t] = field == "worldFromCamera" ? worldFromCamera(pose, to.axes) : cameraFromWorld(pose, to.axes);
  return {{c[0].x, c[1].x, c[2].x, t.x}, {c[0].y, c[1].y, c[2].y, t.y}, {c[0].z, c[1].z, c[2].z, t.z}};
}

/// A camera's document at the product of poses, for the one of each factor or that of a number.
Json atPose(Json camera, const std::vector<PoseFactor>& factors, std::size_t number, const std::string& direction) {
  for (const char* field : kPoseFields) camera.erase(field);
  Json poses = Json::array();
  for (const auto& [file, cameras, field, isOfCamera] : factors) {
    const Json pose = cameras[cameras.size() > 1 ? number : 0].document();
    if (!isOfCamera && !pose.contains(field)) throw InputError(file->name + ": has no pose that says " + field);
    poses.push_back(isOfCamera ? poseIn(camera, *file, pose, field) : pose[field]);
  }
  camera[direction] = poses.size() == 1 ? poses.front() : poses;
  return camera;
}

/// Each camera at the pose, or one camera at each pose: in a folder of the name that picked it. name: of the cameras'
/// file; several poses set it to their own.
Import atPoses(Import result, const Opening& opening, std::string& name) {
  const auto factors = std::make_shared<std::vector<PoseFactor>>();
  const PoseFactor* several = nullptr;
  factors->reserve(opening.poses.size());
  for (const std::string& source : opening.poses) {
    factors->push_back(factorOf(source, opening));
    const PoseFactor& factor = factors->back();
    if (factor.cameras.size() == 1) continue;
    if (several || (result.cameras.size() > 1 && !opening.pick))
      throw InputError(factor.file->name + ": holds " + std::to_string(factor.cameras.size()) +
                       (several ? " poses, and another file does too" : " poses for several cameras") +
                       "; pick one of either");
    several = &factor;
  }
  std::string folder;
  if (several && opening.pick) {
    result.cameras = {result.cameras[CameraSet(name, result, {}).choose(opening.pick)]};
    folder = *opening.pick + "/";
  }
  const bool isWorldFirst = opening.direction == "worldFromCamera";
  const std::string option = isWorldFirst ? "--world-from-camera" : "--camera-from-world";
  const std::string replaced = "its own pose, which " + option + " replaces (" + option + " " +
                               (isWorldFirst ? "POSE " : "FILE ") + option + (isWorldFirst ? " FILE" : " POSE") +
                               " keeps both)";
  result.hasUnclearAxes = false;
  const bool isKept = std::any_of(factors->begin(), factors->end(), [&](const PoseFactor& factor) {
    return factor.isOfCamera && factor.file->name == name;
  });
  const auto unreadOf = [unread = result.unread, cameras = result.cameras, replaced, isKept](std::size_t which) {
    std::string names = unread ? unread(which) : "";
    if (!isKept && hasPose(cameras[which].document())) names += (names.empty() ? "" : ", ") + replaced;
    return names;
  };
  const auto moved = [&](const CameraEntry& camera, std::size_t number) {
    return [document = camera.document, factors, number, direction = opening.direction] {
      return atPose(document(), *factors, number, direction);
    };
  };
  if (!several) {
    result.unread = unreadOf;
    for (CameraEntry& camera : result.cameras) camera.document = moved(camera, 0);
    return result;
  }
  Import all;
  // Of the camera's file, though the poses' gives the names; once, for all of them.
  all.unread = [unreadOf, name, isTold = std::make_shared<bool>(false)](std::size_t) -> std::string {
    const std::string names = *isTold ? "" : unreadOf(0);
    *isTold = true;
    return names.empty() ? "" : "of " + name + ": " + names;
  };
  name = several->file->name;
  for (std::size_t i = 0; i < several->cameras.size(); ++i) {
    const CameraEntry& pose = several->cameras[i];
    all.add(folder + (folder.empty() || !pose.name.empty() ? pose.name : std::to_string(i)), pose.id,
            moved(result.cameras.front(), i));
  }
  return all;
}

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
  if (opening.parts && !patches.readAs.empty())
    throw UsageError("--parts makes a camera in the convention opencv; leave out --read-as, or say " +
                     (patches.readAs == "unreal" || patches.readAs == "unity"
                          ? "--set convention=" + patches.readAs + " --set euler.order=" + patches.readAs
                          : "--set cameraAxes=RUB for the axes of OpenGL"));
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
  Import result;
  result.add("", "",
             [camera = Json{{"convention", patches.readAs.empty() ? "opencv" : patches.readAs}}] { return camera; });
  std::string name = splitPick(opening.poses.front()).file;
  result = atPoses(std::move(result), opening, name);
  return std::make_unique<CameraSet>(std::move(name), std::move(result), std::move(patches));
}

bool hasPose(const Json& camera) {
  const Json origin = {0, 0, 0}, none = {0, 0, 0, 1};
  return std::any_of(std::begin(kPoseFields), std::end(kPoseFields), [&](const char* field) {
    return camera.contains(field) && camera[field] != (std::string_view(field) == "position" ? origin : none);
  });
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
