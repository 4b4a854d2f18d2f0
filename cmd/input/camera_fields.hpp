// The fields of a camera file.
#pragma once

#include <array>

#include "input/convention_names.hpp"
#include "input/field.hpp"

namespace viewproj::cmd {

/// Of projection_types.hpp.
std::vector<std::string_view> projectionTypeNames();

}  // namespace viewproj::cmd

namespace viewproj::cmd::field {

template <const auto&... Fields>
inline constexpr std::array<const Field*, sizeof...(Fields)> list = {&Fields...};

// Of any document.

inline constexpr Field schema{"$schema", ValueForm::text, "Where this schema is, for editors."};
inline constexpr Field name{"name", ValueForm::text, "What it is called."};

// A place on the Earth.

inline constexpr Field lat{"lat", ValueForm::elevation, "Latitude in degrees."};
inline constexpr Field lon{"lon", ValueForm::turn, "Longitude in degrees, east."};
inline constexpr Field height{"height", ValueForm::number, "Metres above the ellipsoid WGS84."};
inline constexpr ObjectForm place{
    .help = "A place on WGS84.", .fields = list<lat, lon, height>, .required = list<lat, lon, height>};

// The pose.

inline constexpr NameRow<bool> kWorlds[] = {{"ecef", true}};
inline constexpr Field world{"world", ValueForm::word,
                             "ecef: the world's numbers are Earth-centred, Earth-fixed metres. So they are where "
                             "position or target is a place.",
                             namesOf<kWorlds>};
inline constexpr Field position =
    Field{"position", ValueForm::position, "Of the eye, in the world: x, y, z or a place.", nullptr, &place}
        .typed("--position")
        .also({"eye", "from"});
inline constexpr Field target =
    Field{"target", ValueForm::position, "What the middle of the view is on, before any shift: x, y, z or a place.",
          nullptr, &place}
        .typed("--target")
        .also({"lookAt", "at", "center", "to"});
inline constexpr Field direction =
    Field{"direction", ValueForm::direction, "Along which the camera looks, of any length."}
        .typed("--direction")
        .also({"forward"});
inline constexpr Field up =
    Field{"up", ValueForm::direction,
          "What is upwards in the picture. Default: 0 1 0; unreal 0 0 1; on the Earth: away from the "
          "ellipsoid."}
        .typed("--up");
inline constexpr Field rotation =
    Field{"rotation", ValueForm::quaternion, "World from camera, a quaternion x, y, z, w of any length."}
        .typed("--rotation")
        .also({"quaternion", "orientation"});
inline constexpr Field worldFromCamera{"worldFromCamera", ValueForm::rigid,
                                       "Four rows of four; column vectors: world = M camera."};
inline constexpr Field cameraFromWorld{"cameraFromWorld", ValueForm::rigid,
                                       "Four rows of four; column vectors: camera = M world."};
inline constexpr Field cameraAxes{"cameraAxes", ValueForm::word,
                                  "Where the camera's x, y, z of a rotation or a matrix point: right, up, back, and so "
                                  "on. Default: the convention's.",
                                  namesOf<kCameraAxesNames>};
inline constexpr Field heading =
    Field{"heading", ValueForm::turn,
          "Degrees clockwise from north. With a place for the position, as pitch and roll; those "
          "that are absent are 0."}
        .typed("--heading");
inline constexpr Field pitch = Field{"pitch", ValueForm::elevation, "Degrees above the horizon."}.typed("--pitch");
inline constexpr Field roll = Field{"roll", ValueForm::turn, "Degrees, right side down."}.typed("--roll");

inline constexpr NameRow<std::array<std::size_t, 3>> kEulerOrders[] = {
    {"XYZ", {0, 1, 2}}, {"XZY", {0, 2, 1}}, {"YXZ", {1, 0, 2}}, {"YZX", {1, 2, 0}},
    {"ZXY", {2, 0, 1}}, {"ZYX", {2, 1, 0}}, {"XYX", {0, 1, 0}}, {"XZX", {0, 2, 0}},
    {"YXY", {1, 0, 1}}, {"YZY", {1, 2, 1}}, {"ZXZ", {2, 0, 2}}, {"ZYZ", {2, 1, 2}},
};
inline constexpr Field eulerOrder{"order", ValueForm::word,
                                  "The axes in the order of the turns, each about the axis as the turns before it left "
                                  "it.",
                                  namesOf<kEulerOrders>};
inline constexpr Field eulerDegrees{"degrees", ValueForm::turns, "An angle for each turn, in their order."};
inline constexpr ObjectForm turns{.help = "Turns about the camera's own axes, from where those lie along the world's.",
                                  .fields = list<eulerOrder, eulerDegrees>,
                                  .required = list<eulerOrder, eulerDegrees>};
inline constexpr Field euler{"euler", ValueForm::object, turns.help, nullptr, &turns};

inline constexpr Way poseWays[] = {
    {.keys = list<target>, .with = list<position>, .may = list<up>},
    {.keys = list<direction>, .with = list<position>, .may = list<up>},
    {.keys = list<rotation>, .with = list<position>, .may = list<cameraAxes>},
    {.keys = list<euler>, .with = list<position>, .may = list<cameraAxes>},
    {.keys = list<worldFromCamera>, .may = list<cameraAxes>},
    {.keys = list<cameraFromWorld>, .may = list<cameraAxes>},
    {.keys = list<heading, pitch, roll>, .with = list<position>, .anyKey = true},
};

// The projection.

inline constexpr Field type{"type", ValueForm::word, "Which fields say what the camera sees.", projectionTypeNames};
inline constexpr Field fovY =
    Field{"fovY", ValueForm::angle, "Degrees from the lower edge of the picture to the upper."}.typed("--fov-y");
inline constexpr Field fovX =
    Field{"fovX", ValueForm::angle, "Degrees from the left edge of the picture to the right."}.typed("--fov-x");
inline constexpr Field fovDiagonal =
    Field{"fovDiagonal", ValueForm::angle, "Degrees from corner to corner of the picture."}.typed("--fov-diagonal");
inline constexpr Field nearWidth{"nearWidth", ValueForm::positive, "Width of the window on the near plane."};
inline constexpr Field nearHeight{"nearHeight", ValueForm::positive, "Height of the window on the near plane."};
inline constexpr std::string_view kSensorUnit =
    " without a unit: focalLength, sensorWidth and sensorHeight are in the same one";
inline constexpr Field focalLength =
    Field{"focalLength", ValueForm::positive, "In the unit of the sensor, such as millimetres."}
        .hinting(kSensorUnit)
        .typed("--focal-length");
inline constexpr Field sensorWidth = Field{"sensorWidth", ValueForm::positive, "In the unit of focalLength."}
                                         .typed("--sensor-width")
                                         .hinting(kSensorUnit);
inline constexpr Field sensorHeight = Field{"sensorHeight", ValueForm::positive, "In the unit of focalLength."}
                                          .typed("--sensor-height")
                                          .hinting(kSensorUnit);
inline constexpr Field aspect =
    Field{"aspect", ValueForm::ratio, "Width over height. Default: the viewport's."}.typed("--aspect");
inline constexpr Field left =
    Field{"left", ValueForm::number, "Edge of the window: frustum on the near plane, orthographic in view space."}
        .typed("--left");
inline constexpr Field right = Field{"right", ValueForm::number, "Edge of the window, above left."}.typed("--right");
inline constexpr Field bottom = Field{"bottom", ValueForm::number, "Edge of the window."}.typed("--bottom");
inline constexpr Field top = Field{"top", ValueForm::number, "Edge of the window, above bottom."}.typed("--top");
inline constexpr Field orthoWidth =
    Field{"width", ValueForm::positive, "Width of the window around the viewing axis."}.typed("--ortho-width");
inline constexpr Field orthoHeight =
    Field{"height", ValueForm::positive, "Height of the window around the viewing axis."}.typed("--ortho-height");
inline constexpr Field fx =
    Field{"fx", ValueForm::positive, "Focal length in pixels of the viewport, across."}.typed("--fx");
inline constexpr Field fy =
    Field{"fy", ValueForm::positive, "Focal length in pixels of the viewport, down."}.typed("--fy");
inline constexpr Field cx =
    Field{"cx", ValueForm::number, "Screen x of the viewing axis, as the viewport counts pixels."}.typed("--cx");
inline constexpr Field cy =
    Field{"cy", ValueForm::number, "Screen y of the viewing axis, as the viewport counts pixels."}.typed("--cy");
inline constexpr Field skew{"skew", ValueForm::zero, "Skew of the pixels; other than 0 is not modelled."};
inline constexpr Field scrz{"scrz", ValueForm::positive, "Distance of the screen: screen x = cx + ax scrz X/Z."};
inline constexpr Field ax{"ax", ValueForm::positive, "Shape of a pixel, across."};
inline constexpr Field ay{"ay", ValueForm::positive, "Shape of a pixel, down."};
inline constexpr Field zMin{"zMin", ValueForm::number, "Depth at far."};
inline constexpr Field zMax{"zMax", ValueForm::number, "Depth at near."};
inline constexpr Field zNear = Field{"near", ValueForm::positive, "Distance of the near plane."}.typed("--near");
inline constexpr Field zFar =
    Field{"far", ValueForm::positive, "Distance of the far plane. Default: infinite."}.typed("--far").hinting(
        "; without it, or where a file has null (--set projection.far=null), it is infinite");
inline constexpr Field orthoNear =
    Field{"near", ValueForm::number, "Distance of the near plane, which may lie behind the eye."}.typed("--near");
inline constexpr Field orthoFar = Field{"far", ValueForm::number, "Distance of the far plane."}.typed("--far");
inline constexpr Field shift =
    Field{"shift", ValueForm::pair,
          "Moves the picture right by the first times half its width, and up by the second times "
          "half its height."}
        .typed("--shift");

inline constexpr Way perspectiveWays[] = {
    {.keys = list<fovY>, .may = list<aspect>},
    {.keys = list<fovX>, .may = list<aspect>},
    {.keys = list<fovDiagonal>, .may = list<aspect>},
    {.keys = list<nearWidth, nearHeight>},
    {.keys = list<focalLength>, .with = list<sensorWidth>, .may = list<aspect>},
    {.keys = list<focalLength>, .with = list<sensorHeight>, .may = list<aspect>},
    {.keys = list<focalLength>, .with = list<sensorWidth, sensorHeight>},
};
inline constexpr VagueName kVagueAngles[] = {
    {"fov",
     "does not say which angle it is: fovY is from the lower edge of the picture to the upper (OpenGL, "
     "Direct3D, three.js, Unity), fovX from the left to the right (Unreal)"}};
inline constexpr ObjectForm perspective{
    .help = "An opening, and aspect: width over height.",
    .fields = list<type, fovY, fovX, fovDiagonal, nearWidth, nearHeight, focalLength, sensorWidth, sensorHeight, aspect,
                   zNear, zFar, shift>,
    .required = list<zNear>,
    .ways = perspectiveWays,
    .aim = "opening",
    .vague = kVagueAngles};
inline constexpr ObjectForm frustum{.help = "The edges of the window on the near plane.",
                                    .fields = list<type, left, right, bottom, top, zNear, zFar, shift>,
                                    .required = list<left, right, bottom, top, zNear>};
inline constexpr ObjectForm intrinsics{
    .help = "Focal lengths in pixels of the viewport, and the screen position of the viewing axis.",
    .fields = list<type, fx, fy, cx, cy, skew, zNear, zFar, shift>,
    .required = list<fx, fy, cx, cy, zNear>};
inline constexpr Way orthographicWays[] = {
    {.keys = list<left, right, bottom, top>},
    {.keys = list<orthoWidth, orthoHeight>},
    {.keys = list<orthoWidth>, .may = list<aspect>},
    {.keys = list<orthoHeight>, .may = list<aspect>},
};
inline constexpr ObjectForm orthographic{
    .help =
        "The edges of the window, its width and height, or one of these and its aspect. near may be negative; far has "
        "an end.",
    .fields = list<type, left, right, bottom, top, orthoWidth, orthoHeight, aspect, orthoNear, orthoFar, shift>,
    .required = list<orthoNear, orthoFar>,
    .ways = orthographicWays,
    .aim = "window"};
inline constexpr ObjectForm ps2{
    .help = "screen x = cx + ax scrz X/Z and y = cy + ay scrz Y/Z; the depth is zMax at near and zMin at far.",
    .fields = list<type, scrz, ax, ay, cx, cy, zMin, zMax, zNear, zFar, shift>,
    .required = list<scrz, ax, ay, cx, cy, zMin, zMax, zNear>};

// The viewport.

inline constexpr Field cropX{"x", ValueForm::number, "Of the tile's corner in the picture, with y."};
inline constexpr Field cropY{"y", ValueForm::number, "Of the tile's corner in the picture."};
inline constexpr Field cropWidth{"width", ValueForm::positive, "Of the tile, in pixels."};
inline constexpr Field cropHeight{"height", ValueForm::positive, "Of the tile, in pixels."};
inline constexpr ObjectForm tile{
    .help = "A tile of the picture, counted from its corner. The camera is then the tile's.",
    .fields = list<cropX, cropY, cropWidth, cropHeight>,
    .required = list<cropX, cropY, cropWidth, cropHeight>};

inline constexpr Field pixelWidth{"width", ValueForm::positive, "Of the picture, in pixels."};
inline constexpr Field pixelHeight{"height", ValueForm::positive, "Of the picture, in pixels."};
inline constexpr Field x{"x", ValueForm::number, "Screen position of the picture's corner, with y. Default: 0."};
inline constexpr Field y{"y", ValueForm::number, "Screen position of the picture's corner, with x. Default: 0."};
inline constexpr Field depthRange{"depthRange", ValueForm::range,
                                  "Window depth at near and at far, exchanged by reverseZ. Default: 0 1."};
inline constexpr Field origin{"origin", ValueForm::word, "The corner pixels count from. Default: top-left.",
                              namesOf<kOriginNames>};
inline constexpr Field pixelCenter{"pixelCenter", ValueForm::number,
                                   "Where in a pixel its centre is. Default: 0.5; opencv 0."};
inline constexpr Field crop{"crop", ValueForm::object, tile.help, nullptr, &tile};
inline constexpr ObjectForm picture{
    .help =
        "Screen positions are pixels from the viewport's x, y; the centre of pixel (i, j) is (i + pixelCenter, j + "
        "pixelCenter).",
    .fields = list<pixelWidth, pixelHeight, x, y, depthRange, origin, pixelCenter, crop>,
    .required = list<pixelWidth, pixelHeight>};

// The convention.

inline constexpr Field preset{"preset", ValueForm::word, "Of which the axes are that are not named.", presetNames};
inline constexpr Field handedness{"world", ValueForm::word, "Handedness of the world's numbers.", namesOf<kWorldNames>};
inline constexpr Field view{"view", ValueForm::word, "Where x, y, z of view space point: right, up, back.",
                            namesOf<kViewNames>};
inline constexpr Field ndcZ{"ndcZ", ValueForm::word, "The range of NDC z.", namesOf<kNdcZNames>};
inline constexpr Field reverseZ{"reverseZ", ValueForm::flag, "Near and far are exchanged in it."};
inline constexpr Field ndcY{"ndcY", ValueForm::word, "The way NDC y points in the picture.", namesOf<kNdcYNames>};
inline constexpr Field vectors{"vectors", ValueForm::word, "Column vectors (M v) or row vectors (v M).",
                               namesOf<kVectorsNames>};
inline constexpr Field storage{"storage", ValueForm::word, "The order of a matrix's numbers in memory.",
                               namesOf<kStorageNames>};
inline constexpr ObjectForm axes{
    .help = "Axes one by one, from those of the preset (default: opengl, of a ps2 projection ps2).",
    .fields = list<preset, handedness, view, ndcZ, reverseZ, ndcY, vectors, storage>};

// The file.

inline constexpr Field convention{"convention", ValueForm::object,
                                  "How the file's numbers are meant: a preset's name, or its axes one by one.",
                                  presetNames, &axes};
inline constexpr Field projection{"projection", ValueForm::object, "What the camera sees."};
inline constexpr Field viewport{"viewport", ValueForm::object, picture.help, nullptr, &picture};
inline constexpr ObjectForm camera{
    .help = "A pose, a projection, a viewport and the convention their numbers are in.",
    .fields = list<convention, position, target, direction, up, rotation, euler, worldFromCamera, cameraFromWorld,
                   cameraAxes, heading, pitch, roll, world, projection, viewport, name, schema>,
    .ways = poseWays};

}  // namespace viewproj::cmd::field
