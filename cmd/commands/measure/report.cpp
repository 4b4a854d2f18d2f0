#include "commands/measure/report.hpp"

#include <cmath>
#include <cstdio>

#include "commands/measure/timing.hpp"
#include "output/table.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

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

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string rowAsJson(const ModeRow& row) {
  JsonObject out;
  out.add("mode", row.mode);
  out.addText("precision", row.precision ? jsonOf(precisionName(*row.precision)) : "null");
  out.add("nsPerPoint", row.nsPerPoint).add("spread", row.spread).add("pointsPerSecond", 1e9 / row.nsPerPoint);
  out.add("maxErrorPx", row.maxErrorPx).add("p99ErrorPx", row.p99ErrorPx).add("maxErrorUlp", row.maxErrorUlp);
  out.add("maxErrorRadians", row.maxErrorRadians).add("p99ErrorRadians", row.p99ErrorRadians);
  out.add("boundPx", row.boundPx).add("escalated", row.escalated).add("uncertain", row.uncertain);
  return out.add("missing", row.missing).text();
}

}  // namespace

std::string measurementAsTable(const Measurement& m) {
  std::vector<std::vector<std::string>> rows = {{"project", "ns/point", "median/min", "points/s", "max px", "p99 px",
                                                 "max ulp", "bound px", "escalated", "uncertain", "missing"}};
  for (const ModeRow& row : m.projecting)
    rows.push_back({row.mode, asTime(row.nsPerPoint), printed("%.2f", row.spread), formatCount(1e9 / row.nsPerPoint),
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
  return out + "\n" + plural(m.points, "point") + ", " + std::to_string(m.visible) +
         " of them in the picture; kernel " + m.kernel + "; " + std::to_string(kRounds) +
         " interleaved rounds, the fastest shown.\nErrors: the larger of x and y, on the points in the picture, "
         "against the exact result (itself within "
         "0.51 ulp).\nShares: of all points. missing: points in the picture whose result is not finite.\n";
}

std::string measurementAsJson(const Measurement& m, std::size_t leftOut) {
  std::vector<std::string> modes;
  for (const auto* rows : {&m.projecting, &m.casting})
    for (const ModeRow& row : *rows) modes.push_back(rowAsJson(row));
  JsonObject out;
  out.add("points", m.points).add("visible", m.visible).add("leftOut", leftOut).add("kernel", m.kernel);
  out.add("rounds", kRounds);
  out.addText("modes", jsonList(modes, ",\n  "), ",\n ");
  return out.text() + "\n";
}

}  // namespace viewproj::cmd
