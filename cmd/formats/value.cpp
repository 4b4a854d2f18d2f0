#include "formats/value.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "text/error.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// Objects of numbers whose names have an order.
constexpr std::string_view kOrders[] = {"x y z w",     "width height", "w h",      "fx fy cx cy",
                                        "qx qy qz qw", "tx ty tz",     "px py pz", "k1 k2 p1 p2 k3 k4 k5 k6",
                                        "k1 k2 k3 k4"};
constexpr std::string_view kCoefficients[] = {"k1", "k2", "k3",    "k4",   "k5",    "k6",   "p1",
                                              "p2", "xi", "alpha", "beta", "omega", "rpmax"};

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

/// Appends the members of an object in the order of a row whose first names they all are.
bool appendOrdered(const Json& object, std::vector<double>& numbers) {
  for (const std::string_view order : kOrders) {
    const std::vector<std::string_view> names = split(order, " ");
    if (object.size() < 2 || object.size() > names.size()) continue;
    std::vector<double> values;
    for (std::size_t i = 0; i < object.size(); ++i) {
      const auto member = object.find(names[i]);
      const auto value = member == object.end() || member->is_structured() ? std::nullopt : numbersIn(*member);
      if (!value || value->size() != 1) break;
      values.push_back(value->front());
    }
    if (values.size() < object.size()) continue;
    numbers.insert(numbers.end(), values.begin(), values.end());
    return true;
  }
  return false;
}

bool appendText(std::string_view text, std::vector<double>& numbers) {
  bool any = false;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r\n,;[]()", at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(" \t\r\n,;[]()", at), text.size());
    const auto number = parseNumber(text.substr(at, end - at));
    if (!number) return false;
    numbers.push_back(*number);
    any = true;
    at = end;
  }
  return any;
}

bool append(const Json& value, std::vector<double>& numbers) {
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return true;
  }
  if (value.is_string()) return appendText(value.get_ref<const std::string&>(), numbers);
  if (value.is_array())
    return std::all_of(value.begin(), value.end(), [&](const Json& part) {
      return part.is_array() == value.front().is_array() && append(part, numbers);
    });
  if (!value.is_object()) return false;
  if (const auto data = value.find("data"); data != value.end() && (value.contains("rows") || value.contains("cols")))
    return !data->is_object() && append(*data, numbers);
  return appendOrdered(value, numbers);
}

double entryOf(const Json& matrix, const char* key) {
  const auto member = matrix.find(key);
  const auto number = member == matrix.end() ? std::nullopt : numbersIn(*member);
  return number && number->size() == 1 ? number->front() : 1;
}

/// The number of rows and columns of what is to be transposed.
std::optional<std::pair<std::size_t, std::size_t>> matrixShape(const Json& value, std::size_t count) {
  const std::vector<std::size_t> shape = shapeOf(value);
  if (shape.size() == 2) return std::pair(shape[0], shape[1]);
  if (count == 9 || count == 16) return std::pair<std::size_t, std::size_t>(count == 9 ? 3 : 4, count == 9 ? 3 : 4);
  if (count == 12) return std::pair<std::size_t, std::size_t>(4, 3);
  return std::nullopt;
}

Path parsePath(std::string_view text, const std::function<void(const std::string&)>& fail) {
  Path path{std::string(text)};
  while (true) {
    std::string& rest = path.text;
    const std::size_t slash = rest.rfind('/');
    if (rest.ends_with("^T")) {
      rest.resize(rest.size() - 2);
      path.operations.insert(path.operations.begin(), {Operation::transpose});
    } else if (slash != std::string::npos && slash > 0 && parseNumber(rest.substr(slash + 1))) {
      const double divisor = *parseNumber(rest.substr(slash + 1));
      if (divisor == 0) fail(rest + ": divides by 0");
      path.operations.insert(path.operations.begin(), {Operation::divide, divisor});
      rest.resize(slash);
    } else if (const std::size_t open = rest.rfind('['); rest.ends_with(']') && open != std::string::npos) {
      Operation chosen{Operation::choose};
      for (const std::string_view item : split(std::string_view(rest).substr(open + 1, rest.size() - open - 2), ",")) {
        const std::size_t colon = item.find(':');
        const auto index = [&](std::string_view digits, std::size_t otherwise) {
          if (digits.empty() && colon != std::string_view::npos) return otherwise;
          const auto number = parseNumber(digits);
          if (!number || !(*number >= 0 && *number < 1e6) || *number != std::floor(*number))
            fail(rest + ": expected numbers from 0 on, as in [0,1] or [0:4]");
          return static_cast<std::size_t>(*number);
        };
        const std::size_t first = index(item.substr(0, colon), 0);
        chosen.ranges.emplace_back(first,
                                   colon == std::string_view::npos ? first + 1 : index(item.substr(colon + 1), kToEnd));
      }
      path.operations.insert(path.operations.begin(), chosen);
      rest.resize(open);
    } else {
      break;
    }
  }
  path.number = parseNumber(path.text);
  if (path.text.empty()) fail("expected a path of the file");
  if (std::count(path.text.begin(), path.text.end(), '*') > 1) fail(path.text + ": has two stars; one is allowed");
  return path;
}

