#include "commands/inspect/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "camera/names.hpp"
#include "camera/pose.hpp"
#include "camera/projection.hpp"
#include "commands/inspect/notes.hpp"
#include "numbers/degrees.hpp"
#include "output/table.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Json = nlohmann::ordered_json;

constexpr NameRow<MatrixKind> kKindNames[] = {{"projection", MatrixKind::projection},
                                              {"view", MatrixKind::view},
                                              {"worldFromView", MatrixKind::worldFromView},
                                              {"viewProjection", MatrixKind::viewProjection}};
constexpr NameRow<MatrixLayout> kLayoutNames[] = {{"as written", MatrixLayout::asWritten},
                                                  {"transposed", MatrixLayout::transposed},
                                                  {"either", MatrixLayout::either}};

bool determinesView(const MatrixCamera& r) { return r.kind != MatrixKind::viewProjection; }
bool determinesWorld(const MatrixCamera& r) { return r.kind != MatrixKind::projection; }

/// A name of each axis that the reading determines.
std::string_view worldOf(const MatrixCamera& r) {
  return determinesWorld(r) ? nameOf(kWorldNames, r.convention.world) : "-";
}
std::string_view viewOf(const MatrixCamera& r) {
  return determinesView(r) ? nameOf(kViewNames, r.convention.view) : "-";
}
std::string_view ndcZOf(const MatrixCamera& r) { return r.lens ? nameOf(kNdcZNames, r.convention.ndcZ) : "-"; }
std::string_view ndcYOf(const MatrixCamera& r) { return r.lens ? nameOf(kNdcYNames, r.convention.ndcY) : "-"; }
std::string_view reversedOf(const MatrixCamera& r) { return !r.lens ? "-" : r.convention.reverseZ ? "yes" : "no"; }

/// A preset that fits, and what of it does not.
struct FittingPreset {
  std::string_view name;
  bool otherWorld, otherwiseReversed;
};

std::vector<FittingPreset> presetsOf(const MatrixCamera& r, NumberOrder order) {
  std::vector<FittingPreset> result;
  for (const ConventionPreset& preset : conventionPresets()) {
    const Convention& c = preset.convention;
    if (!fits(r, c, order)) continue;
    result.push_back({preset.name, determinesWorld(r) && c.world != r.convention.world,
                      r.lens.has_value() && c.reverseZ != r.convention.reverseZ});
  }
  return result;
}

/// "opengl, unity; with --reverse-z d3d; of a left-handed world d3d-rh".
std::string presetText(const MatrixCamera& r, NumberOrder order) {
  std::string text;
  for (bool otherWorld : {false, true})
    for (bool otherwiseReversed : {false, true}) {
      std::vector<std::string_view> names;
      for (const FittingPreset& p : presetsOf(r, order))
        if (p.otherWorld == otherWorld && p.otherwiseReversed == otherwiseReversed) names.push_back(p.name);
      if (names.empty()) continue;
      text += text.empty() ? "" : "; ";
      if (otherWorld) text += "of a " + std::string(worldOf(r)) + "-handed world ";
      if (otherwiseReversed) text += r.convention.reverseZ ? "with --reverse-z " : "with --no-reverse-z ";
      text += joined(names);
    }
  return text.empty() ? "no preset" : text;
}

std::string plusMinus(double size, int digits = 2) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, size);
  return text;
}

/// To a tenth of half the interval.
std::string endText(double end, double half) {
  const auto exponent = [](double number) { return static_cast<int>(std::floor(std::log10(std::fabs(number)))); };
  return plusMinus(end, end == 0 ? 1 : std::clamp(exponent(end) - exponent(half) + 2, 2, 17));
}

std::string spread(const PlaneDistance& e) {
  constexpr double kHardly = 0.01;
  if (e.low == e.high) return "exact";
  if (std::isinf(e.high)) return "not determined: above " + plusMinus(e.low);
  const double half = e.high / 2 - e.low / 2;
  std::string text = "+- " + plusMinus(half);
  if (half > kHardly * std::fabs(e.value) && e.value != 0)
    return text + " (" + endText(e.low, half) + " to " + endText(e.high, half) + ")";
  return text;
}

