// Reads the cameras of a file as the row of its kind says.
#pragma once

#include <string>
#include <vector>

#include "input/importers/importer.hpp"
#include "input/kinds/distortion.hpp"
#include "input/kinds/kind.hpp"
#include "input/kinds/lookup.hpp"
#include "input/kinds/pose_of.hpp"

namespace viewproj::cmd {

/// Of the rows, the first whose kind the file is; or null.
const Kind* kindOf(const Document& document, std::span<const Kind> kinds);

/// The cameras of a file of a kind, found once for all.
class KindCameras {
 public:
  /// Both must outlive it. Throws InputError where the file holds none.
  KindCameras(const Document& document, const Kind& kind);

  /// What picks each of them. withNotes: and a few words about each.
  std::vector<HeldCamera> list(bool withNotes);
  /// Throws InputError with the place of what is wrong.
  CameraFile read(std::size_t which, const CameraReading& reading);

 private:
  std::string noteOn(const CameraPlace& camera);
  /// The camera's own, or what stands around it under another name.
  std::optional<Distortion> distortion(const CameraPlace& camera) const;

  const Document* document_;
  const Kind* kind_;
  std::vector<CameraPlace> all_;
  Poses poses_;
  std::vector<Found> around_;       ///< of all cameras: looked at once
  std::vector<Found> distortions_;  ///< objects that have an array for each camera, by its name
  std::optional<Distortion> distortionAround_;
};

}  // namespace viewproj::cmd
