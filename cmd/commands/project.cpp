// viewproj project: world points to screen positions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <type_traits>
#include <variant>

#include "camera/plain_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "camera/sea_level.hpp"
#include "commands/command.hpp"
#include "commands/record_camera_options.hpp"
#include "commands/stream_options.hpp"
#include "output/results.hpp"
#include "records/model.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A point and what project knows of it.
struct ProjectedPoint {
  const RecordCamera& from;
  const Camera& camera;
  const CameraOptions& options;  ///< say in which convention ndc, clip and view are
  const Vec4& point;
  const ScreenPoint& screen;
  const std::optional<ScreenBox>& box;  ///< of a shape
  bool isPoint;                         ///< no shape without a center, and not null
  double error;                         ///< how far the point may be from the true one
  Vec2 given = {kNaN, kNaN};            ///< the record's own pixel
  bool isHidden = false;                ///< by the Earth
};

/// A result of project, and how its values are added.
struct PointResult {
  const ResultRow& row;
  void (*add)(const ProjectedPoint& point, ResultValues& values);
};

using P = const ProjectedPoint&;
using V = ResultValues&;

Vec3 xyz(const Vec4& v) { return {v.x, v.y, v.z}; }
Vec4 pointIn(Space space, P p) { return worldTo(p.camera, space, p.point, p.options.writing(p.from.convention)); }
/// From the eye to the point, of any length for a direction.
Vec3 fromEye(P p) {
  const Vec3 eye = p.camera.pose().eye();
  if (!p.isPoint) return {kNaN, kNaN, kNaN};
  const double w = p.point.w == 0 ? 1 : p.point.w, at = p.point.w == 0 ? 0 : 1;
  return {p.point.x / w - at * eye.x, p.point.y / w - at * eye.y, p.point.z / w - at * eye.z};
}
Bearing bearingFromEye(P p) {
  if (!p.from.knowsUp) return {kNaN, kNaN};
  return bearingOf(fromEye(p), p.camera.pose().eye(), p.from.worldIsEcef);
}
double rangeOf(P p) { return p.point.w == 0 ? kNaN : length(fromEye(p)); }
Vec4 edgesOf(P p) {
  const ScreenBox box = p.box.value_or(ScreenBox{kNaN, kNaN, kNaN, kNaN});
  return {box.left, box.top, box.right, box.bottom};
}
/// Without the sides of a picture that has no size.
ScreenPoint knownOf(P p) {
  ScreenPoint known = p.screen;
  if (p.from.lacksSize) known.outside &= sideNear | sideFar;
  return known;
}
/// Nothing where it depends on the size of a picture that has none.
void addVisible(P p, V values) {
  const bool mayBe = knownOf(p).visible() && !p.isHidden;
  if (mayBe && p.from.lacksSize) return values.add(kNaN);
  values.add(mayBe);
}
void addOutside(P p, V values) {
  const ScreenPoint known = knownOf(p);
  if (p.from.lacksSize && known.visible() && !p.isHidden) return values.add(kNaN);
  addSides(values, known, p.isHidden);
}

// clang-format off
constexpr PointResult kPointResults[] = {
    {results::screen, [](P p, V values) { values.add(Vec2{p.screen.x, p.screen.y}); }},
    {results::depth, [](P p, V values) { values.add(p.screen.depth); }},
    {results::viewDistance, [](P p, V values) { values.add(p.screen.viewDistance); }},
    {results::visible, addVisible},
    {results::outside, addOutside},
    {results::ndc, [](P p, V values) { values.add(xyz(pointIn(Space::ndc, p))); }},
    {results::clip, [](P p, V values) { values.add(pointIn(Space::clip, p)); }},
    {results::view, [](P p, V values) { values.add(xyz(pointIn(Space::view, p))); }},
    {results::pixelSize, [](P p, V values) { values.add(pixelSize(p.camera, p.screen.viewDistance)); }},
    {results::miss, [](P p, V values) { values.add(Vec2{p.given.x - p.screen.x, p.given.y - p.screen.y}); }},
    {results::screenBox, [](P p, V values) { values.add(edgesOf(p)); }},
    {results::azimuth, [](P p, V values) { values.add(bearingFromEye(p).azimuth); }},
    {results::elevation, [](P p, V values) { values.add(bearingFromEye(p).elevation); }},
    {results::range, [](P p, V values) { values.add(rangeOf(p)); }},
    {results::bound, [](P p, V values) { values.add(boundOfPoint(p.camera, p.point, p.screen.precision, p.error).screen); }},
};
// clang-format on

