#include "formats/value.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// Objects of numbers whose names have an order.
constexpr std::string_view kOrders[] = {"x y z w",     "width height", "w h",      "fx fy cx cy",
                                        "qx qy qz qw", "tx ty tz",     "px py pz", "k1 k2 p1 p2 k3 k4 k5 k6",
                                        "k1 k2 k3 k4", "u v",          "cx cy",    "fx fy"};
constexpr std::string_view kCoefficients = "k1 k2 k3 k4 k5 k6 p1 p2 xi alpha beta omega rpmax";

std::optional<double> numberIn(const Json& value) {
  const auto numbers = value.is_structured() ? std::nullopt : numbersIn(value);
  return numbers && numbers->size() == 1 ? std::optional(numbers->front()) : std::nullopt;
}

/// Appends the members of an object, or the attributes of an element of XML, in the order of a row whose first names
/// they all are, in any letter case.
bool appendOrdered(const Json& object, std::vector<double>& numbers) {
  for (const std::string_view order : kOrders) {
    const std::vector<std::string_view> names = split(order, " ");
    if (object.size() < 2 || object.size() > names.size()) continue;
    std::vector<double> values;
    for (std::size_t i = 0; i < object.size(); ++i)
      for (const auto& [key, member] : object.items())
        if (sameButForCase(std::string_view(key).substr(key.starts_with('@') ? 1 : 0), names[i])) {
          if (const auto number = numberIn(member)) values.push_back(*number);
          break;
        }
    if (values.size() < object.size()) continue;
    numbers.insert(numbers.end(), values.begin(), values.end());
    return true;
  }
  return false;
}

/// 1920x1080 is two numbers.
bool appendText(std::string_view text, std::vector<double>& numbers) {
  if (const std::size_t by = text.find('x'); by != text.npos) {
    const auto width = parseNumber(trimmed(text.substr(0, by))), height = parseNumber(trimmed(text.substr(by + 1)));
    if (width && height) numbers.insert(numbers.end(), {*width, *height});
    return width && height;
  }
  const std::vector<std::string_view> parts = partsOf(text, " \t\r\n,;[]()");
  for (const std::string_view part : parts) {
    const auto number = parseNumber(part);
    if (!number) return false;
    numbers.push_back(*number);
  }
  return !parts.empty();
}

bool append(const Json& whole, std::vector<double>& numbers) {
  const Json& value = contentOf(whole);
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return true;
  }
  if (value.is_string()) return appendText(value.get_ref<const std::string&>(), numbers);
  if (value.is_array())
    return std::all_of(value.begin(), value.end(), [&](const Json& part) {
      return part.is_array() == value.front().is_array() && append(part, numbers);
    });
  return value.is_object() && appendOrdered(value, numbers);
}

Operation transposing() {
  return [](const Node& value, const std::vector<double>& numbers) {
    const std::vector<std::size_t> shape = shapeOf(value.json());
    const std::size_t count = numbers.size();
    const std::size_t columns = shape.size() == 2 ? shape[1] : count == 9 || count == 12 ? 3 : count == 16 ? 4 : 0;
    if (columns == 0 || count % columns != 0)
      value.fail("expected a matrix to transpose, got " + std::to_string(count) + " numbers");
    return transposed(numbers, columns);
  };
}

Operation dividing(double divisor) {
  return [divisor](const Node&, std::vector<double> numbers) {
    for (double& number : numbers) number /= divisor;
    return numbers;
  };
}

/// items: "0,1" or "0:4" or "5:".
Operation choosing(std::string_view items, const std::function<void(const std::string&)>& fail) {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;  // first, and the end
  for (const std::string_view item : split(items, ",")) {
    const std::size_t colon = item.find(':');
    const auto index = [&](std::string_view digits, std::size_t otherwise) {
      if (digits.empty() && colon != std::string_view::npos) return otherwise;
      const auto number = parseNumber(digits);
      if (!number || !(*number >= 0 && *number < 1e6) || *number != std::floor(*number))
        fail("expected numbers from 0 on, as in [0,1] or [0:4]");
      return static_cast<std::size_t>(*number);
    };
    const std::size_t first = index(item.substr(0, colon), 0);
    ranges.emplace_back(first, colon == std::string_view::npos ? first + 1 : index(item.substr(colon + 1), SIZE_MAX));
  }
  return [ranges](const Node& value, const std::vector<double>& numbers) {
    std::vector<double> chosen;
    for (const auto& [first, end] : ranges) {
      const std::size_t last = end == SIZE_MAX ? numbers.size() : end;
      if (first > last || last > numbers.size()) value.fail("has " + std::to_string(numbers.size()) + " numbers");
      chosen.insert(chosen.end(), numbers.begin() + static_cast<std::ptrdiff_t>(first),
                    numbers.begin() + static_cast<std::ptrdiff_t>(last));
    }
    return chosen;
  };
}

