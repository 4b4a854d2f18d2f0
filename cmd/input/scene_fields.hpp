// The fields of a scene file.
#pragma once

#include "input/camera_fields.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd::field {

inline constexpr Field point{"point", ValueForm::position, "A point of the plane: x, y, z or a place.", nullptr,
                             &place};
inline constexpr Field normal{"normal", ValueForm::direction, "At right angles to the plane, of any length."};
inline constexpr ObjectForm planeForm{
    .help = "An endless plane.", .fields = list<point, normal>, .required = list<point, normal>};

inline constexpr Field center{"center", ValueForm::position, "x, y, z or a place.", nullptr, &place};
inline constexpr Field radius{"radius", ValueForm::natural, "In the world's unit."};
inline constexpr ObjectForm sphereForm{
    .help = "A sphere.", .fields = list<center, radius>, .required = list<center, radius>};

inline constexpr Field min{"min", ValueForm::position, "The corner of the smallest x, y, z.", nullptr, &place};
inline constexpr Field max{"max", ValueForm::position, "The corner of the largest x, y, z.", nullptr, &place};
inline constexpr ObjectForm boxForm{
    .help = "Its edges lie along the world's axes.", .fields = list<min, max>, .required = list<min, max>};

inline constexpr NameRow<Ellipsoid> kEllipsoids[] = {{"WGS84", kWgs84}};

inline constexpr Field id{"id", ValueForm::label,
                          "By which hits name it. Default: its name, or its place in the list, from 0."};
inline constexpr Field plane{"plane", ValueForm::object, planeForm.help, nullptr, &planeForm};
inline constexpr Field sphere{"sphere", ValueForm::object, sphereForm.help, nullptr, &sphereForm};
inline constexpr Field box{"box", ValueForm::object, boxForm.help, nullptr, &boxForm};
inline constexpr Field triangle{"triangle", ValueForm::points, "Corners a, b, c; the normal is (b - a) x (c - a).",
                                nullptr, &place};
inline constexpr Field ellipsoid{"ellipsoid", ValueForm::word,
                                 "The Earth, in Earth-centred metres; with height the surface of that constant height.",
                                 namesOf<kEllipsoids>};

inline constexpr Way shapeWays[] = {{.keys = list<plane>},
                                    {.keys = list<sphere>},
                                    {.keys = list<box>},
                                    {.keys = list<triangle>},
                                    {.keys = list<ellipsoid>, .may = list<height>}};
inline constexpr VagueName kOtherBoxes[] = {{"aabb", "is called box here: {\"min\": [x, y, z], \"max\": [x, y, z]}"},
                                            {"bbox", "is called box here: {\"min\": [x, y, z], \"max\": [x, y, z]}"}};
inline constexpr ObjectForm sceneObject{.help = "One shape.",
                                        .fields = list<id, name, plane, sphere, box, triangle, ellipsoid, height>,
                                        .ways = shapeWays,
                                        .aim = "shape",
                                        .vague = kOtherBoxes};

inline constexpr Field objects{"objects", ValueForm::objects, "What rays may hit.", nullptr, &sceneObject};
inline constexpr ObjectForm scene{
    .help = "What rays are shot at. All numbers are in the world's frame and unit, that of the camera.",
    .fields = list<schema, name, objects>,
    .required = list<objects>};

}  // namespace viewproj::cmd::field
