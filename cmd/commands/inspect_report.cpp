#include "commands/inspect_report.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/names.hpp"
#include "camera/read_camera.hpp"
#include "camera/split_matrix.hpp"
#include "numbers/vectors.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/matrices.hpp"

namespace viewproj::cmd {

using detail::rounded;
namespace {

bool isTurned(Vectors vectors, Storage storage) {
  return (vectors == Vectors::row) != (storage == Storage::columnMajor);
}

/// Whether a matrix of this camera would be written like that in this convention, apart from reverseZ and world, which
/// follow from the matrix and the rest.
bool fits(const MatrixCamera& r, const Convention& c, NumberOrder order) {
  if (r.lens && (c.ndcZ != r.convention.ndcZ || c.ndcY != r.convention.ndcY)) return false;
  if (r.kind != MatrixKind::viewProjection && c.view != r.convention.view) return false;
  const bool turned = r.layout == MatrixLayout::transposed;
  return r.layout == MatrixLayout::either || isTurned(c.vectors, c.storage) == turned ||
         (order == NumberOrder::rows && (c.vectors == Vectors::row) == turned);
}

constexpr NameRow<MatrixKind> kKindNames[] = {{"projection", MatrixKind::projection},
                                              {"view", MatrixKind::view},
                                              {"worldFromView", MatrixKind::worldFromView},
                                              {"viewProjection", MatrixKind::viewProjection}};
constexpr NameRow<MatrixLayout> kLayoutNames[] = {{"as written", MatrixLayout::asWritten},
                                                  {"transposed", MatrixLayout::transposed},
                                                  {"either", MatrixLayout::either}};

bool isOrthographic(const MatrixCamera& r) { return r.lens && r.lens->orthographic; }

MatrixCameras camerasOf(const WrittenMatrix& written, bool isFloat) {
  Mat4 matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i / 4][i % 4] = written.numbers[i];
  return viewproj::camerasOf(matrix, {.float32 = isFloat});
}

/// Whether the input's own words allow the reading: the matrix's name and, if there is one, the convention.
bool isStated(const MatrixCamera& r, const WrittenMatrix& written, const std::optional<Convention>& c) {
  const std::string& name = written.name;
  if ((name == "view" && r.kind != MatrixKind::view) ||
      (name == "viewInverse" && r.kind != MatrixKind::worldFromView) ||
      (name == "projection" && r.kind != MatrixKind::projection))
    return false;
  return !c || (fits(r, *c, written.order) && (!r.lens || r.convention.reverseZ == c->reverseZ) &&
                (r.kind == MatrixKind::projection || r.convention.world == c->world));
}

/// The axes that a reading determines.
OrderedJson axesOf(const MatrixCamera& r) {
  const OrderedJson all = asJson(r.convention);
  OrderedJson axes = OrderedJson::object();
  if (r.kind != MatrixKind::projection) axes["world"] = all["world"];
  if (r.kind != MatrixKind::viewProjection) axes["view"] = all["view"];
  if (r.lens)
    for (const char* axis : {"ndcZ", "reverseZ", "ndcY"}) axes[axis] = all[axis];
  return axes;
}

/// A camera of the window in a picture of one pixel, which counts from its upper left corner: focal lengths and
/// principal point in widths and heights. Nothing where the window leaves the range of cameras.
std::optional<Camera> unitCamera(const MatrixLens& lens) {
  const auto window = [&] {
    return lens.orthographic ? orthographic(lens.left, lens.right, lens.bottom, lens.top, 0, 1)
                             : perspectiveWindow(lens.left, lens.right, lens.bottom, lens.top, 0, kInfiniteFar);
  };
  try {
    const Pose origin = lookAlong({}, {0, 0, -1}, {0, 1, 0}, Handedness::right);
    return makeCamera(origin, lens.projection ? *lens.projection : window(), Viewport{.width = 1, .height = 1});
  } catch (const CameraError&) {
    return std::nullopt;
  }
}

OrderedJson lensJson(const MatrixLens& lens) {
  OrderedJson part{{"type", lens.orthographic ? "orthographic" : "perspective"},
                   {"left", lens.left},
                   {"right", lens.right},
                   {"bottom", lens.bottom},
                   {"top", lens.top}};
  if (const auto camera = unitCamera(lens)) {
    const Projection p = camera->projection();
    const Intrinsics k = camera->intrinsics();
    part["aspect"] = p.aspect();
    if (!lens.orthographic)
      part.update({{"fovX", p.fov(Fov::horizontal)},
                   {"fovY", p.fov(Fov::vertical)},
                   {"fovDiagonal", p.fov(Fov::diagonal)},
                   {"focalLength", {k.fx, k.fy}},
                   {"principalPoint", {k.cx, k.cy}}});
  }
  const auto plane = [](const PlaneDistance& d) -> OrderedJson {
    return {{"value", d.value}, {"low", d.low}, {"high", d.high}};
  };
  part.update({{"near", plane(lens.zNear)}, {"far", plane(lens.zFar)}, {"beyondInfinity", lens.beyondInfinity}});
  return part;
}

OrderedJson poseJson(const MatrixCamera& r) {
  const Convention axes{.world = r.convention.world, .view = ViewAxes::RUF};
  const Camera camera = cameraIn(axes, r.pose);
  const Mat4 rows = r.kind == MatrixKind::worldFromView ? transposed(matrix(camera, Space::world, Space::view))
                                                        : matrix(camera, Space::view, Space::world);
  const auto row = [&](std::size_t i) { return asJson(Vec3{rows[i][0], rows[i][1], rows[i][2]}); };
  return {{"eye", isOrthographic(r) ? OrderedJson() : asJson(r.pose->eye())},
          {"right", row(0)},
          {"up", row(1)},
          {"forward", row(2)},
          {"residual", r.residual}};
}

OrderedJson readingJson(std::size_t number, const MatrixCamera& r, NumberOrder order) {
  OrderedJson result{{"reading", number},
                     {"kind", nameOf(kKindNames, r.kind)},
                     {"layout", nameOf(kLayoutNames, r.layout)},
                     {"layouts", OrderedJson::array()},
                     {"convention", axesOf(r)},
                     {"presets", OrderedJson::array()},
                     {"presetsOtherwise", OrderedJson::array()},
                     {"scale", r.scale}};
  for (const auto& [vectors, vectorsValue] : kVectorsNames)
    for (const auto& [storage, storageValue] : kStorageNames)
      if (r.layout == MatrixLayout::either ||
          isTurned(vectorsValue, storageValue) == (r.layout == MatrixLayout::transposed))
        result["layouts"].push_back({{"vectors", vectors}, {"storage", storage}});
  for (const ConventionPreset& preset : conventionPresets()) {
    if (!fits(r, preset.convention, order)) continue;
    OrderedJson differs = OrderedJson::array();
    if (r.kind != MatrixKind::projection && preset.convention.world != r.convention.world) differs.push_back("world");
    if (r.lens && preset.convention.reverseZ != r.convention.reverseZ) differs.push_back("reverseZ");
    if (differs.empty())
      result["presets"].push_back(preset.name);
    else
      result["presetsOtherwise"].push_back({{"name", preset.name}, {"differs", differs}});
  }
  if (r.lens) result["projection"] = lensJson(*r.lens);
  if (r.pose) result["pose"] = poseJson(r);
  return result;
}

/// What a reading, or two side by side, leave open.
std::vector<std::string> notesOn(const std::vector<MatrixCamera>& readings) {
  const auto any = [&](const auto& is) { return std::any_of(readings.begin(), readings.end(), is); };
  const auto hasLayout = [&](MatrixLayout layout) { return any([&](const auto& r) { return r.layout == layout; }); };
  const auto hasKind = [&](MatrixKind kind) { return any([&](const auto& r) { return r.kind == kind; }); };
  const auto hasBoth = [&](const auto axis, const auto one, const auto other) {
    const auto has = [&](const auto value) {
      return any([&](const MatrixCamera& r) { return r.lens && r.convention.*axis == value; });
    };
    return has(one) && has(other);
  };
  std::vector<std::string> notes;
  if (hasLayout(MatrixLayout::asWritten))
    notes.emplace_back(
        "As written: for column vectors and stored by rows (row-major), or for row vectors and stored by columns.");
  if (hasLayout(MatrixLayout::transposed))
    notes.emplace_back(
        "Transposed: for row vectors and stored by rows (row-major), or for column vectors and stored by columns.");
  if (hasKind(MatrixKind::view) && hasKind(MatrixKind::worldFromView))
    notes.emplace_back("A view and a camera's pose look alike: the reading whose eye is right tells which it is.");
  if (hasBoth(&Convention::ndcY, NdcY::up, NdcY::down))
    notes.emplace_back(
        "NDC y up and down are both possible, of a view-projection with worlds of either hand; taken the wrong way the "
        "picture is upside down. --read-as picks.");
  if (hasBoth(&Convention::ndcZ, NdcZ::minusOneToOne, NdcZ::zeroToOne))
    notes.emplace_back(
        "A matrix made for NDC z of -1..1 but used with 0..1 has the near and far of the other reading.");
  return notes;
}

OrderedJson calibrationReport(const WrittenMatrix& m) {
  const bool isK = m.numbers.size() == 9;
  std::array<double, 12> p{};
  for (std::size_t i = 0; i < m.numbers.size(); ++i) p[isK ? 4 * (i / 3) + i % 3 : i] = m.numbers[i];
  if (isK && (p[4] != 0 || p[8] != 0 || p[9] != 0))
    throw CameraError("K", "has numbers below its diagonal: it is no K");
  if (isK && !(p[0] * p[10] > 0 && p[5] * p[10] > 0)) throw CameraError("K", "has a focal length that is not above 0");
  const SplitMatrix split = splitMatrix(p);
  OrderedJson report{
      {"name", m.name},          {"kind", isK ? "K" : "P"}, {"fx", rounded(split.fx)},    {"fy", rounded(split.fy)},
      {"cx", rounded(split.cx)}, {"cy", rounded(split.cy)}, {"skew", rounded(split.skew)}};
  if (!isK)
    report.update({{"eye", asJson(rounded(split.eye))},
                   {"right", asJson(rounded(split.columns[0]))},
                   {"down", asJson(rounded(split.columns[1]))},
                   {"forward", asJson(rounded(split.columns[2]))}});
  report["notes"] = {
      "It says neither how large the picture is nor where a pixel's centre lies: in OpenCV at whole numbers "
      "(viewport.pixelCenter 0), elsewhere often at halves."};
  if (hasSkew(split)) report["notes"].push_back("Its skew is not 0, and pixels of a skewed grid are not modelled.");
  return report;
}

// ---- For people

/// The shortest number within the interval, and half of that: "0.1 +- 2.2e-16".
std::string planeText(const OrderedJson& plane) {
  const auto get = [&](const char* name) { return plane[name].get<double>(); };
  const double value = get("value"), low = get("low"), high = get("high");
  if (std::isinf(value)) return "infinite" + (std::isinf(low) ? "" : ", at least " + formatDigits(low, 2));
  int digits = 1;
  while (digits < 17 && !(toDigits(value, digits) >= low && toDigits(value, digits) <= high)) ++digits;
  const std::string text = formatDigits(value, digits);
  if (low == high) return text + " exact";
  return text +
         (std::isinf(high) ? ", at least " + formatDigits(low, 2) : " +- " + formatDigits(high / 2 - low / 2, 2));
}

/// "opengl, unity, metal except reverseZ".
std::string presetText(const OrderedJson& reading) {
  auto names = reading["presets"].get<std::vector<std::string>>();
  for (const OrderedJson& preset : reading["presetsOtherwise"])
    names.push_back(preset["name"].get<std::string>() + " except " +
                    joined(preset["differs"].get<std::vector<std::string>>(), " and "));
  return names.empty() ? "no preset" : joined(names);
}

/// A row for each parameter, by its path; readings that agree on one share it.
OrderedJson parameterRows(const OrderedJson& readings) {
  OrderedJson rows = OrderedJson::array();
  for (const OrderedJson& reading : readings)
    for (const std::string part : {"pose", "projection"}) {
      const OrderedJson members = reading.value(part, OrderedJson::object());
      for (const auto& [name, value] : members.items()) {
        if (value.is_null() || name == "type" || name == "beyondInfinity") continue;
        const std::string path = part + "." + name;
        OrderedJson cell = value.is_object() ? OrderedJson(planeText(value)) : value;
        if (value.is_array() && value.size() == 3 && name != "eye")  // a unit vector, without what is left of 0
          for (OrderedJson& component : cell) component = std::round(component.get<double>() * 1e9) / 1e9 + 0.0;
        auto row = rows.begin(), after = rows.end();
        for (; row != rows.end() && ((*row)["parameter"] != path || (*row)["value"] != cell); ++row)
          if ((*row)["parameter"] == path) after = row + 1;
        if (row == rows.end())
          row =
              rows.insert(after, OrderedJson{{"parameter", path}, {"value", cell}, {"readings", OrderedJson::array()}});
        (*row)["readings"].push_back(reading["reading"]);
      }
    }
  for (OrderedJson& row : rows)
    if (row["readings"].size() == readings.size()) row["readings"] = "";  // all of them
  return rows;
}

}  // namespace

