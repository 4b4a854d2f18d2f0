// Values of a file by their paths, the grammar of --parts:
//
//   value = sum { "||" sum }            the first that is there
//   sum   = term { "+" term }           numbers one after the other
//   term  = path { "|" path } [ "?" ]   the first that is there; ? may be absent
//   path  = member { "." member } { "^T" | "/" number | "[" index or slice { "," … } "]" }, or a number
//
// A member is a name or an index; a name may have dots. "*" is one member, or a part of a name: the star, which passes
// over blocks without a name, #1, beside others. In rows of
// formats "%" is a star of digits, "name~" the first name that begins so, and a last member "#" the coefficients of a
// lens by their names. Empty lists are absent, and so are texts that a star alone stands for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// The text of an element of XML that has attributes too; other values as they are.
const Json& contentOf(const Json& value);
/// The numbers of a value: a number, a text that is only numbers, arrays, or an object whose names are known to have an
/// order, such as {"x", "y", "z"}. Nothing if it holds anything else.
std::optional<std::vector<double>> numbersIn(const Json& value);
/// Its dimensions without those of 1; {1} for one number. The value holds numbers.
std::vector<std::size_t> shapeOf(const Json& value);
/// A matrix of numbers by rows, by columns.
std::vector<double> transposed(const std::vector<double>& byRows, std::size_t columns);

/// What is done to the numbers of a value: ^T, /number or [indices].
using Operation = std::function<std::vector<double>(const Node& value, const std::vector<double>& numbers)>;

struct Path {
  std::string text;  ///< without its operations
  std::vector<Operation> operations{};
  std::optional<double> number{};  ///< if the text is one
  bool isOfCoefficients = false;   ///< text is the object whose members they are
  bool isNumbered = false;         ///< the star is digits
};
struct Term {
  std::vector<Path> paths;
  bool isOptional = false;
};
using Sum = std::vector<Term>;

/// name=value; a name that ends in ? may be absent.
struct Part {
  std::string name;
  bool isOptional = false;
  std::vector<Sum> value{};

  /// Those of its paths that have a star.
  std::vector<const Path*> starredPaths() const;
};

/// Reads "name=value, name=value". Every path stands below the container, except those that begin with "/"; "." is the
/// container. Throws UsageError beginning with label.
std::vector<Part> parseParts(std::string_view line, const std::string& label, std::string_view container = "");

/// The value at a path without a star. Null values count as absent.
std::optional<Node> valueAt(const Node& root, std::string_view path);
/// The paths of values that are numbers, a star for each row of a list of objects.
std::vector<std::string> pathsOfNumbers(const Json& root);
/// The path with the star replaced.
std::string withStar(std::string_view path, std::string_view star);
/// Calls visit with each text that the star of a path stands for, until it returns false. Whether there is any.
bool eachStar(const Node& root, std::string_view path, const std::function<bool(std::string_view star)>& visit);
/// What the stars of paths stand for, in the file's order: members of objects by name, numbers by their size. Stops
/// where there are `most` of them.
std::vector<std::string> starsOf(const Node& root, const std::vector<const Path*>& paths, std::size_t most = SIZE_MAX);

/// What a part holds for one star.
struct Found {
  std::vector<double> numbers{};
  std::string text{};                                   ///< of a part that is a text
  std::vector<std::pair<std::string, double>> named{};  ///< coefficients by name
  std::vector<Node> nodes{};                            ///< what was read
  std::vector<std::size_t> ends{};                      ///< of each node's numbers
};

/// The part's value; nothing if it is not in the file. Throws InputError naming part and path if some of it is missing
/// or is no numbers. isText: the part is a text.
std::optional<Found> find(const Node& root, const Part& part, std::string_view star, bool isText);

}  // namespace viewproj::cmd
