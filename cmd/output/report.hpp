// A report is a value: what a command found out, as ordered JSON. Here it becomes text for programs and for people.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "viewproj/convention.hpp"

namespace viewproj::cmd {

using OrderedJson = nlohmann::ordered_json;

OrderedJson asJson(const Vec2& v);
OrderedJson asJson(const Vec3& v);
OrderedJson asJson(const Vec4& v);
/// Rows.
OrderedJson asJson(const Mat4& m);
/// Every axis.
OrderedJson asJson(const Convention& convention);

// digits: significant ones of every number; 0: the shortest text that reads back as the same double. What is not finite
// has no value: null, an empty cell of CSV, or for people "-", or "infinite".

/// On one line.
std::string compactJson(const OrderedJson& value, int digits = 0);

/// A value that fits is one line; a longer one has its members on lines of their own, indented by two blanks for each
/// level from `level` on. Without a line break at the end.
std::string jsonText(const OrderedJson& value, int digits = 0, std::size_t level = 0);

/// For people, of an object: numbers, words and vectors as aligned lines; rows of numbers as a matrix; a list of
/// objects as a table; an object as an indented section; "notes" as paragraphs.
std::string tableText(const OrderedJson& report, int digits);

/// A list of objects as rows, an object as one row. The columns are the paths of all values, as in "eye.0".
std::string csvText(const OrderedJson& rows, int digits = 0);

}  // namespace viewproj::cmd
