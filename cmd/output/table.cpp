#include "output/table.hpp"

#include <algorithm>

#include "input/record.hpp"
#include "stream/csv_lines.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kRowsThatTell = 1000;

using Rows = std::vector<std::vector<std::string>>;

void widen(std::vector<std::size_t>& widths, const Rows& rows) {
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == widths.size()) widths.push_back(0);
      widths[i] = std::max(widths[i], row[i].size());
    }
}

std::string inColumns(const Rows& rows, const std::vector<std::size_t>& widths) {
  std::string out;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::size_t width = i < widths.size() ? widths[i] : 0;
      const std::size_t padding = width - std::min(width, row[i].size());
      if (i > 0) out.append(padding + 2, ' ');
      out += row[i];
      if (i == 0 && row.size() > 1) out.append(padding, ' ');
    }
    out.erase(out.find_last_not_of(' ') + 1);
    out += '\n';
  }
  return out;
}

}  // namespace

std::string alignedTable(const Rows& rows) {
  std::vector<std::size_t> widths;
  widen(widths, rows);
  return inColumns(rows, widths);
}

std::string CsvAligner::add(std::string_view csv) {
  std::vector<std::string_view> cells;
  for (std::size_t at = 0, end; at < csv.size(); at = end + 1) {
    end = endOfCsvRecord(csv, at);
    cells.clear();
    splitCsvLine(csv.substr(at, end - at), cells);
    std::vector<std::string>& row = rows_.emplace_back();
    for (std::string_view cell : cells) {
      row.push_back(csvValue(cell));
      // A line of the table is a line.
      std::replace(row.back().begin(), row.back().end(), '\n', ' ');
    }
  }
  return rows_.size() >= kRowsThatTell || widthsAreSet_ ? aligned() : "";
}

std::string CsvAligner::rest() { return aligned(); }

std::string CsvAligner::aligned() {
  if (!widthsAreSet_) widen(widths_, rows_);
  widthsAreSet_ = true;
  std::string text = inColumns(rows_, widths_);
  rows_.clear();
  return text;
}

}  // namespace viewproj::cmd
