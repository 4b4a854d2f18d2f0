// The formats of a stream of records.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace viewproj::cmd {

/// f64, f32: little-endian doubles or floats, as many in each record. npy: the same after a header of NumPy.
enum class Form { json, csv, text, f64, f32, npy };
inline bool isBinary(Form form) { return form >= Form::f64; }
/// Text and f64 have the results' numbers alone.

/// lines: one JSON value per line. array: one JSON array. table: the columns of CSV, aligned for people.
enum class OutputForm { lines, array, csv, text, f64, table };

/// The name of a format, and its files' extensions or names separated by blanks: ".json .geojson"; "/" is a folder.
template <class T>
struct FormRow {
  std::string_view name;
  T form;
  std::string_view endings = {};
  std::string_view help = {};
};

std::span<const FormRow<Form>> inputForms();
std::span<const FormRow<OutputForm>> outputForms();

/// ".csv" for "points.csv"; empty for a name without an extension.
std::string_view endingOf(std::string_view fileName);

/// Whether an extension is one of these, separated by blanks.
bool isEnding(std::string_view ending, std::string_view endings);

inline bool hasNumbersOnly(OutputForm form) { return form == OutputForm::text || form == OutputForm::f64; }
inline bool hasColumns(OutputForm form) { return form == OutputForm::csv || form == OutputForm::table; }

/// Of binary forms f64.
OutputForm sameForm(Form form);

/// Lines of text that begin with this, after blanks, are comments.
inline constexpr char kTextComment = '#';
inline bool isTextComment(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line[first] == kTextComment;
}

/// The text from the first line that is neither blank nor a comment.
std::string_view afterComments(std::string_view text);

/// The format by the file's extension, or nothing.
std::optional<Form> formOfName(std::string_view fileName);

/// The format by the first bytes, after comments. `{` or `[` begins JSON. A first line with a comma or a semicolon, or
/// with a tab and a word that is not a number, is CSV. Any other line with a number is text, and a line of words only
/// is a CSV header. An .npy file tells itself. Nothing if the bytes are not text; f64 and f32 are never guessed.
std::optional<Form> formOfBytes(std::string_view start);

}  // namespace viewproj::cmd
