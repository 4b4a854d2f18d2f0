#include "input/field.hpp"

#include <algorithm>

#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

using Fields = std::vector<const Field*>;

bool contains(FieldList list, const Field& field) { return std::find(list.begin(), list.end(), &field) != list.end(); }

std::vector<std::string_view> spelledNames(const Fields& fields, Spelling spelled) {
  std::vector<std::string_view> names;
  for (const Field* field : fields) names.push_back(spelled(*field));
  return names;
}

/// "nearWidth and nearHeight", or what one of is enough; empty where one of them has no name.
std::string labelOf(const Way& way, Spelling spelled) {
  std::vector<std::string_view> names = spelledNames({way.keys.begin(), way.keys.end()}, spelled);
  if (way.anyKey) names.resize(1);
  for (const std::string_view name : names)
    if (name.empty()) return "";
  return joined(names, " and ");
}

/// Of those of one label one, in order.
std::vector<std::string> labelsOf(const std::vector<const Way*>& ways, Spelling spelled) {
  std::vector<std::string> labels;
  for (const Way* way : ways)
    if (const std::string label = labelOf(*way, spelled); !label.empty() && (labels.empty() || labels.back() != label))
      labels.push_back(label);
  return labels;
}

std::string alternativesOf(const std::vector<const Way*>& ways, Spelling spelled) {
  std::vector<std::string> labels = labelsOf(ways, spelled);
  for (const Way* way : ways)
    if (way->anyKey)
      for (const Field* key : way->keys.subspan(1)) labels.emplace_back(spelled(*key));
  return alternatives({labels.begin(), labels.end()});
}

/// The two have a key in common.
bool shareKey(const Way& one, const Way& other) {
  return std::any_of(one.keys.begin(), one.keys.end(), [&](const Field* key) { return contains(other.keys, *key); });
}

/// The first that holds, or null.
template <class List, class Condition>
const Field* firstOf(const List& fields, const Condition& condition) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field* field) { return condition(*field); });
  return found == fields.end() ? nullptr : *found;
}

}  // namespace

bool Way::uses(const Field& field) const noexcept {
  return contains(keys, field) || contains(with, field) || contains(may, field);
}

bool ObjectForm::has(std::string_view name) const noexcept {
  return std::any_of(fields.begin(), fields.end(), [&](const Field* field) { return field->name == name; });
}

std::vector<std::string_view> namesOf(FieldList fields) {
  std::vector<std::string_view> names;
  for (const Field* field : fields) names.push_back(field->name);
  return names;
}

std::string formInWords(const Field& field) {
  switch (field.form) {
    case ValueForm::anything:  // as its value
      return "any value";      // a node of glTF has them, which no page is about
    case ValueForm::text:
      return "text";
    case ValueForm::label:
      return "text or number";
    case ValueForm::flag:
      return "true or false";
    case ValueForm::number:
      return "number";
    case ValueForm::positive:
      return "number above 0";
    case ValueForm::natural:
      return "number from 0";
    case ValueForm::zero:
      return "0";
    case ValueForm::ratio:
      return "number or \"16/9\"";
    case ValueForm::angle:
      return "0 to 180 degrees";
    case ValueForm::elevation:
      return "-90 to 90 degrees";
    case ValueForm::turn:
      return "degrees";
    case ValueForm::pair:
    case ValueForm::range:
      return "[a, b]";
    case ValueForm::triple:  // as its value
    case ValueForm::turns:   // the same
      return "[a, b, c]";    // turns have them, which no page lists
    case ValueForm::direction:
      return "[x, y, z]";
    case ValueForm::position:
      return "[x, y, z] or {" + joined(namesOf(field.object->fields)) + "}";
    case ValueForm::quaternion:
      return "[x, y, z, w]";
    case ValueForm::rigid:
      return "4 rows of 4";
    case ValueForm::points:
      return "3 of [x, y, z]";
    case ValueForm::word:
      return alternatives(field.words());
    case ValueForm::object:
      return field.object ? "{" + joined(namesOf(field.object->fields)) + "}" : "object";
    case ValueForm::objects:
      return "array of objects";
  }
  return "";  // these are all
}

ChosenWay chooseWay(const ObjectForm& form, const std::function<bool(const Field&)>& has, Spelling spelled) {
  const auto lacks = [&](const Field& field) { return !has(field); };
  std::vector<const Way*> all, used;
  for (const Way& way : form.ways) {
    all.push_back(&way);
    if (firstOf(way.keys, has)) used.push_back(&way);
  }
  const auto waysWith = [&](const Field& field) {
    std::vector<const Way*> ways = all;
    std::erase_if(ways, [&](const Way* way) { return !way->uses(field); });
    return alternativesOf(ways, spelled);
  };
  Fields given;  // of the fields that the ways speak of
  for (const Field* field : form.fields)
    if (std::any_of(all.begin(), all.end(), [&](const Way* way) { return way->uses(*field); }) && has(*field))
      given.push_back(field);

  if (used.empty()) {
    if (!given.empty() && form.aim.empty())
      return {nullptr, "needs one of " + waysWith(*given.front()) + " beside it", given.front()};
    if (form.aim.empty()) return {};
    return {nullptr, "has no " + std::string(form.aim) + "; expected one of " + alternativesOf(all, spelled)};
  }
  const bool ofOneKey =
      std::all_of(used.begin(), used.end(), [&](const Way* way) { return shareKey(*way, *used.front()); });
  if (!ofOneKey) {
    std::vector<const Way*> apart;
    for (const Way* way : used)
      if (std::none_of(apart.begin(), apart.end(), [&](const Way* other) { return shareKey(*way, *other); }))
        apart.push_back(way);
    std::vector<std::string> labels = labelsOf(apart, spelled);
    for (std::size_t i = 0; i < apart.size(); ++i)  // of several that are keys, the one that is there
      if (apart[i]->anyKey) labels[i] = spelled(*firstOf(apart[i]->keys, has));
    return {nullptr,
            "has " + together({labels.begin(), labels.end()}) + "; expected one of " + alternativesOf(all, spelled)};
  }

  // All of these have a key of the first: the first into which what is given fits.
  std::vector<std::string_view> missing;
  const Field* surplus = nullptr;
  for (const Way* way : used) {
    const Field* const unfit = firstOf(given, [&](const Field& field) { return !way->uses(field); });
    const Field* lacking = firstOf(way->with, lacks);
    if (!lacking && !way->anyKey) lacking = firstOf(way->keys, lacks);
    if (!unfit && !lacking) return {way, "", nullptr};
    if (unfit)
      surplus = unfit;
    else if (std::find(missing.begin(), missing.end(), spelled(*lacking)) == missing.end())
      missing.push_back(spelled(*lacking));
  }
  if (!missing.empty())
    return {nullptr,
            "needs " + alternatives(missing) + " beside " + std::string(spelled(*firstOf(used.front()->keys, has)))};
  // Where another way of the same key takes it, all the rest is in its way.
  const bool oftenGoes = std::any_of(used.begin(), used.end(), [&](const Way* way) { return way->uses(*surplus); });
  std::erase_if(given, [&](const Field* field) {
    return field == surplus || (!oftenGoes && !contains(used.front()->keys, *field));
  });
  return {nullptr,
          "does not go with " + together(spelledNames(given, spelled)) + "; it goes with " + waysWith(*surplus),
          surplus};
}

}  // namespace viewproj::cmd
