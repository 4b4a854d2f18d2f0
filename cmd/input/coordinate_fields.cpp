#include "input/coordinate_fields.hpp"

#include <algorithm>

#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// How columns of an array are joined to its name: position_x, position.x, positionX.
constexpr std::string_view kJoints[] = {"_", ".", ""};

RecordError twoAsGood(const RecordParts& record, std::size_t one, std::size_t other, std::string_view part) {
  const auto& names = record.shape.names;
  return {record.shape.form == Form::csv ? 0 : record.offset(other),
          "has both " + cmd::quoted(names[one]) + " and " + cmd::quoted(names[other]) + " for " + std::string(part) +
              "; --columns says which, as in " + std::string(part) + "=" + visible(names[one])};
}

/// A column or field each; nothing where one that is required is missing.
std::optional<Layout> findEach(const RecordParts& record, std::span<const CoordinatePart> parts, std::size_t required,
                               bool orNull, NameRule rule) {
  const auto& names = record.shape.names;
  const std::vector<NameMatch> matches = matchParts(names, parts, required, rule);
  Layout layout;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NameMatch& match = matches[i];
    if (!match.field && i < required) return std::nullopt;
    if (!match.field) break;
    layout.parts.push_back({*match.field, 1, 1, false, orNull});
  }
  for (std::size_t i = 0; i < layout.parts.size(); ++i) {
    const NameMatch& match = matches[i];
    if (match.also) throw twoAsGood(record, *match.field, *match.also, parts[i].name);
    if (match.isAlias && parts[i].aliases.data() == coordinates::kSeaLevelNames)
      layout.notes.push_back(seaLevelNote(names[*match.field]));
  }
  return layout;
}

/// The names have to outlive them.
std::vector<CoordinatePart> partsOf(const std::vector<std::string>& names) {
  std::vector<CoordinatePart> parts;
  for (const std::string& name : names) parts.push_back({name});
  return parts;
}

/// The columns NAME_x, NAME_y, ... of an array, where its name, an alias or the joint may be another.
std::optional<Layout> findSpread(const Coordinate& row, const RecordParts& record, NameRule rule) {
  std::optional<Layout> found;
  const auto search = [&](std::string_view name, std::string_view joint) {
    std::vector<std::string> columns;
    for (std::size_t i = 0; i < row.most; ++i)
      columns.push_back(std::string(name) + std::string(joint) + std::string(kColumnSuffixes[i].substr(1)));
    const std::vector<CoordinatePart> parts = partsOf(columns);
    auto layout = findEach(record, parts, row.fewest, row.orNull, rule);
    if (layout && found && layout->parts[0].field != found->parts[0].field)
      throw RecordError(0, "has both " + namesIn(*found, record.shape) + " and " + namesIn(*layout, record.shape) +
                               "; --columns says which, as in --columns " + namesIn(*found, record.shape));
    if (layout && !found) found = std::move(layout);
  };
  search(columnName(row.name), kJoints[0]);
  if (found || rule == NameRule::exact) return found;
  for (const std::string_view joint : kJoints) search(row.name, joint);
  // cppcheck-suppress knownConditionTrueFalse  ; search() sets it
  if (found) return found;
  for (const std::string_view alias : row.aliases)
    for (const std::string_view joint : kJoints) search(alias, joint);
  return found;
}

/// min.x, minX, or with the axis first x_min, xmin.
std::vector<std::string> joinedColumns(const Coordinate& row, std::string_view joint, bool axisFirst) {
  std::vector<std::string> columns;
  for (const CoordinatePart& part : row.parts)
    for (std::size_t i = 0; i < part.size; ++i) {
      const std::string_view axis = part.size > 1 ? kColumnSuffixes[i].substr(1) : "";
      const std::string between(axis.empty() ? "" : joint);
      columns.push_back(axisFirst ? std::string(axis) + between + std::string(part.name)
                                  : std::string(part.name) + between + std::string(axis));
    }
  return columns;
}

