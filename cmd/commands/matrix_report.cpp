#include "commands/matrix_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "numbers/vectors.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::size_t kLongestName = 40;
constexpr NameRow<MatrixLayout> kLayoutNames[] = {{"as written", MatrixLayout::asWritten},
                                                  {"transposed", MatrixLayout::transposed},
                                                  {"either", MatrixLayout::either}};

/// The axes that a reading determines.
OrderedJson axesOf(const Reading& reading) {
  OrderedJson axes = OrderedJson::object();
  if (!reading.camera) return axes;
  const OrderedJson all = asJson(reading.camera->convention);
  if (reading.kind != ReadingKind::projection) axes["world"] = all["world"];
  if (reading.kind != ReadingKind::viewProjection) axes["view"] = all["view"];
  if (reading.camera->lens) {
    if (reading.camera->lens->depthFault.empty()) axes.update({{"ndcZ", all["ndcZ"]}, {"reverseZ", all["reverseZ"]}});
    axes["ndcY"] = all["ndcY"];
  }
  return axes;
}

OrderedJson withError(const Vec3& value, const Vec3& error) {
  return {{"value", asJson(value)}, {"error", asJson(error)}};
}

/// The angle between two edges, in degrees.
double angleOf(double low, double high) { return (std::atan(high) - std::atan(low)) * kDegrees; }

OrderedJson lensJson(const MatrixLens& lens) {
  const double width = lens.right - lens.left, height = lens.top - lens.bottom;
  const auto plane = [](const PlaneDistance& d) -> OrderedJson {
    return {{"value", d.value}, {"low", d.low}, {"high", d.high}};
  };
  OrderedJson part{{"type", lens.orthographic ? "orthographic" : "perspective"}};
  if (lens.orthographic)
    part.update({{"width", width}, {"height", height}});
  else
    part.update({{"fovX", {{"value", angleOf(lens.left, lens.right)}, {"error", lens.fovError.x}}},
                 {"fovY", {{"value", angleOf(lens.bottom, lens.top)}, {"error", lens.fovError.y}}}});
  part.update({{"aspect", width / height},
               {"window", {{"left", lens.left}, {"right", lens.right}, {"bottom", lens.bottom}, {"top", lens.top}}},
               {"principalPoint", {-lens.left / width, lens.top / height}}});
  const bool hasDepth = lens.depthFault.empty();
  part.update({{"near", hasDepth ? plane(lens.zNear) : OrderedJson()},
               {"far", hasDepth ? plane(lens.zFar) : OrderedJson()},
               {"beyondInfinity", lens.beyondInfinity}});
  if (!hasDepth) part["depthFault"] = lens.depthFault;
  return part;
}

/// x, y, z, w of a rotation, the largest above 0; of a mirrored one that of its negative.
std::array<double, 4> quaternionOf(const std::array<Vec3, 3>& rows, bool isMirrored) {
  const double sign = isMirrored ? -1 : 1;
  const auto r = [&](std::size_t i, std::size_t j) { return sign * rows[i][j]; };
  const double squares[] = {1 + r(0, 0) - r(1, 1) - r(2, 2), 1 - r(0, 0) + r(1, 1) - r(2, 2),
                            1 - r(0, 0) - r(1, 1) + r(2, 2), 1 + r(0, 0) + r(1, 1) + r(2, 2)};
  const auto largest = static_cast<std::size_t>(std::max_element(squares, squares + 4) - squares);
  const double size = 2 * std::sqrt(squares[largest]);
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    if (largest == 3)
      q[i] = (r(k, j) - r(j, k)) / size;
    else if (largest == i) {
      q[i] = size / 4;
      q[j] = (r(i, j) + r(j, i)) / size;
      q[k] = (r(i, k) + r(k, i)) / size;
      q[3] = (r(k, j) - r(j, k)) / size;
    }
  }
  if (largest == 3) q[3] = size / 4;
  return q;
}

