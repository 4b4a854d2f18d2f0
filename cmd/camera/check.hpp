// Checks of a camera document: known members, values of the right kind, one choice of each group.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/document.hpp"
#include "camera/fields.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// Renames aliases to the fields' names, and turns a convention's name into an object. Throws if both names are there.
void normalize(Document& document);

/// Throws InputError at the first member that is not known, value of the wrong kind, or field that contradicts another.
/// The document must be normalized.
void check(const Document& document);

/// Throws if the object has a member that is not among the names.
void allowMembers(const Node& object, const std::vector<std::string_view>& names);

/// Throws if the last row of the value's matrix is not 0 0 0 1.
void requireAffine(const Mat4& matrix, const Node& value);

/// "; did you mean 'projection.fovY'?" if a field's path ends like this one; else suggestion() for name among names.
std::string suggestField(std::string_view path, std::string_view name, const std::vector<std::string_view>& names);

/// Throws if the value is not of the field's kind.
void checkValue(const Node& value, const Field& field);

/// These need a checked value.
Angle angleOf(const Node& value);
/// The angle in degrees, rounded once.
double degreesOf(const Node& value);
Aspect ratioOf(const Node& value);

/// "fovY" for projection.fovY, "position" for position, "convention.view" for convention.view.
std::string_view shortName(const Field& field);

/// The first two fields that contradict each other, or nulls.
std::pair<const Field*, const Field*> contradiction(const std::vector<const Field*>& fields);
std::string contradictionMessage(std::string_view first, std::string_view second, Group group);

/// The member at the top of the document that holds a field, and its aliases.
std::vector<std::string_view> namesOf(const Field& field);

/// The members of an object in the order of the table. "" is the document.
std::vector<std::string_view> namesUnder(std::string_view path);

/// The fields that the document has, in the order of the table.
std::vector<const Field*> presentFields(const Document& document);
/// The value at a path, or null.
const Json* valueAt(const Json& root, std::string_view path);

}  // namespace viewproj::cmd