/// In CSV.
std::optional<Layout> findColumns(const Coordinate& row, const RecordParts& record, NameRule rule) {
  if (row.form == CoordinateForm::numbers) return findEach(record, row.parts, row.fewest, row.orNull, rule);
  if (row.form == CoordinateForm::array) return findSpread(row, record, rule);
  const std::vector<std::string> names = columnsOf(row);
  if (names.empty()) return std::nullopt;
  if (auto found = findEach(record, partsOf(names), row.fewest, row.orNull, rule); found || rule == NameRule::exact)
    return found;
  std::optional<Layout> found;
  for (const std::string_view joint : kJoints)
    for (const bool axisFirst : {false, true}) {
      auto layout = findEach(record, partsOf(joinedColumns(row, joint, axisFirst)), row.fewest, row.orNull, rule);
      if (layout && found && layout->parts[0].field != found->parts[0].field)
        throw RecordError(0, "has both " + namesIn(*found, record.shape) + " and " + namesIn(*layout, record.shape) +
                                 " for a " + std::string(row.name) + "; expected one of the two");
      if (layout && !found) found = std::move(layout);
    }
  return found;
}

/// A field of JSON with a point: of the row's own name whatever its value; else where that has the form.
std::optional<Layout> findArray(const Coordinate& row, const RecordParts& record, std::vector<FormOfField>& forms,
                                NameRule rule) {
  const PointForm point = row.most < 3                ? PointForm::none
                          : row.kind == kindDirection ? PointForm::vector
                                                      : PointForm::point;
  const auto layoutOf = [&](std::size_t field) {
    return Layout{{{field, row.fewest, row.most, true, row.orNull, {}, 0, 0, point}}};
  };
  if (const auto own = record.shape.find(row.name)) return layoutOf(*own);
  if (rule == NameRule::exact) return std::nullopt;
  const auto& names = record.shape.names;
  const auto search = [&](const auto& isNamed) -> std::optional<std::size_t> {
    std::optional<std::size_t> found, also;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!isNamed(names[i])) continue;
      forms.push_back({i, point == PointForm::none ? '[' : FormOfField::kPoint});
      forms.back().is = forms.back().holds(record.values[i]);
      if (forms.back().is) (found ? also : found) = i;
    }
    if (also)
      throw RecordError(record.offset(*also), "has both " + cmd::quoted(names[*found]) + " and " +
                                                  cmd::quoted(names[*also]) + " for " + std::string(row.name) +
                                                  "; expected one of the two");
    return found;
  };
  if (const auto other = search([&](std::string_view name) { return sameButForCase(name, row.name); }))
    return layoutOf(*other);
  const auto alias = search([&](std::string_view name) {
    return std::any_of(row.aliases.begin(), row.aliases.end(),
                       [&](std::string_view one) { return sameButForCase(name, one); });
  });
  return alias ? std::optional(layoutOf(*alias)) : std::nullopt;
}

}  // namespace

std::optional<Layout> find(const Coordinate& row, const RecordParts& record, std::vector<FormOfField>& forms,
                           NameRule rule) {
  const Shape& shape = record.shape;
  if (shape.isArray) return std::nullopt;
  const auto found = [&]() -> std::optional<Layout> {
    if (shape.form == Form::csv) return findColumns(row, record, rule);
    if (row.form == CoordinateForm::numbers) return findEach(record, row.parts, row.fewest, row.orNull, rule);
    if (row.form == CoordinateForm::array) return findArray(row, record, forms, rule);
    const auto field = shape.find(row.name);
    if (!field) return std::nullopt;
    const char first = row.first;
    forms.push_back({*field, first, record.values[*field].starts_with(first)});
    if (!forms.back().is) return std::nullopt;
    Layout layout;
    if (row.form == CoordinateForm::points)
      for (std::size_t i = 0; i < row.fewest; ++i)
        layout.parts.push_back({*field, 3, 3, true, false, {}, i, row.fewest, PointForm::point});
    else
      for (const CoordinatePart& part : row.parts)
        layout.parts.push_back({*field, part.size, part.size, part.size > 1, false, std::string(part.name), 0, 0,
                                part.size > 1 ? PointForm::point : PointForm::none});
    return layout;
  }();
  if (!found) return std::nullopt;
  Layout layout = *found;
  layout.kind = row.kind;
  return layout;
}