OrderedJson rotationJson(const Reading& r) {
  const std::array<double, 4> q = quaternionOf(r.rows, r.isMirrored);
  const double size = std::hypot(q[0], q[1], q[2]), sign = q[3] < 0 ? -1 : 1;
  OrderedJson axis;
  if (size > 0) axis = {sign * q[0] / size, sign * q[1] / size, sign * q[2] / size};
  return {{"quaternion", q},
          {"axis", axis},
          {"degrees", 2 * std::atan2(size, std::fabs(q[3])) * kDegrees},
          {"mirrored", r.isMirrored}};
}

OrderedJson readingJson(const Reading& r, bool isInMemoryOrder) {
  OrderedJson result{{"kind", nameOf(kReadingKinds, r.kind)},
                     {"layout", nameOf(kLayoutNames, r.layout)},
                     {"convention", axesOf(r)},
                     {"presets", OrderedJson::array()},
                     {"presetsOtherwise", OrderedJson::array()}};
  if (r.kind == ReadingKind::rotation) result.update(rotationJson(r));
  if (r.pixels) {
    result.update({{"fx", r.pixels->fx},
                   {"fy", r.pixels->fy},
                   {"cx", r.pixels->cx},
                   {"cy", r.pixels->cy},
                   {"skew", r.pixels->skew}});
    if (!r.pixels->axes.empty()) result["axes"] = r.pixels->axes;
  }
  if (r.kind == ReadingKind::p)
    result.update({{"eye", withError(*r.eye, r.eyeError)},
                   {"right", asJson(r.rows[0])},
                   {"down", asJson(r.rows[1])},
                   {"forward", asJson(r.rows[2])}});
  if (!r.camera) return result;
  const MatrixCamera& camera = *r.camera;
  for (const ConventionPreset& preset : conventionPresets()) {
    if (!fits(r, preset.convention, isInMemoryOrder)) continue;
    OrderedJson differs = OrderedJson::array();
    if (r.kind != ReadingKind::projection && preset.convention.world != camera.convention.world)
      differs.push_back("world");
    if (camera.lens && camera.lens->depthFault.empty() && preset.convention.reverseZ != camera.convention.reverseZ)
      differs.push_back("reverseZ");
    if (differs.empty())
      result["presets"].push_back(preset.name);
    else
      result["presetsOtherwise"].push_back({{"name", preset.name}, {"differs", differs}});
  }
  if (camera.scale != 1) result["scale"] = camera.scale;
  if (r.scaledBy != 1) result["scaledBy"] = r.scaledBy;
  if (camera.pose) {
    if (!(camera.lens && camera.lens->orthographic)) result["eye"] = withError(camera.pose->eye(), camera.eyeError);
    result.update({{"right", asJson(camera.pose->right())},
                   {"up", asJson(camera.pose->up())},
                   {"forward", asJson(camera.pose->forward())}});
  }
  if (camera.lens) result.update(lensJson(*camera.lens));
  return result;
}

// ---- Notes

