#include "commands/pasted/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/plain_camera.hpp"
#include "commands/pasted/reading_order.hpp"
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
constexpr std::size_t kFewest = 9;  ///< fewer numbers are nothing that nearly is a matrix
constexpr NameRow<MatrixLayout> kLayoutNames[] = {{"as written", MatrixLayout::asWritten},
                                                  {"transposed", MatrixLayout::transposed},
                                                  {"either", MatrixLayout::either}};

/// The axes that a reading determines.
OrderedJson axesOf(const Reading& reading) {
  OrderedJson axes = OrderedJson::object();
  if (!reading.camera) return axes;
  const OrderedJson all = asJson(reading.camera->convention);
  if (reading.camera->kind != MatrixKind::projection) axes["world"] = all["world"];
  if (reading.camera->kind != MatrixKind::viewProjection) axes["view"] = all["view"];
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

/// Of a mirrored one that of its negative.
OrderedJson rotationJson(const Reading& r) {
  const double sign = r.isMirrored ? -1 : 1;
  PlainColumns columns;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) columns[j][i] = sign * r.rows[i][j];
  const std::array<double, 4> q = quaternionOf(columns);
  const double size = std::hypot(q[0], q[1], q[2]);
  OrderedJson axis;
  if (size > 0) axis = {q[0] / size, q[1] / size, q[2] / size};
  return {{"quaternion", q},
          {"axis", axis},
          {"degrees", 2 * std::atan2(size, q[3]) * kDegrees},
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
    if (camera.kind != MatrixKind::projection && preset.convention.world != camera.convention.world)
      differs.push_back("world");
    if (camera.lens && camera.lens->depthFault.empty() && preset.convention.reverseZ != camera.convention.reverseZ)
      differs.push_back("reverseZ");
    if (differs.empty())
      result["presets"].push_back(preset.name);
    else
      result["presetsOtherwise"].push_back({{"name", preset.name}, {"differs", differs}});
  }
  if (camera.pose) {
    if (!(camera.lens && camera.lens->orthographic)) result["eye"] = withError(camera.pose->eye(), camera.eyeError);
    result.update({{"right", asJson(camera.pose->right())},
                   {"up", asJson(camera.pose->up())},
                   {"forward", asJson(camera.pose->forward())}});
  }
  if (camera.lens) result.update(lensJson(*camera.lens));
  if (camera.scale != 1) result["scale"] = camera.scale;
  if (r.scaledBy != 1) result["scaledBy"] = r.scaledBy;
  return result;
}

/// The turn of a rotation, a view or a pose as angles of this order: {"order", "degrees"}; of a rotation both as it
/// takes the camera to the world and as it takes the world to the camera. Null for any other reading, and where the
/// order's axes are of another world.
OrderedJson anglesOf(const Reading& r, const NameRow<EulerOrder>& order) {
  const auto degreesOf = [&](const Pose& pose, CameraAxes axes) {
    Vec3 degrees = eulerDegreesOf(plainPose(pose), order.second, axes);
    for (std::size_t i = 0; i < 3; ++i) degrees[i] = certainDegrees(degrees[i]);
    return asJson(degrees);
  };
  if (r.kind == ReadingKind::rotation && !r.isMirrored) {
    PlainColumns columns;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) columns[j][i] = r.rows[i][j];
    const auto [x, y, z, w] = quaternionOf(columns);
    const CameraAxes axes = order.second.cameraAxes.value_or(CameraAxes::RUB);  // which turn: one matrix in any axes
    return {{"order", order.first},
            {"worldFromCamera", degreesOf(poseFromRotation({}, {x, y, z, w}, axes), axes)},
            {"cameraFromWorld", degreesOf(poseFromRotation({}, {-x, -y, -z, w}, axes), axes)}};
  }
  if (!r.camera || !r.camera->pose || r.camera->lens) return nullptr;
  const Pose& pose = *r.camera->pose;
  const ViewAxes view = r.camera->convention.view;
  const CameraAxes own = view == ViewAxes::RUB   ? CameraAxes::RUB
                         : view == ViewAxes::RUF ? CameraAxes::RUF
                                                 : CameraAxes::RDF;
  const CameraAxes axes = order.second.cameraAxes.value_or(own);
  if (poseFromRotation({}, {}, axes).world() != pose.world()) return nullptr;
  return {{"order", order.first}, {"degrees", degreesOf(pose, axes)}};
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
  if (r.kind == ReadingKind::pose)
    notes.emplace_back(
        "Its axes are those of views. A transform of Unity has RUF, of Unreal FRU, of a robot FLU: "
        "--world-from-camera "
        "FILE --set cameraAxes=FLU.");
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
  if (fov > kWideFov || fov < kNarrowFov || isFlipped) {
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
    else if (fov > kWideFov)
      notes.push_back("Its fovY of " + formatDigits(fov, 6) + " degrees is unusually wide.");
  }
  // -3 to 1: the middle half of a lens of -1 to 1, as (x + 1) / 2 makes of -1 to 1.
  const auto isHalved = [](double low, double high) { return std::fabs(low + 3 * high) <= 1e-4 * std::fabs(low); };
  if (isHalved(lens.left, lens.right) && (isHalved(lens.bottom, lens.top) || isHalved(-lens.top, -lens.bottom)))
    notes.emplace_back(
        "Its picture lies between 0 and 1, not -1 and 1, as texture coordinates of a shadow map do: the camera's own "
        "fields of view are about half of these.");
  for (const int whole : {1, 2})
    if (std::fabs(aspect - whole) < 1e-6)
      notes.push_back("Its aspect is exactly " + std::to_string(whole) +
                      ": right for such a picture; width / height in integers gives it too.");
  return notes;
}

