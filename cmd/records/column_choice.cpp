#include "records/column_choice.hpp"

#include <algorithm>
#include <charconv>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

using Pick = ColumnChoice::Pick;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// What stands between commas; in quotes, as CSV has them, a comma is one of the name's. role: whether = stands between
/// the role and the name.
struct Part {
  std::string_view role, name;
  bool hasRole = false;
};

std::vector<Part> partsOf(std::string_view text) {
  const auto passBlanks = [&](std::size_t at) { return std::min(text.find_first_not_of(" \t", at), text.size()); };
  const auto passQuotes = [&](std::size_t at) {
    if (at == text.size() || text[at] != '"') return at;
    const std::size_t close = text.find('"', at + 1);
    return close == std::string_view::npos ? at : close + 1;
  };
  std::vector<Part> parts;
  for (std::size_t at = 0; at <= text.size();) {
    Part part;
    std::size_t begin = at, end = std::min(text.find_first_of(",=", passQuotes(passBlanks(at))), text.size());
    if (end < text.size() && text[end] == '=') {
      part.role = trimmed(text.substr(at, end - at));
      part.hasRole = true;
      begin = end + 1;
      end = std::min(text.find(',', passQuotes(passBlanks(begin))), text.size());
    }
    part.name = trimmed(text.substr(begin, end - begin));
    parts.push_back(part);
    at = end + 1;
  }
  return parts;
}

UsageError wrong(const std::string& text, const std::string& what) {
  return UsageError("--columns " + text + ": " + what);
}

bool has(const std::vector<Pick>& picks, std::string_view role) {
  return std::any_of(picks.begin(), picks.end(), [&](const Pick& pick) { return pick.role == role; });
}

/// Whether they are all that a row needs, and no more than it and one of the others have.
bool isWhole(const std::vector<Pick>& picks, const ChoosableColumns& choosable) {
  return std::any_of(choosable.rows.begin(), choosable.rows.end(), [&](const Coordinate* row) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < row->parts.size(); ++i) {
      if (has(picks, row->parts[i].name))
        ++count;
      else if (i < row->fewest)
        return false;
    }
    for (const Coordinate* other : choosable.others)
      if (has(picks, other->parts[0].name)) return picks.size() == count + 1;
    return picks.size() == count;
  });
}

/// "x, y, z (, w) or lat, lon, height".
std::string expected(const ChoosableColumns& choosable) {
  std::string text = "expected ";
  for (const Coordinate* row : choosable.rows) {
    if (row != choosable.rows[0]) text += " or ";
    for (std::size_t i = 0; i < row->parts.size(); ++i)
      text += (i == 0 ? "" : i < row->fewest ? ", " : " and perhaps ") + std::string(row->parts[i].name);
  }
  if (!choosable.others.empty()) text += ", and perhaps " + namesOf(choosable.others);
  return text + ", as in " + std::string(choosable.example);
}

void place(Pick& pick, const std::string& text) {
  if (pick.name.empty()) throw wrong(text, "a name is missing");
  const bool hasSign = pick.name.size() > 1 && (pick.name[0] == '-' || pick.name[0] == '+');
  if (!std::all_of(pick.name.begin() + hasSign, pick.name.end(), [](char c) { return c >= '0' && c <= '9'; })) return;
  const auto [end, error] = std::from_chars(pick.name.data(), pick.name.data() + pick.name.size(), pick.number);
  if (error != std::errc() || pick.number < 1 || pick.number > kMostFields)
    throw wrong(text, "columns are numbered from 1 to " + std::to_string(kMostFields));
}

std::vector<const CoordinatePart*> partsOf(const ChoosableColumns& choosable) {
  std::vector<const CoordinatePart*> parts;
  for (const auto& rows : {choosable.rows, choosable.others})
    for (const Coordinate* row : rows)
      for (const CoordinatePart& part : row->parts) parts.push_back(&part);
  return parts;
}

/// The role after the fewest that a column has by its name: viewDistance, and view_distance as CSV has it.
std::string_view roleNamed(std::string_view name, const ChoosableColumns& choosable) {
  const auto isOf = [&](const CoordinatePart& part) { return name == part.name || name == columnName(part.name); };
  for (const CoordinatePart& part : choosable.rows[0]->parts.subspan(choosable.rows[0]->fewest))
    if (isOf(part)) return part.name;
  for (const Coordinate* other : choosable.others)
    if (isOf(other->parts[0])) return other->parts[0].name;
  return "";
}

/// Names or numbers alone: the roles of a row in order, unless they are roles themselves.
void giveRoles(ColumnChoice& choice, const ChoosableColumns& choosable) {
  std::vector<Pick>& picks = choice.picks;
  std::vector<Pick> named = picks;
  for (Pick& pick : named) pick.role = roleOf(pick.name, choosable);
  std::vector<std::string_view> inOrder;
  for (const CoordinatePart& part : choosable.rows[0]->parts) inOrder.push_back(part.name);
  const std::size_t fewest = choosable.rows[0]->fewest;
  if (inOrder.size() == fewest && !choosable.others.empty()) inOrder.push_back(choosable.others[0]->parts[0].name);
  // x, y, z the other way round are columns that take one another's place.
  bool exchanged = picks.size() == fewest;
  for (std::size_t i = 0; i < picks.size(); ++i)
    exchanged &= std::find(inOrder.begin(), inOrder.end(), picks[i].name) != inOrder.end();
  for (std::size_t i = 0, equal = 0; i < std::min(picks.size(), inOrder.size()); ++i)
    if (picks[i].name == inOrder[i] && ++equal == picks.size()) exchanged = false;
  if (!exchanged && isWhole(named, choosable)) {
    picks = std::move(named);
    choice.saysWhat = choice.inOrder = true;
    return;
  }
  if (picks.size() < fewest || picks.size() > inOrder.size())
    throw wrong(choice.text, "expected " + std::to_string(fewest) + " or " + std::to_string(inOrder.size()) +
                                 " names or numbers of columns, separated by commas");
  for (std::size_t i = 0; i < picks.size(); ++i) picks[i].role = inOrder[i];
  if (picks.size() == fewest) return;
  if (const auto role = roleNamed(picks[fewest].name, choosable); !role.empty())
    picks[fewest].role = role;
  else if (inOrder.size() == choosable.rows[0]->parts.size() && !choosable.others.empty())
    throw wrong(choice.text, "the last one may be " + std::string(inOrder.back()) + " or " +
                                 std::string(choosable.others[0]->parts[0].name) +
                                 "; expected a role for each, as in " + std::string(choosable.example));
}

}  // namespace