/// fail: throws.
Path parsePath(std::string_view text, std::string_view container, const std::function<void(const std::string&)>& fail) {
  Path path;
  const auto add = [&](Operation operation, std::size_t end) {
    path.operations.insert(path.operations.begin(), std::move(operation));
    text = text.substr(0, end);
  };
  while (true) {
    const std::size_t slash = text.rfind('/'), open = text.rfind('[');
    const auto divisor =
        slash != std::string_view::npos && slash > 0 ? parseNumber(text.substr(slash + 1)) : std::nullopt;
    if (divisor && *divisor == 0) fail(std::string(text) + ": divides by 0");
    const auto failHere = [&](const std::string& message) { fail(std::string(text) + ": " + message); };
    if (text.ends_with("^T"))
      add(transposing(), text.size() - 2);
    else if (divisor)
      add(dividing(*divisor), slash);
    else if (text.ends_with(']') && open != std::string_view::npos)
      add(choosing(text.substr(open + 1, text.size() - open - 2), failHere), open);
    else
      break;
  }
  path.number = parseNumber(text);
  if (text.empty()) fail("expected a path of the file");
  if (std::count(text.begin(), text.end(), '*') > 1) fail(std::string(text) + ": has two stars; one is allowed");
  if (text == "#" || text.ends_with(".#")) {
    path.isOfCoefficients = true;
    text.remove_suffix(std::min<std::size_t>(2, text.size()));
  }
  path.text = text.starts_with('/')              ? text.substr(1)
              : text == "." || text.empty()      ? container
              : path.number || container.empty() ? text
                                                 : joinedPath(container, text);
  path.isNumbered = path.text.find('%') != std::string::npos;
  if (path.isNumbered) path.text[path.text.find('%')] = '*';
  return path;
}

Sum parseSum(std::string_view text, std::string_view container, const std::function<void(const std::string&)>& fail) {
  Sum sum;
  for (std::string_view piece : split(text, "+")) {
    piece = trimmed(piece);
    Term& term = sum.emplace_back();
    term.isOptional = piece.ends_with('?');
    if (term.isOptional) piece.remove_suffix(1);
    for (const std::string_view path : split(piece, "|"))
      term.paths.push_back(parsePath(trimmed(path), container, fail));
  }
  return sum;
}

/// The member of an object or an item of an array; null counts as absent.
std::optional<Node> child(const Node& node, std::string_view name) {
  const Json& value = node.json();
  const Json* found = nullptr;
  if (value.is_object()) {
    const auto& members = value.get_ref<const Json::object_t&>();
    if (const auto member = value.find(name); member != value.end()) {
      found = &*member;
    } else if (name.ends_with('~')) {
      name.remove_suffix(1);
      const auto next = members.lower_bound(name);
      if (next != members.end() && next->first.starts_with(name)) found = &next->second;
    }
  } else if (value.is_array() && !name.empty() && name.size() < 9 && std::all_of(name.begin(), name.end(), isDigit)) {
    std::size_t index = 0;
    for (const char digit : name) index = 10 * index + static_cast<std::size_t>(digit - '0');
    if (index < value.size()) found = &value[index];
  }
  if (!found || found->is_null()) return std::nullopt;
  return Node(node.document(), *found, joinedPath(node.path(), name));
}

/// The beginnings of a path that may be one name, for names may have dots: the longest first.
template <class Visit>
bool anyFirstName(std::string_view path, const Visit& visit) {
  for (std::size_t end = path.size(); end != std::string_view::npos && end > 0; end = path.rfind('.', end - 1))
    if (visit(path.substr(0, end), end == path.size() ? "" : path.substr(end + 1))) return true;
  return false;
}

