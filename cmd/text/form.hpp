// The forms a stream of records can have.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace viewproj::cmd {

/// f64: little-endian doubles, three a record.
enum class Form { json, csv, text, f64 };

/// lines is a sequence of JSON values, array one array of them; table has the columns of CSV, aligned for people.
enum class OutputForm { lines, array, csv, text, f64, table };

/// A form's name, and the endings of files' names that tell it, separated by blanks: ".json .geojson".
template <class T>
struct FormRow {
  std::string_view name;
  T form;
  std::string_view endings = {};
  std::string_view help = {};
};

std::span<const FormRow<Form>> inputForms();
std::span<const FormRow<OutputForm>> outputForms();

/// ".csv" of "points.csv"; empty where a name has none.
std::string_view endingOf(std::string_view fileName);

/// Whether an ending is one of these, separated by blanks.
bool isEnding(std::string_view ending, std::string_view endings);

inline bool hasColumns(OutputForm form) { return form == OutputForm::csv || form == OutputForm::table; }

OutputForm sameForm(Form form);

/// Lines of text that begin so, after blanks, are no records.
inline constexpr char kTextComment = '#';
inline bool isTextComment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == kTextComment;
}

/// From the first line on that is neither blank nor a comment.
std::string_view afterComments(std::string_view text);

/// By the file's name, or nothing.
std::optional<Form> formOfName(std::string_view fileName);

/// By the first bytes, after comments: `{` or `[` begins JSON; a first line with a comma, a semicolon, or a tab beside
/// what is no number is CSV, any other with a number in it text, one of words alone a header. Nothing where they are no
/// text at all; f64 is never guessed.
std::optional<Form> formOfBytes(std::string_view start);

}  // namespace viewproj::cmd