std::string partlyThere(const Coordinate& row, const Shape& shape) {
  if (row.form != CoordinateForm::numbers || row.fewest < 2) return "";
  const std::vector<NameMatch> matches = matchParts(shape.names, row.parts, row.fewest, NameRule::any);
  std::string there;
  std::string_view missing;
  std::size_t count = 0;
  for (std::size_t i = 0; i < row.fewest; ++i) {
    count += matches[i].field.has_value();
    if (matches[i].field)
      there += (there.empty() ? "" : " and ") + visible(shape.names[*matches[i].field]);
    else if (missing.empty())
      missing = row.parts[i].name;
  }
  // One of them that is not the first may be anything.
  return !matches[0].field && count < 2 ? "" : "has " + there + " but no " + std::string(missing);
}

std::string namesIn(const Layout& layout, const Shape& shape) {
  std::vector<std::string_view> names;
  for (const NumberField& part : layout.parts)
    if (names.empty() || names.back() != shape.names[part.field]) names.push_back(shape.names[part.field]);
  return visible(joined(names, ","));
}

std::string whatIsThere(const Shape& shape) {
  constexpr std::size_t kMostShown = 60;
  if (shape.isArray || !shape.hasHeader || shape.names.empty()) return "";
  const bool csv = shape.form == Form::csv;
  std::string all;
  for (const std::string& name : shape.names) {
    if (all.size() > kMostShown) break;
    all += (all.empty() ? "" : csv ? "," : ", ") + name;
  }
  return (csv ? "; the header is " : "; its fields are ") + quoted(all, kMostShown);
}

std::string nearestField(std::span<const Coordinate* const> rows, const Shape& shape) {
  constexpr std::size_t kFew = 64, kLong = 3;
  if (shape.names.size() > kFew) return "";
  if (shape.form == Form::json && std::find(shape.names.begin(), shape.names.end(), kRecordsField) != shape.names.end())
    return "; " + quoted(kRecordsField) + " holds records where it is an array, and the object's first field";
  std::vector<std::string_view> fields(shape.names.begin(), shape.names.end());
  const auto nearest = [&](std::string_view name) {
    const std::string_view near = name.size() < kLong ? "" : nearestName(name, fields);
    return near.size() < kLong || sameButForCase(near, name) ? std::string_view() : near;
  };
  for (const Coordinate* row : rows) {
    std::vector<std::string_view> known;
    const std::vector<std::string> columns =
        shape.form == Form::csv && row->form == CoordinateForm::array ? columnsOf(*row) : std::vector<std::string>();
    for (const std::string& column : columns)
      if (!shape.find(column)) known.push_back(column);
    if (!columns.empty() && known.size() == columns.size()) known.clear();
    if (!columns.empty()) {
      // Each keeps its place among the names.
      for (std::string_view& field : fields)
        if (std::find(columns.begin(), columns.end(), field) != columns.end()) field = "";
    } else if (row->form == CoordinateForm::numbers) {
      const std::vector<NameMatch> matches = matchParts(shape.names, row->parts, row->fewest, NameRule::any);
      for (std::size_t i = 0; i < row->fewest; ++i) {
        if (matches[i].field) {
          fields[*matches[i].field] = "";
          continue;
        }
        known.push_back(row->parts[i].name);
        known.insert(known.end(), row->parts[i].aliases.begin(), row->parts[i].aliases.end());
      }
    } else {
      known.push_back(row->name);
      known.insert(known.end(), row->aliases.begin(), row->aliases.end());
    }
    for (const std::string_view name : known)
      if (const std::string_view field = nearest(name); !field.empty())
        return "; is " + quoted(field) + " meant for " + std::string(name) + "?";
  }
  return "";
}

}  // namespace viewproj::cmd