/// Whether a comes before b: runs of digits by their number, all else by its bytes.
bool isBefore(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (isDigit(a[i]) && isDigit(b[j])) {
      const auto run = [](std::string_view text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t first = at;
        while (at < text.size() && isDigit(text[at])) ++at;
        return text.substr(first, at - first);
      };
      const std::string_view x = run(a, i), y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

std::string textIn(const Node& node) {
  const Json& value = contentOf(node.json());
  if (value.is_structured()) node.fail("expected a text");
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? formatNumber(value.get<double>()) : value.dump();
}

/// Adds what is at a path. False if it is not in the file.
bool addPath(const Node& root, const Path& path, std::string_view star, bool isText, Found& found) {
  const std::string text = withStar(path.text, star);
  if (path.isOfCoefficients) {
    for (const std::string_view name : split(kCoefficients, " ")) {
      const auto node = valueAt(root, joinedPath(text, name));
      const auto number = node ? numberIn(node->json()) : std::nullopt;
      if (!number) continue;
      found.named.emplace_back(name, *number);
      found.nodes.push_back(*node);
    }
    return !found.named.empty();
  }
  auto node = valueAt(root, text);
  if (node && path.number && !numbersIn(node->json())) node.reset();  // an item of a list is no number
  if (!node && !path.number) return false;
  if (node && isText && path.operations.empty()) {
    found.text = textIn(*node);
  } else {
    auto numbers = node ? numbersIn(node->json()) : std::vector{*path.number};
    if (!numbers) node->fail("expected numbers");
    if (numbers->empty()) return false;
    for (const Operation& operation : path.operations) numbers = operation(node.value_or(root), *numbers);
    found.numbers.insert(found.numbers.end(), numbers->begin(), numbers->end());
    if (isText && numbers->size() == 1) found.text = formatNumber(numbers->front());
  }
  if (node) {
    found.nodes.push_back(*node);
    found.ends.push_back(found.numbers.size());
  }
  return true;
}

}  // namespace

const Json& contentOf(const Json& value) {
  const auto text = value.is_object() ? value.find("#text") : value.end();
  return value.is_object() && text != value.end() ? *text : value;
}

std::optional<std::vector<double>> numbersIn(const Json& value) {
  std::vector<double> numbers;
  return append(value, numbers) ? std::optional(std::move(numbers)) : std::nullopt;
}

std::vector<std::size_t> shapeOf(const Json& value) {
  std::vector<std::size_t> shape;
  if (value.is_array()) {
    for (const Json* at = &value; at->is_array(); at = &at->front()) {
      shape.push_back(at->size());
      if (at->empty()) break;
    }
  } else if (const auto numbers = numbersIn(value)) {
    shape = {numbers->size()};
  }
  std::erase(shape, std::size_t{1});
  if (shape.empty()) shape.push_back(1);
  return shape;
}

std::vector<double> transposed(const std::vector<double>& byRows, std::size_t columns) {
  std::vector<double> turned;
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = j; i < byRows.size(); i += columns) turned.push_back(byRows[i]);
  return turned;
}

