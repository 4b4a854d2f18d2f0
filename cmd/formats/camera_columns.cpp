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
constexpr std::string_view kDistortion = "distortion";
constexpr std::string_view kLensNumbers = "k1 k2 k3 k4 k5 k6 p1 p2 xi alpha beta omega";

/// Names that count where all of them are there, by their letters and digits, or as they are where they have a _.
struct Family {
  std::string_view names, paths;
  bool isClear = true;  ///< in a record too
};
constexpr std::string_view kPlace = "position.x position.y position.z", kSize = "viewport.width viewport.height",
                           kTranslation = "tx ty tz",
                           kVector =
                               "cameraFromWorld.rotationVector.x cameraFromWorld.rotationVector.y "
                               "cameraFromWorld.rotationVector.z",
                           kVectorPlace =
                               "cameraFromWorld.translation.x cameraFromWorld.translation.y "
                               "cameraFromWorld.translation.z";
/// rvec is the first: tx, ty, tz beside it are tvec.
constexpr Family kFamilies[] = {
    {"rvecx rvecy rvecz", kVector},    {"x0 y0 z0", kPlace},           {"px py pz", kPlace},
    {"c_x c_y c_z", kPlace},           {"posx posy posz", kPlace},     {kTranslation, kPlace},
    {"easting northing", kPlace},      {"width height", kSize, false}, {"w h", kSize, false},
    {"imagewidth imageheight", kSize}, {"imgwidth imgheight", kSize},  {"tvecx tvecy tvecz", kVectorPlace}};
/// No fields of ours: a focal length in pixels both ways, one that counts the diagonal of 36 x 24 mm, and an angle
/// across or up. Each with its columns.
constexpr std::string_view kF = "projection.f", kF35 = "projection.f35", kFov = "projection.fov";
constexpr std::string_view kOthers[][2] = {
    {kF, "f focal focalpx focallengthpx"},
    {kF35, "focallengthin35mmformat focallengthin35mmfilm focallength35mm f35mm"},
    {kFov, "fov fieldofview"}};
/// What says the lens otherwise than in pixels, by another name than its own.
constexpr std::string_view kBesidePixels = "f focal focalpx focallengthpx hfov vfov dfov";

/// Columns of Metashape begin so.
constexpr std::string_view kOfMetashape[] = {"X/", "Y/", "Z/"};

/// "x" of "camera_x" and "camX"; a column that is ours with its front stays whole. "pitch" of "pitch_deg".
std::string_view bareName(std::string_view column) {
  for (const std::string_view front : kOfMetashape)
    if (column.starts_with(front)) return column.substr(front.size());
  for (const std::string_view unit : {"_deg", "_degrees", "_m", "_px"})
    if (column.ends_with(unit)) column.remove_suffix(unit.size());
  for (const std::string_view front : {"camera", "cam"}) {
    if (!sameButForCase(column.substr(0, front.size()), front) || !pathOfColumn(column, true).empty()) continue;
    std::string_view rest = column.substr(front.size());
    while (!rest.empty() && lettersOf(rest.substr(0, 1)).empty()) rest.remove_prefix(1);
    return rest.empty() ? column : rest;
  }
  return column;
}

/// "k1" of "k1" and "distortion.k1"; empty for a column of something else.
std::string_view coefficientOf(std::string_view column) {
  std::string letters = lettersOf(column);
  if (letters.starts_with(kDistortion)) letters.erase(0, kDistortion.size());
  for (const std::string_view name : wordsIn(kLensNumbers))
    if (name == letters) return name;
  return "";
}

bool isEmpty(const Json& cell) {
  return cell.is_null() || (cell.is_string() && cell.get_ref<const std::string&>().empty());
}

constexpr std::string_view kPyr[] = {"pitch", "yaw", "roll"};

/// The columns of a row's turns, where they are no heading: their order, and their names as it lists them. The yaw of a
/// robot turns the other way than that of a compass.
std::optional<std::pair<std::string, std::span<const std::string_view>>> turnsOf(const CameraColumns& columns,
                                                                                 const Node& row, bool isOpk,
                                                                                 bool isCompass) {
  if (isOpk) return {{"opk", kOpk}};
  const auto yaw = columns.cellAt(row, "yaw"), order = columns.cellAt(row, "order");
  if (!yaw || isCompass || columns.cellAt(row, "heading")) return std::nullopt;
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

/// The members of these names, null where there are none.
Json listOf(const Json& object, std::string_view names) {
  Json list = Json::array();
  for (const std::string_view name : wordsIn(names)) list.push_back(object.value(std::string(name), Json()));
  return list;
}

}  // namespace

