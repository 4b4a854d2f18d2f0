#include "output/table.hpp"

#include <algorithm>
#include <cstdint>

#include "text/csv.hpp"
#include "text/layout.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kRowsForWidths = 1000, kBytesForWidths = 1 << 20, kWidest = 200;

void widen(std::vector<std::size_t>& widths, const TextRows& rows, std::size_t widest = SIZE_MAX) {
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      if (row[i].size() <= widest) widths[i] = std::max(widths[i], columnsOf(row[i]));
    }
}

void appendInColumns(std::string& out, const TextRows& rows, const std::vector<std::size_t>& widths,
                     const std::function<bool(std::size_t column)>& isRightAligned, std::size_t indent = 0) {
  for (const auto& row : rows) {
    out.append(indent, ' ');
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t width = i < widths.size() ? widths[i] : 0;
      const std::string padding(width - std::min(width, columnsOf(row[i])), ' ');
      out += (i > 0 ? "  " : "") + (isRightAligned(i) ? padding + row[i] : row[i] + padding);
    }
    out.erase(out.find_last_not_of(' ') + 1);
    out += '\n';
  }
}

}  // namespace

std::string aligned(const TextRows& rows, const std::function<bool(std::size_t column)>& isRightAligned,
                    std::size_t indent) {
  std::vector<std::size_t> widths;
  widen(widths, rows);
  std::string out;
  appendInColumns(out, rows, widths, isRightAligned, indent);
  return out;
}

std::string CsvAligner::add(std::string_view csv) {
  std::string out;
  CsvRecord record;
  for (std::size_t at = 0; at < csv.size(); at += record.end + 1) {
    record.split(csv.substr(at), separator_);
    std::vector<std::string>& row = rows_.emplace_back();
    for (std::string_view cell : record.fields) {
      row.push_back(csvValue(cell));
      // A line of the table is a line.
      std::replace_if(
          row.back().begin(), row.back().end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
      row.back() = visible(row.back());
    }
    bytes_ += record.end;
    if (widthsAreSet_ || rows_.size() >= kRowsForWidths || bytes_ >= kBytesForWidths) align(out);
  }
  return out;
}

std::string CsvAligner::rest() {
  std::string out;
  align(out);
  return out;
}

void CsvAligner::align(std::string& out) {
  if (!widthsAreSet_) widen(widths_, rows_, kWidest);
  widthsAreSet_ = true;
  appendInColumns(out, rows_, widths_, [](std::size_t column) { return column > 0; });
  rows_.clear();
  bytes_ = 0;
}

}  // namespace viewproj::cmd
