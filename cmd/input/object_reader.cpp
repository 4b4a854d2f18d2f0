// An object of a document, key by key.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "input/camera_forms.hpp"
#include "input/distortion_names.hpp"
#include "input/document.hpp"
#include "input/value_form.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 60;
  return text.size() > kMost ? text.substr(0, kMost) + "..." : text;
}

}  // namespace

ObjectReader::ObjectReader(const Document& document, const nlohmann::json& object, Path path)
    : document_(&document), object_(&object), path_(std::move(path)) {
  if (!object.is_object()) document.fail(path_, "expected an object");
}

Path ObjectReader::pathOf(const Key& key) const {
  Path path = path_;
  path.emplace_back(lookUp(key).first);
  return path;
}

std::pair<std::string_view, const nlohmann::json*> ObjectReader::lookUp(const Key& key) const {
  const auto under = [&](std::string_view name) {
    const auto found = object_->find(name);
    return found == object_->end() || found->is_null() ? nullptr : &*found;
  };
  if (const nlohmann::json* value = under(key.name)) return {key.name, value};
  if (key.field)
    for (const std::string_view other : key.field->aliases())
      if (const nlohmann::json* value = under(other); value && fits(*value, *key.field)) return {other, value};
  return {key.name, nullptr};
}

void ObjectReader::fail(const Key& key, const std::string& message) const { document_->fail(pathOf(key), message); }

void ObjectReader::fail(const std::string& message) const { document_->fail(path_, message); }

const nlohmann::json* ObjectReader::find(const Key& key) const {
  const nlohmann::json* const found = lookUp(key).second;
  if (document_->isAllRead()) return found;
  // The objects within are read on their own.
  const bool hasObjects =
      found && (found->is_object() || (found->is_array() && !found->empty() && found->front().is_object()));
  document_->noteRead(pathOf(key), !hasObjects || hasCoordinates(*found));
  if (!found && key.field)
    for (const std::string_view other : key.field->aliases()) document_->noteRead(pathOf(other), true);
  return found;
}

bool ObjectReader::has(const Key& key) const { return find(key) != nullptr; }

bool ObjectReader::isString(const Key& key) const {
  const nlohmann::json* value = find(key);
  return value && value->is_string();
}

bool ObjectReader::isObject(const Key& key) const {
  const nlohmann::json* value = find(key);
  return value && value->is_object();
}

bool ObjectReader::isArray(const Key& key) const {
  const nlohmann::json* value = find(key);
  return value && value->is_array();
}

std::optional<double> ObjectReader::number(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  const ValueForm form = key.field ? key.field->form : ValueForm::number;
  const auto number = numberIn(*value, form);
  if (!number)
    fail(key, "expected " + expectedNumber(form) + std::string(key.field ? key.field->hint : std::string_view()));
  return number;
}

double ObjectReader::requireNumber(const Key& key) const {
  const auto value = number(key);
  const bool isOption = document_->isTyped() && key.field && !key.field->option.empty();
  if (!value) fail("needs " + std::string(isOption ? key.field->option : key.name));
  return *value;
}

std::optional<bool> ObjectReader::flag(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_boolean()) fail(key, "expected true or false");
  return value->get<bool>();
}

std::optional<std::string> ObjectReader::string(const Key& key) const {
  if (const auto found = text(key)) return std::string(*found);
  return std::nullopt;
}

std::optional<std::string_view> ObjectReader::text(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_string()) fail(key, "expected a string");
  return value->get_ref<const std::string&>();
}

std::optional<std::vector<double>> ObjectReader::numbers(const Key& key, std::size_t fewest, std::size_t most) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  const ValueForm form = key.field ? key.field->form : ValueForm::number;
  const bool takesObject = key.field && key.field->form != ValueForm::pair && key.field->form != ValueForm::range;
  auto numbers = takesObject || value->is_array() ? coordinatesIn(*value, fewest, most, form) : std::nullopt;
  if (!numbers && form == ValueForm::turns)
    fail(key, "expected " + std::to_string(fewest) + " angles in an array, each " + expectedNumber(form));
  if (!numbers)
    fail(key, "expected " +
                  (fewest == most ? std::to_string(fewest) : std::to_string(fewest) + " to " + std::to_string(most)) +
                  " numbers in an array");
  return numbers;
}

std::optional<Vec3> ObjectReader::vec3(const Key& key) const {
  const auto v = numbers(key, 3, 3);
  if (!v) return std::nullopt;
  return Vec3{(*v)[0], (*v)[1], (*v)[2]};
}

std::optional<Mat4> ObjectReader::mat4(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  Mat4 matrix;
  bool good = value->is_array() && value->size() == 4;
  for (std::size_t i = 0; good && i < 4; ++i) {
    good = (*value)[i].is_array() && (*value)[i].size() == 4;
    for (std::size_t j = 0; good && j < 4; ++j) {
      good = (*value)[i][j].is_number();
      if (good) matrix[i][j] = (*value)[i][j].get<double>();
    }
  }
  if (!good) fail(key, "expected 4 rows of 4 numbers");
  return matrix;
}

