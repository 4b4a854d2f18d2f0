// Tables of cameras, a row each: columns are our fields, or short names of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/field_columns.hpp"
#include "camera/patch.hpp"
#include "camera/read_lens.hpp"
#include "camera/values.hpp"
#include "formats/format.hpp"
#include "formats/poses.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "formats/writer.hpp"
#include "text/csv.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace table {

/// The first of these names the camera, in any letter case.
constexpr std::string_view kNameColumns = "name camera image imagename file filename photoid label id time";
constexpr std::string_view kLens = "lens.";  // before a coefficient, as the place of a column
constexpr std::string_view kCoefficients = "k1 k2 k3 k4 k5 k6 p1 p2 xi alpha beta omega";
/// What is written, in this order.
constexpr std::string_view kWritten =
    "name lat lon height heading x y z omega phi kappa order yaw pitch roll qx qy qz qw cameraAxes world fx fy cx cy "
    "near far "
    "viewport.width "
    "viewport.height "
    "distortion.model k1 k2 k3 k4 k5 k6 p1 p2 distortion.xi distortion.alpha distortion.beta distortion.omega";

/// Names that count where all of them are there, by their letters and digits, or as they are where they have a _.
struct Family {
  std::string_view names, paths;
};
constexpr std::string_view kPlace = "position.x position.y position.z", kSize = "viewport.width viewport.height";
constexpr Family kFamilies[] = {
    {"x0 y0 z0", kPlace},         {"px py pz", kPlace},    {"c_x c_y c_z", kPlace}, {"camx camy camz", kPlace},
    {"easting northing", kPlace}, {"width height", kSize}, {"w h", kSize},          {"imagewidth imageheight", kSize},
    {"imgwidth imgheight", kSize}};
/// No fields of ours: a focal length in pixels both ways, one that counts the diagonal of 36 x 24 mm, and an angle
/// across or up. Each with its columns.
constexpr std::string_view kOthers[][2] = {
    {"projection.f", "f focal focalpx focallengthpx"},
    {"projection.f35", "focallengthin35mmformat focallengthin35mmfilm focallength35mm f35mm"},
    {"projection.fov", "fov fovdeg fovdegrees fieldofview"}};

/// "k1" of "k1" and "distortion.k1"; empty for a column of something else.
std::string_view coefficientOf(std::string_view column) {
  constexpr std::string_view kFront = "distortion";
  std::string letters = lettersOf(column);
  if (letters.starts_with(kFront)) letters.erase(0, kFront.size());
  for (const std::string_view name : wordsIn(kCoefficients))
    if (name == letters) return name;
  return "";
}

/// The cell of a column, whose name counts in any letter case.
std::optional<Node> cellAt(const Node& row, std::string_view name) {
  for (const auto& [column, cell] : row.json().items())
    if (sameButForCase(column, name)) return row.find(column);
  return std::nullopt;
}

bool isOnEarth(const Json& row) {
  return std::any_of(row.items().begin(), row.items().end(),
                     [](const auto& column) { return pathOfColumn(column.key(), true) == "position.lat"; });
}

bool isOnMap(const Json& row) {
  return std::any_of(row.items().begin(), row.items().end(),
                     [](const auto& column) { return lettersOf(column.key()) == "easting"; });
}

bool isEmpty(const Json& cell) {
  return cell.is_null() || (cell.is_string() && cell.get_ref<const std::string&>().empty());
}

std::string nameOf(const Node& row) {
  for (const std::string_view column : wordsIn(kNameColumns))
    if (const auto cell = cellAt(row, column); cell && !isEmpty(cell->json())) {
      cell->mark();
      return cell->json().is_number() ? formatNumber(cell->number()) : cell->json().is_string() ? cell->text() : "";
    }
  return "";
}

constexpr std::string_view kOpk[] = {"omega", "phi", "kappa"}, kRpy[] = {"roll", "pitch", "yaw"},
                           kPyr[] = {"pitch", "yaw", "roll"};

bool isOpk(const Node& row) {
  return std::all_of(std::begin(kOpk), std::end(kOpk), [&](std::string_view name) { return cellAt(row, name); });
}

