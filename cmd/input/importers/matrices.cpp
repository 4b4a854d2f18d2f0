// A camera given by its view and projection matrices, as `viewproj matrix` writes them or a program prints them. The
// convention is the file's, or follows where the matrices fit only one.
#include "viewproj/matrices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "camera/viewport.hpp"
#include "input/camera_fields.hpp"
#include "input/convention_fields.hpp"
#include "input/importers/importer.hpp"
#include "input/kinds/distortion.hpp"
#include "input/readings/readings.hpp"
#include "input/value_form.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

struct Slot {
  MatrixKind kind;
  std::array<std::string_view, 5> names;  ///< of the same; empty: none
};

constexpr Slot kView{MatrixKind::view, {"view", "viewMatrix", "modelview", "modelViewMatrix", "worldToCameraMatrix"}};
constexpr Slot kViewInverse{MatrixKind::worldFromView, {"viewInverse", "viewMatrixInverse", "cameraToWorldMatrix"}};
constexpr Slot kProjection{MatrixKind::projection, {"projection", "projectionMatrix", "proj", "projMatrix"}};
constexpr Slot kViewProjection{MatrixKind::viewProjection, {"viewProjection", "viewProjectionMatrix"}};
constexpr Slot kSlots[] = {kView, kViewInverse, kProjection, kViewProjection};
constexpr std::string_view kEye = "eye";
bool recognises(const nlohmann::json& root) {
  for (const Slot& slot : kSlots)
    for (const std::string_view name : slot.names)
      if (const auto value = root.find(name); !name.empty() && value != root.end() && value->is_array()) return true;
  return false;
}

struct GivenMatrix {
  Slot slot;
  std::string key;
  NumberOrder order = NumberOrder::rows;
  Inspection inspection;
};

CameraAxes cameraAxesOf(ViewAxes view) {
  return view == ViewAxes::RUB ? CameraAxes::RUB : view == ViewAxes::RUF ? CameraAxes::RUF : CameraAxes::RDF;
}

Handedness handednessOf(ViewAxes view) { return view == ViewAxes::RUF ? Handedness::left : Handedness::right; }

/// A product that is a projection too is that of a camera in the origin, along whose axes the world's lie.
bool isInOrigin(const GivenMatrix& m, const Reading& r) {
  return m.slot.kind == MatrixKind::viewProjection && r.kind == MatrixKind::projection;
}

/// Of the readings of a matrix, the one in a convention. Rows count as on paper, sixteen in a row as in memory.
const Reading* readingIn(const GivenMatrix& m, const Convention& c) {
  const bool rowVectors = c.vectors == Vectors::row;
  const bool turned = rowVectors != (m.order == NumberOrder::memory && c.storage == Storage::columnMajor);
  const MatrixLayout layout = turned ? MatrixLayout::transposed : MatrixLayout::asWritten;
  for (const Reading& r : m.inspection.readings) {
    if (r.layout != MatrixLayout::either && r.layout != layout) continue;
    if (r.kind != m.slot.kind && !isInOrigin(m, r)) continue;
    const Convention& own = r.convention;
    if (r.lens && (own.ndcZ != c.ndcZ || own.ndcY != c.ndcY || own.reverseZ != c.reverseZ)) continue;
    if (m.slot.kind != MatrixKind::viewProjection && own.view != c.view) continue;
    if (m.slot.kind != MatrixKind::projection && (isInOrigin(m, r) ? handednessOf(own.view) : own.world) != c.world)
      continue;
    return &r;
  }
  return nullptr;
}

std::optional<Pose> poseOf(const GivenMatrix& m, const Reading& r) {
  const Handedness world = isInOrigin(m, r) ? handednessOf(r.convention.view) : r.convention.world;
  if (isInOrigin(m, r)) return poseFromRotation({}, {}, cameraAxesOf(r.convention.view), world);
  if (r.kind != MatrixKind::viewProjection) return r.pose;
  const Axes& axes = parts(*r.pose).columns;
  return poseFromColumns({axes.right, axes.up, axes.forward}, unroundedEye(parts(*r.pose)), CameraAxes::RUF, world);
}

