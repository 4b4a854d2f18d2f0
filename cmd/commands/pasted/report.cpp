#include "commands/pasted/report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/plain_camera.hpp"
#include "camera/read_pose.hpp"
#include "commands/pasted/reading_parts.hpp"
#include "formats/words.hpp"
#include "numbers/vectors.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
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

/// The angle between two edges, in degrees.
double angleOf(double low, double high) { return (std::atan(high) - std::atan(low)) * kDegrees; }

OrderedJson lensJson(const MatrixLens& lens, const Vec2& edgeError) {
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
  const auto isOff = [](double low, double high) { return std::fabs(low + high) > 1e-6 * (high - low); };
  if (edgeError.x > 0 && (isOff(lens.left, lens.right) || isOff(lens.bottom, lens.top))) {
    const auto edge = [](double at, double error) -> OrderedJson {
      return {{"value", std::atan(at) * kDegrees}, {"error", error / (1 + at * at) * kDegrees}};
    };
    part.update({{"angleLeft", edge(lens.left, edgeError.x)},
                 {"angleRight", edge(lens.right, edgeError.x)},
                 {"angleUp", edge(lens.top, edgeError.y)},
                 {"angleDown", edge(lens.bottom, edgeError.y)}});
  }
  const bool hasDepth = lens.depthFault.empty();
  part.update({{"near", hasDepth ? plane(lens.zNear) : OrderedJson()},
               {"far", hasDepth ? plane(lens.zFar) : OrderedJson()},
               {"beyondInfinity", lens.beyondInfinity}});
  if (!hasDepth) part["depthFault"] = lens.depthFault;
  return part;
}

/// Of a rotation's rows.
std::array<double, 4> turnOf(const Reading& r) {
  PlainColumns columns;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) columns[j][i] = r.rows[i][j];
  return quaternionOf(columns);
}

/// How far the angle of a turn may be off, in radians: numbers that are off by so much in all are off by sqrt(2) of it.
double turnError(const Reading& r) { return r.axesError / std::numbers::sqrt2; }

/// A rotation takes the world to the camera as it is read: its rows are the camera's axes, here OpenCV's.
OrderedJson rotationJson(const Reading& r, OrderedJson& errors) {
  if (r.isMirrored) return {{"quaternion", nullptr}, {"axis", nullptr}, {"degrees", nullptr}, {"mirrored", true}};
  const std::array<double, 4> q = turnOf(r);
  const double size = detail::hypotenuse(q[0], q[1], q[2]);
  OrderedJson axis;
  if (size > 0) axis = {q[0] / size, q[1] / size, q[2] / size};
  errors = {{"quaternion", turnError(r) / 2}, {"degrees", turnError(r) * kDegrees}};
  if (size > 0) errors["axis"] = std::min(turnError(r) / 2 / size, 2.0);
  for (const char* each : {"right", "down", "forward"}) errors[each] = r.axesError;
  return {{"right", asJson(r.rows[0])},
          {"down", asJson(r.rows[1])},
          {"forward", asJson(r.rows[2])},
          {"quaternion", q},
          {"axis", axis},
          {"degrees", 2 * std::atan2(size, q[3]) * kDegrees},
          {"mirrored", false}};
}