std::vector<MatrixCamera> statedReadings(const WrittenMatrix& written, const InspectQuery& query) {
  std::vector<MatrixCamera> readings;
  for (const MatrixCamera& r : camerasOf(written, query.isFloat).cameras)
    if ((!query.readAs || fits(r, *query.readAs, written.order)) && isStated(r, written, query.stated))
      readings.push_back(r);
  // Of the preset's own world and depth, where there are such.
  const auto isPreset = [&](const MatrixCamera& r) { return isStated(r, written, query.readAs); };
  if (query.readAs && std::any_of(readings.begin(), readings.end(), isPreset))
    std::erase_if(readings, [&](const MatrixCamera& r) { return !isPreset(r); });
  return readings;
}

OrderedJson inspectReport(const WrittenMatrix& written, const InspectQuery& query) {
  if (written.isCalibration()) return calibrationReport(written);
  const MatrixCameras found = camerasOf(written, query.isFloat);
  OrderedJson report{{"name", written.name}, {"readings", OrderedJson::array()}};
  std::vector<MatrixCamera> readings;
  std::vector<std::string> stated;
  for (std::size_t i = 0; i < found.cameras.size(); ++i) {
    const MatrixCamera& r = found.cameras[i];
    if (query.readAs && !fits(r, *query.readAs, written.order)) continue;
    readings.push_back(r);
    report["readings"].push_back(readingJson(i + 1, r, written.order));
    if (query.stated && isStated(r, written, query.stated)) stated.push_back(std::to_string(i + 1));
  }
  if (found.cameras.empty()) report["faults"] = {{"asWritten", found.fault}, {"transposed", found.transposedFault}};
  report["notes"] = notesOn(readings);
  if (query.stated && !readings.empty())
    report["notes"].push_back(stated.empty()
                                  ? "No reading is of the convention that the input states."
                                  : "Of the convention that the input states: reading " + joined(stated, " or ") + ".");
  if (readings.empty() && !found.cameras.empty()) report["notes"].push_back("No reading of it fits --read-as.");
  return report;
}

