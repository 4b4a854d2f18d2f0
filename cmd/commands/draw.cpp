// viewproj draw: an SVG of what the camera sees.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/values.hpp"
#include "commands/check/report.hpp"
#include "commands/command.hpp"
#include "commands/ground_height.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "picture/ground.hpp"
#include "picture/picture.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr unsigned kindPolygon = 100;
constexpr const char* kNoLabel = "none";

struct DrawOptions {
  CameraOptions camera;
  StreamOptions stream;
  std::vector<Vec2> pixels;
  std::optional<std::string> scene, photo, title;
  std::vector<std::string> labels;
  GroundHeight height;
  bool hasStems = false;
};

/// JSON text, a string without its quotes.
std::string labelOfJson(std::string_view value) {
  return visible(value.starts_with('"') ? unescaped(value.substr(1, value.size() - 2)) : std::string(value));
}

bool isNameless(const Schema& schema) { return schema.isArray || !schema.hasHeader; }

/// Of records whose fields have no names, also by column1 and so on.
std::optional<std::size_t> fieldNamed(const Schema& schema, std::string_view name) {
  for (std::size_t i = 0; i < schema.size && isNameless(schema); ++i)
    if (sameButForCase(nameOfColumn({}, i), name)) return i;
  const auto found = std::find_if(schema.names.begin(), schema.names.end(),
                                  [&](const std::string& field) { return sameButForCase(field, name); });
  if (found == schema.names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - schema.names.begin());
}

/// A number with a fraction has six digits, or as many as stand before the point.
std::string shortened(const std::string& text) {
  constexpr std::size_t kDigits = 6;
  const auto number = parseNumber(text);
  const bool isLong = number && text.size() > kDigits + 1 && text.find_first_of(".eE") != std::string::npos;
  if (!isLong || !std::isfinite(*number)) return text;
  const double whole = std::floor(std::log10(std::fabs(*number))) + 1;
  return formatDigits(*number, static_cast<int>(std::max<double>(kDigits, whole)));
}

/// A value that can stand in a picture; empty for null.
std::string textIn(const RecordView& record, std::size_t field) {
  const bool isJson = record.schema->form == Form::json;
  if (isJson && record.values[field] == "null") return "";
  const std::string text = visible(plainText(record, field));
  if (!isUtf8(text)) return "";
  return isJson && record.values[field].starts_with('"') ? text : shortened(text);
}

struct RecordLabel {
  std::string name, note;
};

/// The fields of --label, the first as the name; none for the word, where no field is called so; else the id or name,
/// else the number, counted from 1, of a point.
RecordLabel labelOf(const RecordView& record, std::size_t number, const std::vector<std::string>& labels) {
  RecordLabel label;
  for (const std::string& name : labels) {
    const auto field = fieldNamed(*record.schema, name);
    if (!field && labels.size() == 1 && name == kNoLabel) return {};
    if (!field)
      throw RecordError(0, "has no " + inQuotes(name) + " for --label" +
                               (isNameless(*record.schema) ? "; its fields are column1, column2 and so on"
                                                           : fieldsNote(*record.schema)));
    const std::string text = textIn(record, *field);
    if (&name == &labels.front())
      label.name = text;
    else if (!text.empty())
      label.note += (label.note.empty() ? "" : ", ") + text;
  }
  if (!labels.empty()) return label;
  for (const char* name : {"id", "name"})
    if (const auto field = fieldNamed(*record.schema, name))
      if (const std::string text = textIn(record, *field); !text.empty()) return {text, ""};
  return {number > 0 ? std::to_string(number) : "", ""};
}

/// offset: of the field in its record.
std::vector<Vec3> ringOf(const Json& value, std::size_t offset, const std::string& field, bool worldIsEcef) {
  if (!value.is_array() || value.size() < 3) throw RecordError(offset, field + ": expected three points or more");
  std::vector<Vec3> corners;
  for (const Json& each : value) {
    const auto number = [&](const char* name) {
      const auto found = each.find(name);
      return found != each.end() && found->is_number() ? found->get<double>() : NAN;
    };
    const bool isPlace = each.is_object() && each.contains("lat");
    if (isPlace && !worldIsEcef) throw RecordError(offset, kNotOnEarth);
    Vec3 corner{NAN, NAN, NAN};
    if (isPlace)
      corner = geodeticToEcef({number("lat"), number("lon"), number("height")});
    else if (each.is_object())
      corner = {number("x"), number("y"), number("z")};
    else if (each.is_array() && each.size() == 3 && each[0].is_number() && each[1].is_number() && each[2].is_number())
      corner = {each[0].get<double>(), each[1].get<double>(), each[2].get<double>()};
    if (!isValid(Sphere{corner}))
      throw RecordError(offset,
                        field + ": expected [x, y, z], x, y, z or lat, lon, height, got " + inQuotes(each.dump()));
    corners.push_back(corner);
  }
  return corners;
}