OrderedJson readingJson(const Reading& r, bool isInMemoryOrder) {
  OrderedJson result{{"kind", nameOf(kReadingKinds, r.kind)},
                     {"layout", nameOf(kLayoutNames, r.layout)},
                     {"convention", axesOf(r)},
                     {"presets", OrderedJson::array()},
                     {"presetsOtherwise", OrderedJson::array()}};
  OrderedJson errors = OrderedJson::object();
  if (r.kind == ReadingKind::rotation) result.update(rotationJson(r, errors));
  if (r.pixels) {
    const auto& [fx, fy, cx, cy, skew, axes, pixelErrors] = *r.pixels;
    result.update({{"fx", fx}, {"fy", fy}, {"cx", cx}, {"cy", cy}, {"skew", skew}});
    for (std::size_t i = 0; i < 4; ++i) errors[std::array{"fx", "fy", "cx", "cy"}[i]] = pixelErrors[i];
    if (!axes.empty()) result["axes"] = axes;
  }
  if (r.kind == ReadingKind::p || (r.camera && r.camera->pose))
    for (const char* axis : {"right", r.kind == ReadingKind::p ? "down" : "up", "forward"}) errors[axis] = r.axesError;
  if (!errors.empty()) result["errors"] = errors;
  if (r.kind == ReadingKind::p)
    result.update({{"eye", {{"value", asJson(*r.eye)}, {"error", asJson(r.eyeError)}}},
                   {"right", asJson(r.rows[0])},
                   {"down", asJson(r.rows[1])},
                   {"forward", asJson(r.rows[2])}});
  if (!r.camera) return result;
  const MatrixCamera& camera = *r.camera;
  for (const ConventionPreset& preset : conventionPresets()) {
    if (!fits(r, preset.convention, isInMemoryOrder)) continue;
    const std::vector<std::string> differs = differences(r, preset.convention);
    if (differs.empty())
      result["presets"].push_back(preset.name);
    else
      result["presetsOtherwise"].push_back({{"name", preset.name}, {"differs", differs}});
  }
  if (result["presets"].empty()) {
    OrderedJson others = OrderedJson::array();
    for (const ConventionPreset& preset : conventionPresets())
      if (fitsButVectors(r, preset) && differences(r, preset.convention).empty())
        others.push_back({{"name", preset.name}, {"differs", OrderedJson::array({"vectors"})}});
    for (const OrderedJson& other : result["presetsOtherwise"]) others.push_back(other);
    result["presetsOtherwise"] = others;
  }
  if (camera.pose) {
    if (!(camera.lens && camera.lens->orthographic))
      result["eye"] = {{"value", asJson(camera.pose->eye())}, {"error", asJson(camera.eyeError)}};
    result.update({{"right", asJson(camera.pose->right())},
                   {"up", asJson(camera.pose->up())},
                   {"forward", asJson(camera.pose->forward())}});
  }
  if (camera.lens) result.update(lensJson(*camera.lens, r.edgeError));
  if (camera.scale != 1) result["scale"] = camera.scale;
  if (r.scaledBy != 1) result["scaledBy"] = r.scaledBy;
  return result;
}

/// The turn of a rotation, a view or a pose as angles of this order: {"order", "degrees", "errors"}; of a rotation both
/// as it takes the camera to the world and as it takes the world to the camera. Null for any other reading, and where
/// the order's axes are of another world.
OrderedJson anglesOf(const Reading& r, const NameRow<EulerOrder>& order) {
  OrderedJson angles{{"order", order.first}}, errors;
  const auto add = [&](const char* name, const Pose& pose, CameraAxes axes) {
    const auto degreesOf = [&](const Pose& each) { return eulerDegreesOf(plainPose(each), order.second, axes); };
    Vec3 degrees = degreesOf(pose), error;
    const std::array<double, 4> q = quaternionOf(worldFromCamera(plainPose(pose), axes).columns);
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<double, 4> turned = q;
      turned[k] += turnError(r) / 2;
      const Vec3 moved = degreesOf(poseFromRotation({}, {turned[0], turned[1], turned[2], turned[3]}, axes));
      for (std::size_t i = 0; i < 3; ++i) error[i] += std::fabs(std::remainder(moved[i] - degrees[i], 360));
    }
    for (std::size_t i = 0; i < 3; ++i) degrees[i] = certainDegrees(degrees[i]);
    angles[name] = asJson(degrees);
    errors[name] = asJson(error);
    angles["errors"] = errors;
  };
  if (r.kind == ReadingKind::rotation && !r.isMirrored) {
    const auto [x, y, z, w] = turnOf(r);
    const CameraAxes axes = order.second.cameraAxes.value_or(CameraAxes::RUB);  // which turn: one matrix in any axes
    add("worldFromCamera", poseFromRotation({}, {x, y, z, w}, axes), axes);
    add("cameraFromWorld", poseFromRotation({}, {-x, -y, -z, w}, axes), axes);
    return angles;
  }
  if (!r.camera || !r.camera->pose || r.camera->lens) return nullptr;
  const Pose& pose = *r.camera->pose;
  const CameraAxes own = valueOf(kCameraAxesNames, nameOf(kViewNames, r.camera->convention.view));
  const CameraAxes axes = axesOfOrder(order.second, pose.world(), own);
  if (poseFromRotation({}, {}, axes).world() != pose.world()) return nullptr;
  add("degrees", pose, axes);
  return angles;
}

// ---- Notes

