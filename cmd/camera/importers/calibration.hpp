// Shared by the importers of calibrations: matrices of known shape, and a pinhole camera as our document.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "camera/importers/importer.hpp"

namespace viewproj::cmd {

using Names = std::initializer_list<std::string_view>;
using Size = std::array<double, 2>;  ///< width, height

/// Whether the object has one of these members with this many numbers, in a form that Node::numbers accepts.
bool holds(const Json& object, Names members, std::size_t count);

/// Files of one camera, or of an object with cameras as members, by name.
bool holdsCameras(const Json& root, bool (*isCamera)(const Json&));
Import openCameras(const Node& root, bool (*isCamera)(const Json&), Json (*document)(const Node&));

/// The member with one of these names. Throws if there are two with different values.
std::optional<Node> oneOf(const Node& object, Names names);

/// A matrix by rows. Throws if its shape differs; a single row or column may hold any shape.
std::vector<double> matrixOf(const Node& node, std::size_t rows, std::size_t columns);

/// The picture's size. Throws if only one of the two is there.
std::optional<Size> sizeOf(const Node& object, Names width, Names height);

/// Our document of a camera at the origin, in the convention opencv and with the pixels of the file's pictures.
/// intrinsics: fx, fy, cx, cy.
Json pinholeCamera(std::span<const double> intrinsics, const std::optional<Size>& size);

/// fx, fy, cx, cy of K. Throws if K has a skew.
std::array<double, 4> intrinsicsOf(const Node& k, std::span<const double> byRows);

/// Replaces the pose of a camera at the origin.
void setPose(Json& camera, std::string_view field, Json pose);

/// Adds the camera's distortion, if it has one.
void setDistortion(Json& camera, const std::optional<Node>& coefficients, const std::optional<Node>& model);

/// The camera of a 3x4 P = K [R | t] (12 numbers by rows). Throws for another matrix, and for a skew.
Json cameraOfMatrix(const Node& node, std::span<const double> p, const std::optional<Size>& size);

}  // namespace viewproj::cmd
