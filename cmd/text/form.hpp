// The forms a stream of records can have.
#pragma once

#include <optional>
#include <string_view>

namespace viewproj::cmd {

/// f64: little-endian doubles, three a record.
enum class Form { json, csv, text, f64 };

/// lines is a sequence of JSON values, array one array of them; table has the columns of CSV, aligned for people.
enum class OutputForm { lines, array, csv, text, f64, table };

inline bool hasColumns(OutputForm form) { return form == OutputForm::csv || form == OutputForm::table; }

OutputForm sameForm(Form form);

/// By the file's name, or nothing.
std::optional<Form> formOfName(std::string_view fileName);

/// By the first bytes: `{` or `[` begins JSON; a first line with a comma is CSV, any other with a number in it text,
/// one of words alone a header. goesOn: a bad record may come first, so such words are one, unless `;` parts them.
/// Nothing where they are no text at all; f64 is never guessed.
std::optional<Form> formOfBytes(std::string_view start, bool goesOn);

}  // namespace viewproj::cmd