/// What looks wrong, or is easily taken for something else, in the likeliest reading.
std::vector<std::string> notesOn(const Reading& r, const PastedMatrix& m) {
  std::vector<std::string> notes;
  const bool isTurned = r.layout == MatrixLayout::transposed;
  const Mat4 read = matrixOf(m, r.layout);
  for (std::size_t j = 0; j < (isTurned ? m.rows : m.columns) && (isTurned ? m.columns : m.rows) == 4; ++j)
    if (const double entry = isTurned ? m.at(j, 3) : m.at(3, j); entry != read[3][j] && notes.empty())
      notes.push_back("Its last " + std::string(isTurned ? "column" : "row") + " has " + formatDigits(entry, 3) +
                      ", which rounding left and counts as 0.");
  if (r.scaledBy != 1)
    notes.push_back("Its axes have the length " + formatDigits(r.scaledBy, 6) +
                    ", not 1: it scales too, as an object's does.");
  if (r.isMirrored && r.kind != ReadingKind::rotation) notes.emplace_back("It is mirrored: one axis is flipped.");
  if (r.kind == ReadingKind::rotation && !r.isMirrored)
    notes.emplace_back(
        "Its axes are those of a camera of OpenCV. Of OpenGL's the second is up and the third back: -down, -forward.");
  if (r.kind == ReadingKind::k || r.kind == ReadingKind::p)
    notes.emplace_back(
        r.pixels->fx < kFewestPixels ? "It is not in pixels, but in half widths or in pictures."
        : countsFromOne(m)
            ? "MATLAB's pixels begin at 1, as a camera made of it has them: viewport.pixelCenter 1."
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
  if (!camera.lens) return notes;
  const MatrixLens& lens = *camera.lens;
  if (lens.orthographic && camera.convention.ndcY == NdcY::down && r.kind == ReadingKind::projection)
    notes.emplace_back(
        "It is read as Vulkan's. Of OpenGL or Direct3D, as glm::ortho(0, width, height, 0), its y runs down from the "
        "picture's top: count pixels with --set viewport.origin=bottom-left.");
  if (lens.orthographic) return notes;
  if (!lens.depthFault.empty()) notes.push_back("Of its depth nothing is known: " + lens.depthFault + ".");
  const double fov = angleOf(lens.bottom, lens.top), aspect = (lens.right - lens.left) / (lens.top - lens.bottom);
  const bool isFlipped = r.kind == ReadingKind::viewProjection && detail::maxAbs(camera.pose->eye()) == 0;
  if (fov > kWideFov || fov < kNarrowFov || isFlipped || lens.fovError.y < 1e-3) {
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

// ---- For people

/// The shortest number within an error of the value.
double shortest(double value, double error) {
  if (std::fabs(value) <= error) return 0;
  int digits = 1;
  while (digits < 17 && !(std::fabs(toDigits(value, digits) - value) <= error)) ++digits;
  return toDigits(value, digits);
}

/// The error is rounded up.
std::string plusMinus(const std::string& value, double error) {
  const double rounded = toDigits(error, 2);
  return error > 0 ? value + " ± " + formatDigits(rounded < error ? 1.05 * error : rounded, 2) : value;
}

std::string planeText(const PlaneDistance& d) {
  constexpr double kSure = 0.01;
  if (std::isinf(d.value)) return "infinite" + (std::isinf(d.low) ? "" : ", at least " + formatDigits(d.low, 2));
  const double shown = shortest(d.value, std::min(d.value - d.low, d.high - d.value));
  const std::string value = formatNumber(shown);
  if (std::isinf(d.high)) return value + ", at least " + formatDigits(d.low, 2);
  const double error = std::max(d.high - shown, shown - d.low);
  return error <= kSure * std::fabs(d.value)
             ? plusMinus(value, error)
             : value + " (" + formatDigits(d.low, 3) + " .. " + formatDigits(d.high, 3) + ")";
}

/// A number or a list, each as short as its error lets it be; as it is where the error is below this share of it.
OrderedJson pageWithError(const OrderedJson& value, const OrderedJson& error, double least) {
  const auto listOf = [](const OrderedJson& of) {
    return of.is_array() ? of.get<std::vector<double>>() : std::vector<double>{of.get<double>()};
  };
  const std::vector<double> numbers = listOf(value);
  std::vector<double> errors = listOf(error);
  errors.resize(numbers.size(), errors.front());
  std::vector<std::string> parts;
  double most = 0, size = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double shown = shortest(numbers[i], errors[i]);
    parts.push_back(formatNumber(shown));
    most = std::max(most, errors[i] + std::fabs(shown - numbers[i]));
    size = std::max(size, std::fabs(numbers[i]));
  }
  return most < least * size ? value : OrderedJson(plusMinus(joined(parts), most));
}

/// A value with its error; an axis without what rounding left of 0; an object's members; else as it is.
OrderedJson valuePage(std::string_view name, const OrderedJson& value, const OrderedJson& error) {
  constexpr double kSeen = 5e-9;  // in the digits that a table has
  if (value.contains("low"))
    return planeText({value["value"].get<double>(), value["low"].get<double>(), value["high"].get<double>()});
  if (value.contains("error")) return pageWithError(value["value"], value["error"], 0);
  OrderedJson page = error.is_null() ? value : pageWithError(value, error, kSeen);
  if (page.is_array() && isAmong(name, "right up down forward"))
    for (OrderedJson& x : page) x = std::round(x.get<double>() * 1e9) / 1e9 + 0.0;
  if (!value.is_object()) return page;
  page.erase("errors");
  for (auto& [member, each] : page.items())
    each = valuePage(member, each, value.value("errors", OrderedJson::object()).value(member, OrderedJson()));
  return page;
}

/// "opengl, unity, metal except reverseZ".
std::string presetText(const OrderedJson& reading) {
  auto names = reading["presets"].get<std::vector<std::string>>();
  for (const OrderedJson& preset : reading["presetsOtherwise"])
    names.push_back(preset["name"].get<std::string>() + " except " +
                    joined(preset["differs"].get<std::vector<std::string>>(), " and "));
  return names.empty() ? "no preset" : joined(names);
}

/// What of the numbers a layout says.
std::string numbersText(const OrderedJson& reading) {
  const auto layout = reading["layout"].get<std::string>();
  const bool isTransposed = layout == nameOf(kLayoutNames, MatrixLayout::transposed);
  if (reading["kind"] == "rotation" && !reading["mirrored"].get<bool>())
    return layout + (isTransposed ? ": from the camera to the world" : ": from the world to the camera");
  return layout + (isTransposed ? ": each column is printed as a row, as column-major memory or row vectors" : "");
}

OrderedJson readingPage(const OrderedJson& reading) {
  OrderedJson page{{"kind", reading["kind"]}, {"numbers", numbersText(reading)}};
  if (reading.value("mirrored", false)) page["determinant"] = "-1: a reflection, no rotation";
  const OrderedJson errors = reading.value("errors", OrderedJson::object());
  page.update(reading["convention"]);
  if (!reading["convention"].empty()) page["presets"] = presetText(reading);
  for (const auto& [name, value] : reading.items()) {
    constexpr std::string_view kForPrograms =
        "layout convention presets presetsOtherwise type window beyondInfinity mirrored depthFault errors";
    if (!isAmong(name, kForPrograms) && !value.is_null() && !page.contains(name))
      page[name] = valuePage(name, value, errors.value(name, OrderedJson()));
  }
  return page;
}

/// What differs from one reading to the next, on a line.
OrderedJson readingLine(std::size_t number, const OrderedJson& reading) {
  const OrderedJson page = readingPage(reading);
  OrderedJson line{{"#", number}, {"kind", page["kind"]}, {"numbers", reading["layout"]}};
  for (const char* axis : {"world", "view", "ndcZ", "ndcY"}) line[axis] = page.value(axis, OrderedJson("-"));
  std::vector<std::string> facts, names{"eye", "near", "far", "fx", "determinant"};
  if (page["kind"] == "rotation") names = {"determinant", "right", "down", "forward"};
  for (const std::string& fact : names)
    if (page.contains(fact)) {
      const OrderedJson& value = page[fact];
      std::vector<std::string> numbers;
      if (!value.is_string())
        for (const OrderedJson& each : value.is_array() ? value : OrderedJson{value})
          numbers.push_back(formatDigits(each.get<double>(), 6));
      facts.push_back(fact + " " + (value.is_string() ? value.get<std::string>() : joined(numbers)));
    }
  line["what"] = joined(facts, "; ");
  line["presets"] = page.value("presets", OrderedJson("-"));
  return line;
}

/// What has a name and is no matrix: 't' (3 numbers, line 4), 'rvec' (3 numbers, line 5).
std::vector<std::string> vectorsIn(const std::vector<PassedOver>& passedOver) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> vectors;
  for (const PassedOver& over : passedOver)
    if (over.numbers >= 3 && over.numbers < kFewest && !over.name.empty() && vectors.size() <= kMost)
      vectors.push_back(vectors.size() == kMost ? "and others"
                                                : inQuotes(over.name) + " (" + std::to_string(over.numbers) +
                                                      " numbers, line " + std::to_string(over.line) + ")");
  return vectors;
}

/// Whether the first reading is a K of pixels in OpenCV's axes, and no name beside it speaks of others.
bool isOpenCvK(const ReadMatrix& m) {
  if (m.found.readings.empty()) return false;
  const Reading& first = m.found.readings.front();
  return first.kind == ReadingKind::k && first.pixels->axes == "RDF" && first.pixels->fx >= kFewestPixels &&
         hintOf(m.pasted).axes.value_or(ViewAxes::RDF) == ViewAxes::RDF;
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
    if (!readings.empty() && question.readAs && !question.isQuiet &&
        !fits(readings.front(), *question.readAs, m.pasted.isInMemoryOrder))
      note(source + ": line " + std::to_string(m.pasted.line) + ": only its transpose is as --read-as states");
    if (readings.empty())
      m.found.fault =
          std::string("none of its readings is as ") + (question.readAs ? "--read-as" : "--which") + " states";
  }
  const std::vector<std::string> vectors = vectorsIn(pasted.passedOver);
  const auto line = [](const PassedOver& over) { return "line " + std::to_string(over.line) + ": " + over.why; };
  std::erase_if(pasted.passedOver, [](const PassedOver& over) { return over.numbers < kFewest; });
  if (matrices.empty()) {
    const auto longest = std::max_element(pasted.passedOver.begin(), pasted.passedOver.end(),
                                          [](const auto& a, const auto& b) { return a.numbers < b.numbers; });
    throw InputError(otherwise + (longest != pasted.passedOver.end() ? "; " + line(*longest)
                                  : vectors.size() > 1               ? "; it has " + joined(vectors)
                                                                     : ""));
  }
  if (question.isQuiet) return matrices;
  for (const PassedOver& over : pasted.passedOver) note(source + ": " + line(over));
  if (!vectors.empty()) note(source + ": not shown, since no matrix: " + joined(vectors));
  return matrices;
}

