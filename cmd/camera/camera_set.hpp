// Sets of cameras: every file is one. Each camera is a document with the options laid over it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "camera/document.hpp"
#include "camera/patch.hpp"
#include "camera/read_camera.hpp"

namespace viewproj::cmd {

/// Where turns are in our axes, and may mean those of others.
inline constexpr const char* kAxesNote =
    "rotations are read with axes RUB: right, up, back; --set cameraAxes=RDF if the camera looks along its z";

/// Where a position is called tx, ty, tz.
inline constexpr const char* kTranslationNote =
    "tx, ty, tz are read as the camera's position, as TUM and ROS mean them, and not as a translation of "
    "cameraFromWorld, as COLMAP's; --parts with cameraFromWorld.translation=*.tx+*.ty+*.tz and "
    "cameraFromWorld.quaternion=*.qx+*.qy+*.qz+*.qw reads those";

/// Where a heading turns a camera in x, y, z.
inline constexpr const char* kEnuNote =
    "heading is clockwise from north, and so x, y, z are read as east, north, up: --set world=enu";

/// Where --parts takes a lens alone.
inline constexpr const char* kNoPoseNote =
    "the line takes no pose: points are in the camera's axes, right, down, forward";

class CameraSet;

/// Where options give a pose, and a lens without a K.
inline constexpr const char* kOpenCvNote =
    "read as OpenCV's: axes right, down, forward, and the first pixel's centre at 0, 0; --set cameraAxes=RUB if the "
    "camera looks along its -z, --set viewport.pixelCenter=0.5 if 0, 0 is the corner";

/// One of the cameras of a file. FILE#NAME, FILE#ID or FILE#NUMBER picks it.
struct CameraEntry {
  std::string name;  ///< the name in the file, or empty
  std::string id;    ///< a number or a second name, or empty
  /// Our document of the camera. Throws InputError naming the file's own field. Calls are one at a time.
  std::function<Json()> document = nullptr;
  std::optional<Node> own = std::nullopt;  ///< what the file has of this camera alone
  /// It is another camera's straightened picture, or its place in another world, or the lens of others without a view.
  bool isOfAnother = false;
  /// Of a set of several files the camera of its own file, by number; else null.
  std::shared_ptr<const CameraSet> set = nullptr;
  std::size_t which = 0;
};

/// The cameras of a file, as a format finds them.
struct Import {
  std::vector<CameraEntry> cameras{};
  /// Parts of the file that are of other cameras, or none.
  std::vector<const Json*> apart = {};
  /// What the format has not read of a camera whose document was made, for a note; or empty.
  std::function<std::string(std::size_t which)> unread = nullptr;
  /// Of bare matrices and of plain text the text, which may be matrices where it makes no camera; null for others.
  std::shared_ptr<const std::string> matricesText = nullptr;
  std::string noun = "camera";  ///< in messages about picks
  /// Where the same cameras are in other worlds, which a pick that begins so has: "velodyne/". None if it does.
  std::vector<std::string> worlds = {};
  bool mayLackPose = false;    ///< the file may give none; its cameras then stand at the origin
  bool lacksAxes = false;      ///< it turns cameras, and says of no axes
  bool isTurnedByRpy = false;  ///< by a robot's angles, but in the axes of a camera
  bool hasRotation = false, hasFocalPixels = false;
  bool hasTranslation = false;                                           ///< positions are called tx, ty, tz
  std::vector<std::string> notes = {};                                   ///< on how its members are read
  std::vector<std::pair<std::string, std::string>> notesUnlessSet = {};  ///< the same, by the field that is not set
  std::vector<std::string> withoutPose = {};         ///< entries of the file that are left out, by name
  std::map<std::string, std::string> ownNames = {};  ///< by the paths of fields: what messages call them

