// Tables of cameras, a row each: our own fields as columns; and drone pictures, as exiftool -csv -n or -json -n writes
// them. Source: DJI's XMP tags.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/fields.hpp"
#include "camera/patch.hpp"
#include "camera/read_lens.hpp"
#include "camera/read_pose.hpp"
#include "formats/format.hpp"
#include "formats/poses.hpp"
#include "formats/value.hpp"
#include "formats/writer.hpp"
#include "text/csv.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace exif {

/// A number of a row; nothing where the cell is empty.
std::optional<double> cellOf(const Node& row, std::string_view name) {
  const auto cell = row.find(name);
  if (!cell || (cell->json().is_string() && cell->json().get_ref<const std::string&>().empty())) return std::nullopt;
  const auto number = numbersIn(cell->json());
  if (!number || number->size() != 1) cell->fail("is no plain number; exiftool writes them with -n");
  return number->front();
}

double requireCell(const Node& row, std::string_view name) {
  if (const auto number = cellOf(row, name)) return *number;
  row.fail("needs " + std::string(name));
}

Json documentOf(const Node& row) {
  const auto place = [&](std::string_view name) { return requireCell(row, name); };
  Json camera{{"position",
               {{"lat", place("GPSLatitude")}, {"lon", place("GPSLongitude")}, {"height", place("AbsoluteAltitude")}}},
              {"heading", place("GimbalYawDegree")},
              {"pitch", place("GimbalPitchDegree")},
              {"roll", cellOf(row, "GimbalRollDegree").value_or(0)}};
  const auto w = cellOf(row, "ImageWidth"), h = cellOf(row, "ImageHeight");
  if (w && h) camera["viewport"] = {{"width", *w}, {"height", *h}};
  if (const auto dewarp = cellOf(row, "DewarpFlag"); dewarp && *dewarp == 0 && row.find("DewarpData"))
    row.find("DewarpData")->fail("is the lens of these pictures, which is not read; dewarp them, or leave it out");
  // From options otherwise: FocalLengthIn35mmFormat is a whole number, and 2 % off at 24.
  const auto f = cellOf(row, "CalibratedFocalLength"), x = cellOf(row, "CalibratedOpticalCenterX"),
             y = cellOf(row, "CalibratedOpticalCenterY");
  if (f && x && y) {
    camera["projection"] = {{"type", "intrinsics"}, {"fx", *f}, {"fy", *f}, {"cx", *x}, {"cy", *y}};
    if (w && h) camera["projection"]["pixels"] = {*w, *h};
  }
  return camera;
}

Import open(const Node& root) {
  Import result;
  for (const Json& row : root.json()) {
    std::string name;
    for (const char* column : {"FileName", "SourceFile"})
      if (name.empty() && row.is_object() && row.contains(column) && row[column].is_string())
        name = row[column].get<std::string>();
    result.cameras.push_back({name, ""});
  }
  result.document = [root](std::size_t which) { return documentOf(root[which]); };
  return result;
}  // namespace exif

}  // namespace exif

extern const Format kExif{"exiftool", "a drone table of exiftool -n", ":list *.GPSLatitude *.GimbalYawDegree",
                          exif::open, "*"};