using Rows = std::vector<const PointResult*>;

bool isIn(const Rows& rows, const ResultRow& row) {
  return std::any_of(rows.begin(), rows.end(), [&](const PointResult* one) { return &one->row == &row; });
}

/// The results to write.
struct Fields {
  bool areAll = false;  ///< but those whose names a record has
  Rows named, numbers;  ///< numbers: in text and f64, where names have no place
  Rows ofShapes;        ///< in place of named; empty where --fields names results
};

/// Without --fields, the usual ones.
Fields fieldsOf(const std::optional<Several<const PointResult*>>& chosen) {
  if (chosen && !chosen->all) return {false, chosen->named, chosen->named, {}};
  Fields fields;
  fields.areAll = chosen.has_value();
  for (const PointResult& result : kPointResults) {
    const ResultRow& row = result.row;
    const bool isBox = &row == &results::screenBox;         // of shapes alone
    const bool isOfAll = !isBox && &row != &results::miss;  // of records that have a pixel alone
    if (chosen ? isOfAll : row.byDefault != Default::never) fields.named.push_back(&result);
    if (chosen ? isOfAll && numbersOf(row) > 0 : row.byDefault == Default::everywhere)
      fields.numbers.push_back(&result);
    if (isBox) fields.ofShapes.insert(fields.ofShapes.begin(), &result);
    if (&row == &results::visible || &row == &results::outside) fields.ofShapes.push_back(&result);
  }
  return fields;
}

Names<const PointResult*> fieldNames() {
  Names<const PointResult*> names;
  for (const PointResult& result : kPointResults) names.emplace_back(result.row.name, &result);
  return names;
}

std::string helpOnFields() {
  std::vector<std::string_view> usual;
  for (const PointResult* result : fieldsOf({}).named) usual.push_back(result->row.name);
  return withNames("Results, in this order, or all", known(fieldNames()), joined(usual));
}

struct Projecting {
  const RecordCameras& cameras;
  const CameraOptions& options;  ///< how ndc, clip and view are written
  Precision precision;
  PointReading reading;
  Fields fields;
  bool hasMiss = false;  ///< records have a pixel beside their point
  std::string prefix;
  bool hasUsualNumbers = true;              ///< in text and f64
  std::optional<Mat4> worldFromLocal = {};  ///< of a model that the points are in
};

/// Whether there is no such result without near.
bool needsNear(const PointResult* result) { return &result->row == &results::ndc || &result->row == &results::clip; }

/// Whether there is no such result without a size of the picture.
bool needsSize(const PointResult* result) { return needsNear(result) || &result->row == &results::screenBox; }

bool needsUp(const PointResult* result) {
  return &result->row == &results::azimuth || &result->row == &results::elevation;
}

/// Throws for a camera that has no results that --fields names: without near, or in a world without up.
void requireFor(const Fields& fields, const CameraFile& file) {
  if (!fields.ofShapes.empty()) return;
  for (const PointResult* result : fields.named) {
    if (needsSize(result)) requireSize(file, "--fields " + std::string(result->row.name));
    if (needsNear(result) || &result->row == &results::depth)
      requireNear(file, "--fields " + std::string(result->row.name));
    else if (needsUp(result))
      requireUp(file, "--fields " + std::string(result->row.name));
  }
}

/// A segment among the points.
struct Segment {
  Vec3 a, b;
};

/// What has no screen position, distance or side: a point that is null.
constexpr ScreenPoint kNoPoint{
    .x = kNaN, .y = kNaN, .depth = kNaN, .viewDistance = kNaN, .status = PointStatus::outOfRange};

