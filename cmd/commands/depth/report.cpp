#include "commands/depth/report.hpp"

#include <algorithm>
#include <cmath>

#include "output/table.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Three digits; large numbers with an exponent.
std::string brief(double value) {
  const std::string plain = formatDigits(value, 3);
  if (!(value >= 1e6)) return plain;
  const int exponent = static_cast<int>(std::floor(std::log10(*parseNumber(plain))));
  return formatDigits(value / std::pow(10, exponent), 3) + "e" + std::to_string(exponent);
}

bool isClipped(const DepthMapping& m, double distance) { return !(distance >= m.near && distance <= m.far); }

std::string asGap(const DepthMapping& m, const DepthFormat& format, double distance) {
  return isClipped(m, distance) ? "clipped" : brief(resolvedGap(m, format, distance));
}

std::string describeFar(const DepthMapping& m) { return std::isinf(m.far) ? "infinite" : formatNumber(m.far); }

/// "perspective, near 0.1, far 1000".
std::string describe(const DepthMapping& m) {
  return std::string(m.orthographic ? "orthographic" : "perspective") + ", near " + formatNumber(m.near) + ", far " +
         describeFar(m);
}

Rows ownRows(const DepthReport& r) {
  const DepthMapping& m = r.own();
  Rows rows = {{"distance", "depth", "slope"}};
  for (const NamedFormat& f : r.formats) rows[0].push_back(f.name);
  for (double distance : r.distances) {
    rows.push_back({formatNumber(distance), formatDigits(depthAtDistance(m, distance), 9),
                    formatDigits(depthSlope(m, distance), 4)});
    for (const NamedFormat& f : r.formats) rows.back().push_back(asGap(m, f.format, distance));
  }
  return rows;
}

/// A heading, and a column for every mapping.
std::vector<std::string> sideBySideHeader(const std::vector<NamedMapping>& mappings, const std::string& heading) {
  std::vector<std::string> header = {heading};
  for (const NamedMapping& m : mappings) header.push_back(m.name + (m.own ? " *" : ""));
  return header;
}

Rows comparedRows(const DepthReport& r, const NamedFormat& f) {
  Rows rows = {sideBySideHeader(r.mappings, f.name)};
  for (double distance : r.distances) {
    rows.push_back({formatNumber(distance)});
    for (const NamedMapping& m : r.mappings) rows.back().push_back(asGap(m.mapping, f.format, distance));
  }
  return rows;
}

/// {"d16": value, ...}; value: of a format, as JSON
template <class Value>
std::string perFormat(const DepthReport& r, Value value) {
  JsonObject out;
  for (const NamedFormat& f : r.formats) out.addText(f.name, value(f.format));
  return out.text();
}

std::string mappingAsJson(const DepthReport& r, const NamedMapping& named) {
  const DepthMapping& m = named.mapping;
  std::vector<std::string> distances;
  for (double distance : r.distances) {
    const auto ifSeen = [&](double value) { return isClipped(m, distance) ? "null" : jsonOf(value); };
    JsonObject out;
    out.add("distance", distance).add("depth", depthAtDistance(m, distance)).add("slope", depthSlope(m, distance));
    out.addText("step", perFormat(r, [&](const DepthFormat& f) { return ifSeen(depthStep(m, f, distance)); }));
    out.addText("resolves", perFormat(r, [&](const DepthFormat& f) { return ifSeen(resolvedGap(m, f, distance)); }));
    distances.push_back(out.text());
  }
  JsonObject out;
  out.add("name", named.name).add("own", named.own).add("near", m.near).add("far", m.far);
  out.add("depthAtNear", m.atNear).add("depthAtFar", m.atFar);
  return out.addText("distances", jsonList(distances, ",\n    "), ",\n   ").text();
}

/// NDC z in place of window depth.
DepthMapping ofNdc(const NamedMapping& named) {
  DepthMapping m = named.mapping;
  m.atNear = named.reversed ? 1 : -1;
  m.atFar = -m.atNear;
  return m;
}

const DepthMapping& ownOf(const std::vector<NamedMapping>& mappings) {
  return std::find_if(mappings.begin(), mappings.end(), [](const NamedMapping& m) { return m.own; })->mapping;
}

}  // namespace

const DepthMapping& DepthReport::own() const { return ownOf(mappings); }

std::string distancesAsTable(const DepthsReport& r) {
  const DepthMapping& m = ownOf(r.mappings);
  const auto rows = [&](const char* heading, bool isNdc) {
    Rows all = {sideBySideHeader(r.mappings, heading)};
    for (const double depth : r.depths) {
      all.push_back({formatNumber(depth)});
      for (const NamedMapping& named : r.mappings) {
        const double distance = distanceAtDepth(isNdc ? ofNdc(named) : named.mapping, depth);
        all.back().push_back(std::isnan(distance)   ? "none"
                             : std::isinf(distance) ? "infinite"
                                                    : formatDigits(distance, 9));
      }
    }
    return alignedTable(all);
  };
  return describe(m) + "; window depth " + formatNumber(m.atNear) + " at near, " + formatNumber(m.atFar) +
         " at far\nHow far along the viewing axis what has these depths is; * is this camera's mapping.\n\n" +
         rows("window depth", false) + "\n" + rows("NDC z of -1..1", true);
}

std::string distancesAsJson(const DepthsReport& r) {
  const DepthMapping& m = ownOf(r.mappings);
  std::vector<std::string> mappings;
  for (const NamedMapping& named : r.mappings) {
    std::vector<std::string> distances;
    for (const double depth : r.depths) {
      JsonObject out;
      out.add("depth", depth).add("distance", distanceAtDepth(named.mapping, depth));
      distances.push_back(out.add("distanceOfNdc", distanceAtDepth(ofNdc(named), depth)).text());
    }
    JsonObject out;
    out.add("name", named.name).add("own", named.own);
    mappings.push_back(out.addText("distances", jsonList(distances, ",\n    "), ",\n   ").text());
  }
  JsonObject out;
  out.add("projection", m.orthographic ? "orthographic" : "perspective").add("near", m.near).add("far", m.far);
  return out.addText("mappings", jsonList(mappings, ",\n  "), ",\n ").text() + "\n";
}

std::string depthAsTable(const DepthReport& r) {
  const DepthMapping& m = r.own();
  std::string out = describe(m) + "; window depth " + formatNumber(m.atNear) + " at near, " + formatNumber(m.atFar) +
                    " at far\nOne step as a length: how much nearer than a surface at this distance another must be "
                    "to be stored apart from it.\n\n" +
                    alignedTable(ownRows(r)) + "\nThe same side by side; * is this camera's mapping.\n";
  for (const NamedFormat& f : r.formats) out += "\n" + alignedTable(comparedRows(r, f));
  out += "\n";
  for (const std::string& note : r.notes) out += note + "\n";
  return out;
}

std::string depthAsJson(const DepthReport& r) {
  const DepthMapping& m = r.own();
  std::vector<std::string> mappings;
  for (const NamedMapping& named : r.mappings) mappings.push_back(mappingAsJson(r, named));
  JsonObject out;
  out.add("projection", m.orthographic ? "orthographic" : "perspective").add("near", m.near).add("far", m.far);
  out.addText("notes", jsonListOf(r.notes), ",\n ").addText("mappings", jsonList(mappings, ",\n  "), ",\n ");
  return out.text() + "\n";
}

}  // namespace viewproj::cmd