/// What looks wrong, or is easily taken for something else, in the likeliest reading.
std::vector<std::string> notesOn(const Reading& r) {
  std::vector<std::string> notes;
  if (r.scaledBy != 1)
    notes.push_back("Its axes have the length " + formatDigits(r.scaledBy, 6) +
                    ", not 1: it scales too, as an object's does.");
  if (r.isMirrored) notes.emplace_back("It is mirrored: one axis is flipped.");
  if (r.kind == ReadingKind::k || r.kind == ReadingKind::p)
    notes.emplace_back(
        r.pixels->fx < 20
            ? "It is not in pixels, but in half widths or in pictures."
            : "It says neither how large the picture is nor where a pixel's centre lies: in OpenCV at whole numbers "
              "(viewport.pixelCenter 0), elsewhere often at halves.");
  if (r.pixels && std::fabs(r.pixels->skew) > 1e-6 * r.pixels->fx)
    notes.emplace_back("Its skew is not 0, and pixels of a skewed grid are not modelled.");
  if (!r.camera) return notes;
  const MatrixCamera& camera = *r.camera;
  const bool isPose = r.kind == ReadingKind::view || r.kind == ReadingKind::pose;
  if (isPose && (camera.convention.world == Handedness::left) != (camera.convention.view == ViewAxes::RUF))
    notes.emplace_back(
        "It is mirrored: it goes between a left-handed world and a right-handed view, as Unity's, or an axis is "
        "flipped.");
  if (!camera.lens || camera.lens->orthographic) return notes;
  const MatrixLens& lens = *camera.lens;
  if (!lens.depthFault.empty()) notes.push_back("Of its depth nothing is known: " + lens.depthFault + ".");
  const double fov = angleOf(lens.bottom, lens.top), aspect = (lens.right - lens.left) / (lens.top - lens.bottom);
  const bool isFlipped = r.kind == ReadingKind::viewProjection && detail::maxAbs(camera.pose->eye()) == 0;
  if (fov > 120 || fov < 4 || isFlipped) {
    std::string cause;
    for (int degrees = 20; degrees <= 120 && cause.empty(); degrees += 5) {
      const auto is = [&](double angle) { return std::fabs(angle - fov) <= lens.fovError.y + 1e-9; };
      if (is(2 * std::atan(std::fabs(std::tan(degrees / 2.0))) * kDegrees))
        cause = std::to_string(degrees) + " degrees taken for radians";
      else if (is(degrees / kDegrees))
        cause = std::to_string(degrees) + " degrees in radians, taken for degrees";
    }
    if (!cause.empty())
      notes.push_back("Its fovY of " + formatDigits(fov, 6) + " degrees is that of " + cause + ".");
    else if (fov > 120)
      notes.push_back("Its fovY of " + formatDigits(fov, 6) + " degrees is unusually wide.");
  }
  for (const int whole : {1, 2})
    if (std::fabs(aspect - whole) < 1e-6)
      notes.push_back("Its aspect is exactly " + std::to_string(whole) +
                      ": right for such a picture; width / height in integers gives it too.");
  return notes;
}

// ---- For people

/// The shortest number within an error of the value.
std::string shortest(double value, double error) {
  int digits = 1;
  while (digits < 17 && !(std::fabs(toDigits(value, digits) - value) <= error)) ++digits;
  return std::fabs(value) <= error ? "0" : formatDigits(value, digits);
}

std::string plusMinus(const std::string& value, double error) {
  return error > 0 ? value + " ± " + formatDigits(error, 2) : value;
}

std::string planeText(const PlaneDistance& d) {
  constexpr double kSure = 0.01;
  if (std::isinf(d.value)) return "infinite" + (std::isinf(d.low) ? "" : ", at least " + formatDigits(d.low, 2));
  const std::string value = shortest(d.value, std::min(d.value - d.low, d.high - d.value));
  if (std::isinf(d.high)) return value + ", at least " + formatDigits(d.low, 2);
  const double error = (d.high - d.low) / 2;
  return error <= kSure * std::fabs(d.value)
             ? plusMinus(value, error)
             : value + " (" + formatDigits(d.low, 3) + " .. " + formatDigits(d.high, 3) + ")";
}

std::string pointText(const Vec3& value, const Vec3& error) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < 3; ++i) parts.push_back(shortest(value[i], error[i]));
  return plusMinus(joined(parts), detail::maxAbs(error));
}

std::string angleText(double value, double error) { return plusMinus(shortest(value, error), error); }

/// A unit vector without what rounding left of 0.
OrderedJson directionText(const Vec3& v) {
  const auto clean = [](double x) { return std::round(x * 1e9) / 1e9 + 0.0; };
  return {clean(v.x), clean(v.y), clean(v.z)};
}

/// "opengl, unity, metal except reverseZ".
std::string presetText(const OrderedJson& reading) {
  auto names = reading["presets"].get<std::vector<std::string>>();
  for (const OrderedJson& preset : reading["presetsOtherwise"])
    names.push_back(preset["name"].get<std::string>() + " except " +
                    joined(preset["differs"].get<std::vector<std::string>>(), " and "));
  return names.empty() ? "no preset" : joined(names);
}

