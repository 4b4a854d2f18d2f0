#include "formats/pose_chain.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/names.hpp"
#include "camera/plain_camera.hpp"
#include "camera/read_convention.hpp"
#include "camera/read_pose.hpp"
#include "formats/poses.hpp"
#include "formats/tree.hpp"
#include "formats/value.hpp"
#include "text/file.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// One of the poses whose product is a camera's, or several in turn.
struct PoseFactor {
  std::shared_ptr<Document> file;
  std::vector<CameraEntry> cameras;  ///< that have the pose
  std::string field;
  bool isOfCamera = false;  ///< of axes that its file states
  bool isOwn = false;       ///< the cameras' own file: each has its own pose
  bool lacksAxes = false;   ///< of a camera, but its axes are those of the camera that the pose is for
  bool isPicked = false;    ///< of a file with more poses, or of none
  std::vector<std::string> notes = {};
};

/// A pose with a rotation vector, as an option takes it.
std::string typedPose(const Json& camera) {
  const Json *const place = valueAt(camera, "cameraFromWorld.translation"), *const turn = valueAt(
                                                                                camera,
                                                                                "cameraFromWorld.rotationVector");
  const auto p = place ? numbersIn(*place) : std::nullopt, v = turn ? numbersIn(*turn) : std::nullopt;
  if (!p || !v) return "X,Y,Z rvec:A,B,C";
  const auto text = [](const std::vector<double>& numbers) {
    std::vector<std::string> all;
    for (const double number : numbers) all.push_back(formatNumber(number));
    return joined(all, ",");
  };
  return text(*p) + " rvec:" + text(*v);
}

/// A pose that is typed, or printed in a file of no form.
PoseFactor factorOf(Json pose, const std::string& field) {
  CameraEntry camera;
  camera.document = [pose = std::move(pose), field] { return Json{{field, pose}}; };
  return {.file = nullptr, .cameras = {camera}, .field = field, .isPicked = true};
}

/// A typed pose whose camera is Godot's.
PoseFactor ofGodotsCamera(const PoseFactor& typed, const std::string& source) {
  CameraEntry camera;
  camera.document = [pose = typed.cameras.front().document()]() mutable {
    pose["cameraAxes"] = "RUB";
    return pose;
  };
  return {.file = std::make_shared<Document>(Document{source, nullptr}),
          .cameras = {camera},
          .field = typed.field,
          .isOfCamera = true,
          .isPicked = true};
}

/// own: the name of the cameras' file.
PoseFactor factorOf(const std::string& source, const Opening& opening, const std::string& own) {
  const std::string& field = opening.direction;
  if (const auto pose = poseOfText(source)) return factorOf(*pose, field);
  const auto [name, pick] = splitPick(source);
  const bool isOwn = shownName(name) == own;
  const auto file = std::make_shared<Document>();
  PosesOfFile read;
  bool isOfCamera = false;
  try {
    *file = readTree(name, field == "worldFromCamera" ? "--world-from-camera" : "--camera-from-world",
                     {.mayBeFaulty = true});
    file->marks = std::make_shared<std::unordered_set<const void*>>();
    const bool isOfLine = isOwn && opening.parts && (!pick || pick == opening.pick);
    if (const auto pose = pick && !isOfLine && file->fault.empty() ? poseAt(*file, *pick) : std::nullopt)
      return factorOf(*pose, field);
    if (file->fault.empty() && !isOfLine) read = posesOf(Node(*file));
    isOfCamera = read.poses.cameras.empty();
    if (isOfCamera) {
      Import cameras = importFile(file,
                                  {.option = opening.option,
                                   .pick = isOwn && !pick ? opening.pick : pick,
                                   .parts = isOfLine ? opening.parts : std::nullopt},
                                  "");
      const std::string stated = cameras.hasTranslation ? "worldFromCamera" : field;
      read = {std::move(cameras), stated, true};
    }
  } catch (const UnknownFormat& unknown) {
    if (const auto pose = writtenPose(unknown.text)) return factorOf(*pose, field);
    if (const auto pose = file->root ? jointPose(*file, pick) : std::nullopt) return factorOf(*pose, field);
    auto printed = printedPoses(unknown.text);
    const auto turn = printed.empty() ? printedRotation(unknown.text) : std::nullopt;
    if (turn) printed.emplace_back("", *turn);
    const auto named = printed.empty() && file->root ? namedPose(*file, field) : std::nullopt;
    if (printed.empty() && !named && isInlineJson(name)) throw;
    if (printed.empty() && !named)
      throw InputError(
          shownName(name) +
          ": holds no pose: expected 4 rows of 4 numbers, 12 or 16 numbers a line, time x y z qx qy qz qw, or "
          "{\"rotation\": [x, y, z, w] or 3 rows of 3, \"translation\"}" +
          (unknown.text.find("<origin") == std::string::npos ? "" : "; FILE#NAME picks the origin of a joint"));
    if (!named) *file = {shownName(name), nullptr};
    isOfCamera = false;
    read = named.value_or(PosesOfFile{{}, field, false});
    read.poses.noun = "pose";
    if (turn) read.poses.notes.push_back("is a rotation alone: its translation is 0, 0, 0");
    for (const auto& [called, pose] : printed)
      read.poses.add(called, "", [pose = pose, field] { return Json{{field, pose}}; });
  }
  if (read.isDirected && read.field != field)
    throw InputError(file->name + ": holds " + read.field +
                     (field == "worldFromCamera"
                          ? ", as --camera-from-world takes it; the pose of what the camera sees "
                            "is a link as it stands: --world-from-camera '" +
                                typedPose(read.poses.cameras.front().document()) + "'"
                          : ", as --world-from-camera takes it"));
  PoseFactor factor{
      file, {}, read.field, isOfCamera, isOfCamera && isOwn, read.poses.lacksAxes, pick.has_value(), read.poses.notes};
  for (const std::size_t i : CameraSet(file->name, read.poses, {}).chooseAll(pick))
    factor.cameras.push_back(read.poses.cameras[i]);
  const auto standsAtOrigin = [](const CameraEntry& camera) { return !hasPose(camera.document()); };
  if (isOfCamera && !isOwn && read.poses.mayLackPose &&
      std::all_of(factor.cameras.begin(), factor.cameras.end(), standsAtOrigin))
    throw InputError(file->name + ": holds no pose that is read; its camera stands at the origin");
  return factor;
}

