// The options of a camera: the file, its fields, how it is read and in which convention it is written.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera_set.hpp"
#include "camera/read_camera.hpp"
#include "camera/sea_level.hpp"
#include "commands/cli.hpp"

namespace viewproj::cmd {

/// The presets of conventions by name.
Names<ConventionPreset> presetChoices();

/// The camera, how it is read, and the convention it is written in.
class CameraOptions {
 public:
  void add(CLI::App& app);
  /// FILE, for a command that reads nothing but the camera.
  void addFile(CLI::App& app);
  /// FILE..., for a command that takes all cameras of several files: the first, and what remains.
  void addFiles(CLI::App& app);
  /// What changes --convention, for a command that writes in one; of others it is how options alone are read.
  void addWriting(CLI::App& app);

  /// --reverse-z for a command that reads depth: of options alone.
  void addReversed(CLI::App& app);

  /// For a command that needs near and far alone: options without a field of view are enough.
  void takeAnyLens() { takesAnyLens_ = true; }
  /// For a command that tells of matrices in a text, unless options want a camera of them.
  void showMatrices() { showsMatrices_ = true; }
  /// For a command that lists the cameras of a file: those of another pose or picture too.
  void takeAll() { takesAll_ = true; }
  /// For a command that moves the camera: options without a position are enough.
  void takeAnyPosition() { takesAnyPosition_ = true; }
  /// The viewport of a camera that has none.
  void assumeViewport(double width, double height) { otherwise_ = {width, height}; }
  /// For a command whose pixels need no size of the picture: see ReadOptions.
  void takeAnySize() { takesAnySize_ = true; }

  /// The camera that -c, FILE or the options give. needsPicture: as in ReadOptions.
  CameraFile read(bool needsPicture = true) const;
  /// All cameras of the file, or the one of options; and what #NAME picks among them. Of several files those that are
  /// picked of each. mayLack: there may be neither.
  std::pair<std::unique_ptr<CameraSet>, std::optional<std::string>> readAll(bool mayLack = false) const;
  /// How they are read.
  ReadOptions reading(bool needsPicture = true, BoxLack boxMayLack = BoxLack::nothing) const {
    return {allowStretch_, ignoreDistortion_, needsPicture && !takesAnyLens_, boxMayLack, takesAnySize_};
  }
  CameraFile readOne(const CameraSet& cameras, std::size_t which, bool needsPicture = true,
                     BoxLack boxMayLack = BoxLack::nothing) const;
  /// Writes a text of every camera of the file; pick: what picks it. A camera that cannot be read, or of which there is
  /// no such text, has a message instead. Returns the exit status.
  int writeEach(bool needsPicture,
                const std::function<std::string(const std::string& pick, const CameraFile& camera)>& textOf) const;

  /// The first -c or FILE; nothing where options are the camera. Throws UsageError where there is none, or both.
  std::optional<std::string> file(bool mayLack = false) const;
  /// The preset of --convention; null without it.
  const ConventionPreset* convention() const { return convention_ ? &*convention_ : nullptr; }
  /// The convention of --read-as.
  std::optional<Convention> readAs() const;
  /// Whether an option says something of a camera, which matrices in a text have no place for.
  bool changesCamera() const {
    return !patches_.empty() || viewport_ || resize_ || allowStretch_ || ignoreDistortion_ || hasGeoid();
  }

  /// The convention to write in: the file's world, and the axes that options name.
  Convention writing(const Convention& read) const;
  /// The camera's document, in the convention that is written.
  std::string written(const CameraFile& file) const;
  std::string written(const CameraFile& file, std::string_view between) const;
  /// Notes a --convention whose world has another handedness than that of a file which states none, and one that makes
  /// the world of options another than the default.
  void noteHandedness(const CameraFile& file) const;

 private:
  CameraPatches patches(bool isTyped) const;
  /// Throws UsageError where other options replace all of the pose that the option gives.
  void requirePoseCounts(const std::string& option) const;
  std::pair<std::unique_ptr<CameraSet>, std::optional<std::string>> open(const std::optional<std::string>& name) const;

  const CLI::App* app_ = nullptr;
  std::optional<std::string> operand_, readAs_, parts_;
  std::vector<std::string> cameras_, worldFromCamera_, cameraFromWorld_;
  std::optional<Size> viewport_;
  std::optional<double> resize_;  ///< of the picture of a file
  std::optional<std::array<double, 2>> otherwise_;
  std::optional<ConventionPreset> convention_;
  std::optional<NdcZ> ndcZ_;
  std::optional<bool> reverseZ_;
  std::vector<Patch> patches_;  ///< of options and of --set, in their order
  bool takesAll_ = false, takesAnyLens_ = false, takesAnyPosition_ = false, showsMatrices_ = false, onlyReads_ = true,
       readsDepth_ = false, allowStretch_ = false, ignoreDistortion_ = false, takesAnySize_ = false;
};

}  // namespace viewproj::cmd