OrderedJson inspectPage(const OrderedJson& report) {
  if (!report.contains("readings")) return report;
  OrderedJson page{{"name", report["name"]}};
  if (report.contains("faults")) page["nothing known"] = report["faults"];
  OrderedJson lines = OrderedJson::array();
  for (const OrderedJson& r : report["readings"]) {
    OrderedJson line{{"#", r["reading"]}, {"kind", r["kind"]}, {"numbers", r["layout"]}};
    for (const char* axis : {"world", "view", "ndcZ", "reverseZ", "ndcY"})
      line[axis] = r["convention"].value(axis, OrderedJson("-"));
    line["presets"] = presetText(r);
    lines.push_back(line);
  }
  if (!lines.empty()) page.update({{"readings", lines}, {"parameters", parameterRows(report["readings"])}});
  page["notes"] = report["notes"];
  return page;
}

Mat4 converted(const MatrixCamera& r, const Convention& target) {
  if (r.lens && !r.lens->projection) throw CameraError("near", "is not determined by the matrix");
  const Camera camera = cameraIn(target, r.pose, r.lens ? r.lens->projection : std::nullopt);
  if (r.kind == MatrixKind::projection) return matrix(camera, Space::clip, Space::view);
  if (r.kind == MatrixKind::view) return matrix(camera, Space::view, Space::world);
  if (r.kind == MatrixKind::worldFromView) return matrix(camera, Space::world, Space::view);
  Mat4 m = matrix(camera, Space::clip, Space::world);
  for (auto& row : m.m) {  // what is left where the parts of an entry cancel to their own error is 0
    const double size = std::max({std::fabs(row[0]), std::fabs(row[1]), std::fabs(row[2])});
    for (std::size_t j = 0; j < 4; ++j)
      if (std::fabs(row[j]) <= size * (j == 3 ? detail::maxAbs(r.pose->eye()) : 1) * detail::kCancellation) row[j] = 0;
  }
  return m;
}

}  // namespace viewproj::cmd