CameraColumns::CameraColumns(const Json& columns, bool isRecord, bool hasNorth) {
  for (const auto& [column, cell] : columns.items()) names_[column] = bareName(column);
  const auto anyIs = [&](const auto& is) {
    return std::any_of(names_.begin(), names_.end(), [&](const auto& name) { return is(name.second); });
  };
  const auto isNamed = [](std::string_view column, std::string_view names) {
    return isAmong(lettersOf(column), names);
  };
  const bool hasBox = isRecord && std::any_of(names_.begin(), names_.end(),
                                              [&](const auto& name) { return isNamed(name.first, "width w"); });
  const auto isOfBox = [&](std::string_view column) { return hasBox && isNamed(column, "height h"); };
  onEarth_ = anyIs([](std::string_view name) { return pathOfColumn(name, true) == "position.lat"; });
  for (const char* own : {"X/Easting", "X/Longitude", "Accuracy_X/Y/Z_(m)", "Yaw_est"})
    isOfMetashape_ = isOfMetashape_ || columns.contains(own);
  onMap_ = anyIs([](std::string_view name) { return lettersOf(name) == "easting"; });
  hasNorth_ = hasNorth || onEarth_ || onMap_;
  isRobots_ = !hasNorth_ && anyIs([](std::string_view name) { return sameButForCase(name, "yaw"); });
  isOpk_ = std::all_of(std::begin(kOpk), std::end(kOpk), [&](std::string_view turn) {
    return anyIs([&](std::string_view name) { return sameButForCase(name, turn); });
  });
  for (const auto& [column, cell] : columns.items()) {
    std::string& path = paths_[column];
    if (isOfBox(column)) continue;
    const std::string& name = nameOf(column);
    const std::string_view coefficient = coefficientOf(name);
    const std::string letters = lettersOf(name);
    path = isAmong(letters, "distortionmodel model cameramodel") ? "distortion.model"
           : coefficient.empty()                                 ? pathOfColumn(name, onEarth_)
                                                                 : std::string(kLens) + std::string(coefficient);
    for (const auto& [other, names] : kOthers)
      if (isAmong(letters, names)) path = other;
  }
  for (const auto& [names, ofNames, isClear] : kFamilies) {
    std::vector<std::string_view> found;
    for (const std::string_view name : wordsIn(names)) {
      std::string_view named;  // of two the one in pixels is the picture's
      for (const auto& [column, path] : paths_)
        if ((sameButForCase(nameOf(column), name) || lettersOf(nameOf(column)) == name) &&
            (named.empty() || (ofNames == kSize && column.ends_with("_px"))))
          named = column;
      if (!named.empty()) found.push_back(named);
    }
    const bool isOfVector = names == kTranslation && isOpenCv_;  // as tvec, beside rvec
    const std::vector<std::string_view> all = wordsIn(isOfVector ? kVectorPlace : ofNames);
    const bool isBare = std::any_of(found.begin(), found.end(), [&](auto column) { return nameOf(column) == column; });
    const bool isOther = (ofNames == kPlace && has("position")) || (isRecord && !isClear && isBare);
    if (found.size() != wordsIn(names).size() || isOther) continue;
    for (std::size_t i = 0; i < found.size(); ++i) paths_.find(found[i])->second = all[i];
    hasTranslation_ = hasTranslation_ || (names == kTranslation && !isOfVector);
    isOpenCv_ = isOpenCv_ || ofNames == kVector;
  }
  for (auto& [column, path] : paths_) {
    const std::string& name = nameOf(column);
    const bool isHeight = path.empty() && !isOfBox(column) && (isSeaLevelName(name) || sameButForCase(name, "height"));
    if (isHeight && isPath("position.x") && !isPath("position.z")) path = "position.z";
    if (path.empty() && !isRecord && isNamed(name, "width height")) path = "viewport." + lettersOf(name);
    // What says the lens in pixels counts before what says it otherwise.
    if ((path == kF35 || isNamed(name, kBesidePixels)) && isPath("projection.fx")) path = "";
    if (path == "position.height" && isSeaLevelName(name)) notes_.push_back(seaLevelNote(column));
  }
  if (!isRecord && isPath("heading") && !isRobots_ && isPath("position.x") && !onMap_ && !has("world") &&
      !has("convention")) {
    onMap_ = true;
    notes_.emplace_back(kEnuNote);
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

std::optional<Node> CameraColumns::cellAt(const Node& row, std::string_view name) const {
  for (const auto& [column, cell] : row.json().items())
    if (sameButForCase(nameOf(column), name)) return row.find(column);
  return std::nullopt;
}

bool CameraColumns::reads(const std::string& column) const {
  const std::string letters = lettersOf(nameOf(column));
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
  return (hasRotation() || isRobots_) && !isOpk_ && !isOpenCv_ && !has("cameraAxes") && !has("convention");
}

Json CameraColumns::documentOf(const Node& row) const {
  Json fields = Json::object();
  const auto turns = turnsOf(*this, row, isOpk_, hasNorth_);
  std::vector<Json> degrees(3);
  const auto requireFirst = [](bool isFirst, const Node& cell) {
    if (!isFirst) cell.fail("is said by another column too; keep one");
  };
  const auto putTurn = [&](std::string_view column, const Node& cell) {
    if (sameButForCase(column, "order")) {
      cell.mark();
      return true;
    }
    if (!turns) return false;
    const auto at = std::find_if(turns->second.begin(), turns->second.end(),
                                 [&](std::string_view name) { return sameButForCase(name, column); });
    if (at == turns->second.end()) return false;
    Json& turn = degrees[static_cast<std::size_t>(at - turns->second.begin())];
    requireFirst(turn.is_null(), cell);
    turn = numberOf(cell);
    return true;
  };
  if (const auto pitch = isOfMetashape_ && !isOpk_ ? cellAt(row, "pitch") : std::nullopt)
    pitch->fail("is 0 where Metashape's camera looks down; export omega, phi, kappa");
  NamedNumbers coefficients;
  std::string model;
  for (const auto& [column, cell] : row.json().items()) {
    const std::string& path = pathOf(column);
    if (path == kDistortion && cell.is_null()) fields[path] = cell;
    if (isEmpty(cell)) continue;
    const Node node = *row.find(column);
    const std::string& name = nameOf(column);
    if (putTurn(name, node)) continue;
    if (path.starts_with(kLens)) {
      const std::string coefficient = path.substr(kLens.size());
      requireFirst(std::none_of(coefficients.begin(), coefficients.end(),
                                [&](const auto& other) { return other.first == coefficient; }),
                   node);
      coefficients.emplace_back(coefficient, numberOf(node));
      continue;
    }
    const std::string letters = lettersOf(name);
    if (isAmong(letters, "width height") && path.starts_with("viewport") && !isPerspective_)
      node.fail("may be the picture's or the window's: call it viewport." + letters + " or projection." + letters +
                "; no column is an angle of view or a focal length, as fovX or fx");
    if (letters == "height" && path == "viewport.height" && isHeightUnclear_)
      node.fail("may be the picture's or the place's: call it viewport.height or position.height");
    if (path == kFov) node.fail("may be the angle across or up: call it fovX or fovY");
    if (path.empty()) continue;
    node.mark();
    if (path == "distortion.model") {
      requireFirst(model.empty(), node);
      model = node.text();
      continue;
    }
    const auto whole = fields.find(path.substr(0, path.find('.')));
    const bool isWhole = whole != fields.end() && path.find('.') != path.npos && !whole->is_object();
    requireFirst(!isWhole && placeAt(fields, path).is_null(), node);
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
    fields["projection"]["fovDiagonal"] = f.is_number() ? Json(fovOfEquivalent(f.get<double>())) : f;
  if (onMap_) fields.emplace("world", "enu");
  if (const auto q = fields.find("rotation"); q != fields.end() && q->is_object()) *q = listOf(*q, "x y z w");
  if (isOpenCv_) {
    for (auto& [part, numbers] : fields["cameraFromWorld"].items()) numbers = listOf(numbers, "x y z");
    fields.emplace("convention", "opencv");
  }
  if (turns && turns->first == "unreal") fields.emplace("convention", "unreal");
  std::replace(degrees.begin(), degrees.end(), Json(), Json(0));
  if (turns) fields["euler"] = {{"order", turns->first}, {"degrees", degrees}};
  Document camera{row.document().name + (row.path().empty() ? "" : ": " + row.path()),
                  std::make_shared<Json>(Json::object())};
  layOver(camera, fields);
  const bool statesLens = !model.empty() || !coefficients.empty();
  if (statesLens) setLens(*camera.root, row, model, coefficients);
  // Null takes the lens of what it is laid over.
  if (statesLens || fields.contains(kDistortion)) camera.root->emplace(kDistortion, nullptr);
  return std::move(*camera.root);
}

}  // namespace viewproj::cmd
