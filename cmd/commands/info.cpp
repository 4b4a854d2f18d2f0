// viewproj info: what is in a camera file, or in a text with matrices.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "camera/names.hpp"
#include "camera/plain_camera.hpp"
#include "camera/plain_vectors.hpp"
#include "camera/read_lens.hpp"
#include "camera/read_pose.hpp"
#include "camera/sea_level.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "commands/ground_height.hpp"
#include "commands/outline.hpp"
#include "commands/pasted/camera_of_matrices.hpp"
#include "commands/pasted/report.hpp"
#include "commands/world_options.hpp"
#include "formats/finder/finder.hpp"
#include "formats/open.hpp"
#include "formats/pose_chain.hpp"
#include "numbers/arctangent.hpp"
#include "numbers/vectors.hpp"
#include "output/output_file.hpp"
#include "output/results.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "viewproj/geodesy.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

/// The object, or one of the same members that are all null.
OrderedJson ifThere(bool isThere, OrderedJson object) {
  if (!isThere)
    for (OrderedJson& value : object) value = nullptr;
  return object;
}

OrderedJson poseOf(const CameraFile& file) {
  const Pose pose = file.pose.value_or(lookAlong({}, {0, 0, -1}, {0, 1, 0}, Handedness::right));
  const Geodetic place = ecefToGeodetic(pose.eye());
  const HeadingPitchRoll turn = headingPitchRollOf(plainPose(pose), file.worldIsEcef);
  OrderedJson members = ifThere(file.pose.has_value(), {{"eye", asJson(pose.eye())},
                                                        {"right", asJson(pose.right())},
                                                        {"up", asJson(pose.up())},
                                                        {"forward", asJson(pose.forward())}});
  members.update(ifThere(file.pose && file.worldIsEcef,
                         {{"place", {{"lat", place.lat}, {"lon", place.lon}, {"height", place.height}}}}));
  members.update(ifThere(file.pose && (file.worldIsEcef || file.worldIsEnu),
                         {{"heading", std::fmod(certainDegrees(turn.heading.value) + 360, 360)},
                          {"pitch", certainDegrees(turn.pitch.value)},
                          {"roll", certainDegrees(turn.roll.value)}}));
  return members;
}

OrderedJson projectionOf(const Projection& p) {
  return {{"type", p.isOrthographic() ? "orthographic" : "perspective"},
          {"fovX", p.fov(Fov::horizontal)},
          {"fovY", p.fov(Fov::vertical)},
          {"fovDiagonal", p.fov(Fov::diagonal)},
          {"left", p.left()},
          {"right", p.right()},
          {"bottom", p.bottom()},
          {"top", p.top()},
          {"fx", nullptr},
          {"fy", nullptr},
          {"cx", nullptr},
          {"cy", nullptr},
          {"aspect", p.aspect()},
          {"near", hasDepth(p) ? OrderedJson(p.zNear()) : OrderedJson()},
          {"far", p.zFar()}};
}

OrderedJson pictureOf(const Viewport& v) {
  return {{"width", v.width},
          {"height", v.height},
          {"x", v.x},
          {"y", v.y},
          {"depthRange", {v.depthFirst, v.depthSecond}},
          {"origin", nameOf(kOriginNames, v.origin)},
          {"pixelCenter", v.pixelCenter}};
}

/// The angle to the axis that the lens sees at a pixel; NaN for none.
double degreesSeenAt(const Camera& camera, const Lens& lens, const Vec2& pixel) {
  const Intrinsics k = camera.intrinsics();
  const double down = camera.viewport().origin == Origin::topLeft ? 1 : -1;
  const Vec3 d = undistorted(lens, {(pixel.x - k.cx) / k.fx, down * (pixel.y - k.cy) / k.fy});
  const detail::DoubleDouble aside = detail::sqrt(detail::twoProd(d.x, d.x) + detail::twoProd(d.y, d.y));
  return (detail::angleOf(aside, detail::DoubleDouble(d.z)) * detail::kDegreesPerRadian).hi;
}