OrderedJson rowsOf(const PastedMatrix& m, bool isTurned) {
  OrderedJson rows = OrderedJson::array();
  for (std::size_t i = 0; i < (isTurned ? m.columns : m.rows); ++i) {
    rows.push_back(OrderedJson::array());
    for (std::size_t j = 0; j < (isTurned ? m.rows : m.columns); ++j)
      rows.back().push_back(isTurned ? m.at(j, i) : m.at(i, j));
  }
  return rows;
}

OrderedJson matrixReport(const ReadMatrix& matrix, const NameRow<EulerOrder>* angles) {
  const PastedMatrix& m = matrix.pasted;
  OrderedJson report{{"name", m.name.empty() ? OrderedJson() : OrderedJson(visible(m.name))},
                     {"line", m.line},
                     {"rows", rowsOf(m, false)},
                     {"order", m.isInMemoryOrder ? "memory"
                               : m.isByColumns   ? "columns"
                                                 : "rows"},
                     {"float32", matrix.found.isFloat},
                     {"readings", OrderedJson::array()}};
  for (const Reading& r : matrix.found.readings) {
    report["readings"].push_back(readingJson(r, m.isInMemoryOrder));
    if (angles) report["readings"].back()["angles"] = anglesOf(r, *angles);
  }
  const bool isNothing = matrix.found.readings.empty();
  report["notes"] = isNothing ? std::vector<std::string>() : notesOn(matrix.found.readings.front(), m);
  if (isNothing) report["fault"] = matrix.found.fault;
  return report;
}

OrderedJson matrixPage(const ReadMatrix& matrix, const NameRow<EulerOrder>* angles, std::size_t number,
                       std::size_t count) {
  const PastedMatrix& m = matrix.pasted;
  const OrderedJson report = matrixReport(matrix, angles);
  std::vector<std::string> title{"line " + std::to_string(m.line),
                                 std::to_string(m.rows) + " rows of " + std::to_string(m.columns)};
  if (!m.name.empty()) title.insert(title.begin(), inQuotes(m.name));
  if (count > 1) title.insert(title.begin(), std::to_string(number));
  if (m.isInMemoryOrder || m.isByColumns) title.emplace_back(m.isInMemoryOrder ? "in memory order" : "each a column");
  OrderedJson page{{"matrix", joined(title)}, {"as understood", report["rows"]}};
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