std::vector<Part> parseParts(std::string_view line, const std::string& label, std::string_view container) {
  std::vector<Part> parts;
  for (std::size_t at = 0; at < line.size();) {
    std::size_t end = at;
    for (int depth = 0; end < line.size() && (depth > 0 || line[end] != ','); ++end)
      depth += line[end] == '[' ? 1 : line[end] == ']' ? -1 : 0;
    const std::string_view text = trimmed(line.substr(at, end - at));
    at = end + 1;
    const std::size_t equals = text.find('=');
    const auto fail = [&](const std::string& message) { throw UsageError(label + ": " + visible(message)); };
    if (equals == std::string_view::npos || equals == 0)
      fail(inQuotes(text) + ": expected name=path, as in K=camera_matrix");
    Part part{std::string(trimmed(text.substr(0, equals)))};
    part.isOptional = part.name.ends_with('?');
    if (part.isOptional) part.name.pop_back();
    for (const std::string_view sum : split(text.substr(equals + 1), "||"))
      part.value.push_back(
          parseSum(sum, container, [&](const std::string& message) { fail(part.name + ": " + message); }));
    if (std::any_of(parts.begin(), parts.end(), [&](const Part& other) { return other.name == part.name; }))
      fail(part.name + " is given twice");
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<const Path*> Part::starredPaths() const {
  std::vector<const Path*> paths;
  for (const Sum& sum : value)
    for (const Term& term : sum)
      for (const Path& path : term.paths)
        if (path.text.find('*') != std::string::npos) paths.push_back(&path);
  return paths;
}

std::optional<Node> valueAt(const Node& root, std::string_view path) {
  if (path.empty()) return root;
  std::optional<Node> found;
  anyFirstName(path, [&](std::string_view name, std::string_view rest) {
    if (const auto next = child(root, name)) found = valueAt(*next, rest);
    return found.has_value();
  });
  return found;
}

namespace {

void addPaths(const Json& value, const std::string& path, std::size_t depth, std::vector<std::string>& paths) {
  constexpr std::size_t kMostPaths = 2000, kDeepestPath = 12;
  if (paths.size() == kMostPaths || depth == kDeepestPath) return;
  if (const auto numbers = numbersIn(value); numbers && !numbers->empty() && !path.empty())
    paths.push_back(path);
  else if (value.is_object())
    for (const auto& [key, member] : value.items()) addPaths(member, joinedPath(path, key), depth + 1, paths);
  else if (value.is_array() && !value.empty())
    addPaths(value.front(), joinedPath(path, value.front().is_object() && path.empty() ? "*" : "0"), depth + 1, paths);
}

}  // namespace

std::vector<std::string> pathsOfNumbers(const Json& root) {
  std::vector<std::string> paths;
  addPaths(root, "", 0, paths);
  return paths;
}

std::string withStar(std::string_view path, std::string_view star) {
  std::string text(path);
  if (const std::size_t at = text.find('*'); at != std::string::npos) text.replace(at, 1, star);
  return text;
}

bool eachStar(const Node& root, std::string_view path, const std::function<bool(std::string_view star)>& visit) {
  const Json& value = root.json();
  return anyFirstName(path, [&](std::string_view name, std::string_view rest) {
    const std::size_t at = name.find('*');
    if (at == std::string_view::npos) {
      const auto next = child(root, name);
      return next && eachStar(*next, rest, visit);
    }
    // Paths only for what has the rest: there may be millions of others.
    bool any = false, goesOn = true;
    const auto tryOut = [&](std::string_view text, const Json& part) {
      const auto there = part.is_null() ? std::nullopt : valueAt(Node(root.document(), part, ""), rest);
      const bool isWord = rest.empty() && part.is_string() && !numbersIn(part);
      if (!there || isWord || (there->json().is_array() && there->json().empty())) return;
      any = true;
      goesOn = visit(text);
    };
    if (value.is_array() && name == "*")
      for (std::size_t i = 0; goesOn && i < value.size(); ++i) tryOut(std::to_string(i), value[i]);
    if (!value.is_object()) return any;
    const std::string_view before = name.substr(0, at), after = name.substr(at + 1);
    if (value.empty()) return any;
    const bool areNamed = !value.get_ref<const Json::object_t&>().rbegin()->first.starts_with('#');
    for (const auto& [key, member] : value.items()) {
      if (!goesOn) break;
      if (areNamed && name == "*" && key.starts_with('#')) continue;
      const bool isLonger = key.size() > before.size() + after.size() || name == "*";
      if (isLonger && key.starts_with(before) && std::string_view(key).ends_with(after))
        tryOut(std::string_view(key).substr(before.size(), key.size() - before.size() - after.size()), member);
    }
    return any;
  });
}

std::vector<std::string> starsOf(const Node& root, const std::vector<const Path*>& paths, std::size_t most) {
  std::vector<std::string> texts;
  for (const Path* path : paths)
    if (texts.size() < most)
      eachStar(root, path->text, [&](std::string_view text) {
        if (!path->isNumbered || std::all_of(text.begin(), text.end(), isDigit)) texts.emplace_back(text);
        return texts.size() < most;
      });
  std::sort(texts.begin(), texts.end(), isBefore);
  texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
  return texts;
}

/// Fails where a later name of the value that a term found has other numbers. A lens may leave out zeros at its end.
void requireOneValue(const Node& root, const Term& term, const Path& found, std::string_view star, bool isLens) {
  const auto first = valueAt(root, withStar(found.text, star));
  auto numbers = first && !found.isOfCoefficients ? numbersIn(first->json()) : std::nullopt;
  if (!numbers || numbers->size() < 2) return;
  for (const Path* path = &found + 1; path < term.paths.data() + term.paths.size(); ++path) {
    const auto other = path->isOfCoefficients ? std::nullopt : valueAt(root, withStar(path->text, star));
    auto others = other ? numbersIn(other->json()) : std::nullopt;
    if (!others || others->size() < 2 || (others->size() != numbers->size() && !isLens)) continue;
    const std::size_t count = std::max(others->size(), numbers->size());
    others->resize(count);
    numbers->resize(count);
    if (*others != *numbers)
      other->fail("differs from " + first->path() + ", which is another name of it; take one of them out");
  }
}

std::optional<Found> find(const Node& root, const Part& part, std::string_view star, bool isText) {
  std::string lacking;  // of the first sum of which some terms are there
  for (const Sum& sum : part.value) {
    Found found;
    std::string missing, present;
    bool isAny = false;
    for (const Term& term : sum) {
      const std::size_t before = found.nodes.size();
      const auto path = std::find_if(term.paths.begin(), term.paths.end(),
                                     [&](const Path& each) { return addPath(root, each, star, isText, found); });
      const bool isThere = path != term.paths.end();
      if (isThere && !isText)
        requireOneValue(root, term, *path, star, part.name == "lens" || part.name == "distortion");
      isAny = isAny || isThere;
      if (!isThere && !term.isOptional && missing.empty()) missing = withStar(term.paths.front().text, star);
      if (found.nodes.size() > before && !term.isOptional && present.empty()) present = found.nodes.back().path();
    }
    if (missing.empty() && isAny) return found;
    if (!present.empty() && lacking.empty()) lacking = missing + " beside " + present;
  }
  if (!lacking.empty()) root.fail(part.name + ": needs " + lacking);
  return std::nullopt;
}

}  // namespace viewproj::cmd
