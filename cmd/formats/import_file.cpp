#include "formats/import_file.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "camera/read_convention.hpp"
#include "formats/claims.hpp"
#include "formats/finder/finder.hpp"
#include "formats/format.hpp"
#include "formats/parts.hpp"
#include "formats/poses.hpp"
#include "formats/rows.hpp"
#include "formats/unread.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/names.hpp"
#include "text/pasted_matrices.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The formats that have a file; the order does not matter, for one at most claims a file.
constexpr const Format* kFormats[] = {&kGltf,   &kThreeJs,  &kTransforms, &kMetashape,     &kMetashapeLens,
                                      &kPix4d,  &kMeshroom, &kOpenSfm,    &kOpenSfmLenses, &kBundler,
                                      &kExif,   &kTable,    &kScanner,    &kOpenXr,        &kUnity,
                                      &kUnreal, &kKalibr,   &kPoses,      &kMatrices};

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
  for (const char* world : {"imu/", "body/", "velodyne/", "lidar/", "earth/"})
    if (name.starts_with(world)) return world;
  return "";
}

/// Whether what the camera needs is in the file.
bool canBeRead(const CameraEntry& camera) {
  try {
    (void)camera.document();
    return true;
  } catch (const InputError&) {
    return false;
  }
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
    if (world.empty() && isLeftOut(camera) &&
        std::find(file.worlds.begin(), file.worlds.end(), worldOf(camera.name)) == file.worlds.end() &&
        canBeRead(camera))
      file.worlds.push_back(worldOf(camera.name));
  std::erase_if(file.cameras, isLeftOut);
}

/// Leaves out what is of another camera, where there are others, and says so.
void keepOwn(Import& file, const std::string& name) {
  std::vector<std::string> others;
  for (const CameraEntry& camera : file.cameras)
    if (camera.isOfAnother) others.push_back("#" + visible(camera.name));
  if (others.empty() || others.size() == file.cameras.size()) return;
  std::erase_if(file.cameras, [](const CameraEntry& camera) { return camera.isOfAnother; });
  file.notes.push_back(
      (file.cameras.size() == 1 ? "takes #" + file.cameras.front().name + ", the camera's own picture; " : "") +
      "left out: " + joined(others) + (others.size() == 1 ? ", which is" : ", which are") +
      " of another pose or picture; " + name + others.front() + " takes it alone");
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

/// Note what looks like a pose where the line takes none.
Import importParts(const Node& root, const std::string& line, bool hasPose) {
  std::vector<Part> parts = parseParts(line, "--parts");
  requireNames(parts, "--parts", false);
  if (parts.empty()) throw UsageError("--parts: expected name=path, as in K=camera_matrix");
  const bool takesPose =
      hasPose || std::any_of(parts.begin(), parts.end(), [](const Part& part) {
        return isAmong(part.name, "P position latLonHeight heading") || part.name.find("From") != std::string::npos;
      });
  // Programs that tell a lens by an angle count pixels from corners.
  const bool isOfPixels =
      std::any_of(parts.begin(), parts.end(), [](const Part& part) { return isAmong(part.name, "K P"); });
  Import result{camerasOfParts(root, std::move(parts), {isOfPixels ? 0 : 0.5}, "")};
  const Proposal proposal = takesPose ? Proposal{} : proposeParts(root.document());
  for (const ProposedLine& proposed : proposal.lines)
    if (!proposed.pose.empty() && !result.unread)
      result.unread = [names = proposed.pose](std::size_t) {
        return names + ", which looks like a pose; without one points are in the camera's frame";
      };
  if (!takesPose && !result.unread) result.notesUnlessSet.emplace_back("position", kNoPoseNote);
  return result;
}

/// "; it names a.yaml, b.yaml beside it …", of the files that its texts name.
std::string filesNamedBy(const Document& file) {
  std::vector<std::string> names;
  const std::filesystem::path folder = pathOf(file.name).parent_path();
  if (!file.root->is_object()) return "";
  for (const Json& value : *file.root) {
    const std::string name = value.is_string() ? value.get<std::string>() : "";
    if (name.find('.') != std::string::npos && name.size() < 256 && isFile(folder / pathOf(name)))
      names.push_back(name);
  }
  constexpr std::size_t kMost = 4;
  if (names.empty()) return "";
  return "; it names " + visible(someOf(names, kMost)) + ", which may be -c, with --world-from-camera " + file.name +
         "#0 where the pose is here";
}

/// Whether the matrices of a text are poses.
bool hasPosesAlone(std::string_view text) {
  const auto printed = printedPoses(text);
  return !printed.empty() &&
         std::all_of(printed.begin(), printed.end(), [](const auto& pose) { return isRigid(*numbersIn(pose.second)); });
}

/// The likeliest line of parts that has a lens, with what it leaves open; or empty.
std::string lineOf(const Proposal& proposal) {
  constexpr std::size_t kMostNames = 6;
  const auto line = std::find_if(proposal.lines.begin(), proposal.lines.end(),
                                 [](const ProposedLine& proposed) { return proposed.hasLens; });
  if (line == proposal.lines.end()) return "";
  return "; it may be read by " + optionsOf(*line) +
         (line->decide.empty() ? "" : "; decide: " + joined(line->decide, "; ")) +
         (proposal.leftOut.empty() ? "" : "; it leaves out " + visible(someOf(proposal.leftOut, kMostNames)));
}

[[noreturn]] void failUnknown(const Document& file) {
  std::string line = lineOf(proposeParts(file));
  if (file.isPlainText && file.text && hasPosesAlone(*file.text))
    line +=
        "; as a pose it is for --camera-from-world FILE, of a view, or --world-from-camera FILE, with --set "
        "cameraAxes=RUB where the camera looks along its -z";
  throw UnknownFile(file.name + ": is not a camera file of a known kind" + filesNamedBy(file) + line +
                        "; viewproj info FILE tells what is in it, viewproj help formats lists the kinds",
                    file);
}

/// Of a text that began like a tree: what is wrong with it as that, and what it has as a text.
[[noreturn]] void failFaulty(const Document& file) {
  const Proposal proposal = proposeParts(file);
  const bool hasMore = !proposal.lines.empty() || (file.text && !findMatrices(*file.text).matrices.empty());
  throw UnknownFile(file.fault + lineOf(proposal) + (hasMore ? "; viewproj info FILE tells what it has as text" : ""),
                    file);
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

}  // namespace

void failPreset(const std::string& name, std::string_view form) {
  throw InputError(name + ": is " + std::string(form) + ", which has a convention of its own; leave out --read-as");
}

Import importFile(const std::shared_ptr<Document>& file, const Opening& opening, const std::string& preset) {
  const Node root(*file);
  if (opening.parts) return importParts(root, *opening.parts, !opening.poses.empty());
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
    if (!opening.pick && !opening.takesAll) keepOwn(result, file->name);
    result.mayLackPose = true;
    if (claim.mayBeMatrices || file->isPlainText) result.matricesText = file->text;
    return judged(file, std::move(result), claim.known);
  }
  if (!file->isPlainText && isCameraDocument(*file->root)) {
    requireOwnMembers(*file);
    return openCameraDocument(*file);
  }
  if (!file->fault.empty()) failFaulty(*file);
  failUnknown(*file);
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
