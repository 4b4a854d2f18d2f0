#include "input/importers/importer.hpp"

#include <nlohmann/json.hpp>

#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

/// Appends the numbers within; false at what is no number.
bool flatten(const nlohmann::json& value, std::vector<double>& numbers) {
  if (value.is_number()) {
    numbers.push_back(value.get<double>());
    return true;
  }
  if (!value.is_array()) return false;
  for (const auto& part : value)
    if (!flatten(part, numbers)) return false;
  return true;
}

}  // namespace

std::optional<ReadViewport> importedViewport(const Document& document, const ViewportDefaults& defaults) {
  const ObjectReader root(document, document.root(), {});
  try {
    return readViewport(root, defaults);
  } catch (const CameraError& e) {
    document.fail(undotted(e.field()), e.message());
  }
}

CameraFile imported(const Document& document, const Convention& convention, const std::optional<Pose>& pose,
                    const std::optional<Projection>& projection, const std::optional<ReadViewport>& viewport) {
  CameraFile file;
  file.name = document.name();
  file.convention = convention;
  file.pose = pose;
  file.projection = projection;
  if (!viewport) return file;
  const ObjectReader root(document, document.root(), {});
  return located(root, {}, [&] {
    if (projection && viewport->crop) file.projection = cropped(*projection, viewport->frame, *viewport->crop);
    file.viewport = viewport->tile();
    return file;
  });
}

std::string shortNumber(double value) { return formatDigits(value, 4); }

std::string shortNumbers(const ObjectReader& fields, std::initializer_list<std::string_view> keys) {
  std::string text;
  for (std::string_view key : keys) {
    const nlohmann::json* value = fields.find(key);
    if (value && value->is_number()) text += ", " + std::string(key) + " " + shortNumber(value->get<double>());
  }
  return text;
}

std::optional<std::vector<double>> flatNumbers(const ObjectReader& fields, std::string_view key, std::size_t count) {
  const nlohmann::json* value = fields.find(key);
  if (!value) return std::nullopt;
  std::vector<double> numbers;
  if (!value->is_array() || !flatten(*value, numbers) || (count > 0 && numbers.size() != count))
    fields.fail(key, "expected " + (count > 0 ? std::to_string(count) + " numbers" : "an array of numbers"));
  return numbers;
}

}  // namespace viewproj::cmd