/// The sides of the picture beyond which all of a rectangle lies.
std::uint8_t sidesBeyond(const Camera& camera, const ScreenBox& box) {
  return static_cast<std::uint8_t>(viewproj::sidesBeyond(camera, Vec2{box.left, box.top}) &
                                   viewproj::sidesBeyond(camera, Vec2{box.right, box.bottom}));
}

/// Zero times a number is zero, and NaN of what is not finite: no branch for each.
bool areFinite(std::span<const Vec3> points) {
  double zero = 0;
  for (const Vec3& p : points) zero += 0 * p.x + 0 * p.y + 0 * p.z;
  return zero == 0;
}

/// How many from the start are points in range whose numbers on the screen exist or are NaN. What overflowed has no
/// value: the writer knows what becomes of it.
std::size_t countUsable(const Camera& camera, std::span<const Vec3> points, std::span<const Vec3> screen) {
  if (areFinite(screen)) return screen.size();  // then so are the points
  const auto overflowed = [](const Vec3& p) { return std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z); };
  std::size_t i = 0;
  const auto isUsable = [&](const Vec3& p) { return isInRange(camera, Vec4{p.x, p.y, p.z, 1}); };
  while (i < screen.size() && isUsable(points[i]) && !overflowed(screen[i])) ++i;
  return i;
}

class Projector final : public RecordProcessor {
 public:
  Projector(const Projecting& how, OutputForm to) : how_(how), numbersOnly_(hasNumbersOnly(to)) {
    for (const ResultRow* row : {&results::screenBox, &results::visible, &results::outside})
      hasShapeFields_ = hasShapeFields_ || isIn(fieldsOf(true), *row);
  }

  NumberPlan locate(const RecordView& record) const override {
    NumberPlan plan = how_.hasMiss ? findPair(record, how_.reading) : findPoint(record, how_.reading);
    for (std::size_t i = 0; how_.fields.areAll && i < std::size(kPointResults); ++i)
      if (hasNameOf(*record.schema, kPointResults[i].row)) plan.leftOut |= 1u << i;
    return plan;
  }

  ResultRows rows(const NumberPlan& plan) const override {
    if (numbersOnly_ && isSegment(plan))
      throw RecordError(0, "has a segment, whose results have no place in text and f64; write JSON or CSV");
    if (numbersOnly_ && isShape(plan) && !isIn(how_.fields.named, results::screenBox))
      throw RecordError(0, "has a shape, for whose screenBox there is no place; --fields screenBox,visible makes it");
    if (isSegment(plan)) return {std::begin(results::kSegment), std::end(results::kSegment)};
    ResultRows rows;
    for (const PointResult* result : fieldsOf(isShape(plan)))
      if (!(plan.leftOut >> (result - kPointResults) & 1)) rows.push_back(&result->row);
    return rows;
  }

  void add(const NumberPlan& plan, const Numbers& n, const RecordCamera& camera) override {
    Vec4 point{kNaN, kNaN, kNaN, 1};
    std::size_t other = kPoint;
    bool isRounded = false;
    const auto addOther = [&](const Other& what) {
      others_.push_back(what);
      other = others_.size() - 1;
    };
    if (n.isNull) {
      addOther(Null{});
    } else if (isSegment(plan)) {
      requireEdges("a segment", camera);
      requireNearFor("a segment", camera.camera);
      const Segment segment{placed({n[0], n[1], n[2]}), placed({n[3], n[4], n[5]})};
      if (!isValid(Sphere{segment.a}) || !isValid(Sphere{segment.b})) throw RecordError(0, "has a number beyond 1e46");
      addOther(segment);
    } else if (isShape(plan)) {
      requireEdges("a shape", camera);
      if (how_.worldFromLocal) throw RecordError(0, "has a shape; --model places points and segments alone");
      const CullShape shape = toShape(plan, n);
      if (const auto* const sphere = std::get_if<Sphere>(&shape))
        point = {sphere->center.x, sphere->center.y, sphere->center.z, 1};
      else if (!hasShapeFields_)
        throw RecordError(
            0, "has a shape, of which --fields names no result; screenBox, visible and outside are a shape's");
      addOther(shape);
    } else {
      point = toPoint(plan, n);
      isRounded = how_.reading.worldIsEcef && mayBePlace(plan);
      if (how_.worldFromLocal) point = toWorld(*how_.worldFromLocal, point);
    }
    if (how_.hasMiss) given_.push_back(pixelBesidePoint(plan, n).value_or(Vec2{kNaN, kNaN}));
    items_.push_back(other);
    leftOut_.push_back(plan.leftOut);
    cameras_.push_back(&camera);
    points_.push_back(point);
    positions_.push_back({point.x, point.y, point.z});
    errors_.push_back(isRounded ? placeError(positions_.back()) : 0);
  }

