// An option's value, read as it was typed: before any file is opened, what is none has ended with a message.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/error.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// The text itself.
std::string readText(const std::string& option, const std::string& text);

/// A file's name, perhaps with #PICK after it; the system's names of standard input are "-" too.
std::string readFileName(const std::string& option, const std::string& text);

// Choices

/// Names that are known, and what they stand for.
template <class T>
using Names = std::vector<std::pair<std::string_view, T>>;

/// A table of such rows.
template <class T, std::size_t N>
Names<T> rowsOf(const std::pair<std::string_view, T> (&table)[N]) {
  return {std::begin(table), std::end(table)};
}

/// Names that stand for themselves.
Names<std::string> namesAlone(std::span<const std::string_view> names);

/// Throws UsageError for a name that is not known, with the nearest that is.
[[noreturn]] void failUnknown(const std::string& option, std::string_view name,
                              std::span<const std::string_view> known);

template <class T>
std::vector<std::string_view> known(const Names<T>& names) {
  std::vector<std::string_view> result;
  for (const auto& [name, value] : names) result.push_back(name);
  return result;
}

template <class T>
T choose(const std::string& option, std::string_view name, const Names<T>& names) {
  for (const auto& [row, value] : names)
    if (row == name) return value;
  failUnknown(option, name, known(names));
}

/// "HELP: a, b, c (default: OTHERWISE)"; what help says after a semicolon comes last.
std::string withNames(std::string_view help, std::span<const std::string_view> names, std::string_view otherwise);

/// "a,b,c" to its parts. Throws UsageError for one that is named twice.
std::vector<std::string> splitNames(const std::string& option, const std::string& text);

/// What "a,b,c" names, or "all", which stands alone.
template <class T>
struct Several {
  bool all = false;
  std::vector<T> named;
};
inline constexpr std::string_view kAll = "all";
template <class T>
Several<T> chooseSeveral(const std::string& option, const std::string& text, const Names<T>& names) {
  if (text == kAll) return {.all = true, .named = {}};
  Several<T> several;
  std::vector<std::string_view> every = known(names);
  every.insert(every.begin(), kAll);
  for (const std::string& name : splitNames(option, text)) {
    if (name == kAll) throw UsageError(option + " all gives every result; leave the other names out");
    const auto row = std::find_if(names.begin(), names.end(), [&](const auto& each) { return each.first == name; });
    if (row == names.end()) failUnknown(option, name, every);
    several.named.push_back(row->second);
  }
  return several;
}

// Numbers

/// Reads a whole number from least to most.
std::function<std::size_t(const std::string&, const std::string&)> wholeNumber(std::size_t least, std::size_t most);

/// Reads a number for which isGood holds. expected: what is told of any other.
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

/// X,Y.
Vec2 readPixelPosition(const std::string& option, const std::string& text);

/// X,Y[,DEPTH].
std::vector<double> readPixelNumbers(const std::string& option, const std::string& text);

}  // namespace viewproj::cmd
