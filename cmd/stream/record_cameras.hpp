// The cameras through which the records of a stream are seen: one for all; the one of a set that a record names; one
// that a record's own fields say; or each of a set.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera_set.hpp"
#include "camera/read_camera.hpp"
#include "formats/camera_columns.hpp"
#include "records/number_plan.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

/// A camera, and what records need of it.
struct RecordCamera {
  std::string name;
  Camera camera;
  Convention convention = {};  ///< of its file
  bool worldIsEcef = false;
  bool knowsUp = false;                 ///< the world does: on the Earth, or of east, north and up
  bool lacksSize = false;               ///< its picture does
  std::optional<Frustum> frustum = {};  ///< nothing where a lens bends its edges, or the picture has no size

  explicit RecordCamera(const Camera& of);
  RecordCamera(const CameraFile& file, std::string named);
};

/// The fields of a record that say its camera.
struct RecordCameraFields {
  std::vector<std::size_t> fields = {};
  std::shared_ptr<const CameraColumns> columns = nullptr;  ///< own: what they are
};

/// The field that an option names: by its name, or by its number where fields have none. Throws RecordError.
std::size_t cameraFieldOf(const std::string& name, const RecordView& record, const char* option = "--camera-by");
/// The camera that a record names in this field; empty where the value is no name.
std::string cameraNameAt(const RecordView& record, std::size_t field);
/// The camera of the set with this name, which a record has in the field, among those that are picked. Throws
/// RecordError.
std::size_t cameraNamed(const CameraSet& cameras, const std::vector<bool>& isPicked, const RecordView& record,
                        std::size_t field, std::string_view name);

enum class CameraChoice : unsigned char { one, named, own, each };

/// Any number of threads may use it.
class RecordCameras {
 public:
  struct Setup {
    CameraChoice choice = CameraChoice::one;
    std::string field = {};  ///< named: the field, or its number
    std::unique_ptr<CameraSet> cameras = nullptr;
    std::vector<std::size_t> picked = {};  ///< those of the set that take part
    ReadOptions reading = {};
    std::function<void(const CameraFile&)> require = [](const CameraFile&) {};  ///< throws if a camera does not do
  };

  explicit RecordCameras(const Camera& one);
  explicit RecordCameras(const CameraFile& one);
  /// named: reads the first camera that can be read; each: all. Throws InputError.
  explicit RecordCameras(Setup setup);

  /// The first camera, which decides what results there are; null where each record has its own.
  const CameraFile* first() const { return first_ ? &*first_ : nullptr; }
  /// What is to be said of the first camera.
  std::vector<std::string> notes() const;
  /// Whether all of them have Earth-centred coordinates; those that differ are errors.
  bool worldIsEcef() const { return worldIsEcef_; }
  /// Whether each record says its own.
  bool areInRecords() const { return setup_.choice == CameraChoice::own; }
  /// The camera of all records, or null.
  const RecordCamera* only() const { return setup_.choice == CameraChoice::one ? all_.front() : nullptr; }

  /// The fields of a record that say its camera; plan: of its other numbers. Throws RecordError.
  RecordCameraFields locate(const RecordView& record, const NumberPlan& plan) const;

 private:
  /// How the first record's fields are read, and what may be of its camera and is not.
  void noteReading(const CameraColumns& columns, const std::vector<std::string>& unread) const;
  friend class CamerasOfBatch;
  struct Kept {
    std::once_flag once = {};
    std::optional<RecordCamera> camera = {};
    std::string fault = {};  ///< why there is none
  };

  void requireWorld(const CameraFile& file) const;
  /// Made when it is first used, and kept. Throws InputError.
  const RecordCamera& cameraOf(std::size_t which) const;
  const RecordCamera& cameraNamed(const RecordView& record, std::size_t field, std::string_view name) const;
  RecordCamera ownCamera(const RecordView& record, const RecordCameraFields& of) const;

  Setup setup_;
  std::optional<CameraFile> first_;
  std::size_t firstWhich_ = 0;
  bool worldIsEcef_ = false;
  mutable std::deque<Kept> kept_;
  std::vector<bool> isPicked_;
  std::vector<const RecordCamera*> all_;  ///< one, each
  Document base_;                         ///< own
  bool isUnplaced_ = false;               ///< own: no file or option says where it stands
  std::unique_ptr<std::once_flag> readingNoted_ = std::make_unique<std::once_flag>();
};

/// The cameras of the records that one worker collects.
class CamerasOfBatch {
 public:
  explicit CamerasOfBatch(const RecordCameras& cameras) : cameras_(cameras) {}

  /// Those of a record, which stay until clear(). Throws RecordError.
  std::span<const RecordCamera* const> find(const RecordView& record, const RecordCameraFields& of);
  void clear();

 private:
  const RecordCameras& cameras_;
  std::string text_, lastText_;  ///< what says the camera
  const RecordCamera* last_ = nullptr;
  std::deque<RecordCamera> own_;
};

}  // namespace viewproj::cmd