OrderedJson readingPage(const Reading& r, bool isInMemoryOrder) {
  const OrderedJson json = readingJson(r, isInMemoryOrder);
  OrderedJson page{{"kind", json["kind"]}, {"numbers", json["layout"]}};
  for (const auto& [axis, value] : json["convention"].items()) page[axis] = value;
  if (r.camera) page["presets"] = presetText(json);
  if (r.camera && r.camera->pose) {
    if (!(r.camera->lens && r.camera->lens->orthographic))
      page["eye"] = pointText(r.camera->pose->eye(), r.camera->eyeError);
    page.update({{"right", directionText(r.camera->pose->right())},
                 {"up", directionText(r.camera->pose->up())},
                 {"forward", directionText(r.camera->pose->forward())}});
  }
  if (r.camera && r.camera->lens) {
    const MatrixLens& lens = *r.camera->lens;
    if (!lens.orthographic)
      page.update({{"fovX", angleText(json["fovX"]["value"].get<double>(), lens.fovError.x)},
                   {"fovY", angleText(json["fovY"]["value"].get<double>(), lens.fovError.y)}});
    for (const char* member : {"width", "height", "aspect", "principalPoint"})
      if (json.contains(member)) page[member] = json[member];
    if (lens.depthFault.empty()) page.update({{"near", planeText(lens.zNear)}, {"far", planeText(lens.zFar)}});
  }
  for (const char* member :
       {"fx", "fy", "cx", "cy", "skew", "axes", "quaternion", "axis", "degrees", "scale", "scaledBy"})
    if (json.contains(member)) page[member] = json[member];
  if (r.kind == ReadingKind::p) {
    page["eye"] = pointText(*r.eye, r.eyeError);
    const char* const names[] = {"right", "down", "forward"};
    for (std::size_t i = 0; i < 3; ++i) page[names[i]] = directionText(r.rows[i]);
  }
  return page;
}

/// What differs from one reading to the next, on a line.
OrderedJson readingLine(std::size_t number, const Reading& r, bool isInMemoryOrder) {
  const OrderedJson page = readingPage(r, isInMemoryOrder);
  OrderedJson line{{"#", number}, {"kind", page["kind"]}, {"numbers", page["numbers"]}};
  for (const char* axis : {"world", "view", "ndcZ", "ndcY"}) line[axis] = page.value(axis, OrderedJson("-"));
  std::vector<std::string> facts;
  for (const char* fact : {"eye", "near", "far", "fx", "degrees"})
    if (page.contains(fact)) {
      const OrderedJson& value = page[fact];
      facts.push_back(std::string(fact) + " " +
                      (value.is_string() ? value.get<std::string>() : formatDigits(value.get<double>(), 6)));
    }
  line["what"] = joined(facts, "; ");
  line["presets"] = page.value("presets", OrderedJson("-"));
  return line;
}

std::string shown(std::string_view name) {
  std::string text = visible(name);
  std::size_t end = std::min(text.size(), kLongestName);
  while (end < text.size() && continuesCharacter(text[end])) ++end;
  return text.substr(0, end) + (end < text.size() ? "…" : "");
}

std::string countOf(const PassedOver& over) {
  return over.columns > 0 && over.rows > 1
             ? std::to_string(over.rows) + " rows of " + std::to_string(over.columns) +
                   " numbers are no matrix; put an empty line between two matrices"
             : std::to_string(over.numbers) + " numbers are no matrix, which has 9, 12 or 16";
}

}  // namespace