/// At the picture's edges, through the principal point.
OrderedJson seenOf(const Camera& camera, const Lens& lens) {
  const Intrinsics k = camera.intrinsics();
  const auto [first, last] = pictureCorners(camera.viewport());
  const bool fromTop = camera.viewport().origin == Origin::topLeft;
  return {{"left", degreesSeenAt(camera, lens, {first.x, k.cy})},
          {"right", degreesSeenAt(camera, lens, {last.x, k.cy})},
          {"top", degreesSeenAt(camera, lens, {k.cx, fromTop ? first.y : last.y})},
          {"bottom", degreesSeenAt(camera, lens, {k.cx, fromTop ? last.y : first.y})}};
}

OrderedJson distortionOf(const Camera& camera, const Lens& lens, bool hasPicture) {
  const LensModel model = lens.model();
  const bool isFisheye = model == LensModel::fisheye, isBrown = model == LensModel::brown || model == LensModel::omni;
  const auto k = lens.k();
  const auto ofModels = [&](std::initializer_list<LensModel> models, double value) {
    return std::find(models.begin(), models.end(), model) == models.end() ? OrderedJson() : OrderedJson(value);
  };
  OrderedJson distortion{{"model", nameOf(model)},
                         {"k", isFisheye ? OrderedJson(std::vector(k.begin(), k.begin() + 4))
                               : isBrown ? OrderedJson(k)
                                         : OrderedJson()},
                         {"p", isBrown ? OrderedJson(lens.p()) : OrderedJson()},
                         {"xi", ofModels({LensModel::doubleSphere, LensModel::omni}, lens.xi())},
                         {"alpha", ofModels({LensModel::unified, LensModel::doubleSphere}, lens.alpha())},
                         {"beta", ofModels({LensModel::unified}, lens.beta())},
                         {"omega", ofModels({LensModel::fov}, lens.omega())},
                         {"limitDegrees", lens.limitDegrees()},
                         {"limitCause", nullptr},
                         {"seen", hasPicture ? seenOf(camera, lens) : OrderedJson()},
                         {"largestShift", hasPicture ? OrderedJson(lensShift(camera).largest) : OrderedJson()}};
  constexpr std::pair<LimitCause, const char*> kCauses[] = {
      {LimitCause::fold, "fold"}, {LimitCause::pole, "pole"}, {LimitCause::stated, "file"}};
  for (const auto& [cause, name] : kCauses)
    if (lens.limitCause() == cause) distortion["limitCause"] = name;
  return distortion;
}

/// Of a camera without a picture, one pixel for a unit of height; without a pose, at the origin. What does not depend
/// on that is told of it.
std::optional<Camera> standIn(const CameraFile& file) {
  if (!file.projection) return std::nullopt;
  const Pose origin = lookAlong({}, {0, 0, -1}, {0, 1, 0}, file.convention.world);
  return makeCamera(file.pose.value_or(origin), *file.projection,
                    file.viewport.value_or(Viewport{.width = file.projection->aspect(), .height = 1}), file.convention);
}

/// Bottom left, bottom right, top right, top left, at a distance along the view.
OrderedJson cornersAt(const Camera& camera, double distance) {
  const auto [first, last] = pictureCorners(camera.viewport());
  const bool fromTop = camera.viewport().origin == Origin::topLeft;
  const double bottom = fromTop ? last.y : first.y, top = fromTop ? first.y : last.y;
  OrderedJson corners = OrderedJson::array();
  for (const Vec2& pixel : {Vec2{first.x, bottom}, Vec2{last.x, bottom}, Vec2{last.x, top}, Vec2{first.x, top}})
    corners.push_back(asJson(screenToWorldAtDistance(camera, pixel, distance).position));
  return corners;
}

