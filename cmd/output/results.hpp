// What commands append to records. Each result is a row, from which --fields, the columns of CSV and messages follow,
// and its values. To add one: a row here, and its values in the command.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/form.hpp"
#include "text/names.hpp"
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
  bool leftOutIfNone = false;                                    ///< JSON: in place of null

  consteval ResultRow whereNamed() const { return {name, kind, size, parts, Default::named, suffixes}; }
  consteval ResultRow onRequest() const { return {name, kind, size, parts, Default::never, suffixes}; }
  consteval ResultRow inColumns(std::span<const std::string_view> names) const {
    return {name, kind, size, parts, byDefault, names};
  }
  consteval ResultRow ifAny() const { return {name, kind, size, parts, byDefault, suffixes, true}; }
};

using ResultRows = std::vector<const ResultRow*>;

/// The results of a record, in the order of its rows. A number or a flag (0 or 1) is a number, a vector its numbers, a
/// word or a JSON text a word, which is empty where there is none. Names are their count, a number, and the words. A
/// group is 1 and the values of its parts, or 0 where there is none; a list its length and the values of each item. A
/// number that is not finite has no value, nor has a vector with one; so has a flag or the count of names.
struct ResultValues {
  std::vector<double> numbers;
  std::vector<std::string_view> words;

  void clear() {
    numbers.clear();
    words.clear();
  }
  void add(double number) { numbers.push_back(number); }
  void add(bool flag) { numbers.push_back(flag ? 1 : 0); }
  void add(const Vec2& v) { addAll(v.x, v.y); }
  void add(const Vec3& v) { addAll(v.x, v.y, v.z); }
  void add(const Vec4& v) { addAll(v.x, v.y, v.z, v.w); }
  void addWord(std::string_view word) { words.push_back(word); }
  void addNames(std::span<const std::string_view> names) {
    add(static_cast<double>(names.size()));
    words.insert(words.end(), names.begin(), names.end());
  }
  /// Of a group or a list, before the values of so many.
  void addCount(std::size_t count) { add(static_cast<double>(count)); }

 private:
  template <class... Numbers>
  void addAll(Numbers... all) {
    (numbers.push_back(all), ...);
  }
};

inline std::string_view flagText(double flag, std::string_view none) {
  return std::isnan(flag) ? none : flag != 0 ? "true" : "false";
}

/// Reads values in the order of the rows.
struct ResultCursor {
  const double* number;
  const std::string_view* word;

  explicit ResultCursor(const ResultValues& values) : number(values.numbers.data()), word(values.words.data()) {}
  std::size_t count() { return static_cast<std::size_t>(*number++); }
  /// Whether names are unknown, which are then passed.
  bool skipsNone() {
    const bool isNone = std::isnan(*number);
    if (isNone) ++number;
    return isNone;
  }
  /// Empty where one of them is not finite.
  std::span<const double> vector(std::size_t size);
  std::span<const std::string_view> names(std::size_t size) {
    word += size;
    return {word - size, size};
  }
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
  /// isHidden: by the Earth.
  explicit Sides(const ScreenPoint& point, bool isHidden = false);
  std::span<const std::string_view> names() const { return {names_.data(), count_}; }

 private:
  std::array<std::string_view, 7> names_;
  std::size_t count_ = 0;
};
void addSides(ResultValues& values, const ScreenPoint& point, bool isHidden = false);
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
    azimuth = numberResult("azimuth").onRequest(),
    elevation = numberResult("elevation").onRequest(),
    range = numberResult("range").onRequest(),
    bound = numberResult("bound").onRequest();
inline constexpr std::string_view kAcross[] = {"_across", "_down"}, kEdges[] = {"_left", "_top", "_right", "_bottom"};
inline constexpr ResultRow
    pixelSize = vectorResult("pixelSize", 2).inColumns(kAcross).onRequest(),
    miss = vectorResult("miss", 2).onRequest(),
    screenBox = vectorResult("screenBox", 4).inColumns(kEdges).onRequest();
inline constexpr const ResultRow* kPoint[] = {&screen, &depth, &viewDistance, &visible, &outside, &ndc, &clip, &view, &pixelSize, &miss, &screenBox, &azimuth, &elevation, &range, &bound};

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
    height = numberResult("height").onRequest(),
    altitude = numberResult("altitude").onRequest(),
    // Of a hit: only points of the Earth are places.
    hitLat = numberResult("lat").ifAny(),
    hitLon = numberResult("lon").ifAny(),
    hitHeight = numberResult("height").ifAny(),
    hitAltitude = numberResult("altitude").ifAny();
inline constexpr const ResultRow *kHitParts[] = {&hitId, &distance, &hitPoint, &normal},
                                 *kPlacedHitParts[] = {&hitId, &distance, &hitPoint, &normal, &hitLat, &hitLon, &hitHeight},
                                 *kSeaHitParts[] = {&hitId, &distance, &hitPoint, &normal, &hitLat, &hitLon, &hitHeight, &hitAltitude};
inline constexpr ResultRow
    hit = groupResult("hit", kHitParts).onRequest(),
    placedHit = groupResult("hit", kPlacedHitParts).onRequest(),
    hits = ResultRow{"hits", ResultKind::list, 1, kPlacedHitParts}.onRequest(),
    seaHit = groupResult("hit", kSeaHitParts).onRequest(),  // with --geoid
    seaHits = ResultRow{"hits", ResultKind::list, 1, kSeaHitParts}.onRequest(),
    pointDistance = numberResult("viewDistance").onRequest(),
    undistorted = vectorResult("undistorted", 2).onRequest();
inline constexpr const ResultRow *kPlaceParts[] = {&lat, &lon, &height}, *kSeaPlaceParts[] = {&lat, &lon, &height, &altitude};
inline constexpr ResultRow
    place = groupResult("place", kPlaceParts).onRequest(),
    seaPlace = groupResult("place", kSeaPlaceParts).onRequest();
inline constexpr const ResultRow* kRay[] = {&origin, &direction, &point, &place, &pointDistance, &bound, &placedHit, &hit, &hits, &undistorted};

inline constexpr ResultRow
    camera = {"camera", ResultKind::word};
inline constexpr const ResultRow* kCamera[] = {&camera};

// Where rays meet.
inline constexpr ResultRow
    position = vectorResult("position", 3),
    reason = {"reason", ResultKind::word},
    rays = numberResult("rays"),
    rmsMiss = numberResult("rmsMiss"),
    largestMiss = numberResult("largestMiss"),
    worst = numberResult("worst"),
    wrong = numberResult("wrong"),
    angle = numberResult("angle"),
    sigma = vectorResult("sigma", 3),
    line = numberResult("line");
inline constexpr const ResultRow* kMissParts[] = {&line, &camera, &miss};
inline constexpr ResultRow
    misses = {"misses", ResultKind::list, 1, kMissParts};
inline constexpr const ResultRow* kMeeting[] = {&reason, &rays, &rmsMiss, &largestMiss, &worst, &wrong, &angle, &sigma};

inline constexpr ResultRow
    cull = ResultRow{"cull", ResultKind::word}.whereNamed(),
    plane = ResultRow{"plane", ResultKind::word}.whereNamed();
inline constexpr const ResultRow* kCull[] = {&cull, &plane};

}  // namespace results
// clang-format on

/// Of all commands.
const ResultRows& allResults();
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
