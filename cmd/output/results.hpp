// What commands append to records: each result is a row, which the writers, --fields, the columns of CSV and messages
// follow from, and which goes to a sink. To add one: a row in results.cpp (project), or here, with its call in the
// command.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/form.hpp"
#include "text/names.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

enum class ResultKind : unsigned char {
  number,
  vector,  ///< two to four numbers, null as a whole
  flag,
  names,  ///< a list of words
  word,
  json,   ///< a value of the input: a string or a number
  group,  ///< an object of parts
  list,   ///< of such objects
};

/// Where a result is written without being named.
enum class Default : unsigned char {
  everywhere,
  named,  ///< where results have names: not in text and f64
  never,  ///< where an option or a field of the record requires it
};

struct ResultRow {
  std::string_view name;  ///< as JSON has it
  ResultKind kind = ResultKind::number;
  std::size_t size = 1;  ///< numbers of a vector
  std::span<const ResultRow* const> parts = {};
  Default byDefault = Default::everywhere;
  std::span<const std::string_view> suffixes = kColumnSuffixes;  ///< of a vector's columns

  consteval ResultRow whereNamed() const { return {name, kind, size, parts, Default::named, suffixes}; }
  consteval ResultRow onRequest() const { return {name, kind, size, parts, Default::never, suffixes}; }
  consteval ResultRow inColumns(std::span<const std::string_view> names) const {
    return {name, kind, size, parts, byDefault, names};
  }
};

using Results = std::vector<const ResultRow*>;

/// Receives the results of a record, each with its row. A number that is not finite has no value: null, an empty cell,
/// or NaN.
class ResultSink {
 public:
  virtual ~ResultSink() = default;
  virtual void number(const ResultRow& row, double value) = 0;
  /// Null as a whole if one of the numbers is not finite.
  virtual void vector(const ResultRow& row, std::span<const double> values) = 0;
  void vector(const ResultRow& row, const Vec2& v) { vector(row, std::array{v.x, v.y}); }
  void vector(const ResultRow& row, const Vec3& v) { vector(row, std::array{v.x, v.y, v.z}); }
  void vector(const ResultRow& row, const Vec4& v) { vector(row, std::array{v.x, v.y, v.z, v.w}); }
  virtual void flag(const ResultRow& row, bool value) = 0;
  /// A list of words; of one, or of a JSON value as text, it is that, and of none it is null. Forms of numbers alone
  /// leave it out.
  virtual void text(const ResultRow& row, std::span<const std::string_view> words) = 0;
  void text(const ResultRow& row, std::string_view word) { text(row, {&word, word.empty() ? 0u : 1u}); }
  /// A group or a list: an object for each of `count`, whose results `write` writes. A group of none is null; in CSV
  /// and text it is the empty cells that `write` makes of values without a number. A list is for JSON alone.
  using WriteParts = std::function<void(ResultSink&, std::size_t)>;
  virtual void object(const ResultRow& row, std::size_t count, const WriteParts& write) = 0;

  /// Every record gets the same results, with or without a value.
  virtual bool hasFixedColumns() const { return false; }
  /// Numbers only, without names.
  virtual bool isText() const { return false; }
};

/// The sides of the view, in the interface's order, and how results name them.
struct SideName {
  Side side;
  std::string_view name;
};
inline constexpr SideName kSides[] = {{sideLeft, "left"}, {sideRight, "right"}, {sideBottom, "bottom"},
                                      {sideTop, "top"},   {sideNear, "near"},   {sideFar, "far"}};
/// What a point lies beyond, in the interface's order.
class Sides {
 public:
  explicit Sides(const ScreenPoint& point);
  std::span<const std::string_view> names() const { return {names_.data(), count_}; }

 private:
  std::array<std::string_view, 6> names_;
  std::size_t count_ = 0;
};
/// Empty for 0.
std::string_view sideName(unsigned side);

consteval ResultRow numberResult(std::string_view name) { return {name}; }
consteval ResultRow vectorResult(std::string_view name, std::size_t size) { return {name, ResultKind::vector, size}; }
consteval ResultRow groupResult(std::string_view name, std::span<const ResultRow* const> parts) {
  return {name, ResultKind::group, 1, parts};
}

