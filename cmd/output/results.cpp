#include "output/results.hpp"

#include <array>
#include <numeric>

#include "text/error.hpp"
#include "text/names.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using P = const ProjectedPoint&;
using R = const ResultRow&;
using S = ResultSink&;

Vec3 xyz(const Vec4& v) { return {v.x, v.y, v.z}; }
Vec4 pointIn(Space space, P p) { return worldTo(p.camera, space, p.point, p.writing); }
double boundOf(P p) { return boundOfPoint(p.camera, p.point, p.screen.precision, p.error).screen; }
std::array<double, 4> edgesOf(P p) {
  const ScreenBox box = p.box.value_or(ScreenBox{kNaN, kNaN, kNaN, kNaN});
  return {box.left, box.top, box.right, box.bottom};
}

// clang-format off
constexpr PointResult kPointResults[] = {
    {results::screen, [](R row, P p, S sink) { sink.vector(row, Vec2{p.screen.x, p.screen.y}); }},
    {results::depth, [](R row, P p, S sink) { sink.number(row, p.screen.depth); }},
    {results::viewDistance, [](R row, P p, S sink) { sink.number(row, p.screen.viewDistance); }},
    {results::visible, [](R row, P p, S sink) { sink.flag(row, p.screen.visible()); }},
    {results::outside, [](R row, P p, S sink) { sink.text(row, Sides(p.screen).names()); }},
    {results::ndc, [](R row, P p, S sink) { sink.vector(row, xyz(pointIn(Space::ndc, p))); }},
    {results::clip, [](R row, P p, S sink) { sink.vector(row, pointIn(Space::clip, p)); }},
    {results::view, [](R row, P p, S sink) { sink.vector(row, xyz(pointIn(Space::view, p))); }},
    {results::pixelSize, [](R row, P p, S sink) { sink.vector(row, pixelSize(p.camera, p.screen.viewDistance)); }},
    {results::screenBox, [](R row, P p, S sink) { sink.vector(row, edgesOf(p)); }},
    {results::bound, [](R row, P p, S sink) { sink.number(row, boundOf(p)); }},
};
// clang-format on

void addColumns(std::vector<std::string>& columns, const ResultRow& row, const std::string& prefix, bool table) {
  const std::string name = prefix + columnName(row.name);
  if (row.kind == ResultKind::group)
    for (const ResultRow* part : row.parts) addColumns(columns, *part, name + "_", table);
  else if (row.kind == ResultKind::vector && !table)
    for (std::size_t i = 0; i < row.size; ++i) columns.push_back(name + std::string(row.suffixes[i]));
  else
    columns.push_back(name);
}

}  // namespace

Sides::Sides(const ScreenPoint& p) {
  if (p.status == PointStatus::behind) names_[count_++] = "behind";
  if (p.status == PointStatus::beyondLens) names_[count_++] = "lens";
  for (const SideName& one : kSides)
    if (p.outside & one.side) names_[count_++] = one.name;
}

std::string_view sideName(unsigned side) {
  for (const SideName& one : kSides)
    if (one.side == side) return one.name;
  return "";
}

std::span<const PointResult> pointResults() { return kPointResults; }

const Results& allResults() {
  static const Results all = [] {
    Results rows;
    for (const PointResult& result : kPointResults) rows.push_back(&result.row);
    for (const auto& more : {std::span<const ResultRow* const>(results::kSegment), {results::kRay}, {results::kCull}})
      rows.insert(rows.end(), more.begin(), more.end());
    return rows;
  }();
  return all;
}

const ResultRow* findResult(std::string_view name) {
  for (const ResultRow* row : allResults())
    if (row->name == name) return row;
  return nullptr;
}

std::vector<std::string> columnsOf(std::span<const ResultRow* const> rows, std::string_view prefix, bool table) {
  std::vector<std::string> columns;
  for (const ResultRow* row : rows) addColumns(columns, *row, std::string(prefix), table);
  return columns;
}

std::size_t numbersOf(const ResultRow& row) {
  switch (row.kind) {
    case ResultKind::number:
    case ResultKind::flag:
      return 1;
    case ResultKind::vector:
      return row.size;
    case ResultKind::group:
      return std::accumulate(row.parts.begin(), row.parts.end(), std::size_t{0},
                             [](std::size_t sum, const ResultRow* part) { return sum + numbersOf(*part); });
    default:
      return 0;
  }
}

void requireRoom(std::span<const ResultRow* const> rows, OutputForm form) {
  const bool numbersOnly = form == OutputForm::text || form == OutputForm::f64;
  if (!numbersOnly && !hasColumns(form)) return;
  std::size_t numbers = 0;
  for (const ResultRow* row : rows) {
    const std::string name(row->name);
    numbers += numbersOf(*row);
    if (row->kind == ResultKind::list)
      throw UsageError("a list of " + name + " has no place in " +
                       (numbersOnly ? "text and f64" : "the columns of CSV") + "; use JSON");
    if (numbersOnly && row->kind == ResultKind::names)
      throw UsageError("--fields " + name + ": text and f64 have numbers only; use JSON or CSV");
  }
  if (numbersOnly && numbers == 0 && !rows.empty())
    throw UsageError("the results are words, which have no place in text and f64; use JSON or CSV");
}

}  // namespace viewproj::cmd