std::vector<ReadMatrix> readMatrices(std::string_view text, const std::string& source, const std::string& otherwise,
                                     const MatrixQuestion& question) {
  constexpr std::size_t kFewest = 9;
  PastedMatrices pasted = findMatrices(text);
  std::vector<ReadMatrix> matrices;
  for (PastedMatrix& matrix : pasted.matrices) {
    MatrixReadings found = readingsOf(matrix);
    if (found.readings.empty() && matrix.isInMemoryOrder && matrix.numbers.size() < 16) continue;
    std::vector<Reading>& readings = found.readings;
    const bool hadAny = !readings.empty();
    if (question.readAs) readings = readingsIn(std::move(readings), *question.readAs, matrix.isInMemoryOrder);
    if (!question.which.empty())
      std::erase_if(readings, [&](const Reading& r) {
        return std::find(question.which.begin(), question.which.end(), r.kind) == question.which.end();
      });
    if (hadAny && readings.empty()) found.fault = "none of its readings is as --read-as and --which state";
    matrices.push_back({std::move(matrix), std::move(found)});
  }
  const auto line = [](const PassedOver& over) { return "line " + std::to_string(over.line) + ": " + countOf(over); };
  std::erase_if(pasted.passedOver, [&](const PassedOver& over) { return over.numbers < kFewest; });
  if (matrices.empty()) {
    const auto longest = std::max_element(pasted.passedOver.begin(), pasted.passedOver.end(),
                                          [](const auto& a, const auto& b) { return a.numbers < b.numbers; });
    throw InputError(otherwise + (longest == pasted.passedOver.end() ? "" : "; " + line(*longest)));
  }
  for (const PassedOver& over : pasted.passedOver) note(source + ": " + line(over));
  return matrices;
}

OrderedJson matrixReport(const ReadMatrix& matrix) {
  const PastedMatrix& m = matrix.pasted;
  OrderedJson rows = OrderedJson::array();
  for (std::size_t i = 0; i < m.rows; ++i) {
    rows.push_back(OrderedJson::array());
    for (std::size_t j = 0; j < m.columns; ++j) rows.back().push_back(m.at(i, j));
  }
  OrderedJson report{{"name", m.name.empty() ? OrderedJson() : OrderedJson(visible(m.name))},
                     {"line", m.line},
                     {"rows", rows},
                     {"order", m.isInMemoryOrder ? "memory"
                               : m.isByColumns   ? "columns"
                                                 : "rows"},
                     {"float32", matrix.found.isFloat},
                     {"readings", OrderedJson::array()}};
  for (const Reading& r : matrix.found.readings) report["readings"].push_back(readingJson(r, m.isInMemoryOrder));
  report["notes"] = matrix.found.readings.empty() ? std::vector<std::string>() : notesOn(matrix.found.readings.front());
  if (matrix.found.readings.empty()) report["fault"] = matrix.found.fault;
  return report;
}

OrderedJson matrixPage(const ReadMatrix& matrix, std::size_t number, std::size_t count) {
  const PastedMatrix& m = matrix.pasted;
  const OrderedJson report = matrixReport(matrix);
  std::string title = count > 1 ? std::to_string(number) : "";
  if (!m.name.empty()) title += (title.empty() ? "" : ", ") + inQuotes(shown(m.name), kLongestName + 3);
  title += (title.empty() ? "" : ", ") + ("line " + std::to_string(m.line)) + ", " + std::to_string(m.rows) +
           " rows of " + std::to_string(m.columns);
  OrderedJson page{{"matrix", title + (m.isInMemoryOrder ? ", in memory order"
                                       : m.isByColumns   ? ", each a column"
                                                         : "")},
                   {"as understood", report["rows"]}};
  const std::vector<Reading>& readings = matrix.found.readings;
  if (readings.empty()) {
    page["nothing fits"] = matrix.found.fault;
    return page;
  }
  page["likeliest reading"] = readingPage(readings.front(), m.isInMemoryOrder);
  for (std::size_t i = 1; i < readings.size(); ++i)
    page["other readings"].push_back(readingLine(i + 1, readings[i], m.isInMemoryOrder));
  page["notes"] = report["notes"];
  return page;
}

}  // namespace viewproj::cmd