/// Of a record as footprint writes it: the polygon, or the polygons of which it is the largest, and holes. None where
/// it is null.
std::vector<std::vector<Vec3>> ringsOf(const RecordView& record, bool worldIsEcef) {
  std::vector<std::vector<Vec3>> rings;
  const auto polygons = fieldNamed(*record.schema, "polygons");
  for (const auto& field : {polygons ? std::nullopt : fieldNamed(*record.schema, "polygon"), polygons,
                            fieldNamed(*record.schema, "holes")}) {
    Json value;
    if (field) (void)parseJson(record.values[*field], value);
    if (value.is_null()) continue;
    const std::string& name = record.schema->names[*field];
    if (sameButForCase(name, "polygon")) value = Json::array({value});
    if (!value.is_array()) throw RecordError(record.offset(*field), name + ": expected a list of outlines");
    for (const Json& each : value) rings.push_back(ringOf(each, record.offset(*field), name, worldIsEcef));
  }
  return rings;
}

/// Where a record has a polygon. Only JSON has one.
std::optional<std::size_t> polygonField(const RecordView& record) {
  return record.schema->form == Form::json && !record.schema->isArray ? fieldNamed(*record.schema, "polygon")
                                                                      : std::nullopt;
}

/// Reads records into a picture.
class PictureRecords {
 public:
  PictureRecords(const DrawOptions& o, const CameraFile& camera, PictureContent& content)
      : o_(o), camera_(camera), content_(content), pairs_(camera, kWithin) {}

  int read(const StreamSetup& setup) {
    const PointReading reading{.columns = setup.columns,
                               .worldIsEcef = camera_.worldIsEcef,
                               .segments = true,
                               .shapes = true,
                               .polygons = true};
    const auto locate = [&](const RecordView& record) {
      if (polygonField(record)) return NumberPlan{.kind = kindPolygon};
      if (record.schema->isArray && hasPixelBesidePoint(record, reading.columns)) return findPair(record, reading);
      NumberPlan plan = findPoint(record, reading);
      return isPoint(plan) && hasPixelBesidePoint(record, reading.columns) ? findPair(record, reading) : plan;
    };
    const int status =
        readRecords(setup, {locate, [&](const NumberPlan& plan, const Numbers& numbers, const RecordView& record,
                                        std::size_t line) { add(plan, numbers, record, line); }});
    if (const std::string text = explanation(); !text.empty()) content_.notes.push_back(text);
    return status;
  }

 private:
  static constexpr double kWithin = 0.1;  // as check

