#include "output/results.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

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

Sides::Sides(const ScreenPoint& p, bool isHidden) {
  if (p.status == PointStatus::behind) names_[count_++] = "behind";
  if (p.status == PointStatus::beyondLens) names_[count_++] = "lens";
  for (const SideName& one : kSides)
    if (p.outside & one.side) names_[count_++] = one.name;
  if (isHidden) names_[count_++] = "earth";
}

void addSides(ResultValues& values, const ScreenPoint& point, bool isHidden) {
  if (point.visible() && !isHidden)
    values.addCount(0);
  else
    values.addNames(Sides(point, isHidden).names());
}

std::string_view sideName(unsigned side) {
  for (const SideName& one : kSides)
    if (one.side == side) return one.name;
  return "";
}

std::span<const double> ResultCursor::vector(std::size_t size) {
  const std::span all(number, size);
  number += size;
  return std::all_of(all.begin(), all.end(), [](double value) { return std::isfinite(value); }) ? all : all.first(0);
}

const ResultRows& allResults() {
  static const ResultRows all = [] {
    ResultRows rows;
    for (const auto& some : {std::span<const ResultRow* const>(results::kPoint),
                             {results::kSegment},
                             {results::kRay},
                             {results::kCull},
                             {results::kCamera},
                             {results::kMeeting}})
      rows.insert(rows.end(), some.begin(), some.end());
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
  const bool numbersOnly = hasNumbersOnly(form);
  if (!numbersOnly && !hasColumns(form)) return;
  std::size_t numbers = 0;
  for (const ResultRow* row : rows) {
    const std::string name(row->name);
    numbers += numbersOf(*row);
    if (row->kind == ResultKind::list)
      throw UsageError("a list of " + name + " has no place in " +
                       (numbersOnly ? "text and f64" : "the columns of CSV") + "; use --to json");
    if (numbersOnly && row->kind == ResultKind::names)
      throw UsageError("--fields " + name + ": text and f64 have numbers only; use --to json or csv");
  }
  if (numbersOnly && numbers == 0 && !rows.empty())
    throw UsageError("the results are words, which have no place in text and f64; use --to json or csv");
}

}  // namespace viewproj::cmd