/// Of a matrix of as many digits as doubles have, and of one of as many as float32s have.
std::string brief(double value, bool isRough) { return formatDigits(value, isRough ? 7 : 15); }

/// Nine decimals, without the noise of components that are 0.
std::string vectorText(const Vec3& v) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    char part[40];
    std::snprintf(part, sizeof part, "%.9f", v[i]);
    text += (i > 0 ? " " : "") + formatNumber(std::strtod(part, nullptr) + 0.0);
  }
  return text;
}

struct Line {
  std::string name, value, spread;
};

std::string eyeText(const Vec3& eye, bool isRough) {
  return brief(eye.x, isRough) + " " + brief(eye.y, isRough) + " " + brief(eye.z, isRough);
}

std::string asText(const std::vector<Line>& lines) {
  std::size_t nameWidth = 0, valueWidth = 0;
  for (const Line& line : lines) {
    nameWidth = std::max(nameWidth, columnsOf(line.name));
    valueWidth = std::max(valueWidth, columnsOf(line.value));
  }
  std::string out;
  for (const Line& line : lines) {
    out += "  " + paddedRight(line.name, nameWidth + 2);
    out += (line.spread.empty() ? line.value : paddedRight(line.value, valueWidth + 2) + line.spread) + "\n";
  }
  return out;
}

/// Right, up and forward: a view's rows, a pose's columns.
std::array<Vec3, 3> axesOf(const MatrixCamera& r) {
  const Axes& axes = r.kind == MatrixKind::worldFromView ? parts(*r.pose).columns : parts(*r.pose).rows;
  return {rounded(axes.right), rounded(axes.up), rounded(axes.forward)};
}

struct WindowFigures {
  double aspect;                   ///< width / height
  double fovX, fovY, fovDiagonal;  ///< degrees
  /// The focal lengths in widths and in heights of the picture, and where the viewing axis meets it, in its widths from
  /// the left and its heights from the top.
  std::array<double, 2> focalLength, principalPoint;
};

/// In perspective all of it means something, in orthographic the aspect.
WindowFigures figuresOf(const MatrixLens& lens) {
  DoubleDouble left = lens.left, right = lens.right, bottom = lens.bottom, top = lens.top;
  if (lens.projection) {  // with all their digits
    const ProjectionParts& p = parts(*lens.projection);
    left = p.left;
    right = p.right;
    bottom = p.bottom;
    top = p.top;
  }
  const DoubleDouble width = right - left, height = top - bottom, one(1);
  const auto angle = [](DoubleDouble from, DoubleDouble to) {
    return (from + to).hi == 0 ? degreesOfHalfTangent(to) : degreesAcross(from, to);
  };
  return {(width / height).hi,
          angle(left, right),
          angle(bottom, top),
          std::max(degreesBetween(left, bottom, right, top), degreesBetween(left, top, right, bottom)),
          {(one / width).hi, (one / height).hi},
          {rounded(-left / width), rounded(top / height)}};
}