  void add(const NumberPlan& plan, const Numbers& n, const RecordView& record, std::size_t line) {
    constexpr std::size_t kMostSlotsOfPoint = 4;
    const bool hasNumber = plan.kind != kindPolygon && isPoint(plan);
    ++count_;
    const auto [name, note] = labelOf(record, hasNumber ? count_ : 0, o_.labels);
    if (plan.kind == kindPolygon) {
      content_.areas.push_back({name, ringsOf(record, camera_.worldIsEcef)});
    } else if (isSegment(plan)) {
      content_.segments.push_back({name, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    } else if (!isPoint(plan)) {
      std::visit(
          [&, &name = name](const auto& shape) {
            if constexpr (!requires { shape.x; }) content_.shapes.push_back({name, shape});
          },
          toShape(plan, n));
    } else if (const Vec4 point = toPoint(plan, n); !isInRange(made_, point)) {
      throw RecordError(0, "lies farther than 1e46 from the eye");
    } else if (plan.slots() > kMostSlotsOfPoint) {
      const std::optional<Vec2> pixel = pixelBesidePoint(plan, n);
      content_.points.push_back({name, note, point, pixel});
      pairs_.add(point, pixel, line);
    } else {
      content_.points.push_back({name, note, point});
    }
  }

  /// What check says of the pairs: the first explanation that holds for all of them.
  std::string explanation() const {
    if (pairs_.records() == 0) return "";
    const OrderedJson report = pairs_.report();
    for (const OrderedJson& each : report["explanations"]) {
      if (!each["wrongPairs"].empty()) continue;
      std::string text = "check: " + each["sentence"].get<std::string>();
      for (const char* const mend : {"mend", "pairs"})
        if (each[mend].is_string()) text += ": " + each[mend].get<std::string>();
      return text;
    }
    return "";
  }

  const DrawOptions& o_;
  const CameraFile& camera_;
  const Camera made_ = makeCamera(camera_);
  PictureContent& content_;
  mistakes::PairReport pairs_;
  std::size_t count_ = 0;
};

std::vector<SceneObject> shapesOf(const DrawOptions& o, const CameraFile& camera) {
  std::vector<SceneObject> shapes;
  if (o.scene) shapes = readScene(*o.scene, camera.worldIsEcef);
  for (SceneObject& shape : shapes) shape.id = labelOfJson(shape.id);
  if (o.height.isTyped()) shapes.push_back(o.height.surface("ground", camera.worldIsEcef, &camera));
  return shapes;
}

std::string titleOf(const DrawOptions& o, const CameraFile& camera) {
  if (o.title) return visible(*o.title);
  const Json* const name = valueAt(*camera.document.root, "name");
  return name && name->is_string() ? visible(name->get<std::string>()) : "What the camera sees";
}

int runDraw(const DrawOptions& o) {
  StreamSetup setup = o.stream.setup(kPointOrPairColumns);
  if (!setup.columns.given()) setup.csvDefaults = {"x", "y", "z", "u", "v"};
  const bool reads = o.stream.reads(setup);
  const std::optional<Photo> photo = o.photo ? std::optional(readPhoto(*o.photo)) : std::nullopt;
  CameraOptions options = o.camera;
  if (photo) options.assumeViewport(photo->width, photo->height);
  const CameraFile file = options.read();
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  PictureContent content{.title = titleOf(o, file),
                         .worldIsEcef = file.worldIsEcef,
                         .shapes = shapesOf(o, file),
                         .pixels = o.pixels,
                         .hasStems = o.hasStems};
  if (o.hasStems && std::none_of(content.shapes.begin(), content.shapes.end(), isGround))
    throw UsageError("--stems needs a ground: --height H, or a plane or an ellipsoid in --scene");
  if (photo) {
    requireSize(*photo, *file.viewport);
    content.photo = photo->url;
  }
  const int status = reads ? PictureRecords(o, file, content).read(setup) : 0;
  writeOutput(pictureOf(makeCamera(file), content));
  return status;
}

}  // namespace

Action declareDraw(CLI::App& app) {
  const auto o = std::make_shared<DrawOptions>();
  describe(
      app,
      "An SVG of what the camera sees, the longer side scaled to 960. Points have their id, name or number. Hidden "
      "points are hollow, hidden edges dashed. A point with a pixel, as check reads it, has an arrow from there to the "
      "computed one.",
      "Examples:\n"
      "  viewproj draw --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
      "    --viewport 640x480 --point 0,0,0 --point 1,1,1 -o view.svg\n"
      "  printf 'x,y,z,name\\n1,1,1,lamp\\n' | viewproj draw --position 3,2,5 \\\n"
      "    --target 0,0,0 --fov-y 60 --viewport 640x480");
  o->stream.addPoints(app);
  addValues(app, "--pixel", "X,Y", o->pixels, readPixelPosition, "A pixel to mark, with what it hits");
  addScene(app, o->scene, "Shapes to draw");
  o->height.add(app, "The ground at this height: z = H, or the Earth's");
  addFlag(app, "--stems", o->hasStems, "A line from each point down to the ground");
  addOption(
      app, "--label", "NAMES",
      [o](const std::string& option, const std::string& text) { o->labels = splitNames(option, text); },
      "Fields beside points, or none (default: id or name)");
  addValue(app, "--title", "TEXT", o->title, readText, "The title (default: the camera's name)");
  addValue(app, "--picture", "PHOTO", o->photo, readFileName, "A JPEG or PNG to put beneath, of the viewport's size");
  o->stream.addInput(app, "points, pairs, shapes and polygons");
  o->camera.add(app);
  addOnlyForm(app, "SVG", ".svg");
  return [o] { return runDraw(*o); };
}

}  // namespace viewproj::cmd
