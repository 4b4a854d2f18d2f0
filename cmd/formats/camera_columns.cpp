#include "formats/camera_columns.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "camera/field_columns.hpp"
#include "camera/fields.hpp"
#include "camera/patch.hpp"
#include "camera/sea_level.hpp"
#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kLens = "lens.";  // before a coefficient, as the place of a column
constexpr std::string_view kLensNumbers = "k1 k2 k3 k4 k5 k6 p1 p2 xi alpha beta omega";

/// Names that count where all of them are there, by their letters and digits, or as they are where they have a _.
struct Family {
  std::string_view names, paths;
  bool isClear = true;  ///< in a record too
};
constexpr std::string_view kPlace = "position.x position.y position.z", kSize = "viewport.width viewport.height",
                           kTranslation = "tx ty tz";
constexpr Family kFamilies[] = {{"x0 y0 z0", kPlace},         {"px py pz", kPlace},
                                {"c_x c_y c_z", kPlace},      {"camx camy camz", kPlace},
                                {"posx posy posz", kPlace},   {kTranslation, kPlace},
                                {"easting northing", kPlace}, {"width height", kSize, false},
                                {"w h", kSize, false},        {"imagewidth imageheight", kSize},
                                {"imgwidth imgheight", kSize}};
/// No fields of ours: a focal length in pixels both ways, one that counts the diagonal of 36 x 24 mm, and an angle
/// across or up. Each with its columns.
constexpr std::string_view kF = "projection.f", kF35 = "projection.f35", kFov = "projection.fov";
constexpr std::string_view kOthers[][2] = {
    {kF, "f focal focalpx focallengthpx"},
    {kF35, "focallengthin35mmformat focallengthin35mmfilm focallength35mm f35mm"},
    {kFov, "fov fovdeg fovdegrees fieldofview"}};
/// What says the lens otherwise than in pixels, by another name than its own.
constexpr std::string_view kBesidePixels = "f focal focalpx focallengthpx hfov vfov dfov";

/// "k1" of "k1" and "distortion.k1"; empty for a column of something else.
std::string_view coefficientOf(std::string_view column) {
  constexpr std::string_view kFront = "distortion";
  std::string letters = lettersOf(column);
  if (letters.starts_with(kFront)) letters.erase(0, kFront.size());
  for (const std::string_view name : wordsIn(kLensNumbers))
    if (name == letters) return name;
  return "";
}

/// The cell of a column, whose name counts in any letter case.
std::optional<Node> cellAt(const Node& row, std::string_view name) {
  for (const auto& [column, cell] : row.json().items())
    if (sameButForCase(column, name)) return row.find(column);
  return std::nullopt;
}

bool isEmpty(const Json& cell) {
  return cell.is_null() || (cell.is_string() && cell.get_ref<const std::string&>().empty());
}

constexpr std::string_view kPyr[] = {"pitch", "yaw", "roll"};

/// The columns of a row's turns, where they are no heading: their order, and their names as it lists them. The yaw of a
/// robot turns the other way than that of a compass.
std::optional<std::pair<std::string, std::span<const std::string_view>>> turnsOf(const Node& row, bool isOpk,
                                                                                 bool isCompass) {
  if (isOpk) return {{"opk", kOpk}};
  const auto yaw = cellAt(row, "yaw"), order = cellAt(row, "order");
  if (!yaw || isCompass || cellAt(row, "heading")) return std::nullopt;
  const std::string name = order ? order->text() : "";
  if (name == "heading") return std::nullopt;
  if (name == "unreal") return {{name, kPyr}};
  if (name != "rpy")
    (order ? *order : *yaw)
        .fail(
            "expected a column order beside yaw: rpy, turns about x, y, z, unreal, of Unreal and CARLA, or heading, a "
            "compass's");
  return {{name, kRpy}};
}