/// The member of an object or an item of an array; null counts as absent.
std::optional<Node> child(const Node& node, std::string_view name) {
  const Json& value = node.json();
  const Json* found = nullptr;
  if (value.is_object()) {
    if (const auto member = value.find(name); member != value.end()) found = &*member;
    if (!found && name.ends_with('~')) {  // a name that begins so
      const auto member =
          value.get_ref<const Json::object_t&>().lower_bound(std::string(name.substr(0, name.size() - 1)));
      if (member != value.get_ref<const Json::object_t&>().end() &&
          member->first.starts_with(name.substr(0, name.size() - 1)))
        found = &member->second;
    }
  } else if (value.is_array() && !name.empty() && name.size() < 9 && std::all_of(name.begin(), name.end(), isDigit)) {
    std::size_t index = 0;
    for (const char digit : name) index = 10 * index + static_cast<std::size_t>(digit - '0');
    if (index < value.size()) found = &value[index];
  }
  if (!found || found->is_null()) return std::nullopt;
  return Node(node.document(), *found, joinedPath(node.path(), name));
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

/// Applies the operations of a path to the numbers of a value.
std::vector<double> applied(const Node& node, const Path& path, std::vector<double> numbers) {
  for (const Operation& operation : path.operations) {
    if (operation.kind == Operation::divide) {
      for (double& number : numbers) number /= operation.divisor;
    } else if (operation.kind == Operation::transpose) {
      const auto shape = matrixShape(node.json(), numbers.size());
      if (!shape || shape->first * shape->second != numbers.size())
        node.fail("expected a matrix to transpose, got " + std::to_string(numbers.size()) + " numbers");
      std::vector<double> turned;
      for (std::size_t j = 0; j < shape->second; ++j)
        for (std::size_t i = 0; i < shape->first; ++i) turned.push_back(numbers[i * shape->second + j]);
      numbers = std::move(turned);
    } else {
      std::vector<double> chosen;
      for (auto [first, end] : operation.ranges) {
        if (end == kToEnd) end = numbers.size();
        if (first > end || end > numbers.size()) node.fail("has " + std::to_string(numbers.size()) + " numbers");
        chosen.insert(chosen.end(), numbers.begin() + static_cast<std::ptrdiff_t>(first),
                      numbers.begin() + static_cast<std::ptrdiff_t>(end));
      }
      numbers = std::move(chosen);
    }
  }
  return numbers;
}

/// Adds a term. False if it is not in the file.
bool addTerm(const Node& root, const Term& term, std::string_view star, bool isText, Found& found) {
  for (const Path& path : term.paths) {
    const std::string text = withStar(path.text, star);
    if (const std::size_t sign = text.find('#');
        sign != std::string::npos && (sign + 1 == text.size()) && (sign == 0 || text[sign - 1] == '.')) {
      for (const std::string_view name : kCoefficients)
        if (const auto node = valueAt(root, text.substr(0, sign) + std::string(name))) {
          const auto number = numbersIn(node->json());
          if (!number || number->size() != 1) continue;
          found.named.emplace_back(name, number->front());
          found.nodes.push_back(*node);
        }
      if (!found.named.empty()) return true;
      continue;
    }
    if (const auto node = valueAt(root, text)) {
      if (isText) {
        const Json& value = node->json();
        if (value.is_structured()) node->fail("expected a text");
        found.text = value.is_string()   ? value.get<std::string>()
                     : value.is_number() ? formatNumber(value.get<double>())
                                         : value.dump();
        found.nodes.push_back(*node);
        return true;
      }
      const auto numbers = numbersIn(node->json());
      if (!numbers) node->fail("expected numbers");
      const std::vector<double> result = applied(*node, path, *numbers);
      found.numbers.insert(found.numbers.end(), result.begin(), result.end());
      found.nodes.push_back(*node);
      return true;
    }
    if (path.number) {
      double number = *path.number;
      for (const Operation& operation : path.operations) number /= operation.divisor;
      found.numbers.push_back(number);
      return true;
    }
  }
  return false;
}

/// The container that "#" stands in.
std::string withoutSign(std::string text) {
  if (text.ends_with("#") && (text.size() == 1 || text[text.size() - 2] == '.')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// A size may be there twice, under two names.
void requireOneSize(const Node& root, const Part& part, std::string_view star, Found& found) {
  if (part.name != "size" || found.numbers.size() != 2) return;
  for (const Sum& sum : part.value) {
    if (sum.size() != 1) continue;
    for (const Path& path : sum.front().paths) {
      const auto other = path.operations.empty() ? valueAt(root, withStar(path.text, star)) : std::nullopt;
      const auto numbers = other ? numbersIn(other->json()) : std::nullopt;
      if (!numbers || numbers->size() != 2) continue;
      if (*numbers != found.numbers) other->fail("differs from the width and height beside it");
      found.nodes.push_back(*other);
    }
  }
}

}  // namespace

std::optional<std::vector<double>> numbersIn(const Json& value) {
  std::vector<double> numbers;
  if (!append(value, numbers)) return std::nullopt;
  return numbers;
}

std::vector<std::size_t> shapeOf(const Json& value) {
  std::vector<std::size_t> shape;
  if (value.is_object() && value.contains("data")) {
    const auto count = numbersIn(value);
    const double rows = entryOf(value, "rows"), cols = entryOf(value, "cols");
    if (count && rows * cols == static_cast<double>(count->size()))
      shape = {static_cast<std::size_t>(rows), static_cast<std::size_t>(cols)};
    else if (count)
      shape = {count->size()};
  } else if (value.is_array()) {
    for (const Json* at = &value; at->is_array(); at = &at->front()) {
      shape.push_back(at->size());
      if (at->empty()) break;
    }
  } else if (const auto count = numbersIn(value)) {
    shape = {count->size()};
  }
  std::erase(shape, std::size_t{1});
  if (shape.empty()) shape.push_back(1);
  return shape;
}

std::vector<Part> parseParts(std::string_view line, const std::string& label) {
  std::vector<Part> parts;
  std::size_t at = 0;
  while (at < line.size()) {
    std::size_t end = at;
    for (int depth = 0; end < line.size() && (depth > 0 || line[end] != ','); ++end)
      depth += line[end] == '[' ? 1 : line[end] == ']' ? -1 : 0;
    const std::string_view text = trimmed(line.substr(at, end - at));
    at = end + 1;
    const std::size_t equals = text.find('=');
    const auto fail = [&](const std::string& message) { throw UsageError(label + ": " + visible(message)); };
    if (equals == std::string_view::npos || equals == 0)
      fail(inQuotes(text) + ": expected name=path, as in K=camera_matrix");
    Part part{std::string(trimmed(text.substr(0, equals))), false, {}};
    if (part.name.ends_with('?')) {
      part.isOptional = true;
      part.name.pop_back();
    }
    for (const std::string_view choice : split(text.substr(equals + 1), "||")) {
      Sum sum;
      for (std::string_view piece : split(choice, "+")) {
        Term term;
        piece = trimmed(piece);
        if (piece.ends_with('?')) {
          term.isOptional = true;
          piece.remove_suffix(1);
        }
        for (const std::string_view path : split(piece, "|"))
          term.paths.push_back(
              parsePath(trimmed(path), [&](const std::string& message) { fail(part.name + ": " + message); }));
        sum.push_back(std::move(term));
      }
      part.value.push_back(std::move(sum));
    }
    for (const Part& other : parts)
      if (other.name == part.name) fail(part.name + " is given twice");
    parts.push_back(std::move(part));
  }
  return parts;
}

void placeUnder(std::vector<Part>& parts, std::string_view container) {
  for (Part& part : parts)
    for (Sum& sum : part.value)
      for (Term& term : sum)
        for (Path& path : term.paths) {
          if (path.number) continue;
          if (path.text.starts_with('/'))
            path.text.erase(0, 1);
          else
            path.text = joinedPath(container, path.text);
        }
}

std::optional<Node> valueAt(const Node& root, std::string_view path) {
  if (path.empty()) return root;
  // The longest name that exists: members may have dots in their names.
  for (std::size_t end = path.size(); end != std::string_view::npos;
       end = end == 0 ? std::string_view::npos : path.rfind('.', end - 1)) {
    const auto next = child(root, path.substr(0, end));
    if (!next) continue;
    if (auto found = valueAt(*next, end == path.size() ? "" : path.substr(end + 1))) return found;
  }
  return std::nullopt;
}

std::string withStar(std::string_view path, std::string_view star) {
  std::string text(path);
  if (const std::size_t at = text.find('*'); at != std::string::npos) text.replace(at, 1, star);
  return text;
}

bool hasStar(const Part& part) {
  for (const Sum& sum : part.value)
    for (const Term& term : sum)
      for (const Path& path : term.paths)
        if (path.text.find('*') != std::string::npos) return true;
  return false;
}

void eachStar(const Node& root, std::string_view path, const std::function<bool(std::string_view star)>& visit) {
  const std::size_t star = path.find('*');
  if (star == std::string_view::npos) return;
  bool any = false, goesOn = true;
  const auto tell = [&](std::string_view text) {
    any = true;
    goesOn = visit(text);
  };
  // Where the names before the star's own end: every dot before it, the last one first.
  for (std::size_t dot = path.rfind('.', star); goesOn && !any; dot = path.rfind('.', dot - 1)) {
    const bool isFirst = dot == std::string_view::npos;
    const auto container = isFirst ? std::optional(root) : valueAt(root, path.substr(0, dot));
    const std::string_view rest = path.substr(isFirst ? 0 : dot + 1);
    const std::size_t at = rest.find('*');
    const std::string_view before = rest.substr(0, at);
    if (container && container->json().is_array() && before.empty() && (at + 1 == rest.size() || rest[at + 1] == '.')) {
      // Paths only for items that have the rest: there may be millions of others.
      const std::string_view after = at + 1 == rest.size() ? "" : rest.substr(at + 2);
      const Json& items = container->json();
      for (std::size_t i = 0; goesOn && i < items.size(); ++i) {
        const bool mayHave = after.empty() ? !items[i].is_null() : items[i].is_structured();
        if (mayHave && valueAt(Node(container->document(), items[i], ""), after)) tell(std::to_string(i));
      }
      return;
    }
    // Where the star's own name ends: it may have dots too.
    for (std::size_t end = rest.size(); goesOn && container && container->json().is_object();) {
      const std::string_view after = rest.substr(at + 1, end - at - 1);
      for (const auto& [name, member] : container->json().items()) {
        if (!goesOn) return;
        if (name.size() < before.size() + after.size() + (before.empty() && after.empty() ? 0 : 1)) continue;
        if (!name.starts_with(before) || !std::string_view(name).ends_with(after) || member.is_null()) continue;
        if (end != rest.size() && !valueAt(Node(container->document(), member, ""), rest.substr(end + 1))) continue;
        tell(std::string_view(name).substr(before.size(), name.size() - before.size() - after.size()));
      }
      const std::size_t next = end > at + 1 ? rest.rfind('.', end - 1) : std::string_view::npos;
      if (next == std::string_view::npos || next <= at) break;
      end = next;
    }
    if (isFirst || dot == 0) return;
  }
}

std::vector<std::string> starsOf(const Node& root, std::string_view path) {
  std::vector<std::string> texts;
  eachStar(root, path, [&](std::string_view text) {
    texts.emplace_back(text);
    return true;
  });
  std::sort(texts.begin(), texts.end(), isBefore);
  texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
  return texts;
}

std::vector<std::string> starsOf(const Node& root, const Value& value) {
  std::vector<std::string> all;
  for (const Sum& sum : value)
    for (const Term& term : sum)
      for (const Path& path : term.paths) {
        const std::vector<std::string> texts = starsOf(root, withoutSign(path.text));
        all.insert(all.end(), texts.begin(), texts.end());
      }
  std::sort(all.begin(), all.end(), isBefore);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool hasStars(const Node& root, const Value& value) {
  bool any = false;
  for (const Sum& sum : value)
    for (const Term& term : sum)
      for (const Path& path : term.paths) {
        if (any) return true;
        eachStar(root, withoutSign(path.text), [&](std::string_view) {
          any = true;
          return false;
        });
      }
  return any;
}

std::optional<Found> find(const Node& root, const Part& part, std::string_view star, bool isText) {
  const auto nameOf = [&](const Term& term) { return withStar(term.paths.front().text, star); };
  std::string lacking, present;
  for (const Sum& sum : part.value) {
    Found found;
    std::string missing, there;
    bool isAny = false;
    for (const Term& term : sum) {
      const std::size_t before = found.nodes.size();
      if (addTerm(root, term, star, isText, found)) {
        isAny = true;
        if (found.nodes.size() > before && !term.isOptional && there.empty()) there = found.nodes.back().path();
      } else if (!term.isOptional && missing.empty()) {
        missing = nameOf(term);
      }
    }
    if (missing.empty() && isAny) {
      requireOneSize(root, part, star, found);
      return found;
    }
    if (!there.empty() && lacking.empty()) {
      lacking = missing;
      present = there;
    }
  }
  if (!lacking.empty()) root.fail(part.name + ": needs " + lacking + " beside " + present);
  return std::nullopt;
}

std::string placeOf(const Part& part, std::string_view star) {
  return part.name + ": " + withStar(part.value.front().front().paths.front().text, star);
}

void mark(const Found& found) {
  for (const Node& node : found.nodes) node.mark();
}

}  // namespace viewproj::cmd
