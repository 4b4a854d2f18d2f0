// viewproj footprint: what each camera's picture shows of the ground.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/plain_vectors.hpp"
#include "camera/sea_level.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/geojson.hpp"
#include "commands/ground_height.hpp"
#include "commands/outline.hpp"
#include "numbers/vectors.hpp"
#include "output/output_file.hpp"
#include "output/report.hpp"
#include "records/arguments.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {
namespace {

enum class FootprintForm : std::uint8_t { table, json, csv, geojson };

struct FootprintOptions {
  CameraOptions camera;
  GroundHeight height;
  std::optional<double> most, error;
  std::optional<PlaneEquation> plane;
  FootprintForm form = FootprintForm::table;
  std::optional<std::size_t> digits;
};

/// A camera's outline, and what its numbers are of.
struct Footprint {
  OrderedJson name, surface;
  std::optional<double> heightOnEarth;
  Vec3 eye;
  Outline outline;

  /// lat, lon and height, or x, y and z.
  OrderedJson placeOf(const Vec3& point) const {
    if (!heightOnEarth) return {{"x", point.x}, {"y", point.y}, {"z", point.z}};
    const Geodetic place = ecefToGeodetic(point);
    OrderedJson heights{{"lat", place.lat}, {"lon", place.lon}, {"height", *heightOnEarth}};
    if (hasGeoid()) heights["altitude"] = *heightOnEarth - seaLevelAt(place.lat, place.lon);
    return heights;
  }
};

OrderedJson pointAndNormal(const PlaneEquation& plane) {
  const Vec3& n = plane.normal;
  return {{"point", asJson(scaled(n, -plane.offset / detail::dot(n, n)))}, {"normal", asJson(n)}};
}

Footprint footprintOf(const FootprintOptions& o, const CameraFile& file, const std::string& name) {
  const Camera camera = makeCamera(file);
  const Vec3 eye = camera.pose().eye();
  if (!o.height.isTyped() && !o.plane)
    throw UsageError("the ground is needed: --height H" + std::string(file.worldIsEcef ? "" : " or --plane") +
                     "; the eye is at height " +
                     formatDigits(file.worldIsEcef ? ecefToGeodetic(eye).height : eye.z, 6));
  if (o.plane && file.worldIsEcef)
    throw UsageError(
        "--plane is of Earth-centred x, y, z with a camera on the Earth; --height 545 is the surface of that height");
  if (file.worldIsEcef && camera.projection().isOrthographic())
    file.fail("an outline on the Earth needs a perspective camera, and that of " + file.name + " is orthographic");
  if (!file.worldIsEcef && o.form == FootprintForm::geojson)
    file.fail("GeoJSON has longitudes and latitudes only, and the camera of " + file.name + " is not on the Earth");
  const double height = o.plane ? 0 : o.height.of(file.worldIsEcef, &file);
  const auto ground =
      groundOf(o.plane ? SceneObject{"", *o.plane} : o.height.surface("", file.worldIsEcef, &file), eye);
  if (ground->holdsEye)
    throw InputError("the eye is on the " +
                     (file.worldIsEcef ? "surface of height " + formatNumber(height) : std::string("plane")) +
                     "; no outline has a size there");
  if (ground->rise < 0)
    note((name.empty() ? "" : name + ": ") + "the eye is " + formatDigits(-ground->rise, 4) +
         " m under the ground of height " + formatNumber(height) + ", and sees it from below");
  return {name.empty() ? OrderedJson() : OrderedJson(name),
          o.plane ? OrderedJson{{"plane", pointAndNormal(*o.plane)}} : OrderedJson{{"height", height}},
          file.worldIsEcef ? std::optional(height) : std::nullopt, eye,
          outlineOf(camera, *ground, o.most.value_or(HUGE_VAL), o.error.value_or(0))};
}

OrderedJson samplingOf(const GroundSampling& gsd) { return gsd ? OrderedJson(*gsd) : OrderedJson(); }

OrderedJson reportOf(const Footprint& f) {
  const Outline& outline = f.outline;
  OrderedJson corners = OrderedJson::array(), polygons = OrderedJson::array(), holes = OrderedJson::array();
  for (const GroundSampling& gsd : outline.cornerGsd) corners.push_back(samplingOf(gsd));
  OrderedJson report{{"name", f.name},
                     {"surface", f.surface},
                     {"cut", outline.cut},
                     {"center", nullptr},
                     {"gsd", {{"center", samplingOf(outline.gsd)}, {"corners", corners}}},
                     {"area", outline.area},
                     {"error", outline.rings.empty() ? OrderedJson() : OrderedJson(outline.error)},
                     {"polygon", nullptr}};
  if (outline.center) {
    report["center"] = f.placeOf(outline.center->point);
    report["center"]["distance"] = outline.center->distance;
  }
  double largest = 0;
  for (const OutlineRing& ring : outline.rings) {
    OrderedJson polygon = OrderedJson::array();
    for (const OutlineVertex& v : ring.vertices) {
      polygon.push_back(f.placeOf(v.point));
      polygon.back()["pixel"] = v.pixel ? asJson(*v.pixel) : OrderedJson();
    }
    (ring.isHole ? holes : polygons).push_back(polygon);
    if (ring.isHole || ring.area < largest) continue;
    largest = ring.area;
    report["polygon"] = polygon;
  }
  if (polygons.size() > 1) report["polygons"] = polygons;
  if (!holes.empty()) report["holes"] = holes;
  return report;
}

/// A row a vertex, or one without a place.
std::string csvRows(const Footprint& f, int digits) {
  const std::string name = f.name.is_string() ? quotedIfNeeded(f.name.get<std::string>()) : "";
  const auto cell = [&](double number) {
    return "," + (std::isfinite(number) ? formatNumber(toDigits(number, digits)) : "");
  };
  std::string rows;
  std::size_t number = 0;
  for (const OutlineRing& ring : f.outline.rings) {
    const std::string last = "," + (ring.isHole ? "hole" : std::to_string(number++)) + "\n";
    std::size_t vertex = 0;
    for (const OutlineVertex& v : ring.vertices) {
      rows += name + "," + std::to_string(vertex++);
      for (const auto& each : f.placeOf(v.point)) rows += cell(each.get<double>());
      rows += cell(v.pixel ? v.pixel->x : NAN) + cell(v.pixel ? v.pixel->y : NAN) + last;
    }
  }
  return rows.empty() ? name + (hasGeoid() && f.heightOnEarth ? ",,,,,,,,\n" : ",,,,,,,\n") : rows;
}

/// RFC 7946: longitude, latitude, height.
OrderedJson featureOf(const Footprint& f) {
  const Outline& outline = f.outline;
  OrderedJson polygons = OrderedJson::array();
  for (const OutlineRing& ring : outline.rings) {
    MapRing places;
    for (const OutlineVertex& v : ring.vertices) places.push_back(v.place);
    std::vector<MapRing> parts = mapRings(places, std::copysign(90, ecefToGeodetic(f.eye).lat));
    if (ring.isHole && (parts.size() > 1 || polygons.size() > 1))
      throw InputError("the outline has a hole, and passes the antimeridian, which GeoJSON is not written for");
    for (MapRing& part : parts) {
      if (ring.isHole) std::reverse(part.begin(), part.end());
      OrderedJson line = OrderedJson::array();
      for (const Vec2& place : part) line.push_back({place.x, place.y, *f.heightOnEarth});
      if (!ring.isHole) polygons.push_back(OrderedJson::array());
      polygons.back().push_back(std::move(line));
    }
  }
  OrderedJson geometry;
  if (polygons.size() == 1) geometry = {{"type", "Polygon"}, {"coordinates", polygons[0]}};
  if (polygons.size() > 1) geometry = {{"type", "MultiPolygon"}, {"coordinates", polygons}};
  return {{"type", "Feature"},
          {"properties",
           {{"name", f.name}, {"cut", outline.cut}, {"area", outline.area}, {"gsd", samplingOf(outline.gsd)}}},
          {"geometry", geometry}};
}

/// Writes footprints, one after the other, and what goes around them.
class FootprintWriter {
 public:
  FootprintWriter(FootprintForm form, int digits) : form_(form), digits_(digits) {}

