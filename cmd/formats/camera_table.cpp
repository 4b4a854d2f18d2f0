// Tables of cameras, a row each: columns are our fields, or short names of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/read_lens.hpp"
#include "camera/values.hpp"
#include "formats/camera_columns.hpp"
#include "formats/format.hpp"
#include "formats/poses.hpp"
#include "formats/writer.hpp"
#include "text/csv.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace table {

/// The first of these names the camera, in any letter case.
constexpr std::string_view kNameColumns =
    "name camera image imagename frame file filename sourcefile photo photoid label id time";
/// What is written, in this order.
constexpr std::string_view kWritten =
    "name lat lon height heading x y z omega phi kappa order yaw pitch roll qx qy qz qw cameraAxes world fx fy cx cy "
    "near far viewport.width viewport.height viewport.pixelCenter distortion.model k1 k2 k3 k4 k5 k6 p1 p2 "
    "distortion.xi distortion.alpha "
    "distortion.beta distortion.omega";

std::string nameOf(const Node& row) {
  for (const std::string_view name : wordsIn(kNameColumns))
    for (const auto& [column, value] : row.json().items())
      if (const auto cell = sameButForCase(column, name) ? row.find(column) : std::nullopt; cell && value != "") {
        cell->mark();
        return value.is_number() ? formatNumber(cell->number()) : value.is_string() ? cell->text() : "";
      }
  return "";
}

/// A position, and a column of a turn or a lens beside it, or what solvePnP gives. A time and a pose alone are a
/// trajectory.
bool recognises(const Node& root) {
  const Json& rows = root.json();
  if (!rows.is_array() || rows.empty() || !rows.front().is_object()) return false;
  const Json& row = rows.front();
  if (std::any_of(row.begin(), row.end(), [](const Json& cell) { return cell.is_structured(); })) return false;
  const CameraColumns columns(row);
  return columns.isOpenCv() ||
         (columns.has("position") && (columns.has("projection") || (columns.hasTurn() && !holdsPoses(root))));
}

Import open(const Node& root) {
  Json names = root.json().front();
  for (const Json& row : root.json())
    if (row.is_object()) names.insert(row.begin(), row.end());
  const auto columns = std::make_shared<const CameraColumns>(names);
  Import result;
  result.lacksAxes = columns->lacksAxes();
  result.hasRotation = columns->hasRotation();
  result.hasFocalPixels = columns->hasFocalPixels();
  result.hasTranslation = columns->hasTranslation();
  result.notes = columns->notes();
  for (std::size_t i = 0; i < root.size(); ++i) {
    const Node row = root[i];
    result.add(
        row.json().is_object() ? nameOf(row) : "", "", [row, columns] { return columns->documentOf(row); }, row);
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
  if (!hasTurns || isRpy) cells["cameraAxes"] = "RUB";
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
  const double pixelCenter = camera.file.viewport->pixelCenter;
  if (pixelCenter != 0.5) cells["viewport.pixelCenter"] = formatNumber(pixelCenter);
  const Intrinsics k = camera.intrinsics(pixelCenter);
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
