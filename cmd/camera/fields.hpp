// The fields of a camera document, a row each. The reader's checks, --set, the options with their placeholders, help,
// the schema and the order of `matrix --to camera` all go by these rows. To add a field: a row here, and where
// read_camera.cpp or read_pose.cpp uses it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "camera/names.hpp"

namespace viewproj::cmd {

/// What a value has to be.
enum class Kind : std::uint8_t {
  text,
  word,  ///< one of the row's words
  flag,  ///< true or false
  number,
  positive,    ///< a number above 0
  far,         ///< a number or "inf"
  zero,        ///< a number that can only be 0
  ratio,       ///< a number above 0, "16/9" or "16:9"
  angle,       ///< between 0 and 180 degrees; all angles: a number of degrees, "60deg" or "1.0472rad"
  elevation,   ///< from -90 to 90 degrees
  turn,        ///< degrees
  pair,        ///< two numbers
  range,       ///< two numbers that differ
  size,        ///< two numbers above 0
  direction,   ///< x, y, z, not all 0
  place,       ///< x, y, z, or {"lat", "lon", "height"}
  quaternion,  ///< x, y, z, w, not all 0
  euler,       ///< {"order": "YXZ", "degrees": [a, b, c]}
  rigid,       ///< 4 or 3 rows of 4, or {"rotation" or "rotationVector", "translation"}
  matrix,      ///< 16 numbers, or 4 rows of 4
  lens,        ///< a distortion
};

/// What help calls a value: of an option, and in a file. Of a word the words themselves.
struct KindWords {
  Kind kind;
  std::string_view placeholder, form;
};
inline constexpr KindWords kKindWords[] = {
    {Kind::text, "TEXT", "text"},
    {Kind::word, "NAME", ""},
    {Kind::flag, "N", "true or false"},
    {Kind::number, "N", "number"},
    {Kind::positive, "N", "number above 0"},
    {Kind::far, "N", "number or \"inf\""},
    {Kind::zero, "N", "0"},
    {Kind::ratio, "W/H", "number or \"16/9\""},
    {Kind::angle, "DEGREES", "0 to 180 degrees"},
    {Kind::elevation, "DEGREES", "-90 to 90 degrees"},
    {Kind::turn, "DEGREES", "degrees"},
    {Kind::pair, "X,Y", "[a, b]"},
    {Kind::range, "A,B", "[a, b]"},
    {Kind::size, "W,H", "[a, b]"},
    {Kind::direction, "X,Y,Z", "[x, y, z]"},
    {Kind::place, "X,Y,Z|lat=..,lon=..,height=..", "[x, y, z] or {lat, lon, height}"},
    {Kind::quaternion, "X,Y,Z,W", "[x, y, z, w]"},
    {Kind::euler, "YXZ:A,B,C", "{order, degrees}"},
    {Kind::rigid, "M", "4 rows of 4, or {rotation, translation}"},
    {Kind::matrix, "M", "16 numbers"},
    {Kind::lens, "JSON", "{model, k, p}"},
};
constexpr const KindWords& wordsOfKind(Kind kind) {
  for (const KindWords& row : kKindWords)
    if (row.kind == kind) return row;
  return kKindWords[0];  // none: every kind has its row
}

/// The types of a projection, as bits: those that a field belongs to.
enum Types : std::uint8_t {
  kPerspective = 1,
  kFrustum = 2,
  kIntrinsics = 4,
  kOrthographic = 8,
  kPs2 = 16,
  kMatrix = 32
};
inline constexpr std::uint8_t kAllTypes = 63, kWithNear = 31;
inline constexpr NameRow<std::uint8_t> kTypeNames[] = {
    {"perspective", kPerspective},   {"frustum", kFrustum}, {"intrinsics", kIntrinsics},
    {"orthographic", kOrthographic}, {"ps2", kPs2},         {"matrix", kMatrix}};

/// Fields of one group contradict each other unless they share a bit of `sets`.
enum class Group : std::uint8_t { none, pose, lens };

struct Field {
  std::string_view path;
  Kind kind;
  std::string_view help;         ///< one line: what it is, its default
  std::string_view option = {};  ///< "--fov-y"
  Group group = Group::none;
  std::uint8_t sets = 0;
  std::uint8_t types = 0;        ///< of a field of the projection
  Words words = nullptr;         ///< of a word
  std::string_view others = {};  ///< other names of it, blanks between them
};

consteval Field wordField(std::string_view path, Words words, std::string_view help, std::uint8_t types = 0) {
  return {path, Kind::word, help, "", Group::none, 0, types, words};
}
consteval Field poseField(std::string_view path, Kind kind, std::uint8_t sets, std::string_view option,
                          std::string_view help, Words words = nullptr, std::string_view others = "") {
  return {path, kind, help, option, Group::pose, sets, 0, words, others};
}
/// No sets: it contradicts nothing.
consteval Field lensField(std::string_view path, Kind kind, std::uint8_t types, std::uint8_t sets,
                          std::string_view option, std::string_view help) {
  return {path, kind, help, option, sets ? Group::lens : Group::none, sets, types};
}

inline constexpr Field kFields[] = {
    {"$schema", Kind::text, "Where the schema of this file is, for editors."},
    {"name", Kind::text, "What the camera is called."},
    wordField("convention.preset", presetNames,
              "The convention whose axes count where no other is named. Default: opengl."),
    wordField("convention.world", wordsOf<kWorldNames>, "Handedness of the world's numbers."),
    wordField("convention.view", wordsOf<kViewNames>, "Where x, y, z of view space point: right, up, back and so on."),
    wordField("convention.ndcZ", wordsOf<kNdcZNames>, "The range of NDC z."),
    {"convention.reverseZ", Kind::flag, "Near and far are exchanged in depth."},
    wordField("convention.ndcY", wordsOf<kNdcYNames>, "The way NDC y points in the picture."),
    wordField("convention.vectors", wordsOf<kVectorsNames>, "Column vectors (M v) or row vectors (v M)."),
    wordField("convention.storage", wordsOf<kStorageNames>, "The order of a matrix in memory."),
    wordField("world", wordsOf<kWorlds>,
              "ecef: Earth-centred, Earth-fixed metres. Default where position or target is a place."),
    poseField("position", Kind::place, 127, "--position",
              "The eye: x, y, z, or a place on the Earth. Over a matrix pose it replaces its place.", nullptr,
              "eye from"),
    poseField("target", Kind::place, 1, "--target", "A point in the middle of the view, before any shift.", nullptr,
              "lookAt at to"),
    poseField("direction", Kind::direction, 2, "--direction", "Where the camera looks; of any length.", nullptr,
              "forward"),
    poseField(
        "up", Kind::direction, 3, "--up",
        "What is up in the picture. Default: 0 1 0; unreal 0 0 1; opencv and ps2 0 -1 0; on the Earth away from it."),
    poseField("rotation", Kind::quaternion, 4, "--rotation", "Camera to world: x, y, z, w of any length.", nullptr,
              "quaternion orientation"),
    poseField("euler", Kind::euler, 8, "--euler", "Turns about the camera's own axes, in the order of the letters."),
    poseField("worldFromCamera", Kind::rigid, 16, "",
              "Rows of a matrix for column vectors, or rotation and translation."),
    poseField("cameraFromWorld", Kind::rigid, 32, "", "The inverse: a view matrix, or rotation and translation."),
    poseField("heading", Kind::turn, 64, "--heading", "Degrees clockwise from north; position is a place."),
    poseField("pitch", Kind::elevation, 64, "--pitch", "Degrees above the horizon. Default: 0."),
    poseField("roll", Kind::turn, 64, "--roll", "Degrees, right side down. Default: 0."),
    poseField("cameraAxes", Kind::word, 60, "",
              "Where x, y, z of a rotation point: right, up, back and so on. Default: the convention's.",
              wordsOf<kCameraAxesNames>),
    wordField("projection.type", wordsOf<kTypeNames>, "Which of the fields below describe the view.", kAllTypes),
    lensField("projection.fovY", Kind::angle, kPerspective, 1, "--fov-y",
              "Angle from the bottom edge of the picture to the top."),
    lensField("projection.fovX", Kind::angle, kPerspective, 2, "--fov-x",
              "Angle from the left edge of the picture to the right."),
    lensField("projection.fovDiagonal", Kind::angle, kPerspective, 4, "--fov-diagonal",
              "Angle from corner to corner of the picture."),
    lensField("projection.nearWidth", Kind::positive, kPerspective, 8, "", "Width of the window on the near plane."),
    lensField("projection.nearHeight", Kind::positive, kPerspective, 8, "", "Height of the window on the near plane."),
    lensField("projection.focalLength", Kind::positive, kPerspective, 16, "--focal-length",
              "In the unit of the sensor, such as millimetres."),
    lensField("projection.sensorWidth", Kind::positive, kPerspective, 16, "--sensor-width",
              "In the unit of focalLength."),
    lensField("projection.sensorHeight", Kind::positive, kPerspective, 16, "--sensor-height",
              "In the unit of focalLength."),
    lensField("projection.left", Kind::number, kFrustum | kOrthographic, 32, "--left",
              "Edge of the window: frustum on the near plane, orthographic in view space."),
    lensField("projection.right", Kind::number, kFrustum | kOrthographic, 32, "--right", "Edge of the window."),
    lensField("projection.bottom", Kind::number, kFrustum | kOrthographic, 32, "--bottom", "Edge of the window."),
    lensField("projection.top", Kind::number, kFrustum | kOrthographic, 32, "--top", "Edge of the window."),
    lensField("projection.width", Kind::positive, kOrthographic, 64, "--ortho-width",
              "Width of the window around the viewing axis."),
    lensField("projection.height", Kind::positive, kOrthographic, 64, "--ortho-height",
              "Height of the window around the viewing axis."),
    lensField("projection.aspect", Kind::ratio, kPerspective | kOrthographic, 1 | 2 | 4 | 16 | 64, "--aspect",
              "Width over height. Default: the viewport's."),
    lensField("projection.fx", Kind::positive, kIntrinsics, 128, "--fx", "Focal length in pixels, across."),
    lensField("projection.fy", Kind::positive, kIntrinsics, 128, "--fy", "Focal length in pixels, down."),
    lensField("projection.scrz", Kind::positive, kPs2, 128, "", "Distance of the screen: screen x = cx + ax scrz X/Z."),
    lensField("projection.ax", Kind::positive, kPs2, 128, "", "Shape of a pixel, across."),
    lensField("projection.ay", Kind::positive, kPs2, 128, "", "Shape of a pixel, down."),
    lensField("projection.cx", Kind::number, kIntrinsics | kPs2, 128, "--cx",
              "Screen x of the viewing axis, as the viewport counts pixels."),
    lensField("projection.cy", Kind::number, kIntrinsics | kPs2, 128, "--cy",
              "Screen y of the viewing axis, as the viewport counts pixels."),
    lensField("projection.skew", Kind::zero, kIntrinsics, 128, "", "Of the pixels; only 0 is read."),
    lensField("projection.pixels", Kind::size, kIntrinsics, 128, "",
              "Width and height of the picture that fx, fy, cx, cy are for. Default: the viewport's."),
    lensField("projection.zMin", Kind::number, kPs2, 128, "", "Depth at far."),
    lensField("projection.zMax", Kind::number, kPs2, 128, "", "Depth at near."),
    lensField("projection.matrix", Kind::matrix, kMatrix, 128, "",
              "A projection matrix in the stated convention: 4 rows as on paper, or 16 numbers as in memory."),
    lensField("projection.near", Kind::number, kWithNear, 0, "--near",
              "Distance of the near plane. Absent: there is none, and no depth."),
    lensField("projection.far", Kind::far, kWithNear, 0, "--far", "Distance of the far plane. Absent: infinite."),
    lensField("projection.shift", Kind::pair, kAllTypes, 0, "--shift",
              "Moves the picture right by x half-widths and up by y half-heights."),
    {"distortion", Kind::lens, "Of the lens: {\"model\": \"brown\", \"k\": [...], \"p\": [p1, p2]} or fisheye.",
     "--distortion"},
    {"viewport.width", Kind::positive, "Of the picture, in pixels."},
    {"viewport.height", Kind::positive, "Of the picture, in pixels."},
    {"viewport.x", Kind::number, "Screen x of the picture's corner. Default: 0."},
    {"viewport.y", Kind::number, "Screen y of the picture's corner. Default: 0."},
    {"viewport.depthRange", Kind::range, "Window depth at near and at far; reverseZ exchanges them. Default: 0 1."},
    wordField("viewport.origin", wordsOf<kOriginNames>, "The corner that pixels count from. Default: top-left."),
    {"viewport.pixelCenter", Kind::number, "Where in a pixel its centre is. Default: 0.5; opencv 0."},
    {"viewport.crop.x", Kind::number, "A tile of the picture: its corner, counted from the picture's."},
    {"viewport.crop.y", Kind::number, "The tile's corner."},
    {"viewport.crop.width", Kind::positive, "Of the tile, in pixels. The camera is then the tile's."},
    {"viewport.crop.height", Kind::positive, "Of the tile, in pixels."},
};

/// The row of a path, or null.
constexpr const Field* findField(std::string_view path) {
  for (const Field& field : kFields)
    if (field.path == path) return &field;
  return nullptr;
}

}  // namespace viewproj::cmd