/// What counts as 0 in the last row, of which rounding left something; or empty.
std::string noiseNote(const PastedMatrix& m, MatrixLayout layout) {
  const bool isTurned = layout == MatrixLayout::transposed;
  if ((isTurned ? m.columns : m.rows) < 4) return "";
  const Mat4 read = matrixOf(m, layout);
  for (std::size_t j = 0; j < (isTurned ? m.rows : m.columns); ++j)
    if (const double entry = isTurned ? m.at(j, 3) : m.at(3, j); entry != read[3][j])
      return "Its last " + std::string(isTurned ? "column" : "row") + " has " + formatDigits(entry, 3) +
             ", which rounding left and counts as 0.";
  return "";
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

/// A number or a vector with its error, or a unit vector without what rounding left of 0; else as it is.
OrderedJson valuePage(const std::string& name, const OrderedJson& value) {
  if (value.contains("low"))
    return planeText({value["value"].get<double>(), value["low"].get<double>(), value["high"].get<double>()});
  if (value.contains("error") && value["error"].is_number()) {
    const double error = value["error"].get<double>();
    return plusMinus(shortest(value["value"].get<double>(), error), error);
  }
  if (value.contains("error")) {
    std::vector<std::string> parts;
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double error = value["error"][i].get<double>();
      parts.push_back(shortest(value["value"][i].get<double>(), error));
      most = std::max(most, error);
    }
    return plusMinus(joined(parts), most);
  }
  OrderedJson result = value;
  if (name == "right" || name == "up" || name == "down" || name == "forward")
    for (OrderedJson& x : result) x = std::round(x.get<double>() * 1e9) / 1e9 + 0.0;
  return result;
}

/// "opengl, unity, metal except reverseZ".
std::string presetText(const OrderedJson& reading) {
  auto names = reading["presets"].get<std::vector<std::string>>();
  for (const OrderedJson& preset : reading["presetsOtherwise"])
    names.push_back(preset["name"].get<std::string>() + " except " +
                    joined(preset["differs"].get<std::vector<std::string>>(), " and "));
  return names.empty() ? "no preset" : joined(names);
}

OrderedJson readingPage(const OrderedJson& reading) {
  OrderedJson page{{"kind", reading["kind"]}, {"numbers", reading["layout"]}};
  page.update(reading["convention"]);
  if (!reading["convention"].empty()) page["presets"] = presetText(reading);
  for (const auto& [name, value] : reading.items()) {
    const bool isForPrograms = name == "layout" || name == "convention" || name == "presetsOtherwise" ||
                               name == "type" || name == "window" || name == "beyondInfinity" || name == "mirrored" ||
                               name == "depthFault" || value.is_null();
    if (!isForPrograms && !page.contains(name) && name != "presets") page[name] = valuePage(name, value);
  }
  return page;
}

/// What differs from one reading to the next, on a line.
OrderedJson readingLine(std::size_t number, const OrderedJson& reading) {
  const OrderedJson page = readingPage(reading);
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

/// What has a name and is no matrix: "t (3 numbers, line 4), rvec (3 numbers, line 5)".
std::vector<std::string> vectorsIn(const std::vector<PassedOver>& passedOver) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> vectors;
  for (const PassedOver& over : passedOver)
    if (over.numbers >= 3 && over.numbers < kFewest && !over.name.empty() && vectors.size() <= kMost)
      vectors.push_back(vectors.size() == kMost ? "and others"
                                                : shown(over.name) + " (" + std::to_string(over.numbers) +
                                                      " numbers, line " + std::to_string(over.line) + ")");
  return vectors;
}

/// Whether the first reading is a K of pixels in OpenCV's axes.
bool isOpenCvK(const ReadMatrix& m) {
  if (m.found.readings.empty()) return false;
  const Reading& first = m.found.readings.front();
  return first.kind == ReadingKind::k && first.pixels->axes == "RDF" && first.pixels->fx >= 20;
}

}  // namespace

