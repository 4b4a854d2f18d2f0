#include "commands/measure/report.hpp"

#include <cmath>
#include <cstdio>

#include "output/plot.hpp"
#include "output/record_writer.hpp"
#include "output/table.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

std::string printed(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string orDash(const std::optional<double>& value, std::string (*format)(double)) {
  return value ? format(*value) : "-";
}

/// What is not finite shows as such.
std::string asError(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return "infinite";
  return value == 0 ? "0" : printed("%.1e", value);
}

/// Ulps are small numbers, until they are not.
std::string asUlps(double value) {
  return value == 0 || !std::isfinite(value) || value >= 1e4 ? asError(value) : formatDigits(value, 3);
}

/// The textbook has none; orthographic rays have one, but not in pixels.
std::string asBound(const ModeRow& row) { return row.boundPx ? asError(*row.boundPx) : row.precision ? "-" : "none"; }

std::string asShare(double share) { return share == 0 ? "0" : formatDigits(share * 100, 3) + " %"; }

std::string asTime(double ns) { return ns < 1000 ? formatDigits(ns, 3) : printed("%.0f", ns); }

std::string asCount(const std::optional<std::size_t>& count) { return count ? std::to_string(*count) : "-"; }

/// auto says what it chose.
std::string nameOf(const ModeRow& row) {
  return row.mode == "auto" ? "auto (" + std::string(precisionName(*row.precision)) + ")" : row.mode;
}

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string sampleOf(const Measurement& m) {
  return plural(m.points, "point") + ", " + std::to_string(m.visible) + " of them in the picture";
}

void appendField(std::string& out, const char* name, const std::optional<double>& value) {
  out += ", \"" + std::string(name) + "\": " + (value ? formatNumber(*value) : "null");
}

std::string rowAsJson(const ModeRow& row) {
  std::string out = "{\"mode\": ";
  out += jsonString(row.mode);
  out += ", \"precision\": " + (row.precision ? "\"" + std::string(precisionName(*row.precision)) + "\"" : "null");
  appendField(out, "nsPerPoint", row.nsPerPoint);
  appendField(out, "spread", row.spread);
  appendField(out, "pointsPerSecond", 1e9 / row.nsPerPoint);
  appendField(out, "maxErrorPx", row.maxErrorPx);
  appendField(out, "p99ErrorPx", row.p99ErrorPx);
  appendField(out, "maxErrorUlp", row.maxErrorUlp);
  appendField(out, "maxErrorRadians", row.maxErrorRadians);
  appendField(out, "p99ErrorRadians", row.p99ErrorRadians);
  appendField(out, "boundPx", row.boundPx);
  appendField(out, "escalated", row.escalated);
  appendField(out, "uncertain", row.uncertain);
  return out + ", \"missing\": " + (row.missing ? std::to_string(*row.missing) : "null") + "}";
}

}  // namespace

std::string measurementAsTable(const Measurement& m) {
  std::vector<std::vector<std::string>> rows = {{"project", "ns/point", "median/min", "points/s", "max px", "p99 px",
                                                 "max ulp", "bound px", "escalated", "uncertain", "missing"}};
  for (const ModeRow& row : m.projecting)
    rows.push_back({nameOf(row), asTime(row.nsPerPoint), printed("%.2f", row.spread), formatCount(1e9 / row.nsPerPoint),
                    orDash(row.maxErrorPx, asError), orDash(row.p99ErrorPx, asError), orDash(row.maxErrorUlp, asUlps),
                    asBound(row), orDash(row.escalated, asShare), orDash(row.uncertain, asShare),
                    asCount(row.missing)});
  std::string out = alignedTable(rows);
  if (!m.casting.empty()) {
    rows = {{"ray", "ns/ray", "median/min", "rays/s", "max px", "p99 px", "max rad", "p99 rad", "bound px", "missing"}};
    for (const ModeRow& row : m.casting)
      rows.push_back({row.precision ? std::string(precisionName(*row.precision)) : "inverse matrix",
                      asTime(row.nsPerPoint), printed("%.2f", row.spread), formatCount(1e9 / row.nsPerPoint),
                      orDash(row.maxErrorPx, asError), orDash(row.p99ErrorPx, asError),
                      orDash(row.maxErrorRadians, asError), orDash(row.p99ErrorRadians, asError), asBound(row),
                      asCount(row.missing)});
    out += "\n" + alignedTable(rows);
  }
  return out + "\n" + sampleOf(m) + "; kernel " + m.kernel + "; " + std::to_string(m.rounds) +
         " interleaved rounds, the fastest shown; auto within " + formatNumber(m.tolerance) +
         " px.\nErrors: the larger of x and y, on the points in the picture, against the exact result (itself within "
         "0.51 ulp).\nShares: of all points. missing: points in the picture whose result is not finite.\n";
}

std::string measurementAsJson(const Measurement& m, std::size_t leftOut, std::span<const std::string> notes) {
  std::string out = "{\"points\": " + std::to_string(m.points) + ", \"visible\": " + std::to_string(m.visible) +
                    ", \"leftOut\": " + std::to_string(leftOut) + ", \"kernel\": ";
  out += jsonString(m.kernel);
  out += ", \"rounds\": " + std::to_string(m.rounds) + ", \"tolerance\": " + formatNumber(m.tolerance) +
         ",\n \"notes\": [";
  for (const std::string& note : notes) {
    if (&note != notes.data()) out += ", ";
    out += jsonString(note);
  }
  out += "],\n \"modes\": [";
  const char* separator = "\n  ";
  for (const auto* rows : {&m.projecting, &m.casting})
    for (const ModeRow& row : *rows) {
      out += separator + rowAsJson(row);
      separator = ",\n  ";
    }
  return out + "\n ]}\n";
}

std::string measurementAsSvg(const Measurement& m) {
  CostPlot plot;
  plot.title = "Largest error over cost";
  plot.caption = sampleOf(m) + "; kernel " + m.kernel + "; fastest of " + std::to_string(m.rounds) + " rounds";
  plot.series = {"points projected", "rays cast"};
  for (const ModeRow& row : m.projecting)
    plot.dots.push_back({nameOf(row), row.nsPerPoint, row.maxErrorPx, row.boundPx, 0});
  for (const ModeRow& row : m.casting) plot.dots.push_back({row.mode, row.nsPerPoint, row.maxErrorPx, row.boundPx, 1});
  return costPlotSvg(plot);
}

}  // namespace viewproj::cmd
