// What makes a document a camera document: members that are known, values of their kinds, one choice of each group.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/document.hpp"
#include "camera/fields.hpp"
#include "viewproj/camera.hpp"

namespace viewproj::cmd {

/// Gives every member its own name, and a convention by name its object. Throws where a member stands under two names.
void normalize(Document& document);

/// Throws InputError at the first member that is not known, value that is not of its kind, or field that contradicts
/// another. The document is normalized.
void check(const Document& document);

/// Throws at a member of the object that is not among the names.
void allowMembers(const Node& object, const std::vector<std::string_view>& names);

/// Throws where the last row of the value's matrix is not 0 0 0 1.
void requireAffine(const Mat4& matrix, const Node& value);

/// "; did you mean 'projection.fovY'?" of a path that is no field's; else what suggestion() tells of name among names.
std::string meantField(std::string_view path, std::string_view name, const std::vector<std::string_view>& names);

/// Throws where the value is not of the kind. words: of a word.
void checkValue(const Node& value, const Field& field);

/// Of checked values.
Angle angleOf(const Node& value);
/// Rounded once.
double degreesOf(const Node& value);
Aspect ratioOf(const Node& value);

/// "fovY" of projection.fovY, "position" of position, "convention.view" of convention.view.
std::string_view shortName(const Field& field);

/// The two of some fields that contradict each other, or nulls.
std::pair<const Field*, const Field*> contradiction(const std::vector<const Field*>& fields);
std::string contradictionMessage(std::string_view first, std::string_view second, Group group);

/// What a field's object, or the field, is called at the top: its name and its other names.
std::vector<std::string_view> namesOf(const Field& field);

/// The members of an object, "" for the document, in the order of the table.
std::vector<std::string_view> namesUnder(std::string_view path);

/// The rows whose fields the document has, in their order.
std::vector<const Field*> presentFields(const Document& document);
/// The value at a row's path, or null.
const Json* valueAt(const Json& root, std::string_view path);

}  // namespace viewproj::cmd
