// What the importers of calibrations share: matrices of known shape, and a pinhole camera as our document.
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

/// Whether the object has one of these members with so many numbers, in a form that Node::numbers takes.
bool holds(const Json& object, Names members, std::size_t count);

/// The member that is there. Throws where two of the names are, with different values.
std::optional<Node> oneOf(const Node& object, Names names);

/// A matrix by rows. Throws where the numbers are of another shape; all in a row or a column they are of any.
std::vector<double> matrixOf(const Node& node, std::size_t rows, std::size_t columns);

/// Throws for one of the two alone.
std::optional<Size> sizeOf(const Node& object, Names width, Names height);

/// Our document in the convention opencv, with pixels of the file's pictures. intrinsics: fx, fy, cx, cy. It has no
/// pose but the origin.
Json pinholeCamera(std::span<const double> intrinsics, const std::optional<Size>& size);

/// fx, fy, cx, cy of K. Throws for a skew.
std::array<double, 4> intrinsicsOf(const Node& k, std::span<const double> byRows);

/// The pose of a camera at the origin gives way to this one.
void setPose(Json& camera, std::string_view field, Json pose);

/// Gives the camera its distortion, if it has one.
void setDistortion(Json& camera, const std::optional<Node>& coefficients, const std::optional<Node>& model);

/// The camera of a 3x4 P = K [R | t] (12 numbers by rows). Throws for what is none, and for a skew.
Json cameraOfMatrix(const Node& node, std::span<const double> p, const std::optional<Size>& size);

}  // namespace viewproj::cmd
