// A picture of what a camera sees, as an SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/scene.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

// Names are as the picture shows them, and may be empty.

struct NamedPoint {
  std::string name, note;  ///< the note stands after the name
  Vec4 point;
  std::optional<Vec2> pixel = {};  ///< where somebody else says that it is
};

struct NamedSegment {
  std::string name;
  Vec3 a, b;
};

/// Outlines on the ground, and of holes in them.
struct NamedArea {
  std::string name;
  std::vector<std::vector<Vec3>> rings;
};

struct PictureContent {
  std::string title;
  bool worldIsEcef = false;
  /// Shapes hide what is behind them. Planes, ellipsoids and surfaces of a height are grounds.
  std::vector<SceneObject> shapes = {};
  std::vector<NamedPoint> points = {};
  std::vector<NamedSegment> segments = {};
  std::vector<NamedArea> areas = {};
  std::vector<Vec2> pixels = {};        ///< to mark, with what their rays hit first
  bool hasStems = false;                ///< a line from each point down to the first ground
  std::string photo = {};               ///< a URL of it
  std::vector<std::string> notes = {};  ///< lines of the legend, such as what explains the misses of pairs
};

/// A JPEG or PNG file. A picture in a page loads no other file: the URL holds its bytes. Throws InputError.
struct Photo {
  std::string name, url;
  double width, height;
};
Photo readPhoto(const std::string& file);
/// Throws InputError if its size is not the viewport's: a stretched one would hide the mistake.
void requireSize(const Photo& photo, const Viewport& viewport);

/// The same bytes for the same content.
std::string pictureOf(const Camera& camera, const PictureContent& content);

}  // namespace viewproj::cmd