/// The value of a cell: texts are numbers, or what --set reads.
Json cellValue(const Node& cell, const std::string& path) {
  const Json& value = cell.json();
  const auto number = numbersIn(value);
  if (number && !value.is_structured() && number->size() == 1) return number->front();
  if (!value.is_string() || !findField(path)) return value;
  try {
    return *setPatch(path + "=" + value.get_ref<const std::string&>()).value;
  } catch (const UsageError& e) {
    cell.fail(e.what());
  }
}

}  // namespace

CameraColumns::CameraColumns(const Json& columns, bool isRecord, bool hasNorth) {
  const auto anyIs = [&](const auto& is) {
    return std::any_of(columns.items().begin(), columns.items().end(),
                       [&](const auto& column) { return is(column.key()); });
  };
  onEarth_ = anyIs([](const std::string& name) { return pathOfColumn(name, true) == "position.lat"; });
  onMap_ = anyIs([](const std::string& name) { return lettersOf(name) == "easting"; });
  hasNorth_ = hasNorth || onEarth_ || onMap_;
  isRobots_ = !hasNorth_ && anyIs([](const std::string& name) { return sameButForCase(name, "yaw"); });
  isOpk_ = std::all_of(std::begin(kOpk), std::end(kOpk), [&](std::string_view turn) {
    return anyIs([&](const std::string& name) { return sameButForCase(name, turn); });
  });
  for (const auto& [column, cell] : columns.items()) {
    const std::string letters = lettersOf(column);
    std::string& path = paths_[column];
    const std::string_view coefficient = coefficientOf(column);
    path = isAmong(letters, "distortionmodel model cameramodel") ? "distortion.model"
           : coefficient.empty()                                 ? pathOfColumn(column, onEarth_)
                                                                 : std::string(kLens) + std::string(coefficient);
    for (const auto& [other, names] : kOthers)
      if (isAmong(letters, names)) path = other;
  }
  for (const auto& [names, ofNames, isClear] : kFamilies) {
    std::vector<std::string_view> found;
    for (const std::string_view name : wordsIn(names))
      for (const auto& [column, path] : paths_)
        if (sameButForCase(column, name) || lettersOf(column) == name) {
          found.push_back(column);
          break;
        }
    const std::vector<std::string_view> all = wordsIn(ofNames);
    const bool isOther = (ofNames == kPlace && has("position")) || (isRecord && !isClear);
    if (found.size() != wordsIn(names).size() || isOther) continue;
    for (std::size_t i = 0; i < found.size(); ++i) paths_.find(found[i])->second = all[i];
    hasTranslation_ = hasTranslation_ || names == kTranslation;
  }
  for (auto& [column, path] : paths_) {
    const bool isHeight = path.empty() && (isSeaLevelName(column) || sameButForCase(column, "height"));
    if (isHeight && isPath("position.x") && !isPath("position.z")) path = "position.z";
    if (path.empty() && !isRecord && isAmong(lettersOf(column), "width height")) path = "viewport." + lettersOf(column);
    // What says the lens in pixels counts before what says it otherwise.
    if ((path == kF35 || isAmong(lettersOf(column), kBesidePixels)) && isPath("projection.fx")) path = "";
    if (path == "position.height" && isSeaLevelName(column)) notes_.push_back(seaLevelNote(column));
  }
  isPerspective_ = std::any_of(paths_.begin(), paths_.end(), [](const auto& column) {
    const auto* const field = findField(column.second);
    return column.second.starts_with("projection.f") ||
           (field && field->types != 0 && (field->types & kOrthographic) == 0);
  });
  isHeightUnclear_ = onEarth_ && !isPath("position.height") && !isPath("position.altitude");
}

bool CameraColumns::isPath(std::string_view path) const {
  return std::any_of(paths_.begin(), paths_.end(), [&](const auto& column) { return column.second == path; });
}

bool CameraColumns::reads(const std::string& column) const {
  const std::string letters = lettersOf(column);
  return !pathOf(column).empty() || (isOpk_ && isAmong(letters, "phi kappa")) || (isRobots_ && letters == "order");
}

bool CameraColumns::has(std::string_view field) const {
  return std::any_of(paths_.begin(), paths_.end(),
                     [&](const auto& column) { return column.second.substr(0, column.second.find('.')) == field; });
}