std::optional<GivenMatrix> readGiven(const ObjectReader& file, const Slot& slot) {
  std::string key;
  for (const std::string_view name : slot.names) {
    if (name.empty() || !file.has(name)) continue;
    if (!key.empty()) file.fail(name, "is another name of " + key + ", which is given too; leave out one of them");
    key = name;
  }
  if (key.empty()) return std::nullopt;
  const auto numbers = flatNumbers(file, key, 16);
  if (!numbers) return std::nullopt;
  const nlohmann::json& value = *file.find(key);
  GivenMatrix given{slot, key, value.front().is_array() ? NumberOrder::rows : NumberOrder::memory, {}};
  if (value.size() != 4 && value.size() != 16) file.fail(key, "expected 16 numbers or 4 rows of 4");
  std::array<double, 16> entries;
  std::copy(numbers->begin(), numbers->end(), entries.begin());
  given.inspection = inspectMatrix(entries);
  for (const Reading& r : given.inspection.readings)
    if (r.kind == slot.kind || isInOrigin(given, r)) return given;
  const std::string name = slot.kind == MatrixKind::projection       ? "projection matrix"
                           : slot.kind == MatrixKind::viewProjection ? "view-projection matrix"
                                                                     : "view matrix";
  if (!given.inspection.readings.empty()) file.fail(key, "is no " + name + "; inspect tells what else it can be");
  file.fail(key, "is no " + name + ": as written " + given.inspection.asWrittenFault + "; transposed " +
                     given.inspection.transposedFault);
}

/// Those that together are a camera: a view and a projection, or else the product, or else what there is.
std::vector<GivenMatrix> readGivens(const ObjectReader& file) {
  auto view = readGiven(file, kView);
  if (!view) view = readGiven(file, kViewInverse);
  auto projection = readGiven(file, kProjection);
  if (!view || !projection)
    if (auto product = readGiven(file, kViewProjection)) return {*product};
  std::vector<GivenMatrix> givens;
  if (view) givens.push_back(*view);
  if (projection) givens.push_back(*projection);
  return givens;
}

struct Candidate {
  std::string name;
  StatedConvention stated;
};

/// Presets, forward and reversed.
std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
  for (const ConventionPreset& preset : conventionPresets())
    all.push_back({std::string(preset.name), {preset.convention, &preset}});
  for (const ConventionPreset& preset : conventionPresets()) {
    Convention other = preset.convention;
    other.reverseZ = !other.reverseZ;
    all.push_back(
        {std::string(preset.name) + " with reverseZ " + (other.reverseZ ? "true" : "false"), {other, &preset}});
  }
  return all;
}

bool fitsAll(const std::vector<GivenMatrix>& givens, const Convention& c) {
  for (const GivenMatrix& given : givens)
    if (!readingIn(given, c)) return false;
  return true;
}

/// A name for each convention that all the matrices fit and that gives a camera of its own.
std::vector<Candidate> fitting(const std::vector<GivenMatrix>& givens) {
  const bool placed = givens.front().slot.kind != MatrixKind::projection;
  const bool hasLens =
      givens.back().slot.kind == MatrixKind::projection || givens.back().slot.kind == MatrixKind::viewProjection;
  const auto sameCamera = [&](const Convention& a, const Convention& b) {
    return (!placed || a.world == b.world) && a.view == b.view &&
           (!hasLens || (a.ndcZ == b.ndcZ && a.reverseZ == b.reverseZ && a.ndcY == b.ndcY));
  };
  std::vector<Candidate> found;
  for (const Candidate& candidate : candidates()) {
    if (!fitsAll(givens, candidate.stated.convention)) continue;
    bool isNew = true;
    for (Candidate& other : found)
      if (sameCamera(other.stated.convention, candidate.stated.convention)) {
        if (isNew) other.name += "/" + candidate.name;
        isNew = false;
      }
    if (isNew) found.push_back(candidate);
  }
  return found;
}

std::string namesOf(const std::vector<Candidate>& found) {
  std::vector<std::string_view> names;
  names.reserve(found.size());
  for (const Candidate& candidate : found) names.push_back(candidate.name);
  return joined(names);
}

StatedConvention conventionOf(const ObjectReader& file, const std::vector<GivenMatrix>& givens,
                              const CameraReading& reading) {
  const std::vector<Candidate> found = fitting(givens);
  if (!reading.readAs.empty() || file.has(field::convention)) {
    const StatedConvention stated = readStated(file, reading.readAs, conventionPresets().front());
    for (const GivenMatrix& given : givens)
      if (!readingIn(given, stated.convention))
        file.fail(given.key, std::string("is not written in the convention ") +
                                 (reading.readAs.empty() ? "that the file states" : reading.readAs) +
                                 (found.empty() ? "; inspect tells its readings" : "; it would fit " + namesOf(found)));
    return stated;
  }
  if (found.empty())
    file.fail(givens.front().key,
              "is written in no convention of a name; inspect tells its readings, and a field "
              "convention or --read-as which one is meant");
  if (found.size() > 1)
    file.fail("states no convention, and its matrices fit " + namesOf(found) +
              ": --read-as NAME or a field convention "
              "says which");
  return found.front().stated;
}