  /// Of one camera without a name.
  static Import one(std::function<Json()> document) {
    Import import;
    import.add("", "", std::move(document));
    return import;
  }
  void add(std::string cameraName, std::string id, std::function<Json()> document, std::optional<Node> own = {}) {
    cameras.push_back({std::move(cameraName), std::move(id), std::move(document), std::move(own)});
  }
};

/// "the lidar" of velodyne/.
std::string frameOf(std::string_view world);

/// "scene.gltf#Camera": a file and the camera to pick in it. A file whose own name has a # is found first.
struct CameraSource {
  std::string file;  ///< in the form that load() accepts
  std::optional<std::string> pick;
};
CameraSource splitPick(const std::string& source);

/// What applies to every camera of a set.
struct CameraPatches {
  std::string readAs;                                ///< the name of a preset; empty: the file's convention
  std::vector<Patch> patches;                        ///< of options and --set, in any order
  std::optional<double> resize{};                    ///< of the file's picture, before the patches
  std::optional<std::array<double, 2>> otherwise{};  ///< the viewport of a camera that no file or patch gives one
};

/// Whether a document is a camera, or a set of cameras, in our own form: it has one of our members at the top (but
/// "name" and "$schema" alone), or no member at all. For a format to ask after its own conditions.
bool isCameraDocument(const Json& root);
/// The cameras of such a document: itself, or the entries of "cameras", each laid over the shared members as --set
/// would. Throws InputError.
Import openCameraDocument(const Document& file);

/// Sets the convention that a file does not state. Throws InputError if it states another one.
void readAs(Document& file, std::string_view preset);

class CameraSet {
 public:
  /// name: of the file, in messages. file: what the cameras are made of, or null. Throws InputError for an empty list.
  CameraSet(std::string name, Import import, CameraPatches patches, std::shared_ptr<const Document> file = nullptr);
  /// A camera from options only.
  explicit CameraSet(const CameraPatches& patches);
  /// The cameras that are picked of several files. One that is its file's only one, and has no name or that of another
  /// camera, is called as the file is.
  struct Picked {
    std::shared_ptr<const CameraSet> cameras;
    std::vector<std::size_t> which;
  };
  explicit CameraSet(const std::vector<Picked>& files);
  CameraSet(const CameraSet&) = delete;
  CameraSet& operator=(const CameraSet&) = delete;

  /// Of the file, in messages.
  const std::string& name() const { return name_; }
  std::size_t size() const { return import_.cameras.size(); }
  /// The name in the file; empty if it has none.
  const std::string& nameOf(std::size_t which) const { return import_.cameras[which].name; }
  /// Of the camera's file, in messages.
  const std::string& fileOf(std::size_t which) const;
  /// See CameraEntry.
  bool isOfAnother(std::size_t which) const { return import_.cameras[which].isOfAnother; }
  /// The same of a document that was read of it: its own name, which options may have set, counts first.
  std::string nameOf(std::size_t which, const Document& read) const;
  /// The shortest text after # that picks only this camera.
  std::string pickOf(std::size_t which) const;
  /// "#P_rect_02": others of its id, which are other pictures of it; or empty.
  std::string othersOf(std::size_t which) const;
  /// Finds a camera by name, id or number (## for a number only); without a pick, the only camera. Throws InputError.
  /// otherwise: what else to do where there are several.
  std::size_t choose(const std::optional<std::string>& pick, const std::string& otherwise = "") const;
  /// All cameras without a pick; those that match a pick with a * in it, or stand in the world or folder that it names;
  /// else the one that choose() finds.
  std::vector<std::size_t> chooseAll(const std::optional<std::string>& pick) const;
  /// The camera that a record names, as choose() finds it; nothing if there is none or more than one. Constant time.
  std::optional<std::size_t> find(std::string_view name) const;

  /// The camera's document with the patches applied. Any number of threads may call this.
  Document document(std::size_t which) const;
  /// What the file's format has not read of the camera; empty if there is nothing to say.
  std::string unreadOf(std::size_t which) const { return import_.unread ? import_.unread(which) : ""; }
  /// What is to be said of the file, once, if this pick chooses among its cameras.
  std::vector<std::string> notes(const std::optional<std::string>& pick) const;
  /// See Import.
  const std::shared_ptr<const std::string>& matricesText() const { return import_.matricesText; }
  /// "for points in the frame of the lidar pick #velodyne/*"; or empty.
  std::string otherWorlds() const;
  bool mayLackPose(std::size_t which) const;

 private:
  std::vector<std::size_t> all() const;
  /// The cameras of a name, or else of an id; or else, where neither are numbers, the camera in the place of a number.
  std::vector<std::size_t> called(std::string_view name) const;
  std::string picksOf(const std::vector<std::size_t>& cameras) const;
  /// Whether a name is a number that may be meant as a camera's place in the file.
  bool mayBePlace(std::string_view text) const;
  [[noreturn]] void failPick(const std::string& pick) const;
  void noteCounting(Document& document) const;

  std::string name_;
  bool isTyped_ = false;
  CameraPatches patches_;
  std::shared_ptr<const Document> file_;  ///< that the cameras of import_ are read from
  Import import_;
  mutable std::mutex importing_;
  std::unordered_map<std::string, std::vector<std::size_t>> names_, ids_;  ///< the cameras of each
  bool areNumbered_ = false;                                               ///< mayBePlace() of a name or an id
};

}  // namespace viewproj::cmd
