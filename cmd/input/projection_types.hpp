// The ways in which a camera file describes what part of space the camera sees.
// To add one: a function in projection_types.cpp that reads its fields and ends in a Projection, and a row in its
// table.
#pragma once

#include <optional>
#include <string_view>

#include "input/document.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

struct ReadProjection {
  Projection projection;
  bool hasOwnShape = false;       ///< width : height follows from the file's projection, not from the viewport
  bool hasOwnPixelShape = false;  ///< the file says itself how wide a pixel is
};

struct ProjectionType {
  std::string_view name;
  const ObjectForm& form;
  /// fields: of "projection"; viewport: the whole frame's, where there is one. Throws InputError, or CameraError with
  /// the field that the library complains about.
  ReadProjection (*read)(const ObjectReader& fields, const std::optional<Viewport>& viewport);
  bool countsPixels = false;  ///< and so needs a viewport
  /// By which a file is read that states no convention; null: the first.
  const char* preset = nullptr;
  /// Near has the greatest depth, so the convention has to be reversed.
  bool isReversed = false;
  /// Where the projection says itself where the picture lies. camera: the whole file.
  void (*placeViewport)(const ObjectReader& camera, const ObjectReader& fields, Viewport& viewport) = nullptr;
  /// A flag that asks for this type where the fields could be another's too.
  std::string_view option = "";
};

inline constexpr std::string_view kPerspective = "perspective", kFrustum = "frustum", kIntrinsics = "intrinsics",
                                  kOrthographic = "orthographic", kPs2 = "ps2";

std::span<const ProjectionType> projectionTypes();

/// By the type's reader, and shifted; where it has a viewport, of its shape. Throws as the reader does.
Projection readProjection(const ObjectReader& fields, const ProjectionType& type,
                          const std::optional<Viewport>& viewport, bool allowStretch);

/// That of the field "type". Throws InputError, with the names of all, where it is none of them.
const ProjectionType& requireProjectionType(const ObjectReader& fields);

}  // namespace viewproj::cmd