// clang-format off
namespace results {

inline constexpr ResultRow
    screen = vectorResult("screen", 2),
    depth = numberResult("depth"),
    viewDistance = numberResult("viewDistance").whereNamed(),
    visible = ResultRow{"visible", ResultKind::flag}.whereNamed(),
    outside = ResultRow{"outside", ResultKind::names}.whereNamed(),
    ndc = vectorResult("ndc", 3).onRequest(),
    clip = vectorResult("clip", 4).onRequest(),
    view = vectorResult("view", 3).onRequest(),
    bound = numberResult("bound").onRequest();
inline constexpr std::string_view kAcross[] = {"_across", "_down"}, kEdges[] = {"_left", "_top", "_right", "_bottom"};
inline constexpr ResultRow
    pixelSize = vectorResult("pixelSize", 2).inColumns(kAcross).onRequest(),
    screenBox = vectorResult("screenBox", 4).inColumns(kEdges).onRequest();

// A segment: the ends of what is visible of it.
inline constexpr ResultRow
    t = numberResult("t"),
    cutBy = {"cutBy", ResultKind::word};
inline constexpr const ResultRow *kEndParts[] = {&t, &screen, &depth, &viewDistance, &cutBy};
inline constexpr ResultRow
    start = groupResult("start", kEndParts).whereNamed(),
    end = groupResult("end", kEndParts).whereNamed();
inline constexpr const ResultRow* kSegment[] = {&visible, &start, &end};

// A ray, the point on it, and what it hits.
inline constexpr ResultRow
    origin = vectorResult("origin", 3),
    direction = vectorResult("direction", 3),
    point = vectorResult("point", 3).onRequest(),
    hitId = {"id", ResultKind::json},
    distance = numberResult("distance"),
    hitPoint = vectorResult("point", 3),
    normal = vectorResult("normal", 3),
    lat = numberResult("lat").onRequest(),
    lon = numberResult("lon").onRequest(),
    height = numberResult("height").onRequest();
inline constexpr const ResultRow *kHitParts[] = {&hitId, &distance, &hitPoint, &normal},
                                 *kPlacedHitParts[] = {&hitId, &distance, &hitPoint, &normal, &lat, &lon, &height};
inline constexpr ResultRow
    hit = groupResult("hit", kHitParts).onRequest(),
    placedHit = groupResult("hit", kPlacedHitParts).onRequest(),
    hits = ResultRow{"hits", ResultKind::list, 1, kPlacedHitParts}.onRequest(),
    pointDistance = numberResult("viewDistance").onRequest();
inline constexpr const ResultRow *kPlaceParts[] = {&lat, &lon, &height};
inline constexpr ResultRow
    place = groupResult("place", kPlaceParts).onRequest();
inline constexpr const ResultRow* kRay[] = {&origin, &direction, &point, &place, &pointDistance, &bound, &placedHit, &hit, &hits};

inline constexpr ResultRow
    cull = ResultRow{"cull", ResultKind::word}.whereNamed(),
    plane = ResultRow{"plane", ResultKind::word}.whereNamed();
inline constexpr const ResultRow* kCull[] = {&cull, &plane};

}  // namespace results
// clang-format on

/// A point and what project knows of it.
struct ProjectedPoint {
  const Camera& camera;
  const Convention& writing;  ///< of ndc, clip and view
  const Vec4& point;
  const ScreenPoint& screen;
  const std::optional<ScreenBox>& box;  ///< of a shape
  double error;                         ///< how far the point may be from the true one
};

/// A result of project.
struct PointResult {
  ResultRow row;
  void (*write)(const ResultRow& row, const ProjectedPoint& point, ResultSink& sink);
};

std::span<const PointResult> pointResults();

/// Of all commands.
const Results& allResults();
/// The one of this name; null: none.
const ResultRow* findResult(std::string_view name);

/// The columns of CSV. table: a vector has one cell.
std::vector<std::string> columnsOf(std::span<const ResultRow* const> rows, std::string_view prefix = "",
                                   bool table = false);

/// The numbers of text and f64.
std::size_t numbersOf(const ResultRow& row);

/// Throws UsageError where a form cannot hold them.
void requireRoom(std::span<const ResultRow* const> rows, OutputForm form);

}  // namespace viewproj::cmd
