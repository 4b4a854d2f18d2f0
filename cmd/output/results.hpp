// What commands append to records: each result is a row, which the writers, --fields, the columns of CSV and messages
// follow from. To add one: a row in results.cpp (project), or here, with its call in the command.
#pragma once

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

inline constexpr ResultRow
    screen = vectorResult("screen", 2),
    depth = numberResult("depth"),
    viewDistance = numberResult("viewDistance").whereNamed(),
    visible = ResultRow{"visible", ResultKind::flag}.whereNamed();
inline constexpr std::string_view kAcross[] = {"_across", "_down"}, kEdges[] = {"_left", "_top", "_right", "_bottom"};
inline constexpr ResultRow
    pixelSize = vectorResult("pixelSize", 2).inColumns(kAcross).asked(),
    screenBox = vectorResult("screenBox", 4).inColumns(kEdges).asked();

// A segment: the ends of what is visible of it, and the point of it under the record's pixel.
inline constexpr ResultRow
    t = numberResult("t"),
    cutBy = {"cutBy", ResultKind::word},
    underT = numberResult("t"),
    underPoint = vectorResult("point", 3);
inline constexpr const ResultRow *kEndParts[] = {&t, &screen, &depth, &viewDistance, &cutBy},
                                 *kUnderParts[] = {&underT, &underPoint};
inline constexpr ResultRow
    start = groupResult("start", kEndParts).whereNamed(),
    end = groupResult("end", kEndParts).whereNamed(),
    under = groupResult("under", kUnderParts).asked();
inline constexpr const ResultRow* kSegment[] = {&visible, &start, &end, &under};

// A ray, the point on it, and what it hits.
inline constexpr ResultRow
    origin = vectorResult("origin", 3),
    direction = vectorResult("direction", 3),
    point = vectorResult("point", 3).asked(),
    pointBound = numberResult("bound").asked(),
    hitId = {"id", ResultKind::json},
    distance = numberResult("distance"),
    hitPoint = vectorResult("point", 3),
    normal = vectorResult("normal", 3),
    lat = numberResult("lat").asked(),
    lon = numberResult("lon").asked(),
    height = numberResult("height").asked();
inline constexpr const ResultRow *kHitParts[] = {&hitId, &distance, &hitPoint, &normal},
                                 *kPlacedHitParts[] = {&hitId, &distance, &hitPoint, &normal, &lat, &lon, &height};
inline constexpr ResultRow
    hit = groupResult("hit", kHitParts).asked(),
    placedHit = groupResult("hit", kPlacedHitParts).asked(),
    hits = ResultRow{"hits", ResultKind::list, 1, kPlacedHitParts}.asked(),
    pointDistance = numberResult("viewDistance").asked();
inline constexpr const ResultRow *kPlaceParts[] = {&lat, &lon, &height};
inline constexpr ResultRow
    place = groupResult("place", kPlaceParts).asked();
inline constexpr const ResultRow* kRay[] = {&origin, &direction, &point, &place, &pointDistance, &pixelSize, &pointBound, &placedHit, &hit, &hits};

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
  bool outsideAlways = false;           ///< `outside` is written where it is empty too
};

/// A result of project.
struct PointResult {
  ResultRow row;
  void (*write)(const ResultRow& row, const ProjectedPoint& point, ResultSink& sink);
};

std::span<const PointResult> pointResults();

/// Of all commands.
const Results& allResults();
/// The one of this name, after the prefix; null: none.
const ResultRow* findResult(std::string_view name, std::string_view prefix = "");

/// The command that writes a result which project does not; empty: none.
std::string_view otherCommandOf(std::string_view name);

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