/// The viewport that a matrix from NDC to the screen is of: its pixels' centres are at halves, for what it cannot tell.
Viewport viewportOf(const Mat4& m, const Convention& c) {
  //     | W/2   0     0   x + W/2 |
  // M = | 0   -+H/2   0   y + H/2 |   z: 0..1, or -1..1 with half the range
  //     | 0     0   range   first |
  Viewport v;
  v.width = 2 * m[0][0];
  v.height = 2 * std::fabs(m[1][1]);
  v.x = m[0][3] - v.width / 2;
  v.y = m[1][3] - v.height / 2;
  v.origin = (m[1][1] < 0) == (c.ndcY == NdcY::up) ? Origin::topLeft : Origin::bottomLeft;
  v.depthFirst = c.ndcZ == NdcZ::zeroToOne ? m[2][3] : m[2][3] - m[2][2];
  v.depthSecond = m[2][3] + m[2][2];
  return v;
}

std::optional<ReadViewport> readPicture(const ObjectReader& file, const StatedConvention& stated) {
  const Convention& convention = stated.convention;
  const nlohmann::json* picture = file.find(field::viewport);
  if (!picture || picture->is_object() || (picture->is_array() && coordinatesIn(*picture, 4, 4))) {
    // Where every axis is named and no preset, as `viewproj matrix` writes them, the preset is the one they are of.
    const ConventionPreset* preset = stated.preset;
    if (!stated.isNamed)
      for (const ConventionPreset& other : conventionPresets())
        if (!(preset->convention == convention) && other.convention == convention) preset = &other;
    return importedViewport(file.document(), {.pixelCenter = preset->pixelCenter});
  }
  const auto rows = file.mat4(field::viewport);
  const Viewport v = viewportOf(convention.vectors == Vectors::row ? transposed(*rows) : *rows, convention);
  const Mat4 again = laidOut(screenFromNdc(v, convention), convention);
  double size = 0, off = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      size = std::max(size, std::fabs((*rows)[i][j]));
      off = std::max(off, std::fabs((*rows)[i][j] - again[i][j]));
    }
  if (!(off <= 0x1p-50 * size)) file.fail(field::viewport, "is no viewport matrix of its convention");
  return located(file, {{"viewport.width", "viewport"}, {"viewport.height", "viewport"}}, [&] {
    validate(v);
    return ReadViewport{v, std::nullopt};
  });
}

CameraFile read(const Document& document, const CameraReading& reading) {
  const ObjectReader file(document, document.root(), {});
  const auto distortion = distortionIn(document, {{}, &document.root()});
  refuseDistortion(document, distortion, std::nullopt, reading);
  const std::vector<GivenMatrix> givens = readGivens(file);
  const StatedConvention stated = conventionOf(file, givens, reading);
  const Convention& convention = stated.convention;
  const auto viewport = readPicture(file, stated);
  std::optional<Pose> pose;
  std::optional<Projection> projection;
  for (const GivenMatrix& given : givens) {
    const Reading& r = *readingIn(given, convention);
    if (given.slot.kind != MatrixKind::projection)
      pose = located(file, {{"columns", given.key}, {"position", given.key}}, [&] { return poseOf(given, r); });
    if (!r.projection) continue;
    const ProjectionParts& p = parts(*r.projection);
    projection =
        located(file, {{"near", given.key}, {"far", given.key}, {"right", given.key}, {"top", given.key}}, [&] {
          return p.orthographic ? orthographic(p.left, p.right, p.bottom, p.top, p.near, p.far)
                                : perspectiveWindow(p.left, p.right, p.bottom, p.top, p.near, p.far);
        });
    if (viewport && !reading.allowStretch) requireShape(windowAspect(p), viewport->frame, file);
  }
  // Matrices relative to the eye have it beside them.
  if (const auto eye = file.vec3(kEye); eye && pose) {
    constexpr double kNothing = 1e-6;  // of the eye, as matrices in float have it
    const Vec3 own = pose->eye();
    if (maxAbs(own) > kNothing * maxAbs(*eye))
      document.fail({"eye"},
                    "stands beside matrices that have an eye of their own; it counts beside those that are "
                    "relative to it, whose view has no translation; --set eye=null leaves it out");
    const Axes& columns = parts(*pose).columns;
    pose = located(file, {{"position", "eye"}}, [&] {
      return poseFromColumns({columns.right, columns.up, columns.forward},
                             unroundedEye(parts(*pose)) + toDoubleDouble(*eye), CameraAxes::RUF, convention.world);
    });
  }
  return imported(document, convention, pose, projection, viewport);
}

std::vector<HeldCamera> list(const Document& document) {
  const ObjectReader file(document, document.root(), {});
  std::string names;
  for (const GivenMatrix& given : readGivens(file)) names += (names.empty() ? "" : ", ") + given.key;
  return {{"", "", "0", "", "matrices", names}};
}

CameraReader open(const Document& document) {
  return [&document](std::size_t, const CameraReading& reading) { return read(document, reading); };
}

}  // namespace

const Importer kMatrices{"matrices", "a file of matrices", recognises, list, open};

}  // namespace viewproj::cmd
