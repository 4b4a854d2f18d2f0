// An option's value, read as it was typed, before any file is opened. A reader gets the option's name for its message,
// and throws UsageError.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/form.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// The text itself.
inline std::string readText(const std::string&, const std::string& text) { return text; }

/// A file's name, perhaps with #PICK after it; the system's names of standard input are "-" too.
std::string readFileName(const std::string& option, const std::string& text);

// Choices

/// Names that are known, and what they stand for.
template <class T>
using Names = std::vector<std::pair<std::string_view, T>>;

template <class T, std::size_t N>
Names<T> rowsOf(const std::pair<std::string_view, T> (&table)[N]) {
  return {std::begin(table), std::end(table)};
}
template <class T>
Names<T> namesOf(std::span<const FormRow<T>> rows) {
  Names<T> names;
  for (const FormRow<T>& row : rows) names.emplace_back(row.name, row.form);
  return names;
}
template <class T>
std::vector<std::string_view> known(const Names<T>& names) {
  std::vector<std::string_view> result;
  for (const auto& [name, value] : names) result.push_back(name);
  return result;
}

/// Throws UsageError with the nearest of the known names.
[[noreturn]] void failUnknown(const std::string& option, std::string_view name,
                              std::span<const std::string_view> known);

template <class T>
T choose(const std::string& option, std::string_view name, const Names<T>& names) {
  for (const auto& [row, value] : names)
    if (row == name) return value;
  failUnknown(option, name, known(names));
}

/// "a,b,c" to its parts. Throws UsageError for one that is named twice.
std::vector<std::string> splitNames(const std::string& option, const std::string& text);

/// What "a,b,c" names, or all where "all" is among them.
template <class T>
struct Several {
  bool all = false;
  std::vector<T> named;
};
template <class T>
Several<T> chooseSeveral(const std::string& option, const std::string& text, const Names<T>& names) {
  Several<T> several;
  for (const std::string& name : splitNames(option, text)) {
    if (name == "all") return {.all = true, .named = {}};
    several.named.push_back(choose(option, name, names));
  }
  return several;
}

/// "HELP: a, b, c (default: OTHERWISE)"; what help says after a semicolon comes last.
std::string withNames(std::string_view help, std::span<const std::string_view> names, std::string_view otherwise);

// Numbers

/// Reads a whole number from least to most.
std::function<std::size_t(const std::string&, const std::string&)> wholeNumber(std::size_t least, std::size_t most);

/// Reads a number for which isGood holds. expected: of a message about any other.
std::function<double(const std::string&, const std::string&)> numberThat(bool (*isGood)(double),
                                                                         const std::string& expected);

/// Width and height, "1920x1080".
struct Size {
  double width = 0, height = 0;
};
Size readSize(const std::string& option, const std::string& text);

/// "1,2,3", from fewest to most numbers. form: what was expected, "X,Y or X,Y,DEPTH".
std::vector<double> readNumbers(const std::string& option, const std::string& text, std::size_t fewest,
                                std::size_t most, const std::string& form);

/// One number or more.
inline auto numberList(const char* form) {
  return [form](const std::string& option, const std::string& text) {
    return readNumbers(option, text, 1, SIZE_MAX, form);
  };
}

/// X,Y.
Vec2 readPixelPosition(const std::string& option, const std::string& text);

/// X,Y[,DEPTH].
std::vector<double> readPixelNumbers(const std::string& option, const std::string& text);

}  // namespace viewproj::cmd
