#include "input/kinds/found.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "input/value_form.hpp"
#include "text/format_number.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

const nlohmann::json* element(const nlohmann::json& array, const std::string& step) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  const bool isThere = error == std::errc() && end == step.data() + step.size() && index < array.size();
  return isThere && !array[index].is_null() ? &array[index] : nullptr;
}

bool flatten(const nlohmann::json& value, std::vector<double>& numbers) {
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return true;
  }
  if (!value.is_array()) return false;
  return std::all_of(value.begin(), value.end(), [&](const auto& part) { return flatten(part, numbers); });
}

/// "1 0 0 2.5e-3": numbers between blanks, at least two.
bool numbersInText(std::string_view text, std::vector<double>& numbers) {
  while (true) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return numbers.size() > 1;
    const std::size_t end = std::min(text.find_first_of(" \t", first), text.size());
    const auto number = parseNumber(text.substr(first, end - first));
    if (!number) return false;
    numbers.push_back(*number);
    text.remove_prefix(end);
  }
}

/// "3d": three doubles in each place of the matrix.
std::size_t channelsOf(const ObjectReader& stored) {
  std::size_t channels = 1;
  if (stored.isString("dt")) {
    const std::string_view type = *stored.text("dt");
    (void)std::from_chars(type.data(), type.data() + type.size(), channels);
  }
  return channels;
}

/// How many numbers a row of a matrix of FileStorage has, up to six; 0: it has other ones.
std::size_t storedColumns(const ObjectReader& stored) {
  const double columns = stored.number("cols").value_or(0) * static_cast<double>(channelsOf(stored));
  return columns >= 1 && columns <= 6 ? static_cast<std::size_t>(columns) : 0;
}

}  // namespace

std::optional<Found> follow(const Document& document, const Found& from, const Steps& steps) {
  Found at = from;
  for (const std::string& step : steps) {
    const nlohmann::json* next = nullptr;
    if (at.value->is_object())
      next = ObjectReader(document, *at.value, at.path).find(step);
    else if (at.value->is_array())
      next = element(*at.value, step);
    if (!next) return std::nullopt;
    at.value = next;
    at.path.push_back(step);
  }
  return at;
}

bool numbersOf(const Document& document, const Found& found, std::vector<double>& numbers) {
  if (found.value->is_string()) return numbersInText(found.value->get_ref<const std::string&>(), numbers);
  if (!found.value->is_object()) return found.value->is_array() && flatten(*found.value, numbers);
  if (const auto coordinates = coordinatesIn(*found.value, 3, 4)) {
    numbers = *coordinates;
    return true;
  }
  // As FileStorage writes a matrix.
  const ObjectReader stored(document, *found.value, found.path);
  for (const char* const said : {"rows", "cols", "dt"}) (void)stored.has(said);
  const nlohmann::json* const data = stored.find("data");
  return data && data->is_array() && flatten(*data, numbers);
}

bool isIdentity(std::span<const double> m) {
  if (m.size() != 9 && m.size() != 12 && m.size() != 16) return false;
  const std::size_t columns = m.size() == 9 ? 3 : 4;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (m[i] != (i / columns == i % columns ? 1 : 0)) return false;
  return true;
}

void requireStored(const Document& document, const Found& found, std::size_t count) {
  if (!found.value->is_object() || !found.value->contains("data")) return;
  const ObjectReader stored(document, *found.value, found.path);
  const auto rows = stored.number("rows"), columns = stored.number("cols");
  if (!rows || !columns) return;
  const std::size_t channels = channelsOf(stored);
  if (*rows * *columns * static_cast<double>(channels) == static_cast<double>(count)) return;
  stored.fail("data", "has " + std::to_string(count) + " numbers; expected rows x cols of them, which are " +
                          formatNumber(*rows) + " x " + formatNumber(*columns));
}

std::size_t rowsOf(const Document& document, const Found& found) {
  if (found.value->is_array())
    return std::any_of(found.value->begin(), found.value->end(), [](const auto& row) { return row.is_structured(); })
               ? found.value->size()
               : 0;
  if (!found.value->is_object()) return 0;
  const ObjectReader stored(document, *found.value, found.path);
  const nlohmann::json* const data = stored.find("data");
  const std::size_t columns = storedColumns(stored);
  if (!data || !data->is_array() || columns == 0) return 0;
  requireStored(document, found, data->size());
  return data->size() / columns;
}

std::optional<std::array<double, 2>> shapeOf(const Document& document, const Found& found) {
  if (found.value->is_object()) {
    const ObjectReader stored(document, *found.value, found.path);
    const auto rows = stored.number("rows"), columns = stored.number("cols");
    if (!rows || !columns) return std::nullopt;
    return std::array{*rows, *columns};
  }
  if (!found.value->is_array() || found.value->empty()) return std::nullopt;
  const auto& first = found.value->front();
  const bool isEven = std::all_of(found.value->begin(), found.value->end(), [&](const nlohmann::json& row) {
    return row.is_array() && row.size() == first.size() &&
           std::all_of(row.begin(), row.end(), [](const auto& each) { return each.is_number(); });
  });
  if (!isEven) return std::nullopt;
  return std::array{static_cast<double>(found.value->size()), static_cast<double>(first.size())};
}

bool isSame(const Document& document, const Found& a, const Found& b) {
  if (*a.value == *b.value) return true;
  std::vector<double> ofA, ofB;
  return numbersOf(document, a, ofA) && numbersOf(document, b, ofB) && ofA == ofB;
}

bool numbersOfRow(const Document& document, const Found& found, std::size_t row, std::vector<double>& numbers) {
  if (found.value->is_array())
    return row < found.value->size() && numbersOf(document, {found.path, &(*found.value)[row]}, numbers);
  const ObjectReader stored(document, *found.value, found.path);
  const nlohmann::json* const data = stored.find("data");
  const std::size_t size = storedColumns(stored);
  if (!data || !data->is_array() || (row + 1) * size > data->size()) return false;
  for (std::size_t i = row * size; i < (row + 1) * size; ++i)
    if (!flatten((*data)[i], numbers)) return false;
  return true;
}

}  // namespace viewproj::cmd