  /// Throws InputError for one that the form has no place for; then nothing is written.
  void write(const Footprint& f) {
    std::string text;
    if (form_ == FootprintForm::table) {
      text = (isFirst_ ? "" : "\n") + tableText(reportOf(f), digits_);
    } else if (form_ == FootprintForm::json) {
      text = compactJson(reportOf(f), digits_) + "\n";
    } else if (form_ == FootprintForm::geojson) {
      text = (isFirst_ ? kHead : ",") + std::string("\n") + compactJson(featureOf(f), digits_);
    } else {
      const std::string head = "name,vertex," + std::string(!f.heightOnEarth ? "x,y,z"
                                                            : hasGeoid()     ? "lat,lon,height,altitude"
                                                                             : "lat,lon,height");
      if (isFirst_) text = head + ",pixel_x,pixel_y,ring\n";
      if (!isFirst_ && head != head_)
        throw InputError("a table has places on the Earth, or positions, and the first camera decides");
      head_ = head;
      text += csvRows(f, digits_);
    }
    writeOutput(text);
    isFirst_ = false;
  }
  /// Of none after faults nothing: an old file stays.
  void end(bool hasFaults) const {
    if (form_ == FootprintForm::geojson && !(isFirst_ && hasFaults))
      writeOutput((isFirst_ ? kHead : "") + std::string("\n]}\n"));
  }

