#include "records/columns.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

using Pick = ColumnChoice::Pick;

constexpr std::size_t kMostPicks = 16;

/// The parts between commas, each split at its first =. Inside quotes, as in CSV, both characters belong to a name.
std::vector<std::pair<std::optional<std::string>, std::string>> splitRoles(std::string_view text) {
  std::vector<std::pair<std::optional<std::string>, std::string>> parts(1);
  bool isQuoted = false;
  for (const char c : text) {
    auto& [role, name] = parts.back();
    isQuoted = isQuoted != (c == '"');
    if (c == ',' && !isQuoted)
      parts.emplace_back();
    else if (c == '=' && !isQuoted && !role)
      role = trimmed(std::exchange(name, ""));
    else
      name += c;
  }
  for (auto& [role, name] : parts) name = csvValue(trimmed(name));
  return parts;
}

/// All parts that may be chosen.
std::vector<const CoordinatePart*> partsOf(std::span<const Coordinate* const> rows,
                                           std::span<const Coordinate* const> others) {
  std::vector<const CoordinatePart*> parts;
  for (const auto& some : {rows, others})
    for (const Coordinate* row : some)
      for (const CoordinatePart& part : row->parts) parts.push_back(&part);
  return parts;
}

/// The role with this name, or an empty text.
std::string_view roleNamed(std::string_view name, const ChoosableColumns& choosable) {
  for (const CoordinatePart* part : partsOf(choosable.rows, choosable.others))
    if (isNamed(name, *part)) return part->name;
  return "";
}

bool has(const std::vector<Pick>& picks, std::string_view role) {
  return std::any_of(picks.begin(), picks.end(), [&](const Pick& pick) { return pick.role == role; });
}

/// The row whose roles these are exactly, each once, with at most one of the others; null: there is none.
const Coordinate* const* wholeRow(const std::vector<Pick>& picks, const ChoosableColumns& choosable) {
  const auto isThere = [&](const CoordinatePart& part) { return has(picks, part.name); };
  const auto others = std::count_if(choosable.others.begin(), choosable.others.end(),
                                    [&](const Coordinate* other) { return isThere(other->parts[0]); });
  const auto found = std::find_if(choosable.rows.begin(), choosable.rows.end(), [&](const Coordinate* row) {
    const auto needed = row->required();
    const auto count = others + std::count_if(row->parts.begin(), row->parts.end(), isThere);
    return std::all_of(needed.begin(), needed.end(), isThere) && static_cast<std::size_t>(count) == picks.size();
  });
  return others <= 1 && found != choosable.rows.end() ? &*found : nullptr;
}

/// A message such as "expected x,y,z[,w] or lat,lon,height, as in E,N,U or x=E,y=N,z=U".
std::string expected(const ChoosableColumns& choosable) {
  std::string text;
  for (const Coordinate* row : choosable.rows) {
    text += text.empty() ? "expected " : " or ";
    for (std::size_t i = 0; i < row->parts.size(); ++i)
      text += (i == 0            ? ""
               : i < row->fewest ? ","
                                 : "[,") +
              std::string(row->parts[i].name) + (i < row->fewest ? "" : "]");
  }
  if (!choosable.others.empty()) text += ", perhaps with " + namesOf(choosable.others);
  return text + ", as in " + std::string(choosable.example);
}

/// Assigns the roles of the first row in order. One more pick gets the role with its name, or the only possible role.
/// Returns false if there is none.
bool assignInOrder(std::vector<Pick>& picks, const ChoosableColumns& choosable) {
  const Coordinate& row = *choosable.rows[0];
  if (picks.size() < row.fewest || picks.size() > row.fewest + 1) return false;
  for (std::size_t i = 0; i < row.fewest; ++i) picks[i].role = row.parts[i].name;
  if (picks.size() == row.fewest) return true;
  std::string_view& last = picks.back().role;
  last = roleNamed(picks.back().name, choosable);
  const bool hasMore = row.parts.size() > row.fewest;
  if (last.empty() && !(hasMore && !choosable.others.empty()))
    last = hasMore ? row.parts[row.fewest].name : choosable.others[0]->parts[0].name;
  return wholeRow(picks, choosable) != nullptr;
}

/// If the names are all roles, assigns those, in any order. Throws UsageError if x, y, z are in another order, because
/// they may be columns with these names that hold other coordinates.
bool assignByName(const std::string& text, std::vector<Pick>& picks, const ChoosableColumns& choosable) {
  std::vector<Pick> named = picks;
  for (Pick& pick : named) {
    pick.role = roleNamed(pick.name, choosable);
    pick.nameless = static_cast<std::size_t>(&pick - named.data()) + 1;
  }
  if (!wholeRow(named, choosable)) return false;
  if (named.size() == choosable.rows[0]->fewest && assignInOrder(picks, choosable))
    for (std::size_t i = 0; i < picks.size(); ++i)
      if (named[i].role != picks[i].role && has(picks, named[i].role))
        throw UsageError("--columns " + text + ": coordinates in another order; write each with its role, as in " +
                         std::string(picks[i].role) + "=" + picks[i].name);
  picks = std::move(named);
  return true;
}