std::vector<Line> parametersOf(const MatrixCamera& r, bool isRough) {
  std::vector<Line> lines;
  const auto text = [&](double value) { return brief(value, isRough); };
  const auto add = [&](const char* name, double value) { lines.push_back({name, text(value), ""}); };
  if (r.pose) {
    const auto [right, up, forward] = axesOf(r);
    if (isEyeKnown(r)) lines.push_back({"eye", eyeText(r.pose->eye(), isRough), ""});
    lines.push_back({"right", vectorText(right), ""});
    lines.push_back({"up", vectorText(up), ""});
    lines.push_back({"forward", vectorText(forward), ""});
    lines.push_back({"off a rotation by", plusMinus(r.residual), ""});
  }
  if (r.lens) {
    const MatrixLens& lens = *r.lens;
    const WindowFigures figures = figuresOf(lens);
    add("window left", lens.left);
    add("window right", lens.right);
    add("window bottom", lens.bottom);
    add("window top", lens.top);
    if (!lens.orthographic) {
      // In widths and heights of the picture.
      const auto addShares = [&](const char* name, const std::array<double, 2>& shares) {
        lines.push_back({name, text(shares[0]) + " w " + text(shares[1]) + " h", ""});
      };
      add("fovX", figures.fovX);
      add("fovY", figures.fovY);
      add("fovDiagonal", figures.fovDiagonal);
      addShares("focal length", figures.focalLength);
      addShares("principal point", figures.principalPoint);
    }
    add("aspect", figures.aspect);
    lines.push_back({"near", shortestWithin(lens.zNear), spread(lens.zNear)});
    lines.push_back({"far", shortestWithin(lens.zFar), spread(lens.zFar)});
  }
  return lines;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json asJson(const PlaneDistance& e) {
  return {{"value", number(e.value)}, {"low", number(e.low)}, {"high", number(e.high)}};
}

Json asJson(const Vec3& v) { return Json::array({number(v.x), number(v.y), number(v.z)}); }

Json asJson(const NumberedReading& numbered, NumberOrder order) {
  const MatrixCamera& r = numbered.reading;
  Json result{
      {"reading", numbered.number}, {"kind", nameOf(kKindNames, r.kind)}, {"layout", nameOf(kLayoutNames, r.layout)}};
  Json layouts = Json::array();
  for (const auto& [vectors, vectorsValue] : kVectorsNames)
    for (const auto& [storage, storageValue] : kStorageNames) {
      const bool turned = (vectorsValue == Vectors::row) != (storageValue == Storage::columnMajor);
      if (r.layout == MatrixLayout::either || turned == (r.layout == MatrixLayout::transposed))
        layouts.push_back({{"vectors", vectors}, {"storage", storage}});
    }
  result["layouts"] = layouts;
  Json convention = Json::object();
  if (determinesWorld(r)) convention["world"] = worldOf(r);
  if (determinesView(r)) convention["view"] = viewOf(r);
  if (r.lens) {
    convention["ndcZ"] = ndcZOf(r);
    convention["reverseZ"] = r.convention.reverseZ;
    convention["ndcY"] = ndcYOf(r);
  }
  result["convention"] = convention;
  result["presets"] = Json::array();
  result["presetsOtherwise"] = Json::array();
  for (const FittingPreset& p : presetsOf(r, order)) {
    Json differs = Json::array();
    if (p.otherWorld) differs.push_back("world");
    if (p.otherwiseReversed) differs.push_back("reverseZ");
    if (differs.empty())
      result["presets"].push_back(p.name);
    else
      result["presetsOtherwise"].push_back({{"name", p.name}, {"differs", differs}});
  }
  result["scale"] = r.scale;
  if (r.lens) {
    const MatrixLens& lens = *r.lens;
    const WindowFigures figures = figuresOf(lens);
    Json part{{"type", lens.orthographic ? "orthographic" : "perspective"},
              {"left", number(lens.left)},
              {"right", number(lens.right)},
              {"bottom", number(lens.bottom)},
              {"top", number(lens.top)},
              {"aspect", number(figures.aspect)}};
    if (!lens.orthographic) {
      part["fovX"] = number(figures.fovX);
      part["fovY"] = number(figures.fovY);
      part["fovDiagonal"] = number(figures.fovDiagonal);
      part["focalLength"] = {number(figures.focalLength[0]), number(figures.focalLength[1])};
      part["principalPoint"] = {number(figures.principalPoint[0]), number(figures.principalPoint[1])};
    }
    part["near"] = asJson(lens.zNear);
    part["far"] = asJson(lens.zFar);
    part["beyondInfinity"] = lens.beyondInfinity;
    result["projection"] = part;
  }
  if (r.pose) {
    const auto [right, up, forward] = axesOf(r);
    result["pose"] = {{"eye", isEyeKnown(r) ? asJson(r.pose->eye()) : Json(nullptr)},
                      {"right", asJson(right)},
                      {"up", asJson(up)},
                      {"forward", asJson(forward)},
                      {"residual", r.residual}};
  }
  return result;
}

std::string plural(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// A row a reading: the axes it determines, and the presets that fit.
std::string readingTable(const InspectedMatrix& m) {
  std::vector<std::vector<std::string>> cells{{"#", "kind", "numbers", "world", "view", "ndcZ", "reverseZ", "ndcY"}};
  std::vector<std::string> presets{"fits"};
  for (const NumberedReading& n : m.readings) {
    const MatrixCamera& r = n.reading;
    cells.push_back({std::to_string(n.number)});
    for (std::string_view cell : {nameOf(kKindNames, r.kind), nameOf(kLayoutNames, r.layout), worldOf(r), viewOf(r),
                                  ndcZOf(r), reversedOf(r), ndcYOf(r)})
      cells.back().emplace_back(cell);
    presets.push_back(presetText(r, m.written.order));
  }
  const std::string aligned = alignedTable(cells);
  std::string out;
  std::size_t at = 0;
  for (const std::string& preset : presets) {
    const std::size_t end = aligned.find('\n', at);
    out += "  " + aligned.substr(at, end - at) + "  " + preset + "\n";
    at = end + 1;
  }
  return out;
}

/// A row a parameter; readings that agree on one share it.
std::string parameterTable(const InspectedMatrix& m, bool isRough) {
  struct Row {
    Line line;
    std::vector<std::size_t> readings;
  };
  std::vector<Row> rows;
  for (const NumberedReading& n : m.readings)
    for (const Line& line : parametersOf(n.reading, isRough)) {
      auto place = rows.end();  // beside the others of its name
      bool shared = false;
      for (auto row = rows.begin(); row != rows.end() && !shared; ++row)
        if (row->line.name == line.name) {
          shared = row->line.value == line.value && row->line.spread == line.spread;
          place = shared ? row : row + 1;
        }
      if (!shared) place = rows.insert(place, {line, {}});
      place->readings.push_back(n.number);
    }
  std::vector<Line> lines;
  for (auto& [line, readings] : rows) {
    if (readings.size() != m.readings.size()) {
      std::string which;
      for (const std::size_t number : readings) which += (which.empty() ? "" : " ") + std::to_string(number);
      line.spread += (line.spread.empty() ? "[" : "  [") + which + "]";
    }
    lines.push_back(line);
  }
  return asText(lines);
}

std::string asText(const InspectedMatrix& m, const std::string& name, bool isRough) {
  std::string out = name + ": ";
  if (m.all == 0) {
    out += "nothing known\n  as written: " + m.asWrittenFault + "\n";
    if (m.transposedFault != m.asWrittenFault) out += "  transposed: " + m.transposedFault + "\n";
    return out;
  }
  out +=
      plural(m.readings.size(), "reading") + (m.readings.size() == m.all ? "" : " of " + std::to_string(m.all)) + "\n";
  if (!m.readings.empty()) out += readingTable(m) + "\n" + parameterTable(m, isRough) + (m.notes.empty() ? "" : "\n");
  for (const std::string& note : m.notes) out += "  " + wrapped(note, terminalWidth(), 4);
  return out;
}

std::vector<Line> parametersOf(const Calibration& c, bool isRough) {
  std::vector<Line> lines;
  const auto add = [&](const char* name, double value) { lines.push_back({name, brief(value, isRough), ""}); };
  add("fx", c.fx);
  add("fy", c.fy);
  add("cx", c.cx);
  add("cy", c.cy);
  add("skew", c.skew);
  if (!c.eye) return lines;
  lines.push_back({"eye", eyeText(*c.eye, isRough), ""});
  lines.push_back({"right", vectorText(c.right), ""});
  lines.push_back({"down", vectorText(c.down), ""});
  lines.push_back({"forward", vectorText(c.forward), ""});
  return lines;
}

std::string asText(const Calibration& c, const std::string& name, bool isRough) {
  std::string out = name + ": " +
                    (c.eye ? "P = K [R | t], a calibrated camera in the world" : "K, the intrinsics of a camera") +
                    ", in pixels\n\n";
  out += asText(parametersOf(c, isRough)) + "\n";
  for (const std::string& note : c.notes) out += "  " + wrapped(note, terminalWidth(), 4);
  return out;
}

Json asJson(const Calibration& c, const std::string& name) {
  Json part{{"name", name},       {"kind", c.eye ? "P" : "K"}, {"fx", number(c.fx)},    {"fy", number(c.fy)},
            {"cx", number(c.cx)}, {"cy", number(c.cy)},        {"skew", number(c.skew)}};
  if (c.eye) {
    part["eye"] = asJson(*c.eye);
    part["right"] = asJson(c.right);
    part["down"] = asJson(c.down);
    part["forward"] = asJson(c.forward);
  }
  part["notes"] = c.notes;
  return part;
}

Json asJson(const InspectedMatrix& m, const std::string& name) {
  Json readings = Json::array();
  for (const NumberedReading& n : m.readings) readings.push_back(asJson(n, m.written.order));
  Json part{{"name", name}, {"readings", readings}};
  if (m.all == 0) part["faults"] = {{"asWritten", m.asWrittenFault}, {"transposed", m.transposedFault}};
  part["notes"] = m.notes;
  return part;
}

}  // namespace

std::string nameOf(const WrittenMatrix& matrix, std::size_t index) {
  return matrix.name.empty() ? "matrix " + std::to_string(index + 1) : matrix.name;
}

std::string oneLine(const NumberedReading& numbered, NumberOrder order) {
  const MatrixCamera& r = numbered.reading;
  std::string text = std::to_string(numbered.number) + ": " + std::string(nameOf(kKindNames, r.kind)) + ", " +
                     std::string(nameOf(kLayoutNames, r.layout));
  const auto add = [&](const char* name, std::string_view value) {
    if (value != "-") text += std::string(", ") + name + " " + std::string(value);
  };
  add("world", worldOf(r));
  add("view", viewOf(r));
  add("ndcZ", ndcZOf(r));
  add("reverseZ", reversedOf(r));
  add("ndcY", ndcYOf(r));
  return text + " (" + presetText(r, order) + ")";
}

std::string Report::add(const InspectedMatrix& m) {
  const std::string name = nameOf(m.written, count_);
  return json_ ? item({}, asJson(m, name).dump(2, ' ', false, Json::error_handler_t::replace))
               : item(asText(m, name, isRough(m.written)), {});
}

std::string Report::add(const WrittenMatrix& m, const Calibration& calibration) {
  const std::string name = nameOf(m, count_);
  return json_ ? item({}, asJson(calibration, name).dump(2, ' ', false, Json::error_handler_t::replace))
               : item(asText(calibration, name, isRough(m)), {});
}

bool Report::isRough(const WrittenMatrix& m) const {
  constexpr int kFloatDigits = 9;
  return asFloat_ || m.digits <= kFloatDigits;
}

std::string Report::item(const std::string& text, const std::string& json) {
  const bool first = count_++ == 0;
  if (!json_) return (first ? "" : "\n") + text;
  std::string out =
      first ? std::string("{\n  \"entries\": \"") + (asFloat_ ? "float32" : "float64") + "\",\n  \"matrices\": [" : ",";
  for (const char c : "\n" + json) {
    out += c;
    if (c == '\n') out += "    ";
  }
  return out;
}

std::string Report::end() const { return json_ ? "\n  ]\n}\n" : ""; }

}  // namespace viewproj::cmd