  void compute() override {
    screen_.resize(points_.size());
    for (std::size_t begin = 0, end = 0; begin < points_.size(); begin = end) {
      while (end < points_.size() && cameras_[end] == cameras_[begin]) ++end;
      worldToScreen(cameras_[begin]->camera, std::span(positions_).subspan(begin, end - begin),
                    std::span(screen_).subspan(begin, end - begin), how_.precision);
    }
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i].w != 1) screen_[i] = worldToScreen(cameras_[i]->camera, points_[i], how_.precision);
  }

  void results(std::size_t i, ResultValues& values) override {
    if (items_[i] != kPoint)
      addOther(others_[items_[i]], i, values);
    else if (screen_[i].status == PointStatus::outOfRange)
      throw RecordError(0, "lies farther than 1e46 from the eye");
    else
      addFields(screen_[i], i, std::nullopt, fieldsOf(false), values);
  }

  bool isVisible(std::size_t i) const override {
    return items_[i] == kPoint ? screen_[i].visible() && !isHidden(i) : isOtherVisible_;
  }

  void clear() override {
    items_.clear();
    leftOut_.clear();
    cameras_.clear();
    others_.clear();
    points_.clear();
    given_.clear();
    positions_.clear();
    errors_.clear();
  }

  std::size_t convert(std::span<const double> in, TextBuffer& out) override {
    if (!how_.hasUsualNumbers || how_.worldFromLocal) return 0;
    const Camera& camera = how_.cameras.only()->camera;
    const std::size_t count = in.size() / 3;
    char* const room = out.room(count * sizeof(Vec3));
    const std::span points(reinterpret_cast<const Vec3*>(in.data()), count);
    const std::span screen(reinterpret_cast<Vec3*>(room), count);
    worldToScreen(camera, points, screen, how_.precision);
    const std::size_t good = countUsable(camera, points, screen);
    out.written(room + good * sizeof(Vec3));
    return good;
  }

 private:
  /// Whether a result would have the name of a field, or of a column.
  bool hasNameOf(const Schema& schema, const ResultRow& row) const {
    if (schema.isArray) return false;
    std::vector<std::string> names = columnsOf({{&row}}, how_.prefix);
    names.push_back(how_.prefix + std::string(row.name));
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return schema.find(name); });
  }

  struct Null {};
  using Other = std::variant<Null, Segment, CullShape>;
  static constexpr std::size_t kPoint = ~std::size_t{0};

  static void requireEdges(const std::string& what, const RecordCamera& camera) {
    if (camera.lacksSize)
      throw RecordError(0, what + " needs the size of the picture; --viewport WIDTHxHEIGHT gives it");
    if (!camera.frustum)
      throw RecordError(
          0, what + " needs straight edges, which the lens bends; --ignore-distortion leaves its distortion out");
  }

  static void requireNearFor(const std::string& what, const Camera& camera) {
    if (!hasDepth(camera.projection())) throw RecordError(0, what + " needs a camera with near; --near gives it");
  }

  Vec3 placed(const Vec3& local) const {
    if (!how_.worldFromLocal) return local;
    const Vec4 world = toWorld(*how_.worldFromLocal, {local.x, local.y, local.z, 1});
    return {world.x, world.y, world.z};
  }

  bool isHidden(std::size_t i) const {
    const RecordCamera& from = *cameras_[i];
    return from.worldIsEcef && items_[i] == kPoint && earthHides(from.camera.pose().eye(), points_[i]);
  }

  const Rows& fieldsOf(bool isShape) const {
    if (isShape && !numbersOnly_ && !how_.fields.ofShapes.empty()) return how_.fields.ofShapes;
    return numbersOnly_ ? how_.fields.numbers : how_.fields.named;
  }

  void addOther(const Other& other, std::size_t i, ResultValues& values) {
    isOtherVisible_ = false;
    if (const auto* const segment = std::get_if<Segment>(&other))
      addSegment(*segment, *cameras_[i]->frustum, values);
    else if (const auto* const shape = std::get_if<CullShape>(&other))
      addShape(*shape, i, values);
    else
      addFields(kNoPoint, i, std::nullopt, fieldsOf(false), values);
  }

  void addSegment(const Segment& whole, const Frustum& frustum, ResultValues& values) {
    const VisibleSegment segment = clipSegment(frustum, whole.a, whole.b);
    isOtherVisible_ = segment.visible;
    values.add(segment.visible);
    for (const SegmentEnd& end : {segment.start, segment.end}) {
      values.addCount(segment.visible ? 1 : 0);
      if (!segment.visible) continue;
      values.add(end.t);
      values.add(end.screen);
      values.add(end.depth);
      values.add(end.viewDistance);
      values.addWord(sideName(end.side));
    }
  }

  void addShape(const CullShape& shape, std::size_t i, ResultValues& values) {
    const Camera& camera = cameras_[i]->camera;
    const auto box = std::visit(
        [&](const auto& one) -> std::optional<ScreenBox> {
          if constexpr (std::is_same_v<decltype(one), const Vec3&>)
            return std::nullopt;  // a point is none of these
          else
            return screenBox(camera, one);
        },
        shape);
    const Cull verdict = std::visit([&](const auto& one) { return cull(*cameras_[i]->frustum, one); }, shape);
    if (!box && verdict.verdict != CullVerdict::outside) requireNearFor("a shape that is not all in front", camera);
    // Of a sphere what is of one point is its center's.
    ScreenPoint screen = std::holds_alternative<Sphere>(shape) ? screen_[i] : kNoPoint;
    screen.status = PointStatus::inFront;
    if (verdict.verdict == CullVerdict::outside)
      screen.outside = verdict.side;
    else
      screen.outside = box ? sidesBeyond(camera, *box) : static_cast<std::uint8_t>(sideNear);
    isOtherVisible_ = screen.visible();
    addFields(screen, i, box, fieldsOf(true), values);
  }

  void addFields(const ScreenPoint& screen, std::size_t i, const std::optional<ScreenBox>& box, const Rows& rows,
                 ResultValues& values) const {
    const RecordCamera& camera = *cameras_[i];
    const bool isPoint = items_[i] == kPoint || std::isfinite(points_[i].x);
    const ProjectedPoint projected{camera,     camera.camera, how_.options,
                                   points_[i], screen,        box,
                                   isPoint,    errors_[i],    how_.hasMiss ? given_[i] : Vec2{kNaN, kNaN},
                                   isHidden(i)};
    for (const PointResult* result : rows)
      if (!(leftOut_[i] >> (result - kPointResults) & 1)) result->add(projected, values);
  }

  const Projecting& how_;
  bool numbersOnly_;
  bool hasShapeFields_ = false;  ///< of boxes and triangles
  bool isOtherVisible_ = false;  ///< the last of them that had results
  std::vector<const RecordCamera*> cameras_;
  std::vector<std::size_t> items_;  ///< kPoint, or the index of what it is else
  std::vector<std::uint32_t> leftOut_;
  std::vector<Other> others_;
  std::vector<Vec4> points_;  ///< of a segment, a shape without a center and null: NaN
  std::vector<Vec2> given_;   ///< pixels of the records
  std::vector<Vec3> positions_;
  std::vector<double> errors_;  ///< how far each may be from the true one
  std::vector<ScreenPoint> screen_;
};