std::vector<ReadMatrix> readMatrices(std::string_view text, const std::string& source, const std::string& otherwise,
                                     const MatrixQuestion& question) {
  PastedMatrices pasted = findMatrices(text);
  std::vector<ReadMatrix> matrices;
  for (PastedMatrix& matrix : pasted.matrices) {
    MatrixReadings found = readingsOf(matrix);
    if (!found.readings.empty() || !matrix.isInMemoryOrder || matrix.numbers.size() == 16)
      matrices.push_back({std::move(matrix), std::move(found)});
  }
  const bool hasK = std::any_of(matrices.begin(), matrices.end(), isOpenCvK);
  std::vector<std::vector<Reading>> lenses;
  for (const ReadMatrix& m : matrices)
    if (!m.found.readings.empty() && m.found.readings.front().kind == ReadingKind::projection)
      lenses.push_back(m.found.readings);
  for (ReadMatrix& m : matrices) {
    std::vector<Reading>& readings = m.found.readings;
    if (readings.empty()) continue;
    if (hasK) readings = readingsOf(m.pasted, true).readings;
    for (const std::vector<Reading>& lens : lenses) orderBeside(readings, lens);
    if (question.readAs) readings = readingsIn(std::move(readings), *question.readAs, m.pasted.isInMemoryOrder);
    if (!question.which.empty())
      std::erase_if(readings, [&](const Reading& r) {
        return std::find(question.which.begin(), question.which.end(), r.kind) == question.which.end();
      });
    if (readings.empty())
      m.found.fault =
          std::string("none of its readings is as ") + (!question.readAs         ? "--which states"
                                                        : question.which.empty() ? "--read-as states"
                                                                                 : "--read-as and --which state");
  }
  const std::vector<std::string> vectors = vectorsIn(pasted.passedOver);
  const auto line = [](const PassedOver& over) { return "line " + std::to_string(over.line) + ": " + over.why; };
  const auto has = [&](std::string_view name) {
    return std::any_of(pasted.passedOver.begin(), pasted.passedOver.end(),
                       [&](const PassedOver& over) { return over.name == name && over.numbers == 3; });
  };
  const bool areCamera = hasK && matrices.size() == 1 && has("rvec") && has("tvec");
  std::erase_if(pasted.passedOver, [](const PassedOver& over) { return over.numbers < kFewest; });
  if (matrices.empty()) {
    const auto longest = std::max_element(pasted.passedOver.begin(), pasted.passedOver.end(),
                                          [](const auto& a, const auto& b) { return a.numbers < b.numbers; });
    throw InputError(otherwise + (longest != pasted.passedOver.end() ? "; " + line(*longest)
                                  : vectors.size() > 1               ? "; it has " + joined(vectors)
                                                                     : ""));
  }
  for (const PassedOver& over : pasted.passedOver) note(source + ": " + line(over));
  if (!vectors.empty())
    note(source + ": not shown, since no matrix: " + joined(vectors) +
         (areCamera ? "; with --viewport WxH they and the K are read as a camera" : ""));
  return matrices;
}

OrderedJson matrixReport(const ReadMatrix& matrix, const NameRow<EulerOrder>* angles) {
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
  for (const Reading& r : matrix.found.readings) {
    report["readings"].push_back(readingJson(r, m.isInMemoryOrder));
    if (angles) report["readings"].back()["angles"] = anglesOf(r, *angles);
  }
  report["notes"] = matrix.found.readings.empty() ? std::vector<std::string>() : notesOn(matrix.found.readings.front());
  if (!matrix.found.readings.empty())
    if (const std::string note = noiseNote(m, matrix.found.readings.front().layout); !note.empty())
      report["notes"].push_back(note);
  if (matrix.found.readings.empty()) report["fault"] = matrix.found.fault;
  return report;
}

OrderedJson matrixPage(const ReadMatrix& matrix, const NameRow<EulerOrder>* angles, std::size_t number,
                       std::size_t count) {
  const PastedMatrix& m = matrix.pasted;
  const OrderedJson report = matrixReport(matrix, angles);
  std::string title = count > 1 ? std::to_string(number) : "";
  if (!m.name.empty()) title += (title.empty() ? "" : ", ") + inQuotes(shown(m.name), kLongestName + 3);
  title += (title.empty() ? "" : ", ") + ("line " + std::to_string(m.line)) + ", " + std::to_string(m.rows) +
           " rows of " + std::to_string(m.columns);
  OrderedJson page{{"matrix", title + (m.isInMemoryOrder ? ", in memory order"
                                       : m.isByColumns   ? ", each a column"
                                                         : "")},
                   {"as understood", report["rows"]}};
  if (report["readings"].empty()) {
    page["nothing fits"] = matrix.found.fault;
    return page;
  }
  page["likeliest reading"] = readingPage(report["readings"].front());
  for (std::size_t i = 1; i < report["readings"].size(); ++i)
    page["other readings"].push_back(readingLine(i + 1, report["readings"][i]));
  page["notes"] = report["notes"];
  return page;
}

}  // namespace viewproj::cmd