namespace table {

/// Columns that are named in short.
constexpr std::pair<std::string_view, std::string_view> kShort[] = {
    {"x", "position.x"},          {"y", "position.y"},         {"z", "position.z"},
    {"lat", "position.lat"},      {"latitude", "position.lat"}, {"lon", "position.lon"},
    {"lng", "position.lon"},      {"longitude", "position.lon"}, {"alt", "position.height"},
    {"altitude", "position.height"}, {"elevation", "position.height"}, {"qx", "rotation.x"},
    {"qy", "rotation.y"},         {"qz", "rotation.z"},        {"qw", "rotation.w"},
    {"yaw", "heading"},           {"model", "distortion.model"}};
constexpr std::string_view kNameColumns[] = {"name", "camera", "image", "file", "FileName", "label", "id", "time"};
constexpr std::string_view kLensColumns[] = {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "xi", "alpha", "beta", "omega"};

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// "k1" of "k1" and "distortion.k1"; empty for a column of something else.
std::string_view coefficientOf(std::string_view column) {
  constexpr std::string_view kFront = "distortion.";
  if (column.starts_with(kFront)) column.remove_prefix(kFront.size());
  return contains(kLensColumns, column) ? column : "";
}

/// Where the value of a column stands in our document; empty: it is no field of ours.
std::string pathOf(std::string_view column, bool isOnEarth) {
  for (const auto& [name, path] : kShort)
    if (name == column) return std::string(path);
  if (column == "height" && isOnEarth) return "position.height";
  if (column == "name" || column == "$schema") return "";
  const std::size_t dot = std::min(column.rfind('.'), column.size());
  constexpr std::string_view kParts[] = {".x", ".y", ".z", ".w", ".lat", ".lon", ".height"};
  for (const Field& field : kFields) {
    if (field.path == column) return std::string(column);
    if (field.path == column.substr(0, dot) && contains(kParts, column.substr(dot))) return std::string(column);
    const bool isShort = field.path.starts_with("projection.") && shortName(field) == column;
    if (isShort && column != "width" && column != "height" && column != "type" && column != "matrix")
      return std::string(field.path);
  }
  return column == "distortion.model" ? std::string(column) : "";
}

bool isOnEarth(const Json& row) { return row.contains("lat") || row.contains("latitude") || row.contains("position.lat"); }

bool isEmpty(const Json& cell) { return cell.is_null() || (cell.is_string() && cell.get_ref<const std::string&>().empty()); }

std::string nameOf(const Json& row) {
  for (const std::string_view column : kNameColumns)
    if (const auto cell = row.find(column); cell != row.end() && !isEmpty(*cell))
      return cell->is_number() ? formatNumber(cell->get<double>()) : cell->is_string() ? cell->get<std::string>() : "";
  return "";
}

/// A position, and a column of a turn or a lens beside it. A time and a pose alone are a trajectory.
bool recognises(const Node& root) {
  const Json& rows = root.json();
  if (!rows.is_array() || rows.empty() || !rows.front().is_object()) return false;
  const Json& row = rows.front();
  bool hasPosition = false, hasTurn = false, hasLens = false;
  for (const auto& [column, cell] : row.items()) {
    if (cell.is_structured()) return false;
    const std::string path = pathOf(column, isOnEarth(row)), first = path.substr(0, path.find('.'));
    hasPosition = hasPosition || first == "position";
    hasLens = hasLens || first == "projection";
    hasTurn = hasTurn || contains(std::array{"rotation", "heading", "target", "direction"}, first);
  }
  return hasPosition && (hasLens || (hasTurn && !holdsPoses(root)));
}

Json documentOf(const Node& row) {
  const bool onEarth = isOnEarth(row.json());
  Json fields = Json::object();
  std::vector<std::pair<std::string, double>> coefficients;
  std::string model;
  for (const auto& [column, cell] : row.json().items()) {
    const Node node = *row.find(column);
    if (isEmpty(cell)) continue;
    if ((column == "width" || column == "height") && !onEarth)
      node.fail("may be the picture's or the window's: call it viewport." + column + " or projection." + column);
    if (const std::string_view coefficient = coefficientOf(column); !coefficient.empty()) {
      coefficients.emplace_back(coefficient, numberOf(node));
      continue;
    }
    const std::string path = pathOf(column, onEarth);
    if (path.empty()) continue;
    node.mark();
    if (path == "distortion.model") {
      model = node.text();
      continue;
    }
    Json* at = &fields;
    for (std::size_t begin = 0; begin <= path.size();) {
      const std::size_t end = std::min(path.find('.', begin), path.size());
      at = &(*at)[path.substr(begin, end - begin)];
      begin = end + 1;
    }
    *at = cell;
  }
  if (const auto q = fields.find("rotation"); q != fields.end() && q->is_object())
    *q = {q->value("x", Json()), q->value("y", Json()), q->value("z", Json()), q->value("w", Json())};
  Document camera{row.document().name + (row.path().empty() ? "" : ": " + row.path()), std::make_shared<Json>(Json::object())};
  layOver(camera, fields);
  if (Json lens = coefficients.empty() ? Json() : lensOf(row, model, coefficients); !lens.is_null())
    (*camera.root)["distortion"] = std::move(lens);
  return std::move(*camera.root);
}

Import open(const Node& root) {
  Import result;
  for (const Json& row : root.json()) result.cameras.push_back({row.is_object() ? nameOf(row) : "", ""});
  result.document = [root](std::size_t which) { return documentOf(root[which]); };
  result.own = [root](std::size_t which) { return std::optional(root[which]); };
  return result;
}

// ---- Writing

/// The columns of written tables, in their order.
constexpr std::string_view kColumns[] = {
    "name",           "lat",       "lon",      "height",   "heading",        "pitch",           "roll",
    "x",              "y",         "z",        "qx",       "qy",             "qz",              "qw",
    "world",          "fx",        "fy",       "cx",       "cy",             "near",            "far",
    "viewport.width", "viewport.height", "distortion.model", "k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2",
    "distortion.xi", "distortion.alpha", "distortion.beta", "distortion.omega"};

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
  for (std::size_t i = 0; i < 4; ++i) {
    if (i < 3) cells[std::string(1, "xyz"[i])] = formatNumber(place[i]);
    cells[std::string("q") + "xyzw"[i]] = formatNumber(q[i]);
  }
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
  for (const auto& [name, value] : {std::pair("fx", k.fx), {"fy", k.fy}, {"cx", k.cx}, {"cy", k.cy},
                                    {"viewport.width", camera.width()}, {"viewport.height", camera.height()}})
    cells[name] = formatNumber(value);
  if (hasDepth(p)) cells["near"] = formatNumber(p.zNear());
  if (std::isfinite(p.zFar())) cells["far"] = formatNumber(p.zFar());
  if (camera.file.lens) addLens(*camera.file.lens, cells);
  return cells;
}

}  // namespace table

extern const Format kTable{"csv", "a table of cameras (CSV, or JSON objects)", "", table::open, "id", table::recognises};

std::vector<WrittenFile> writeTable(std::span<const WrittenCamera> cameras, std::string_view) {
  std::vector<table::Cells> rows;
  for (const WrittenCamera& camera : cameras) rows.push_back(table::cellsOf(camera));
  std::vector<std::string_view> columns;
  for (const std::string_view column : table::kColumns)
    if (std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.contains(column); })) columns.push_back(column);
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
