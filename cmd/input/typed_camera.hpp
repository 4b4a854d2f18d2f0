// Camera fields that the command line gives: read by their rows, checked against one another, and put over those of a
// camera that was read, or in place of one.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "input/camera_file.hpp"
#include "input/document.hpp"
#include "input/projection_types.hpp"

namespace viewproj::cmd {

/// A row of the camera's tables that has an option.
struct CameraOption {
  std::string_view name;                 ///< "--fov-y"
  const Field* field = nullptr;          ///< the first that has it
  const ProjectionType* type = nullptr;  ///< in place of a field: a flag that asks for this type
  bool ofLens = false;                   ///< of the projection; otherwise of the pose
};

/// In the order of the tables.
std::vector<CameraOption> cameraOptions();

class TypedCamera {
 public:
  /// Throws UsageError where the text is no value of the option.
  void add(const CameraOption& option, const std::string& text);
  bool empty() const { return given_.empty(); }
  /// "--near", each once.
  std::vector<std::string_view> names() const;
  TypedCamera without(std::string_view option) const;
  /// A place stands for the position or the target.
  bool hasPlace() const;

  /// The position and more: nothing of the file's pose is left.
  bool replacesPose() const;
  /// More than near, far and shift of the projection.
  bool replacesLens() const;
  std::optional<double> aspect() const;

  /// An opening like any other, where near and far are all that is given of the lens, and all that matters.
  void assumeOpening(bool hasViewport);

  /// Throws UsageError, with their names, where options say the same thing twice.
  void requireConsistent() const;

  /// Over the fields of a camera file of our own, which may be empty. What no field of the file can hold goes into the
  /// reading. unchanged: reads the file without the options.
  void mergeInto(Document& document, CameraReading& reading, const std::function<CameraFile()>& unchanged) const;

  /// Over a camera that was read from a file of another form.
  CameraFile over(const CameraFile& camera, const Document& document, const CameraReading& reading) const;

 private:
  struct Given {
    CameraOption option;
    std::shared_ptr<const nlohmann::json> value;  ///< null for a type
  };
  std::vector<Given> of(bool lens) const;
  void mergePose(Document& document, CameraReading& reading, const std::function<CameraFile()>& unchanged) const;
  void mergeLens(Document& document, CameraReading& reading, const std::function<CameraFile()>& unchanged) const;
  /// Besides near, far and shift, of which there may be none, an aspect is all.
  static bool shapesByAspectAlone(const std::vector<Given>& lens);
  const ProjectionType& typeFor(const std::vector<Given>& lens) const;

  std::vector<Given> given_;
};

}  // namespace viewproj::cmd
