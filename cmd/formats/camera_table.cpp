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
constexpr std::string_view kCoefficients = "k1 k2 k3 k4 k5 k6 p1 p2 xi alpha beta omega";
/// What is written, in this order.
constexpr std::string_view kWritten =
    "name lat lon height heading x y z omega phi kappa order yaw pitch roll qx qy qz qw world fx fy cx cy near far "
    "viewport.width "
    "viewport.height "
    "distortion.model k1 k2 k3 k4 k5 k6 p1 p2 distortion.xi distortion.alpha distortion.beta distortion.omega";

/// "k1" of "k1" and "distortion.k1"; empty for a column of something else.
std::string_view coefficientOf(std::string_view column) {
  constexpr std::string_view kFront = "distortion.";
  if (column.starts_with(kFront)) column.remove_prefix(kFront.size());
  return isAmong(column, kCoefficients) ? column : "";
}

/// Where the value of a column stands in our document; empty: it is no field of ours.
std::string pathOf(std::string_view column, bool isOnEarth) {
  if (isAmong(column, "distortion.model model camera_model distortion_model")) return "distortion.model";
  return pathOfColumn(column, isOnEarth);
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

constexpr std::string_view kOpk[] = {"omega", "phi", "kappa"}, kRpy[] = {"roll", "pitch", "yaw"};

bool isOpk(const Node& row) {
  return std::all_of(std::begin(kOpk), std::end(kOpk), [&](std::string_view name) { return cellAt(row, name); });
}

/// The columns of a row's turns, where they are no heading: their order, and their names as it lists them. The yaw of a
/// robot turns the other way than that of a compass.
std::optional<std::pair<std::string, std::span<const std::string_view>>> turnsOf(const Node& row) {
  if (isOpk(row)) return {{"opk", kOpk}};
  const auto yaw = cellAt(row, "yaw"), order = cellAt(row, "order");
  if (!yaw || isOnEarth(row.json()) || cellAt(row, "heading")) return std::nullopt;
  const std::string name = order ? order->text() : "";
  if (name == "heading") return std::nullopt;
  if (name != "rpy")
    (order ? *order : *yaw)
        .fail("expected a column order beside yaw: rpy, turns about x, y, z, or heading, a compass's");
  return {{name, kRpy}};
}

/// A position, and a column of a turn or a lens beside it. A time and a pose alone are a trajectory.
bool recognises(const Node& root) {
  const Json& rows = root.json();
  if (!rows.is_array() || rows.empty() || !rows.front().is_object()) return false;
  const Json& row = rows.front();
  const bool onEarth = isOnEarth(row);
  bool hasPosition = false, hasTurn = isOpk(root[0]), hasLens = false;
  for (const auto& [column, cell] : row.items()) {
    if (cell.is_structured()) return false;
    const std::string path = pathOf(column, onEarth), first = path.substr(0, path.find('.'));
    hasPosition = hasPosition || first == "position";
    hasLens = hasLens || first == "projection";
    hasTurn = hasTurn || isAmong(first, "rotation heading target direction");
  }
  return hasPosition && (hasLens || (hasTurn && !holdsPoses(root)));
}

/// Where each column of a file stands in our document.
using Paths = std::unordered_map<std::string, std::string>;

Json documentOf(const Node& row, const Paths& paths) {
  const bool onEarth = isOnEarth(row.json());
  // Only an orthographic camera has a window of a size.
  const bool isPerspective = std::any_of(row.json().items().begin(), row.json().items().end(), [&](const auto& column) {
    const auto* const field = findField(pathOf(column.key(), onEarth));
    return field && field->types != 0 && (field->types & kOrthographic) == 0;
  });
  Json fields = Json::object();
  const auto turns = turnsOf(row);
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
    const std::string side = lowered(column);
    const bool isSize = (side == "width" || side == "height") && !onEarth;
    if (isSize && !isPerspective)
      node.fail("may be the picture's or the window's: call it viewport." + side + " or projection." + side);
    if (const std::string_view coefficient = coefficientOf(column); !coefficient.empty()) {
      coefficients.emplace_back(coefficient, numberOf(node));
      continue;
    }
    const auto found = paths.find(column);
    const std::string path = isSize                 ? "viewport." + side
                             : found == paths.end() ? pathOf(column, onEarth)
                                                    : found->second;
    if (path.empty()) continue;
    node.mark();
    if (path == "distortion.model") {
      model = node.text();
      continue;
    }
    const auto number = numbersIn(cell);
    Json& place = placeAt(fields, path);
    if (!place.is_null()) node.fail("is said by another column too; keep one");
    place = number && number->size() == 1 ? Json(number->front()) : cell;
  }
  if (const auto q = fields.find("rotation"); q != fields.end() && q->is_object())
    *q = {q->value("x", Json()), q->value("y", Json()), q->value("z", Json()), q->value("w", Json())};
  if (turns) fields["euler"] = {{"order", turns->first}, {"degrees", degrees}};
  Document camera{row.document().name + (row.path().empty() ? "" : ": " + row.path()),
                  std::make_shared<Json>(Json::object())};
  layOver(camera, fields);
  if (!model.empty() || !coefficients.empty()) setLens(*camera.root, row, model, coefficients);
  return std::move(*camera.root);
}

Import open(const Node& root) {
  const auto paths = std::make_shared<Paths>();
  for (const auto& [column, cell] : root.json().front().items())
    paths->emplace(column, pathOf(column, isOnEarth(root.json().front())));
  Import result;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const Node row = root[i];
    result.add(
        row.json().is_object() ? nameOf(row) : "", "", [row, paths] { return documentOf(row, *paths); }, row);
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