std::string_view roleOf(std::string_view name, const ChoosableColumns& choosable) {
  const std::vector<const CoordinatePart*> parts = partsOf(choosable);
  for (const CoordinatePart* part : parts)
    if (name == part->name) return part->name;
  for (const CoordinatePart* part : parts) {
    const auto is = [&](std::string_view other) { return sameButForCase(name, other); };
    if (is(part->name) || is(columnName(part->name)) || std::any_of(part->aliases.begin(), part->aliases.end(), is))
      return part->name;
  }
  return "";
}

const Pick* ColumnChoice::find(std::string_view role) const {
  const auto pick = std::find_if(picks.begin(), picks.end(), [&](const Pick& one) { return one.role == role; });
  return pick == picks.end() ? nullptr : &*pick;
}

std::vector<std::size_t> ColumnChoice::numbers() const {
  std::vector<std::size_t> numbers;
  for (const Pick& pick : picks)
    if (pick.number > 0) numbers.push_back(pick.number);
  return numbers;
}

std::vector<std::string> ColumnChoice::columnNames() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < picks.size(); ++i) {
    const std::size_t at = inOrder ? i : picks[i].number - 1;
    if (!inOrder && picks[i].number == 0) continue;
    names.resize(std::max(names.size(), at + 1));
    names[at] = picks[i].role;
  }
  return names;
}

void ColumnChoice::requireNoNames(const std::string& of) const {
  if (inOrder || std::all_of(picks.begin(), picks.end(), [](const Pick& pick) { return pick.number > 0; })) return;
  throw wrong(text, of + " have no names; numbers are the way, as in 1,2,3");
}

ColumnChoice chooseColumns(const std::string& text, const ChoosableColumns& choosable) {
  ColumnChoice choice{text, {}};
  for (const Part& part : partsOf(text)) {
    if (!choice.picks.empty() && part.hasRole != choice.saysWhat)
      throw wrong(text, "either each column has a name and =, or none has; " + expected(choosable));
    choice.saysWhat = part.hasRole;
    Pick pick{.role = std::string(part.role), .name = csvValue(part.name)};
    place(pick, text);
    for (const Pick& other : choice.picks)
      if (other.name == pick.name) throw UsageError("--columns: " + pick.name + " is named twice");
    choice.picks.push_back(std::move(pick));
    if (choice.picks.size() > 16) throw wrong(text, "too many; " + expected(choosable));
  }
  if (!choice.saysWhat) {
    giveRoles(choice, choosable);
    return choice;
  }
  for (Pick& pick : choice.picks) {
    const std::string_view role = roleOf(pick.role, choosable);
    if (role.empty()) throw wrong(text, inQuotes(pick.role) + " is no role; " + expected(choosable));
    pick.role = role;
  }
  for (std::size_t i = 0; i < choice.picks.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (choice.picks[i].role == choice.picks[j].role)
        throw UsageError("--columns: " + choice.picks[i].role + " is given twice");
  if (!isWhole(choice.picks, choosable)) throw wrong(text, expected(choosable));
  return choice;
}

std::size_t fieldOf(const Pick& pick, const ColumnChoice& choice, const RecordParts& record) {
  const Shape& shape = record.shape;
  const bool csv = shape.form == Form::csv, nameless = shape.isArray || (csv && !shape.hasHeader);
  const std::string what = csv ? "column" : shape.isArray ? "number" : "field";
  if (pick.number > 0 || (nameless && choice.inOrder)) {
    if (!nameless && !csv) throw RecordError(0, "is an object; --columns takes its fields by name, as in x=E,y=N,z=U");
    const std::size_t number =
        pick.number > 0 ? pick.number : static_cast<std::size_t>(&pick - choice.picks.data()) + 1;
    if (number > shape.size)
      throw RecordError(0, "has " + std::to_string(shape.size) + " " + what + (shape.size == 1 ? "" : "s") +
                               "; --columns names number " + std::to_string(number));
    return number - 1;
  }
  if (nameless)
    throw RecordError(0,
                      (csv ? "has no header, so that no column has a name" : std::string("has numbers without names")) +
                          "; --columns takes them by number, as in 1,2,3");
  if (const auto field = shape.find(pick.name)) return *field;
  if (const auto other = otherSeparator(shape))
    throw RecordError(0, "has no " + what + " " + visible(pick.name) + ", which --columns names; " + *other);
  throw RecordError(0, "has no " + what + " " + visible(pick.name) + ", which --columns names" + whatIsThere(shape));
}

}  // namespace viewproj::cmd
