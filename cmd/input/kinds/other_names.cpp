#include "input/kinds/other_names.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "input/distortion_names.hpp"
#include "input/importers/importer.hpp"
#include "input/kinds/pose_names.hpp"
#include "input/kinds/pose_of.hpp"

namespace viewproj::cmd {
namespace {

enum class Change { crop, binning, flip };

struct ChangeName {
  std::string_view name;  ///< plain
  Change is;
};
/// What pixels may have gone through.
constexpr ChangeName kChangeNames[] = {
    {"crop", Change::crop},
    {"cropbox", Change::crop},
    {"cropped", Change::crop},
    {"cropregion", Change::crop},
    {"cropx", Change::crop},
    {"cropy", Change::crop},
    {"cropoffset", Change::crop},
    {"rotate", Change::flip},
    {"imagerotation", Change::flip},
    {"binningfactor", Change::binning},
    {"binning", Change::binning},
    {"binningx", Change::binning},
    {"binningy", Change::binning},
    {"binninghorizontal", Change::binning},
    {"binningvertical", Change::binning},
    {"flip", Change::flip},
    {"flipped", Change::flip},
    {"fliph", Change::flip},
    {"flipv", Change::flip},
    {"flipx", Change::flip},
    {"flipy", Change::flip},
    {"hflip", Change::flip},
    {"vflip", Change::flip},
    {"fliphorizontal", Change::flip},
    {"flipvertical", Change::flip},
    {"horizontalflip", Change::flip},
    {"verticalflip", Change::flip},
    {"mirror", Change::flip},
    {"mirrored", Change::flip},
};

/// Whether the row looks for the field, or for something in it, or says that it is nothing.
bool isNamed(const Kind& kind, const std::string& name, const nlohmann::json& value) {
  const auto leads = [&](const Steps& path) { return leadsTo(path, name, value); };
  const auto has = [&](const std::vector<Steps>& paths) { return std::any_of(paths.begin(), paths.end(), leads); };
  return isAmong(kind.passedOver, name) || readsField(kind, name, value) || has(kind.needs) || has(kind.models) ||
         (kind.distortion && has(*kind.distortion)) ||
         std::any_of(kind.only.begin(), kind.only.end(), [&](const auto& only) { return leads(only.path); });
}

/// The field, where the row does not read it. Does not count as read: --set of such a field is refused.
std::optional<Found> unread(const CameraPlace& camera, const Found& spot, std::string_view name) {
  if (!spot.value->is_object()) return std::nullopt;
  const auto item = spot.value->find(name);
  if (item == spot.value->end() || item->is_null()) return std::nullopt;
  if (isNamed(camera.kind(), std::string(name), *item)) return std::nullopt;
  Found field{spot.path, &*item};
  field.path.emplace_back(name);
  return field;
}

/// Numbers that are neither an identity nor all 0, or what cannot be told.
bool saysSomething(const Document& document, const Found& found) {
  if (found.value->is_number()) return *found.value != 0 && isTurnName(found.path.back());
  std::vector<double> numbers;
  if (!numbersOf(document, found, numbers)) return found.value->is_structured() && !found.value->empty();
  return !isIdentity(numbers) && !std::all_of(numbers.begin(), numbers.end(), [](double n) { return n == 0; });
}

/// Whether a value of a crop, a binning or a flip leaves the picture as it is.
bool leavesPicture(const nlohmann::json& value, Change change, const std::optional<Viewport>& pixels) {
  const bool cuts = change == Change::crop;
  if (value.is_structured()) {
    // An object of arrays is a box in the world, as a path of nerfstudio has.
    const auto isDeep = [](const nlohmann::json& part) { return part.is_structured(); };
    if (value.is_object() && std::any_of(value.begin(), value.end(), isDeep)) return true;
    return std::all_of(value.begin(), value.end(), [&](const nlohmann::json& part) {
      return (cuts && value.is_object() && !part.is_number()) || leavesPicture(part, change, pixels);
    });
  }
  if (value.is_string()) return saysNone(value.get_ref<const std::string&>());
  if (!value.is_number()) return value != true;
  const double number = value.get<double>();
  if (number == 0 || (change == Change::binning && number == 1)) return true;
  // The last pixel is one less.
  return cuts && (!pixels || number == pixels->width || number == pixels->height || number == pixels->width - 1 ||
                  number == pixels->height - 1);
}

}  // namespace

void requireWholePicture(const CameraPlace& camera, const std::optional<Viewport>& pixels) {
  const auto meanwhile = camera.document().withoutReading();
  for (const Found& spot : camera.lensSpots())
    for (const auto& item : spot.value->items()) {
      const auto known = std::find_if(std::begin(kChangeNames), std::end(kChangeNames), [&](const ChangeName& name) {
        return item.key().size() < 2 * name.name.size() && name.name == plainName(item.key());
      });
      if (known == std::end(kChangeNames) || leavesPicture(item.value(), known->is, pixels)) continue;
      const auto found = unread(camera, spot, item.key());
      if (!found) continue;
      camera.document().fail(found->path, "is not modelled, and the lens may count other pixels; --set " +
                                              dotted(found->path) + "=null leaves it out");
    }
}

void refuseSkew(const CameraPlace& camera) {
  for (const Found& spot : camera.lensSpots())
    for (const std::string_view name : {"skew", "alpha_c", "shear", "skew_coefficient"})
      if (const auto skew = unread(camera, spot, name); skew && skew->value->is_number() && *skew->value != 0)
        camera.document().fail(skew->path, "is a skew, and pixels of a skewed grid are not modelled; --set " +
                                               dotted(skew->path) + "=null leaves it out");
}

void refuseOddP(const CameraPlace& camera) {
  if (!camera.kind().has("K") || !camera.document().ownKinds().empty()) return;
  for (const std::string_view name : {"projection_matrix", "P", "p"}) {
    const auto odd = unread(camera, camera.own(), name);
    if (!odd || (name == "p" && !camera.own().value->contains("k"))) continue;
    std::vector<double> numbers;
    if (!numbersOf(camera.document(), *odd, numbers) || numbers.size() != 12)
      camera.document().fail(odd->path, "expected 12 numbers, the 3 rows of K [R | t]; --set " + dotted(odd->path) +
                                            "=null leaves it out");
  }
}

void requirePoseRead(const CameraPlace& camera, const CameraReading& reading) {
  if (reading.replacesPose || poseField(camera)) return;
  const auto meanwhile = camera.document().withoutReading();
  const Document& document = camera.document();
  for (const auto& item : camera.own().value->items()) {
    if (poseName(item.key()) != PoseName::certain) continue;
    const auto found = unread(camera, camera.own(), item.key());
    if (!found || !saysSomething(document, *found)) continue;
    const bool isNextToK = camera.find("K") && camera.kind().cameras.empty();
    document.fail(found->path,
                  "is a pose that is not read of " + camera.kind().form + "; " +
                      (isNextToK ? "call it T_cam_world or T_world_cam, which say what they map, or " : "") +
                      "give --position and --rotation; --set " + dotted(found->path) + "=null leaves it out");
  }
}

}  // namespace viewproj::cmd
