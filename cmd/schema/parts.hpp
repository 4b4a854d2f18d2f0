// JSON Schema from the rows of fields.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "input/field.hpp"

namespace viewproj::cmd::schema {

using Json = nlohmann::ordered_json;

/// A schema's head: $schema, $id, title and description.
Json head(const std::string& name, const std::string& title, const std::string& description);

/// Any value of this type.
Json ofType(const char* type);

/// Where a part of that name stands.
Json reference(const std::string& name);

/// An object of this form; what is null counts as absent. own: schemas of fields that their rows do not tell.
Json objectOf(const ObjectForm& form, bool orNull, const Json& own = Json::object());

/// A value of this field, or null.
Json valueOf(const Field& field);

/// One of the words, or null.
Json wordOf(const std::vector<std::string_view>& words, bool orNull = true);

/// The object has this field, under any of its names, and of this schema; it is not null unless the schema says so.
Json has(const Field& field, const Json& value = {{"not", {{"type", "null"}}}});

/// An object that is a place, not x, y, z.
Json place();

/// What a filter prints: a record of this name, an array of some, a document.
Json recordsOf(const std::string& record);

Json allOf(std::initializer_list<Json> parts);
Json anyOf(std::initializer_list<Json> parts);

}  // namespace viewproj::cmd::schema