/// One camera, whole or in part: every member is always there, null for what the camera has not. Planes, corners and
/// fx ... cy are those of the lens without distortion.
OrderedJson infoReport(const CameraFile& file, const std::string& name, std::span<const double> distances) {
  OrderedJson info{{"name", name.empty() ? OrderedJson() : OrderedJson(name)}, {"convention", asJson(file.convention)}};
  info.update(poseOf(file));
  info["projection"] =
      ifThere(file.projection.has_value(), projectionOf(file.projection.value_or(perspective(60, 1, 1))));
  info["viewport"] = ifThere(file.viewport.has_value(), pictureOf(file.viewport.value_or(Viewport{})));
  info["distortion"] = nullptr;
  for (const SideName& side : kSides) info["planes"][side.name] = nullptr;
  info["corners"] = {{"near", nullptr}, {"far", nullptr}};
  info["pixelSizes"] = OrderedJson::array();
  const std::optional<Camera> camera = standIn(file);
  if (camera && file.lens) {
    const Camera through = withLens(*camera, *file.lens);
    if (const auto lens = lensOf(through)) info["distortion"] = distortionOf(through, *lens, file.viewport.has_value());
  }
  if (camera && file.pose) {
    const Frustum frustum = viewFrustum(*camera);
    for (const FrustumPlane& plane : frustum.planes()) info["planes"][sideName(plane.side)] = asJson(plane.equation);
    if (hasDepth(camera->projection())) info["corners"]["near"] = cornersAt(*camera, camera->projection().zNear());
    if (std::isfinite(camera->projection().zFar()))
      info["corners"]["far"] = cornersAt(*camera, camera->projection().zFar());
  }
  if (camera && file.viewport) {
    const Intrinsics k = camera->intrinsics();
    info["projection"].update({{"fx", k.fx}, {"fy", k.fy}, {"cx", k.cx}, {"cy", k.cy}});
  }
  for (const double distance : distances) {
    const Vec2 size = camera && file.viewport ? pixelSize(*camera, distance) : Vec2{NAN, NAN};
    info["pixelSizes"].push_back({{"distance", distance}, {"across", size.x}, {"down", size.y}});
  }
  return info;
}

/// A row of a list of cameras. The document is normalized. What its projection lacks, such as the size of a picture, is
/// told where the camera is used. Throws InputError, and CameraError naming a field of the pose.
OrderedJson cameraRow(const std::string& name, const Document& document, bool mayLackPose, const ReadOptions& reading,
                      const NameRow<EulerOrder>* angles) {
  const FieldValues values = readValues(document);
  const auto valueOr = [&](const char* path, const OrderedJson& otherwise) {
    const Json* const value = valueAt(*document.root, path);
    return value && !value->is_null() ? OrderedJson(*value) : otherwise;
  };
  OrderedJson size = valueOr("projection.pixels", nullptr);
  if (const OrderedJson width = valueOr("viewport.width", nullptr); !width.is_null())
    size = {width, valueOr("viewport.height", nullptr)};
  const DocumentConvention convention = readConvention(values);
  const std::optional<Pose> pose = readPose(values, convention);
  OrderedJson row{{"name", name},    {"type", valueOr("projection.type", nullptr)},
                  {"size", size},    {"distortion", valueOr("distortion.model", nullptr)},
                  {"fovX", nullptr}, {"fovY", nullptr}};
  for (const char* number : {"fx", "fy", "cx", "cy"})
    row[number] = valueOr((std::string("projection.") + number).c_str(), nullptr);
  const bool hasItsPose = pose.has_value() && !(mayLackPose && !hasPose(*document.root));
  OrderedJson eye{{"eye", hasItsPose ? asJson(pose->eye()) : OrderedJson()}};
  const OrderedJson forward = hasItsPose ? asJson(pose->forward()) : OrderedJson();
  try {
    const CameraFile file = readCamera(copied(document), reading);
    const auto states = [&](std::string_view fields) {
      const std::vector<std::string_view> all = wordsIn(fields);
      return std::any_of(all.begin(), all.end(), [&](std::string_view field) {
        return !valueOr(("projection." + std::string(field)).c_str(), nullptr).is_null();
      });
    };
    // One angle alone, or focal lengths in pixels, want the picture's size for the other.
    const bool isShaped = file.viewport || states("aspect nearWidth") ||
                          (states("sensorWidth") && states("sensorHeight")) ||
                          (row["type"] != "intrinsics" && row["type"] != "perspective");
    if (const std::optional<Camera> camera = standIn(file)) {
      const Projection p = camera->projection();
      if (isShaped || states("fovX sensorWidth")) row["fovX"] = p.fov(Fov::horizontal);
      if (isShaped || states("fovY sensorHeight")) row["fovY"] = p.fov(Fov::vertical);
      const Intrinsics k = camera->intrinsics();
      if (file.viewport) row.update({{"fx", k.fx}, {"fy", k.fy}, {"cx", k.cx}, {"cy", k.cy}});
    }
    if (file.worldIsEcef && hasItsPose) {
      const Geodetic place = ecefToGeodetic(pose->eye());
      eye = {{"place", {{"lat", place.lat}, {"lon", place.lon}, {"height", place.height}}}};
    }
  } catch (const InputError&) {
  } catch (const CameraError&) {
  }
  row.update(eye);
  row["forward"] = forward;
  row["pose"] = hasItsPose;
  if (angles) row["angles"] = anglesOf(*angles, values, *convention.preset, pose);
  return row;
}