 private:
  static constexpr const char* kHead = "{\"type\": \"FeatureCollection\", \"features\": [";
  FootprintForm form_;
  int digits_;
  bool isFirst_ = true;
  std::string head_;  ///< of CSV
};

/// A camera without an outline has a message instead.
int runFootprint(const FootprintOptions& o) {
  constexpr std::size_t kDigitsOfTable = 9;
  int status = 0;
  FootprintWriter writer(o.form,
                         static_cast<int>(o.digits.value_or(o.form == FootprintForm::table ? kDigitsOfTable : 0)));
  const auto [cameras, pick] = o.camera.readAll();
  for (const std::size_t i : cameras->chooseAll(pick)) {
    std::string place;
    try {
      const CameraFile file = o.camera.readOne(*cameras, i, true, BoxLack::nearAndFar);
      if (!file.isTyped) place = file.name + ": ";
      writer.write(footprintOf(o, file, cameras->nameOf(i, file.document)));
    } catch (const InputError& e) {
      const std::string message = e.what();
      complain(message.starts_with(place) ? message : place + message);
      status = 1;
    }
  }
  writer.end(status != 0);
  return status;
}

}  // namespace

Action declareFootprint(CLI::App& app) {
  const auto o = std::make_shared<FootprintOptions>();
  describe(
      app,
      "What each picture shows of the ground: its outline as a polygon, the area, and the ground sampling distance, "
      "metres a pixel, at the centre and the corners, clockwise from the top left. Takes all cameras of the files, or "
      "those that #NAME picks. It is cut at the horizon or --max-distance, as `cut` says.",
      "Examples:\n"
      "  viewproj footprint --position lat=46.9481,lon=7.4474,height=640 \\\n"
      "    --heading 212 --pitch -35 --fov-x 74 --viewport 5472x3648 --height 545\n"
      "  viewproj footprint --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 640x480 --plane z=0 --max-distance 50 --to csv");
  const auto aboveZero = [](double number) { return number > 0 && std::isfinite(number); };
  CLI::Option* const plane =
      addValue(app, "--plane", "z=0|A,B,C,D", o->plane, readPlaneArgument, "The ground: x=, y=, z= or ax+by+cz+d=0");
  o->height.add(app, "The ground: the Earth's surface of this height, or z = H", {plane});
  addValue(app, "--max-distance", "D", o->most, numberThat(aboveZero, "a distance above 0"),
           "What is farther from the eye is cut (default: nothing)");
  addValue(app, "--error", "E", o->error, numberThat(aboveZero, "a distance above 0"),
           "How far the boundary may be from the line between two vertices (default: a thousandth of its extent)");
  static constexpr FormRow<FootprintForm> kForms[] = {{"table", FootprintForm::table, ".txt"},
                                                      {"json", FootprintForm::json, ".json .ndjson .jsonl"},
                                                      {"csv", FootprintForm::csv, ".csv"},
                                                      {"geojson", FootprintForm::geojson, ".geojson"}};
  addForm(app, o->form, std::span<const FormRow<FootprintForm>>(kForms), "Output format");
  addDigits(app, o->digits, "9 in a table, else all");
  o->camera.addFiles(app);
  o->camera.add(app);
  return [o] { return runFootprint(*o); };
}

}  // namespace viewproj::cmd