/// The columns of a row's turns, where they are no heading: their order, and their names as it lists them. The yaw of a
/// robot turns the other way than that of a compass.
std::optional<std::pair<std::string, std::span<const std::string_view>>> turnsOf(const Node& row, bool isCompass) {
  if (isOpk(row)) return {{"opk", kOpk}};
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

/// Where each column of a file stands in our document; empty: nowhere.
using Paths = std::map<std::string, std::string, std::less<>>;

bool hasPath(const Paths& paths, std::string_view path) {
  return std::any_of(paths.begin(), paths.end(), [&](const auto& column) { return column.second == path; });
}
bool hasField(const Paths& paths, std::string_view top) {
  return std::any_of(paths.begin(), paths.end(),
                     [&](const auto& column) { return column.second.substr(0, column.second.find('.')) == top; });
}

Paths pathsOf(const Json& row) {
  const bool onEarth = isOnEarth(row);
  Paths paths;
  for (const auto& [column, cell] : row.items()) {
    const std::string letters = lettersOf(column);
    std::string& path = paths[column];
    const std::string_view coefficient = coefficientOf(column);
    path = isAmong(letters, "distortionmodel model cameramodel") ? "distortion.model"
           : coefficient.empty()                                 ? pathOfColumn(column, onEarth)
                                                                 : std::string(kLens) + std::string(coefficient);
    for (const auto& [other, names] : kOthers)
      if (isAmong(letters, names)) path = other;
  }
  for (const auto& [names, ofNames] : kFamilies) {
    std::vector<std::string_view> columns;
    for (const std::string_view name : wordsIn(names))
      for (const auto& [column, path] : paths)
        if (sameButForCase(column, name) || lettersOf(column) == name) {
          columns.push_back(column);
          break;
        }
    const std::vector<std::string_view> all = wordsIn(ofNames);
    const bool isOther = ofNames == kPlace && hasField(paths, "position");
    if (columns.size() == wordsIn(names).size() && !isOther)
      for (std::size_t i = 0; i < columns.size(); ++i) paths.find(columns[i])->second = all[i];
  }
  for (auto& [column, path] : paths) {
    const bool isHeight = path.empty() && (isSeaLevelName(column) || sameButForCase(column, "height"));
    if (isHeight && hasPath(paths, "position.x") && !hasPath(paths, "position.z")) path = "position.z";
    if (path.empty() && isAmong(lettersOf(column), "width height")) path = "viewport." + lettersOf(column);
    // What says the lens in pixels counts before what says it otherwise.
    if ((path == kOthers[0][0] || path == kOthers[1][0]) && hasPath(paths, "projection.fx")) path = "";
  }
  return paths;
}

/// A position, and a column of a turn or a lens beside it. A time and a pose alone are a trajectory.
bool recognises(const Node& root) {
  const Json& rows = root.json();
  if (!rows.is_array() || rows.empty() || !rows.front().is_object()) return false;
  const Json& row = rows.front();
  if (std::any_of(row.begin(), row.end(), [](const Json& cell) { return cell.is_structured(); })) return false;
  const Paths paths = pathsOf(row);
  const bool hasTurn =
      isOpk(root[0]) || std::any_of(paths.begin(), paths.end(), [](const auto& column) {
        return isAmong(column.second.substr(0, column.second.find('.')), "rotation heading target direction");
      });
  return hasField(paths, "position") && (hasField(paths, "projection") || (hasTurn && !holdsPoses(root)));
}

/// What the columns of a file are, once for all rows.
struct Header {
  Paths paths;
  bool onEarth, onMap;
  bool isPerspective;    ///< only an orthographic camera has a window of a size
  bool isHeightUnclear;  ///< no other column is the place's

  explicit Header(const Json& columns)
      : paths(pathsOf(columns)),
        onEarth(hasPath(paths, "position.lat")),
        onMap(isOnMap(columns)),
        isPerspective(std::any_of(paths.begin(), paths.end(),
                                  [](const auto& column) {
                                    const auto* const field = findField(column.second);
                                    return column.second.starts_with("projection.f") ||
                                           (field && field->types != 0 && (field->types & kOrthographic) == 0);
                                  })),
        isHeightUnclear(onEarth && !hasPath(paths, "position.height") && !hasPath(paths, "position.altitude")) {}
};

Json documentOf(const Node& row, const Header& header) {
  Json fields = Json::object();
  const auto turns = turnsOf(row, header.onEarth || header.onMap);
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
    const std::string& path = header.paths.find(column)->second;
    if (path.starts_with(kLens)) {
      coefficients.emplace_back(path.substr(kLens.size()), numberOf(node));
      continue;
    }
    const std::string letters = lettersOf(column);
    if (isAmong(letters, "width height") && path.starts_with("viewport") && !header.isPerspective)
      node.fail("may be the picture's or the window's: call it viewport." + letters + " or projection." + letters);
    if (letters == "height" && path == "viewport.height" && header.isHeightUnclear)
      node.fail("may be the picture's or the place's: call it viewport.height or position.height");
    if (path == "projection.fov") node.fail("may be the angle across or up: call it fovX or fovY");
    if (path.empty()) continue;
    node.mark();
    if (path == "distortion.model") {
      model = node.text();
      continue;
    }
    const auto number = numbersIn(cell);
    const auto whole = fields.find(path.substr(0, path.find('.')));
    const bool isWhole = whole != fields.end() && path.find('.') != path.npos && !whole->is_object();
    if (isWhole || !placeAt(fields, path).is_null()) node.fail("is said by another column too; keep one");
    Json& place = placeAt(fields, path);
    place = number && number->size() == 1 ? Json(number->front()) : cell;
  }
  const auto take = [&](const char* name) {
    Json value;
    if (const auto projection = fields.find("projection"); projection != fields.end() && projection->contains(name)) {
      value = (*projection)[name];
      projection->erase(name);
    }
    return value;
  };
  if (const Json f = take("f"); !f.is_null()) fields["projection"].update({{"fx", f}, {"fy", f}});
  if (const Json f = take("f35"); !f.is_null())
    fields["projection"].update({{"focalLength", f}, {"sensorDiagonal", std::hypot(36, 24)}});
  if (header.onMap) fields.emplace("world", "enu");
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

Import open(const Node& root) {
  Json columns = root.json().front();
  for (const Json& row : root.json())
    if (row.is_object()) columns.insert(row.begin(), row.end());
  const auto header = std::make_shared<const Header>(columns);
  Import result;
  const auto has = [&](std::string_view top) { return hasField(header->paths, top); };
  result.hasUnclearAxes = (has("rotation") || has("worldFromCamera") || has("cameraFromWorld")) &&
                          (hasPath(header->paths, "projection.fx") || hasPath(header->paths, kOthers[0][0])) &&
                          !has("cameraAxes") && !has("convention");
  for (std::size_t i = 0; i < root.size(); ++i) {
    const Node row = root[i];
    result.add(
        row.json().is_object() ? nameOf(row) : "", "", [row, header] { return documentOf(row, *header); }, row);
  }
  return result;
}

// ---- Writing

using Cells = std::map<std::string, std::string, std::less<>>;

void addPose(const WrittenCamera& camera, Cells& cells) {
  const FieldValues values = readValues(camera.file.document);
  const auto* const position = values.find<Position>("position");
  if (position && position->place) {
    const HeadingPitchRoll computed = headingPitchRollOf(camera.pose, true);
    const bool isStated = values.has("heading");
    const auto add = [&](const char* name, double degrees) { cells[name] = formatNumber(degrees); };
    add("lat", position->place->lat);
    add("lon", position->place->lon);
    add("height", position->place->height);
    add("heading", degreesOf(isStated ? *values.find<Angle>("heading") : computed.heading));
    add("pitch", degreesOf(isStated ? values.valueOr<Angle>("pitch", 0) : computed.pitch));
    add("roll", degreesOf(isStated ? values.valueOr<Angle>("roll", 0) : computed.roll));
    return;
  }
  const auto [columns, place] = worldFromCamera(camera.pose, CameraAxes::RUB);
  const std::array<double, 4> q = quaternionOf(columns);
  const auto* const euler = values.find<EulerTurns>("euler");
  const bool isRpy = euler && euler->order->first == "rpy";
  const Vec3 turns = euler ? eulerDegreesOf(camera.pose, euler->order->second, CameraAxes::RUB) : Vec3{};
  const bool hasTurns = isRpy || (euler && euler->order->first == "opk");
  for (std::size_t i = 0; i < 3; ++i) {
    cells[std::string(1, "xyz"[i])] = formatNumber(place[i]);
    if (hasTurns) cells[std::string((isRpy ? kRpy : kOpk)[i])] = formatNumber(turns[i]);
  }
  if (isRpy) cells["order"] = "rpy";
  if (!hasTurns) cells["cameraAxes"] = "RUB";
  for (std::size_t i = 0; i < 4 && !hasTurns; ++i) cells[std::string("q") + "xyzw"[i]] = formatNumber(q[i]);
  if (camera.file.worldIsEcef || camera.file.worldIsEnu)
    cells["world"] = viewproj::cmd::nameOf(kWorlds, camera.file.worldIsEcef ? World::ecef : World::enu);
}

void addLens(const Lens& lens, Cells& cells) {
  cells["distortion.model"] = viewproj::cmd::nameOf(lens.model());
  const auto add = [&](const std::string& name, double value, bool always) {
    if (always || value != 0) cells[name] = formatNumber(value);
  };
  const bool isFisheye = lens.model() == LensModel::fisheye;
  const bool isBent = isFisheye || lens.model() == LensModel::brown || lens.model() == LensModel::omni;
  for (std::size_t i = 0; i < 6 && isBent; ++i) add("k" + std::to_string(i + 1), lens.k()[i], i < (isFisheye ? 4 : 2));
  for (std::size_t i = 0; i < 2 && isBent; ++i) add("p" + std::to_string(i + 1), lens.p()[i], false);
  add("distortion.xi", lens.xi(), lens.model() == LensModel::doubleSphere || lens.model() == LensModel::omni);
  add("distortion.alpha", lens.alpha(), lens.model() == LensModel::doubleSphere || lens.model() == LensModel::unified);
  add("distortion.beta", lens.beta(), lens.model() == LensModel::unified);
  if (lens.model() != LensModel::unified) cells.erase("distortion.beta");
  add("distortion.omega", lens.omega(), false);
}

Cells cellsOf(const WrittenCamera& camera) {
  Cells cells{{"name", camera.label()}};
  addPose(camera, cells);
  const Intrinsics k = camera.intrinsics(0.5);
  const Projection& p = *camera.file.projection;
  for (const auto& [name, value] : {std::pair("fx", k.fx),
                                    {"fy", k.fy},
                                    {"cx", k.cx},
                                    {"cy", k.cy},
                                    {"viewport.width", camera.width()},
                                    {"viewport.height", camera.height()}})
    cells[name] = formatNumber(value);
  if (hasDepth(p)) cells["near"] = formatNumber(p.zNear());
  if (std::isfinite(p.zFar())) cells["far"] = formatNumber(p.zFar());
  if (camera.file.lens) addLens(*camera.file.lens, cells);
  return cells;
}

}  // namespace table

extern const Format kTable{
    "csv", "a table of cameras (CSV, or JSON objects)", "", table::open, "r1* r2* r3*", table::recognises};

std::vector<WrittenFile> writeTable(std::span<const WrittenCamera> cameras, std::string_view) {
  std::vector<table::Cells> rows;
  for (const WrittenCamera& camera : cameras) rows.push_back(table::cellsOf(camera));
  std::vector<std::string_view> columns;
  for (const std::string_view column : wordsIn(table::kWritten))
    if (std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.contains(column); }))
      columns.push_back(column);
  std::string text = joined(columns, ",") + "\n";
  for (const table::Cells& row : rows)
    for (const std::string_view column : columns) {
      const auto cell = row.find(column);
      if (cell != row.end()) text += quotedIfNeeded(cell->second);
      text += column == columns.back() ? '\n' : ',';
    }
  return {{"", text}};
}

}  // namespace viewproj::cmd