/// Of the ground of a height: how far below level it is at the camera's heading, in degrees, and how far away; and its
/// pixels. Null from below the ground.
OrderedJson horizonOf(const CameraFile& file, const GroundHeight& typed) {
  const double height = typed.of(file.worldIsEcef, &file);
  if (!file.pose) return nullptr;
  const Vec3 eye = file.pose->eye();
  if (!((file.worldIsEcef ? ecefToGeodetic(eye).height : eye.z) > height)) return nullptr;
  const auto ground = groundOf(typed.surface("", file.worldIsEcef, &file), eye);
  const double degrees = headingPitchRollOf(plainPose(*file.pose), file.worldIsEcef).heading.value;
  const double heading = degrees * std::numbers::pi / 180;
  const auto limit = ground->farthest(heading, std::numeric_limits<double>::infinity());
  OrderedJson pixels = OrderedJson::array({nullptr, nullptr, nullptr});
  if (file.projection && file.viewport) {
    const auto found = horizonPixels(makeCamera(file), *ground, heading);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i]) pixels[i] = asJson(*found[i]);
  }
  OrderedJson horizon{{"height", height}};
  if (file.worldIsEcef && hasGeoid()) {
    const Geodetic place = ecefToGeodetic(eye);
    horizon["altitude"] = height - seaLevelAt(place.lat, place.lon);
  }
  horizon["dip"] = 0 - limit->elevation * 180 / std::numbers::pi;
  horizon["distance"] = limit->distance;
  horizon["pixels"] = pixels;
  return horizon;
}

struct InfoOptions {
  CameraOptions camera;
  GroundHeight height;
  std::optional<std::vector<double>> at;
  std::vector<ReadingKind> which;
  const NameRow<EulerOrder>* angles = nullptr;
  ReportOptions report;
};

/// Where cameras stand together: the middle and the box of their eyes, and of two how far they are apart. Null for one.
OrderedJson eyesOf(const OrderedJson& rows) {
  std::vector<Vec3> eyes;
  for (const OrderedJson& row : rows)
    if (const auto eye = row.find("eye"); eye != row.end() && eye->is_array())
      eyes.push_back({(*eye)[0].get<double>(), (*eye)[1].get<double>(), (*eye)[2].get<double>()});
  if (eyes.size() < 2) return nullptr;
  Vec3 mean{}, low = eyes.front(), high = eyes.front();
  for (const Vec3& eye : eyes)
    for (std::size_t i = 0; i < 3; ++i) {
      mean[i] += eye[i] / static_cast<double>(eyes.size());
      low[i] = std::min(low[i], eye[i]);
      high[i] = std::max(high[i], eye[i]);
    }
  if (low == high) return nullptr;
  OrderedJson all{{"count", eyes.size()}, {"mean", asJson(mean)}, {"min", asJson(low)}, {"max", asJson(high)}};
  if (eyes.size() == 2) all["distance"] = apart(eyes[0], eyes[1]);
  return all;
}

