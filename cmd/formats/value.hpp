// Values of a file by their paths, the grammar of --parts:
//
//   value = sum { "||" sum }            the first that is there
//   sum   = term { "+" term }           numbers one after the other
//   term  = path { "|" path } [ "?" ]   the first that is there; ? may be absent
//   path  = member { "." member } { "^T" | "/" number | "[" index or slice { "," … } "]" }, or a number
//
// A member is a name or an index; a name may have dots. "*" is one member, or a part of a name: the star.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// The numbers of a value: a number, a text that is only numbers, arrays, a matrix {"rows", "cols", "data"}, or an
/// object whose names are known to have an order, such as {"x", "y", "z"}. Nothing if it holds anything else.
std::optional<std::vector<double>> numbersIn(const Json& value);
/// Its dimensions without those of 1; {1} for one number. The value holds numbers.
std::vector<std::size_t> shapeOf(const Json& value);

struct Operation {
  enum Kind { transpose, divide, choose } kind;
  double divisor = 1;
  std::vector<std::pair<std::size_t, std::size_t>> ranges{};  ///< first, end; kToEnd
};
inline constexpr std::size_t kToEnd = static_cast<std::size_t>(-1);

struct Path {
  std::string text;  ///< without its operations
  std::vector<Operation> operations{};
  std::optional<double> number{};  ///< if the text is one
};
struct Term {
  std::vector<Path> paths;
  bool isOptional = false;
};
using Sum = std::vector<Term>;
using Value = std::vector<Sum>;

/// name=value; a name that ends in ? may be absent.
struct Part {
  std::string name;
  bool isOptional = false;
  Value value;
};

/// Reads "name=value, name=value". Throws UsageError beginning with label.
std::vector<Part> parseParts(std::string_view line, const std::string& label);
/// Every path stands below a container, except those that begin with "/".
void placeUnder(std::vector<Part>& parts, std::string_view container);

/// The value at a path without a star. Null values count as absent.
std::optional<Node> valueAt(const Node& root, std::string_view path);
/// The path with the star replaced.
std::string withStar(std::string_view path, std::string_view star);
bool hasStar(const Part& part);
/// Calls visit with each text that the star of a path stands for, until it returns false.
void eachStar(const Node& root, std::string_view path, const std::function<bool(std::string_view star)>& visit);
/// The texts that the star stands for, in the file's order (members of objects by name, numbers by their size).
std::vector<std::string> starsOf(const Node& root, std::string_view path);
/// Of the first paths of the value that have one.
std::vector<std::string> starsOf(const Node& root, const Value& value);

/// Whether one of its paths has one.
bool hasStars(const Node& root, const Value& value);

/// What a part holds for one star.
struct Found {
  std::vector<double> numbers{};
  std::string text{};                                   ///< of a part that is a text
  std::vector<std::pair<std::string, double>> named{};  ///< of a path with "#": by the name of a coefficient
  std::vector<Node> nodes{};                            ///< what was read
};

/// The part's value; nothing if it is not in the file. Throws InputError naming part and path if some of it is missing
/// or is no numbers. isText: the part is a text.
std::optional<Found> find(const Node& root, const Part& part, std::string_view star, bool isText);
/// "K: cameras.cam1.K" for messages.
std::string placeOf(const Part& part, std::string_view star);

/// Marks what was read.
void mark(const Found& found);

}  // namespace viewproj::cmd