/// areNames: the picks are names of columns, not values.
ColumnChoice readPicks(const std::string& option, const std::string& text, const ChoosableColumns& choosable,
                       bool areNames) {
  const auto wrong = [&](const std::string& what) { return UsageError(option + " " + text + ": " + what); };
  ColumnChoice choice{text};
  std::vector<Pick>& picks = choice.picks;
  for (const auto& [role, name] : splitRoles(text)) {
    if (name.empty()) throw wrong("a " + std::string(areNames ? "name" : "number") + " is missing");
    if (!picks.empty() && role.has_value() != choice.hasRoles)
      throw wrong("write each with its role and =, or none; " + expected(choosable));
    if (picks.size() == kMostPicks) throw wrong("too many; " + expected(choosable));
    choice.hasRoles = role.has_value();
    const std::string& called = role ? *role : name;
    picks.push_back({role ? roleNamed(*role, choosable) : "", isSeaLevelName(called) ? called : "", name});
    if (role && picks.back().role.empty()) throw wrong(inQuotes(*role) + " is not a role; " + expected(choosable));
  }
  if (!choice.hasRoles && !(areNames && (choice.hasRoles = assignByName(text, picks, choosable))))
    (void)assignInOrder(picks, choosable);
  const Coordinate* const* const row = wholeRow(picks, choosable);
  if (!row) throw wrong(expected(choosable));
  const auto parts = partsOf({row, 1}, choosable.others);
  const auto orderOf = [&](const Pick& pick) {
    return std::find_if(parts.begin(), parts.end(), [&](const auto* part) { return part->name == pick.role; });
  };
  std::sort(picks.begin(), picks.end(), [&](const Pick& a, const Pick& b) { return orderOf(a) < orderOf(b); });
  return choice;
}

}  // namespace

ColumnChoice readValues(const std::string& option, const std::string& text, const ChoosableColumns& choosable) {
  return readPicks(option, text, choosable, false);
}

ColumnChoice chooseColumns(const std::string& text, const ChoosableColumns& choosable) {
  ColumnChoice choice = readPicks("--columns", text, choosable, true);
  for (Pick& pick : choice.picks) {
    const std::size_t sign = pick.name.size() > 1 && (pick.name[0] == '-' || pick.name[0] == '+');
    if (pick.name.find_first_not_of("0123456789", sign) == std::string::npos) {
      const auto [end, error] = std::from_chars(pick.name.data(), pick.name.data() + pick.name.size(), pick.number);
      if (error != std::errc() || pick.number < 1 || pick.number > kMostFields)
        throw UsageError("--columns " + text + ": columns are numbered from 1 to " + std::to_string(kMostFields));
      pick.nameless = pick.number;
    }
    for (const Pick* other = choice.picks.data(); other != &pick; ++other)
      if (other->name == pick.name) throw UsageError("--columns " + text + ": names " + inQuotes(pick.name) + " twice");
  }
  return choice;
}

bool ColumnChoice::has(std::string_view role) const { return cmd::has(picks, role); }

std::vector<std::size_t> ColumnChoice::numbers() const {
  std::vector<std::size_t> numbers;
  for (const Pick& pick : picks)
    if (pick.number > 0) numbers.push_back(pick.number);
  return numbers;
}

std::vector<std::string> ColumnChoice::columnNames() const {
  std::vector<std::string> names;
  for (const Pick& pick : picks) {
    if (pick.nameless == 0) continue;
    names.resize(std::max(names.size(), pick.nameless));
    names[pick.nameless - 1] = pick.role;
  }
  return names;
}

void ColumnChoice::requireNoNames(const std::string& of) const {
  if (std::any_of(picks.begin(), picks.end(), [](const Pick& pick) { return pick.nameless == 0; }))
    throw UsageError("--columns " + text + ": " + of + " have no names; use numbers, as in 1,2,3");
}

namespace {

/// The field that a pick means, and where in its value. Throws RecordError if the record does not have it.
std::pair<std::size_t, std::string> fieldOf(const Pick& pick, const RecordView& record) {
  const Schema& schema = *record.schema;
  const bool csv = schema.form == Form::csv, hasNames = !schema.isArray && (!csv || schema.hasHeader);
  const std::string what = csv ? "column" : schema.isArray ? "number" : "field";
  const std::size_t number = hasNames ? pick.number : pick.nameless;
  if (number > 0 && hasNames && !csv)
    throw RecordError(0, "is an object; name its fields in --columns, as in x=E,y=N,z=U");
  if (number > schema.size)
    throw RecordError(0, "has " + std::to_string(schema.size) + " " + what + (schema.size == 1 ? "" : "s") +
                             "; --columns names number " + std::to_string(number));
  if (number > 0) return {number - 1, ""};
  if (!hasNames) throw RecordError(0, "has " + what + "s without names; number them in --columns, as in 1,2,3");
  if (const auto field = schema.find(pick.name)) return {*field, ""};
  for (std::size_t dot = pick.name.find('.'); !csv && dot < pick.name.size(); dot = pick.name.find('.', dot + 1))
    if (const auto field = schema.find(pick.name.substr(0, dot))) return {*field, pick.name.substr(dot + 1)};
  throw RecordError(0, "has no " + what + " " + visible(pick.name) + ", which --columns names" + fieldsNote(schema));
}

}  // namespace

NumberPlan chosenFields(const ColumnChoice& choice, const RecordView& record, bool mayBeAbsent) {
  NumberPlan plan;
  for (const Pick& pick : choice.picks) {
    const auto [field, inner] = fieldOf(pick, record);
    for (const NumberField& other : plan.fields)
      if (other.field == field && other.inner == inner)
        throw RecordError(0, "--columns " + choice.text + " names column " + std::to_string(field + 1) + " twice");
    plan.fields.push_back({field, 1, 1, false, mayBeAbsent, inner});
    if (pick.role == coordinates::place.parts[2].name) noteSeaLevel(pick.altitude, plan);
  }
  return plan;
}

}  // namespace viewproj::cmd