bool isRpy(const Json& pose) {
  const Json* const order = pose.is_object() ? valueAt(pose, "euler.order") : nullptr;
  return order && *order == "rpy";
}

bool isPose(const Field& field) { return field.group == Group::pose && field.path != "cameraAxes"; }

/// What a document says of its axes, and where its camera stands.
struct Stand {
  CameraAxes axes;
  Handedness world;
  World north;
  std::optional<Pose> pose;

  explicit Stand(Document document) {
    normalize(document);
    const FieldValues values = readValues(document);
    const DocumentConvention stated = readConvention(values);
    axes = cameraAxesOf(values, *stated.preset);
    world = stated.convention.world;
    north = worldOf(values);
    pose = readPose(values, stated);
  }
};

/// The pose of another camera, in the axes of this one. field: the direction. lacksAxes: its file says of none.
Json poseIn(const Json& camera, const Document& file, Json other, bool lacksAxes, const std::string& field) {
  const Stand to(Document{file.name, std::make_shared<Json>(camera)});
  if (lacksAxes && !other.contains("convention") && !other.contains("heading"))
    other["cameraAxes"] = nameOf(kCameraAxesNames, to.axes);
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

/// A camera's document at the product of poses: the one of each factor, that of a number, or its own. which: of the
/// cameras of its file. The outermost says the world.
Json atPose(Json camera, const std::vector<PoseFactor>& factors, std::size_t which, std::size_t number,
            const std::string& direction, const std::string& cameraAxes) {
  for (const Field& field : kFields)
    if (isPose(field)) camera.erase(std::string(field.path));
  if (!cameraAxes.empty()) camera["cameraAxes"] = cameraAxes;
  Json poses = Json::array();
  World north = World::any;
  const PoseFactor& outermost = direction == "worldFromCamera" ? factors.front() : factors.back();
  for (const PoseFactor& factor : factors) {
    const auto& [file, cameras, field, isOfCamera, isOwn, lacksAxes, isPicked, notes] = factor;
    const Json pose = cameras[cameras.size() == 1 ? 0 : isOwn ? which : number].document();
    if (!isOfCamera && !pose.contains(field)) throw InputError(file->name + ": has no pose that says " + field);
    const Json turned = isOfCamera ? poseIn(camera, *file, pose, lacksAxes, field) : pose[field];
    if (turned.is_array() && !turned.empty() && turned.front().is_object())  // itself a chain, as a link of a URDF is
      poses.insert(poses.end(), turned.begin(), turned.end());
    else
      poses.push_back(turned);
    if (isOfCamera && &factor == &outermost) north = Stand(Document{file->name, std::make_shared<Json>(pose)}).north;
  }
  camera[direction] = poses.size() == 1 ? poses.front() : poses;
  if (north != World::any) camera["world"] = north == World::ecef ? "ecef" : "enu";
  return camera;
}

}  // namespace

Json poseOf(const std::string& source) {
  const Opening opening{.option = "--model", .direction = "worldFromCamera"};
  const PoseFactor factor = factorOf(source, opening, "");
  if (factor.cameras.size() > 1)
    throw InputError(factor.file->name + ": holds " + std::to_string(factor.cameras.size()) +
                     " poses; pick one with FILE#NAME");
  const Json pose = factor.cameras.front().document();
  return factor.isOfCamera ? poseIn(pose, *factor.file, pose, false, factor.field) : pose[factor.field];
}