/// A camera that cannot be read has a message instead of a row.
int runList(const InfoOptions& o, const CameraSet& cameras, const std::optional<std::string>& pick) {
  OrderedJson rows = OrderedJson::array();
  int status = 0;
  std::string last;  // of one fault of the file for every camera
  const auto tell = [&](const std::string& message) {
    if (message != last) complain(message);
    last = message;
    status = 1;
  };
  for (const std::size_t i : cameras.chooseAll(pick)) {
    const std::string name = cameras.pickOf(i);
    try {
      rows.push_back(cameraRow(name, cameras.document(i), cameras.mayLackPose(i), o.camera.reading(false), o.angles));
    } catch (const CameraError& e) {
      tell(name + ": " + e.what());
    } catch (const InputError& e) {
      tell(e.what());
    }
  }
  OrderedJson report{{"cameras", rows}};
  if (OrderedJson eyes = eyesOf(rows); !eyes.is_null()) report["eyes"] = std::move(eyes);
  if (!rows.empty() || o.report.form() == ReportForm::json) o.report.write(report, "cameras");
  return status;
}

int writeProposal(const InfoOptions& o, const Proposal& proposal) {
  const bool isTable = o.report.form() == ReportForm::table;
  writeOutput(isTable ? textOf(proposal) : jsonOf(proposal).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return 1;
}

/// options: those that make a camera of the file.
void writeCommand(const InfoOptions& o, const std::string& options) {
  if (o.report.form() == ReportForm::table && !options.empty())
    writeOutput("\nas a camera:\nviewproj project --point X,Y,Z -c " + inShell(o.camera.file().value_or("-")) +
                options + "\n");
}

/// What the matrices of a text can be. otherwise: the message where there are none. Matrix by matrix, since the
/// readings of one take many times the memory of its numbers.
int runMatrices(const InfoOptions& o, const std::string& text, const std::string& otherwise, bool isTree) {
  const MatrixQuestion question{o.camera.readAs(), o.which};
  const std::vector<ReadMatrix> matrices =
      readMatrices(text, shownName(o.camera.file().value_or("-")), otherwise, question);
  const auto isTurn = [](const Reading& r) {
    return r.kind == ReadingKind::rotation || r.kind == ReadingKind::view || r.kind == ReadingKind::pose;
  };
  if (o.angles && std::none_of(matrices.begin(), matrices.end(), [&](const ReadMatrix& m) {
        return std::any_of(m.found.readings.begin(), m.found.readings.end(), isTurn);
      }))
    throw UsageError("--angles needs a rotation, a view or a pose, and no matrix here can be one");
  const bool isJson = o.report.form() == ReportForm::json;
  if (isJson) writeOutput("{\"matrices\": [");
  OrderedJson rows = OrderedJson::array();
  bool allFit = true;
  for (std::size_t i = 0; i < matrices.size(); ++i) {
    allFit = allFit && !matrices[i].found.readings.empty();
    if (isJson)
      writeOutput((i > 0 ? ",\n  " : "\n  ") + jsonText(matrixReport(matrices[i], o.angles), o.report.digits(), 1));
    else if (o.report.form() == ReportForm::table)
      writeOutput((i > 0 ? "\n" : "") +
                  tableText(matrixPage(matrices[i], o.angles, i + 1, matrices.size()), o.report.digits()));
    else
      rows.push_back(matrixReport(matrices[i], o.angles));
  }
  if (isJson) writeOutput("\n]}\n");
  if (!rows.empty()) writeOutput(csvText(rows, o.report.digits()));
  writeCommand(o, optionsOf(matrices, text, isTree));
  return allFit ? 0 : 1;
}

/// Where a file of a known kind needs no more than the size of its picture to be a camera: how to give that, and its
/// eye.
void writeWhole(const InfoOptions& o, const std::string& text) try {
  const auto [cameras, pick] = o.camera.readAll();
  const CameraFile file = o.camera.readOne(*cameras, cameras->choose(pick), false);
  if (!file.projection || file.viewport || o.report.form() != ReportForm::table) return;
  const FieldValues values = readValues(file.document);
  const Vec2 middle{values.valueOr("projection.cx", 0.0), values.valueOr("projection.cy", 0.0)};
  writeCommand(o, viewportOption(sizeIn(text, middle, 0)));
  if (file.pose) writeOutput("\n" + tableText({{"eye", asJson(file.pose->eye())}}, o.report.digits()));
} catch (const InputError&) {  // NOLINT: it lacks more
}

int runCamera(const InfoOptions& o) {
  const auto [cameras, pick] = o.camera.readAll();
  if (cameras->chooseAll(pick).size() > 1) {
    if (o.height.isTyped()) throw UsageError("--height tells the horizon of one camera; FILE#NAME picks it");
    return runList(o, *cameras, pick);
  }
  const std::size_t which = cameras->chooseAll(pick).front();
  const CameraFile file = o.camera.readOne(*cameras, which);
  std::vector<double> distances{1, 10, 100};
  if (file.targetDistance) distances.push_back(*file.targetDistance);
  if (o.at) distances = *o.at;
  for (const double distance : distances)
    if (!(distance > 0)) throw UsageError("--at " + formatNumber(distance) + ": expected a distance above 0");
  OrderedJson info = infoReport(file, cameras->nameOf(which), distances);
  if (o.angles) info["angles"] = anglesOf(*o.angles, readValues(file.document), *file.preset, file.pose);
  if (o.height.isTyped()) info["horizon"] = horizonOf(file, o.height);
  if (o.height.isTyped() && !file.worldIsEcef && !info["horizon"].is_null())
    note("the horizon is of a flat world; with lat, lon in place of x, y it is the Earth's");
  if (info["heading"].is_number())  // not 360, also where digits are left out
    info["heading"] = std::fmod(toDigits(info["heading"].get<double>(), static_cast<int>(o.report.digits())), 360);
  o.report.write(info);
  return 0;
}

/// A file that no format claims: what --parts could make of it, if that is a lens with something beside it, else what
/// its matrices can be.
int runUnknown(const InfoOptions& o, const UnknownFile& unknown) {
  const Proposal proposal = proposeParts(unknown.file);
  const auto isCamera = [](const ProposedLine& line) {
    return line.hasLens && std::count(line.parts.begin(), line.parts.end(), '=') > 1;
  };
  const bool isForCamera = o.camera.changesCamera() || o.at || o.height.isTyped();
  const bool hasCamera = std::any_of(proposal.lines.begin(), proposal.lines.end(), isCamera);
  const bool isFaulty = !unknown.file.fault.empty();
  if (isForCamera && proposal.lines.empty() && isFaulty) throw InputError(unknown.file.fault);
  if (hasCamera && unknown.isOurs) complain(unknown.what());
  const std::vector<PastedMatrix> matrices = findMatrices(unknown.text).matrices;
  // A K needs the size of the picture to be a camera, and can be explained without.
  const bool isK = hasCamera && !isForCamera && matrices.size() == 1 && o.report.form() == ReportForm::table &&
                   proposal.lines.front().parts.find(", size=") == std::string::npos;
  if (isK) {
    const int status = runMatrices(o, unknown.text, "", true);
    writeOutput("\nwith --viewport WIDTHxHEIGHT it is a camera:\n" + textOf(proposal));
    return status;
  }
  if (hasCamera || (isForCamera && !unknown.isOurs)) return writeProposal(o, proposal);
  if (unknown.isOurs) throw InputError(unknown.what());
  const bool areNamed = std::any_of(proposal.numbers.begin(), proposal.numbers.end(),
                                    [](const std::string& path) { return !path.starts_with('#'); });
  const bool isNothing = proposal.lines.empty() && (isFaulty || !areNamed) && unknown.file.isPlainText;
  if (!isNothing && matrices.empty()) return writeProposal(o, proposal);
  const int status = runMatrices(
      o, unknown.text,
      isFaulty ? unknown.file.fault
               : unknown.file.name +
                     ": is not a camera file of a known kind, and no numbers in it look like a camera or a matrix; "
                     "viewproj help formats lists the kinds",
      !unknown.file.isPlainText);
  noteOthers(unknown.file, matrices);
  return status;
}

/// A camera file, else what a file that no format claims may be, else matrices, else what is wrong with the file.
int runInfo(const InfoOptions& o) {
  constexpr std::size_t kMostBytes = 1 << 20;
  if (!o.which.empty()) {
    if (o.camera.changesCamera() || o.at || o.height.isTyped())
      throw UsageError("--which is for matrices, and the other options for a camera");
    const auto name = o.camera.file();
    if (!name) throw UsageError("--which needs a FILE with matrices");
    return runMatrices(o, readWholeFile(*name, kMostBytes), shownName(*name) + ": has no matrix", true);
  }
  try {
    return runCamera(o);
  } catch (const UnknownFile& unknown) {
    return runUnknown(o, unknown);
  } catch (const AmbiguousMatrix& e) {
    note(e.what());
    return runMatrices(o, e.text, e.what(), false);
  } catch (const UnknownFormat& e) {
    if (e.text.empty() || o.camera.changesCamera() || o.at || o.height.isTyped()) throw;
    const int status = runMatrices(o, e.text, e.what(), true);
    writeWhole(o, e.text);
    return status;
  }
}

}  // namespace

