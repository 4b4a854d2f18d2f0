// The options of a camera: the file, its fields, how it is read and in which convention it is written.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/read_camera.hpp"
#include "camera/source.hpp"
#include "commands/cli.hpp"
#include "commands/notes.hpp"
#include "commands/values.hpp"

namespace viewproj::cmd {

/// The presets of conventions by name.
Names<Convention> presetConventions();

/// The camera, how it is read, and the convention it is written in.
class CameraOptions {
 public:
  void add(CLI::App& app);
  /// --convention and what changes it.
  void addWriting(CLI::App& app);
  /// FILE, for a command that reads nothing but the camera.
  void addFile(CLI::App& app);

  /// For a command that asks for near and far alone: options without an opening are enough.
  void takeAnyOpening() { anyOpening_ = true; }

  /// From -c, or from FILE where the command has it. needsPicture: as in ReadOptions.
  CameraFile read(bool needsPicture = true) const;
  /// Writes a text of every camera of the file; pick: what picks it. A camera that cannot be read, or of which there is
  /// no such text, has a message instead. Returns the exit status.
  int writeEach(bool needsPicture,
                const std::function<std::string(const std::string& pick, const CameraFile& camera)>& textOf) const;
  /// All cameras of the file, or the one of options; and what #NAME picks among them.
  std::pair<std::unique_ptr<CameraDocuments>, std::optional<std::string>> readAll() const;
  CameraFile readOne(const CameraDocuments& cameras, std::size_t which) const;
  bool fromStandardInput() const;
  bool isGiven() const { return camera_ || file_ || isTyped(); }
  /// The camera's document, in the convention that is written.
  std::string written(const CameraFile& file) const;
  bool allowsStretch() const { return allowStretch_; }

  /// Where the camera's x, y, z point in the convention that is written: of an unnamed one as the file or the world has
  /// them.
  CameraAxes writtenAxes(const CameraFile& file) const;

  /// The convention to write in: the file's world, and the axes that options name.
  Convention writing(const CameraFile& file) const;

  /// Notes a --convention whose world has another handedness than that of a file which states none.
  void noteHandedness(const CameraFile& file) const;
  bool namesConvention() const { return convention_.has_value(); }
  bool namesAxis() const { return reverseZ_.has_value() || ndcZ_.has_value(); }

 private:
  CameraSource source() const;
  ReadOptions reading(bool needsPicture) const;
  CameraPatches patches() const;
  /// The cameras of the file, or of options alone.
  std::unique_ptr<CameraDocuments> open(const CameraSource& picked) const;
  /// The camera is what options say of it, and no file's.
  bool isTyped() const;
  bool hasPlace() const;
  std::string readAs() const;

  std::optional<std::string> camera_, file_, readAs_;
  std::optional<Size> viewport_;
  std::optional<ConventionPreset> convention_;
  std::optional<NdcZ> ndcZ_;
  std::optional<bool> reverseZ_;
  std::vector<Patch> patches_;  ///< of options and of --set, in their order
  bool takesFile_ = false, anyOpening_ = false, allowStretch_ = false, ignoreDistortion_ = false;
  mutable bool statesConvention_ = true;  ///< of the camera that was read
};

}  // namespace viewproj::cmd