Import atPoses(Import result, const Opening& opening, std::string& name, bool hasFile) {
  const auto factors = std::make_shared<std::vector<PoseFactor>>();
  const PoseFactor* several = nullptr;
  factors->reserve(opening.poses.size());
  for (const std::string& source : opening.poses) {
    factors->push_back(factorOf(source, opening, hasFile ? name : ""));
    PoseFactor& factor = factors->back();
    if (hasFile && isGodotPose(source) && &source == &innermost(opening)) factor = ofGodotsCamera(factor, source);
    if (factor.cameras.size() == 1) continue;
    factor.isOwn = factor.isOwn && factor.cameras.size() == result.cameras.size();
    if (factor.isOwn) continue;
    if (several)
      throw InputError(factor.file->name + ": holds " + std::to_string(factor.cameras.size()) +
                       " poses, and another file does too; pick one of either");
    several = &factor;
  }
  const bool isWorldFirst = opening.direction == "worldFromCamera";
  const std::string option = isWorldFirst ? "--world-from-camera " : "--camera-from-world ";
  std::string others;
  for (const std::string& source : opening.poses) others += " " + option + inShell(source);
  const auto withOwn = [&](const std::string& pick) {
    const std::string own = option + inShell(name + (pick.empty() ? "" : "#" + pick));
    return isWorldFirst ? others.substr(1) + " " + own : own + others;
  };
  const std::string pick = opening.pick.value_or("");
  bool isKept = false, stateAxes = true;
  for (const PoseFactor& factor : *factors) {
    stateAxes = stateAxes && factor.isOfCamera && !factor.lacksAxes;
    result.notes.insert(result.notes.end(), factor.notes.begin(), factor.notes.end());
    isKept = isKept || factor.isOwn;
  }
  if (stateAxes) std::erase(result.notes, kOpenCvNote);
  const auto isPosed = [](const CameraEntry& camera) { return hasPose(camera.document()); };
  // One camera for several poses, or for one that replaces its own.
  std::size_t first = 0;
  if (several || (!isKept && !opening.pick && std::any_of(result.cameras.begin(), result.cameras.end(), isPosed))) {
    const std::string together = several ? "" : "; " + withOwn(pick) + " moves them together";
    first = CameraSet(name, result, {}).choose(opening.pick, together);
    result.cameras = {result.cameras[first]};
  }
  // A trajectory of one names its camera as a longer one does.
  for (const PoseFactor& factor : *factors)
    if (!several && result.cameras.size() == 1 && !factor.isPicked && !factor.isOwn &&
        !factor.cameras.front().name.empty())
      several = &factor;
  if (!isKept) result.lacksAxes = result.hasTranslation = false;
  const PoseFactor& last = isWorldFirst ? factors->back() : factors->front();
  if (hasFile && !last.isOfCamera && isRpy(last.cameras.front().document()[last.field]))
    result.isTurnedByRpy =
        Stand(Document{name, std::make_shared<Json>(result.cameras.front().document())}).axes == CameraAxes::RDF;
  for (const std::string& world : std::exchange(result.worlds, {}))
    if (!isKept)
      result.notes.push_back("if the poses are of " + frameOf(world) + ", use " +
                             withOwn(world + (pick.empty() ? result.cameras.front().name : pick)));
  const std::string folder = several && opening.pick ? pick + "/" : "";
  const std::string replaced = "its own pose, which " + option + "replaces (" + withOwn(pick) + " keeps both)";
  const auto unreadOf = [unread = result.unread, cameras = result.cameras, first, replaced, isKept](std::size_t which) {
    std::string names = unread ? unread(first + which) : "";
    if (!isKept && hasPose(cameras[which].document())) names += (names.empty() ? "" : ", ") + replaced;
    return names;
  };
  const auto moved = [&](const CameraEntry& camera, std::size_t which, std::size_t number) {
    return [document = camera.document, factors, which, number, direction = opening.direction,
            axes = opening.cameraAxes] { return atPose(document(), *factors, which, number, direction, axes); };
  };
  if (!several) {
    result.unread = unreadOf;
    for (std::size_t i = 0; i < result.cameras.size(); ++i)
      result.cameras[i].document = moved(result.cameras[i], first + i, 0);
    return result;
  }
  Import all;
  all.notes = result.notes;
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
            moved(result.cameras.front(), first, i));
  }
  return all;
}

bool hasPose(const Json& camera) {
  const Json origin = {0, 0, 0}, none = {0, 0, 0, 1};
  return std::any_of(std::begin(kFields), std::end(kFields), [&](const Field& field) {
    const auto value = isPose(field) ? camera.find(field.path) : camera.end();
    return value != camera.end() && *value != (field.path == "position" ? origin : none);
  });
}

}  // namespace viewproj::cmd