bool CameraColumns::hasTurn() const {
  return isOpk_ || has("rotation") || has("euler") || has("heading") || has("target") || has("direction");
}

bool CameraColumns::hasRotation() const { return has("rotation") || has("worldFromCamera") || has("cameraFromWorld"); }

bool CameraColumns::lacksAxes() const {
  return (hasRotation() || isRobots_) && !isOpk_ && !has("cameraAxes") && !has("convention");
}

Json CameraColumns::documentOf(const Node& row) const {
  Json fields = Json::object();
  const auto turns = turnsOf(row, isOpk_, hasNorth_);
  std::vector<Json> degrees(3, 0);
  const auto putTurn = [&](std::string_view column, const Node& cell) {
    if (sameButForCase(column, "order")) {
      cell.mark();
      return true;
    }
    if (!turns) return false;
    const auto at = std::find_if(turns->second.begin(), turns->second.end(),
                                 [&](std::string_view name) { return sameButForCase(name, column); });
    if (at == turns->second.end()) return false;
    degrees[static_cast<std::size_t>(at - turns->second.begin())] = numberOf(cell);
    return true;
  };
  NamedNumbers coefficients;
  std::string model;
  for (const auto& [column, cell] : row.json().items()) {
    if (isEmpty(cell)) continue;
    const Node node = *row.find(column);
    if (putTurn(column, node)) continue;
    const std::string& path = pathOf(column);
    if (path.starts_with(kLens)) {
      coefficients.emplace_back(path.substr(kLens.size()), numberOf(node));
      continue;
    }
    const std::string letters = lettersOf(column);
    if (isAmong(letters, "width height") && path.starts_with("viewport") && !isPerspective_)
      node.fail("may be the picture's or the window's: call it viewport." + letters + " or projection." + letters +
                "; no column is an angle of view or a focal length, as fovX or fx");
    if (letters == "height" && path == "viewport.height" && isHeightUnclear_)
      node.fail("may be the picture's or the place's: call it viewport.height or position.height");
    if (path == kFov) node.fail("may be the angle across or up: call it fovX or fovY");
    if (path.empty()) continue;
    node.mark();
    if (path == "distortion.model") {
      model = node.text();
      continue;
    }
    const auto whole = fields.find(path.substr(0, path.find('.')));
    const bool isWhole = whole != fields.end() && path.find('.') != path.npos && !whole->is_object();
    if (isWhole || !placeAt(fields, path).is_null()) node.fail("is said by another column too; keep one");
    placeAt(fields, path) = cellValue(node, path);
  }
  const auto take = [&](std::string_view path) {
    Json value;
    const std::string name(path.substr(path.find('.') + 1));
    if (const auto projection = fields.find("projection"); projection != fields.end() && projection->contains(name)) {
      value = (*projection)[name];
      projection->erase(name);
    }
    return value;
  };
  if (const Json f = take(kF); !f.is_null()) fields["projection"].update({{"fx", f}, {"fy", f}});
  if (const Json f = take(kF35); !f.is_null())
    fields["projection"].update({{"focalLength", f}, {"sensorDiagonal", std::hypot(36, 24)}});
  if (onMap_) fields.emplace("world", "enu");
  if (const auto q = fields.find("rotation"); q != fields.end() && q->is_object())
    *q = {q->value("x", Json()), q->value("y", Json()), q->value("z", Json()), q->value("w", Json())};
  if (turns && turns->first == "unreal") fields.emplace("convention", "unreal");
  if (turns) fields["euler"] = {{"order", turns->first}, {"degrees", degrees}};
  Document camera{row.document().name + (row.path().empty() ? "" : ": " + row.path()),
                  std::make_shared<Json>(Json::object())};
  layOver(camera, fields);
  if (!model.empty() || !coefficients.empty()) setLens(*camera.root, row, model, coefficients);
  return std::move(*camera.root);
}

}  // namespace viewproj::cmd