std::optional<std::string> ObjectReader::label(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  if (!value->is_string() && !value->is_number()) fail(key, "expected a string or a number");
  return value->dump();
}

std::optional<std::vector<Vec3>> ObjectReader::vec3s(const Key& key, std::size_t count) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  std::vector<Vec3> vectors;
  for (const auto& item : *value) {
    const auto numbers = coordinatesIn(item, 3, 3);
    if (!numbers) break;
    vectors.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2]});
  }
  if (!value->is_array() || vectors.size() != count || value->size() != count)
    fail(key, "expected " + std::to_string(count) + " points [x, y, z]");
  return vectors;
}

std::optional<ObjectReader> ObjectReader::object(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  return ObjectReader(*document_, *value, pathOf(key));
}

ObjectList ObjectReader::objects(const Key& key) const {
  const nlohmann::json* value = find(key);
  if (!value) return {};
  if (!value->is_array()) fail(key, "expected an array of objects");
  return {*document_, *value, pathOf(key)};
}

ObjectList::ObjectList(const Document& document, const nlohmann::json& array, Path path)
    : document_(&document), array_(&array), path_(std::move(path)) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!document.isAllRead()) document.noteRead(pathOf(i), false);
    if (!array[i].is_object()) (void)(*this)[i];  // throws
  }
}

std::size_t ObjectList::size() const { return array_ ? array_->size() : 0; }

ObjectReader ObjectList::operator[](std::size_t index) const { return {*document_, (*array_)[index], pathOf(index)}; }

Path ObjectList::pathOf(std::size_t index) const {
  Path path = path_;
  path.push_back(std::to_string(index));
  return path;
}

namespace {

std::optional<std::size_t> indexBelow(const nlohmann::json& value, std::size_t count) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count) return std::nullopt;
  return value.get<std::size_t>();
}

std::string expectedIndex(std::size_t count, const char* what) {
  return "expected a whole number below " + std::to_string(count) + ", the number of " + what;
}

}  // namespace

std::optional<std::size_t> ObjectReader::index(const Key& key, std::size_t count, const char* what) const {
  const nlohmann::json* value = find(key);
  if (!value) return std::nullopt;
  const auto number = indexBelow(*value, count);
  if (!number) fail(key, expectedIndex(count, what));
  return number;
}

std::vector<std::size_t> ObjectReader::indices(const Key& key, std::size_t count, const char* what) const {
  const nlohmann::json* value = find(key);
  if (!value) return {};
  if (!value->is_array()) fail(key, "expected an array of numbers");
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < value->size(); ++i) {
    const auto number = indexBelow((*value)[i], count);
    if (!number) {
      Path path = pathOf(key);
      path.push_back(std::to_string(i));
      document_->fail(path, expectedIndex(count, what));
    }
    result.push_back(*number);
  }
  return result;
}

void ObjectReader::allow(const ObjectForm& form) const {
  for (const auto& item : object_->items())
    if (!form.has(item.key())) allowKey(item.key(), form);
}

void ObjectReader::allowKey(const std::string& key, const ObjectForm& form) const {
  const nlohmann::json& value = object_->at(key);
  for (const VagueName& vague : form.vague)
    if (vague.name == key) fail(key, std::string(vague.message));
  for (const Field* field : form.fields) {
    const auto names = field->aliases();
    if (std::find(names.begin(), names.end(), key) == names.end()) continue;
    if (value.is_null()) return;
    if (!fits(value, *field)) fail(key, "is another name of " + std::string(*field) + ", but no value of one");
    // What was found first, if it is not this one.
    if (const auto [first, other] = lookUp(*field); first != key)
      fail(key, "is another name of " + std::string(first) + ", which is given too" +
                    (other ? ": " + shortened(other->dump()) + " and " + shortened(value.dump()) : ""));
    return;
  }
  if (key.size() > 1 && distortionName(key) != DistortionName::none)
    document_->fail(
        pathOf(key),
        "is not a known field here: a lens that distorts is not modelled; undistort points or picture first", false);
  const std::string place = whereItBelongs(key, form);
  document_->fail(pathOf(key),
                  "is not a known field here" + (place.empty() ? suggestion(key, namesOf(form.fields)) : place), false);
}

const Way* ObjectReader::way(const ObjectForm& form) const {
  const ChosenWay chosen = chooseWay(
      form, [&](const Field& field) { return has(field); }, document_->isTyped() ? byOption : byName);
  if (chosen.fault.empty()) return chosen.way;
  if (chosen.at) fail(*chosen.at, chosen.fault);
  fail(chosen.fault);
}

void ObjectReader::failChoice(const Key& key, const std::string& name,
                              const std::vector<std::string_view>& known) const {
  fail(key, "is none of the known names" + suggestion(name, known));
}

}  // namespace viewproj::cmd
