// What commands append to records: each result is a row, which the writers, --fields, the columns of CSV, messages and
// the schema follow from. To add one: a row in results.cpp (project), or here, with its call in the command.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/result_row.hpp"
#include "output/result_sink.hpp"
#include "text/form.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

// clang-format off
namespace results {

inline constexpr std::string_view kWorldUnit = "the world's unit";
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline constexpr ResultRow
    screen = vectorResult("screen", 2, "pixels", "position in the picture, as the viewport counts").orNull(),
    depth = numberResult("depth", "window depth", "depthRange's first at near, its second at far; reverseZ exchanges them").orNull(),
    viewDistance = numberResult("viewDistance", kWorldUnit, "along the viewing axis; null for a direction").whereNamed().orNull(),
    visible = flagResult("visible", "within the picture, near and far").whereNamed();
inline constexpr std::string_view kAcross[] = {"_across", "_down"}, kEdges[] = {"_left", "_top", "_right", "_bottom"};
inline constexpr ResultRow
    pixelSize = vectorResult("pixelSize", 2, kWorldUnit, "what a pixel spans there, across and down").inColumns(kAcross).asked().orNull(),
    screenBox = vectorResult("screenBox", 4, "pixels", "of a shape: left, top, right, bottom of what lies in front of near").inColumns(kEdges).asked().orNull();

// A segment: the ends of what is visible of it, and the point of it under the record's pixel.
inline constexpr ResultRow
    t = numberResult("t", "0 to 1", "share of the whole segment").within(0, 1),
    cutBy = wordResult("cutBy", ResultWords::sides, "the side that cuts it there").orNull(),
    underT = numberResult("t", "0 to 1", "share of the whole segment").orNull(),
    underPoint = vectorResult("point", 3, kWorldUnit, "the point itself").orNull();
inline constexpr const ResultRow *kEndParts[] = {&t, &screen, &depth, &viewDistance, &cutBy},
                                 *kUnderParts[] = {&underT, &underPoint};
inline constexpr ResultRow
    start = groupResult("start", kEndParts, "where it becomes visible").whereNamed().orNull(),
    end = groupResult("end", kEndParts, "where it ceases to be").whereNamed().orNull(),
    under = groupResult("under", kUnderParts, "the point of it under the record's pixel").asked().orNull();
inline constexpr const ResultRow* kSegment[] = {&visible, &start, &end, &under};

// A ray, the point on it, and what it hits.
inline constexpr ResultRow
    origin = vectorResult("origin", 3, kWorldUnit, "where the ray begins").orNull(),
    direction = vectorResult("direction", 3, "unit length", "where it goes").within(-1, 1).orNull(),
    point = vectorResult("point", 3, kWorldUnit, "of the record's depth or viewDistance").asked().orNull(),
    pointBound = numberResult("bound", kWorldUnit, "with --fields bound: how far point may be off as its depth was rounded").asked().orNull(),
    hitId = jsonResult("id", "of the object"),
    distance = numberResult("distance", kWorldUnit, "from the ray's origin").within(0, kInfinity),
    hitPoint = vectorResult("point", 3, kWorldUnit, "where it hits"),
    normal = vectorResult("normal", 3, "unit length", "of the surface there"),
    lat = numberResult("lat", "degrees", "with a camera on the Earth, and where an ellipsoid is hit").asked(),
    lon = numberResult("lon", "degrees", "with a camera on the Earth, and where an ellipsoid is hit").asked(),
    height = numberResult("height", "metres", "above the ellipsoid").asked();
inline constexpr const ResultRow *kHitParts[] = {&hitId, &distance, &hitPoint, &normal},
                                 *kPlacedHitParts[] = {&hitId, &distance, &hitPoint, &normal, &lat, &lon, &height};
inline constexpr ResultRow
    hit = groupResult("hit", kHitParts, "the nearest of a scene").asked().orNull(),
    placedHit = groupResult("hit", kPlacedHitParts, "the nearest of a scene").asked().orNull(),
    hits = listResult("hits", kPlacedHitParts, "all of a scene, nearest first").asked(),
    pointDistance = numberResult("viewDistance", kWorldUnit, "of the point, along the viewing axis; where the record has it not").asked().orNull();
inline constexpr const ResultRow *kPlaceParts[] = {&lat, &lon, &height};
inline constexpr ResultRow
    place = groupResult("place", kPlaceParts, "of the point, with a camera on the Earth").asked().orNull();
inline constexpr const ResultRow* kRay[] = {&origin, &direction, &point, &place, &pointDistance, &pixelSize, &pointBound, &placedHit, &hit, &hits};

inline constexpr ResultRow
    cull = wordResult("cull", ResultWords::verdicts, "where it lies").whereNamed(),
    plane = wordResult("plane", ResultWords::sides, "which one decides; null for inside").whereNamed().orNull();
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
  bool outsideAlways = false;           ///< `outside` is written where it is empty too
};

/// A result of project.
struct PointResult {
  ResultRow row;
  void (*write)(const ResultRow& row, const ProjectedPoint& point, ResultSink& sink);
  /// Of the convention that is written: nothing, its axes, or its range of depth too.
  enum class Shows : unsigned char { nothing, axes, depth } shows = Shows::nothing;
};

std::span<const PointResult> pointResults();

/// Of all commands.
const Results& allResults();
/// The one of this name, after the prefix; null: none.
const ResultRow* findResult(std::string_view name, std::string_view prefix = "");

/// The command that writes a result which project does not; empty: none.
std::string_view otherCommandOf(std::string_view name);

/// The words that a result of words can have, as JSON knows them; empty: any.
std::span<const std::string_view> wordsOf(ResultWords words);

/// The columns of CSV. table: a vector has one cell.
std::vector<std::string> columnsOf(std::span<const ResultRow* const> rows, std::string_view prefix = "",
                                   bool table = false);

/// A column that may have what --keep-going of an earlier run said of a bad record.
struct ErrorColumn {
  std::size_t column;
  bool afterResult;    ///< as that writes it
  bool beforeResults;  ///< and other results follow: a later run took it over
};
/// Those called error, after a prefix or none. results: those of this run; the columns of other runs' are known.
std::vector<ErrorColumn> errorColumns(std::span<const std::string> names, const Results& results);
inline constexpr std::string_view kErrorName = "error";

/// The numbers of text and f64.
std::size_t numbersOf(const ResultRow& row);

/// Throws UsageError where a form cannot hold them.
void requireRoom(std::span<const ResultRow* const> rows, OutputForm form);

}  // namespace viewproj::cmd