struct Options {
  CameraOptions camera;
  RecordCameraOptions cameras;
  StreamOptions stream;
  Precision precision = Precision::exact;
  std::optional<Several<const PointResult*>> fields;
  std::vector<std::string> models;
};

int run(const Options& o) {
  // Then a point with a radius is a sphere.
  const bool asksForBoxes = o.fields && isIn(o.fields->named, results::screenBox);
  const bool hasMiss = o.fields && isIn(o.fields->named, results::miss);
  if (hasMiss && asksForBoxes)
    throw UsageError("--fields: miss is of points with a pixel and screenBox of shapes; keep one of them");
  StreamSetup setup = o.stream.setup(hasMiss ? kPairColumns : asksForBoxes ? kSphereColumns : kPointColumns);
  o.stream.reads(setup);
  Fields fields = fieldsOf(o.fields);
  const RecordCameras cameras = o.cameras.read(o.camera, setup, [&](const CameraFile& file) {
    requireFor(fields, file);
    if (setup.visibleOnly) requireSize(file, "--visible");
  });
  const bool hasUsualNumbers = fields.numbers == fieldsOf({}).numbers;
  if (const CameraFile* const file = cameras.first()) {
    for (auto* rows : {&fields.named, &fields.numbers})  // of all results, those that would be null are left out
      std::erase_if(*rows, [&](const PointResult* result) {
        return (needsNear(result) && !hasDepth(*file->projection)) || (needsUp(result) && !knowsUp(*file)) ||
               (needsSize(result) && file->lacksSize);
      });
    o.camera.noteHandedness(*file);
    if (file->lacksSize)
      note(file->name + ": its picture has no size: visible and outside are null; --viewport WIDTHxHEIGHT tells them");
  }
  o.stream.settleOnEarth(setup, cameras.worldIsEcef());
  Projecting how{.cameras = cameras,
                 .options = o.camera,
                 .precision = o.precision,
                 .reading = {.columns = setup.columns,
                             .worldIsEcef = cameras.worldIsEcef(),
                             .segments = !hasMiss,
                             .shapes = !hasMiss,
                             .radius = asksForBoxes,
                             .besideCamera = cameras.areInRecords()},
                 .fields = fields,
                 .hasMiss = hasMiss,
                 .prefix = setup.prefix,
                 .hasUsualNumbers = hasUsualNumbers};
  if (!o.models.empty()) how.worldFromLocal = readModel(o.models);
  setup.arrayName = hasMiss ? "pair" : "position";
  const bool lacksDepth = cameras.first() && !hasDepth(*cameras.first()->projection) && hasUsualNumbers;
  std::once_flag noted;
  return runFilter(setup, cameras, [&](OutputForm to) {
    if (lacksDepth && to == OutputForm::text)
      std::call_once(noted, [] {
        note("depth, the third number, is NaN without near; --fields screen,viewDistance writes the distance");
      });
    return std::make_unique<Projector>(how, to);
  });
}

}  // namespace

Action declareProject(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  describe(app, "World points to screen positions: each record of FILE with its pixel, depth and visibility appended.",
           "Examples:\n"
           "  viewproj project --position 3,2,5 --target 0,0,0 --fov-y 60 \\\n"
           "    --viewport 1280x720 --point 1,1,1\n"
           "  printf 'x,y,z\\n1,2,-9\\n' |\n"
           "    viewproj project --position 0,0,9 --target 0,0,0 --fov-y 60 --viewport 64x48");
  o->stream.add(app, "points");
  o->stream.addPoints(app);
  const auto readFields = [](const std::string& option, const std::string& text) {
    return chooseSeveral(option, text, fieldNames());
  };
  addValue(app, "--fields", "NAMES", o->fields, readFields, helpOnFields());
  addPrecision(app, o->precision);
  addModel(app, o->models, "Where the points' model stands in the world");
  o->camera.takeAnySize();
  o->camera.add(app);
  o->cameras.add(app, true);
  o->camera.addWriting(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