Action declareInfo(CLI::App& app) {
  const auto o = std::make_shared<InfoOptions>();
  describe(app,
           "What is in a file: of one camera its eye, axes, fields of view, window, focal length, near, far, viewport, "
           "convention, lens, planes and corners of the view, and pixel size; of several a table; of matrices, pasted "
           "from code or logs, what each can be, the likeliest first. `seen` has distortion; other angles (degrees) "
           "and edges (x/z, y/z: glFrustum's over near; orthographic: lengths) have none.",
           "Examples:\n"
           "  viewproj info --position 3,2,5 --target 0,0,0 --fov-y 60 --viewport 9x6\n"
           "  echo 'view: [0 0 1 3; 1 0 0 4; 0 1 0 5; 0 0 0 1]' | viewproj info\n"
           "  viewproj info --fx 800 --fy 800 --cx 320 --cy 240 --viewport 640x480 --to json");
  addValue(app, "--at", "DISTANCES", o->at, numberList("distances separated by commas, as in 1,10,100"),
           "Distances of pixel sizes (default: 1,10,100,target)");
  o->height.add(app, "Tell the horizon of this height too, or of z = H");
  addOption(
      app, "--which", "KINDS",
      [o](const std::string& option, const std::string& text) {
        o->which = chooseSeveral(option, text, rowsOf(kReadingKinds)).named;
        if (o->which.empty())
          for (const auto& [name, kind] : kReadingKinds) o->which.push_back(kind);
      },
      withNames("Read matrices, as these kinds alone", known(rowsOf(kReadingKinds)), "a camera, if there is one"));
  addAngles(app, o->angles, "Tell the pose last, as turns about turned axes");
  o->report.add(app, 9);
  o->camera.showMatrices();
  o->camera.takeAll();
  o->camera.addFiles(app);
  o->camera.add(app);
  o->camera.addReversed(app);
  return [o] { return runInfo(*o); };
}

}  // namespace viewproj::cmd
