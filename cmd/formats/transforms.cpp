// transforms.json of NeRFs. Sources: nerfstudio, "Data conventions" and its nerfstudio dataparser; instant-ngp, "NeRF
// dataset tips".
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/writer.hpp"
#include "numbers/degrees.hpp"
#include "numbers/vectors.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace transforms {

/// A member of a frame stands for the same member of the file.
struct Frame {
  Node file, frame;

  std::optional<Node> find(std::string_view key) const {
    const auto inFrame = frame.find(key), inFile = file.find(key);
    // Programs do not agree on which of the two counts.
    if (inFrame && inFile && inFrame->json() != inFile->json())
      inFrame->fail("differs from " + std::string(key) + " beside frames; keep one");
    return inFrame ? inFrame : inFile;
  }
  std::optional<double> number(std::string_view key) const {
    const auto value = find(key);
    return value ? std::optional(value->number()) : std::nullopt;
  }
};

void readLens(const Frame& at, Json& camera) {
  const auto model = at.find("camera_model"), flag = at.find("is_fisheye"), all = at.find("distortion_params");
  std::string name = model ? model->text() : "";
  if (flag && flag->flag()) name = "OPENCV_FISHEYE";
  const bool isFisheye = name.ends_with("FISHEYE");
  const char* const order[] = {"k1", "k2", "k3", "k4", "p1", "p2"};
  const std::vector<double> c = all ? all->numbers() : std::vector<double>{};
  if (all && c.size() != std::size(order))
    all->fail("expected the 6 numbers k1 k2 k3 k4 p1 p2, got " + std::to_string(c.size()));
  NamedNumbers named;
  for (std::size_t i = 0; i < std::size(order); ++i) {
    const auto value = at.number(order[i]);
    if (all && value && *value != c[i]) at.find(order[i])->fail("differs from distortion_params");
    named.emplace_back(order[i], all ? c[i] : value.value_or(0));
  }
  const Node& where = all ? *all : at.frame;
  if (!isFisheye && named[3].second != 0) where.fail("k4 is not supported: programs do not agree on what it means");
  setLens(camera, where, name.empty() ? "opencv" : name, named);
}

/// The names for one axis of the picture.
struct Axis {
  const char *focal, *center, *size, *angle, *fov;
};
constexpr Axis kX{"fl_x", "cx", "w", "camera_angle_x", "fovX"}, kY{"fl_y", "cy", "h", "camera_angle_y", "fovY"};

double halfSize(const Frame& at, const Axis& axis) {
  const auto size = at.number(axis.size);
  if (!size) at.frame.fail(std::string("needs ") + axis.size + ", or " + axis.focal + " and " + axis.center);
  return *size / 2;
}

std::optional<double> focalLength(const Frame& at, const Axis& axis) {
  const auto focal = at.number(axis.focal), angle = at.number(axis.angle), size = at.number(axis.size);
  if (focal && angle && size) {
    const double stated = *size / 2 / std::tan(*angle / 2);
    constexpr double kTolerance = 0.01;
    if (!(std::fabs(stated - *focal) <= kTolerance * *focal))
      at.find(axis.angle)
          ->fail(std::string("contradicts ") + axis.focal + ": it means " + formatDigits(stated, 6) + " pixels");
  }
  if (focal) return focal;
  if (!angle) return std::nullopt;
  return rounded(DoubleDouble(halfSize(at, axis)) / tanHalfRadians(*angle));
}

Json lensOfFrame(const Frame& at) {
  Json lens;
  for (const char* key : {"near", "far"})
    if (const auto distance = at.number(key)) lens[key] = *distance;
  const auto angleX = at.number(kX.angle), angleY = at.number(kY.angle), w = at.number("w"), h = at.number("h");
  const bool isInPixels = at.find("fl_x") || at.find("fl_y") || at.find("cx") || at.find("cy");
  if (!isInPixels && angleX.has_value() != angleY.has_value()) {
    lens["type"] = "perspective";
    // Stays in radians, to keep all digits.
    lens[angleX ? kX.fov : kY.fov] = formatNumber(angleX ? *angleX : *angleY) + "rad";
    if (w && h) lens["aspect"] = formatNumber(*w) + "/" + formatNumber(*h);
    return lens;
  }
  const auto fx = focalLength(at, kX), fy = focalLength(at, kY), cx = at.number(kX.center), cy = at.number(kY.center);
  if (!fx && !fy) at.frame.fail("needs fl_x or camera_angle_x, in the frame or beside frames");
  lens["type"] = "intrinsics";
  lens["fx"] = fx ? *fx : *fy;
  lens["fy"] = fy ? *fy : *fx;
  lens["cx"] = cx ? *cx : halfSize(at, kX);
  lens["cy"] = cy ? *cy : halfSize(at, kY);
  if (w && h) lens["pixels"] = {*w, *h};
  return lens;
}

Json documentOf(const Frame& at) {
  for (const Node& node : {at.file, at.frame}) {
    refuse(node, "rolling_shutter transform_matrix_start transform_matrix_end",
           "is of a camera that moves during the picture, which is not supported");
    refuse(node, "equirectangular latlong orthographic ftheta_p0 ftheta_p1 ftheta_p2 ftheta_p3 ftheta_p4",
           "is of a lens that is not supported");
  }
  Json document{{"convention", "opengl"},
                {"worldFromCamera", at.frame.require("transform_matrix").mat4().m},
                {"projection", lensOfFrame(at)}};
  readLens(at, document);
  const auto w = at.number("w"), h = at.number("h");
  if (w && h) document["viewport"] = {{"width", *w}, {"height", *h}};
  return document;
}

/// "x,-z,y" of a world that was turned by rows of 0, 1 and -1: what turns it back.
std::optional<std::string> mapBack(const Node& applied) {
  const std::vector<double> m =
      applied.json().is_array() ? numbersIn(applied.json()).value_or(std::vector<double>()) : std::vector<double>();
  if (m.size() < 12) return std::nullopt;
  std::string map;
  bool moves = false;
  for (std::size_t j = 0; j < 3; ++j) {
    std::string axis;
    for (std::size_t i = 0; i < 3; ++i) {
      const double entry = m[4 * i + j];
      if (entry == 0) continue;
      if (std::fabs(entry) != 1 || !axis.empty()) return std::nullopt;
      axis = (entry < 0 ? "-" : "") + std::string(1, "xyz"[i]);
    }
    moves = moves || axis != std::string(1, "xyz"[j]);
    map += (j == 0 ? "" : ",") + axis;
  }
  return moves && m[3] == 0 && m[7] == 0 && m[11] == 0 ? std::optional(map) : std::nullopt;
}

Import open(const Node& root) {
  const Node frames = root.require("frames");
  Import result;
  result.apart = {&frames.json()};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Node frame = frames[i];
    const std::string path = textAt(frame, "file_path");
    result.add(
        path, path.starts_with("./") ? path.substr(2) : "",
        [root, frame] {
          return documentOf({root, frame});
        },
        frame);
  }
  if (const auto applied = root.find("applied_transform")) {
    const auto map = mapBack(*applied);
    result.notes.push_back("poses are in the world that applied_transform made" +
                           (map ? "; convert --map " + *map + " turns them back" : std::string()));
  }
  return result;
}

std::string_view modelOf(const WrittenCamera& camera) {
  const std::optional<Lens>& lens = camera.file.lens;
  return !lens ? "PINHOLE" : lens->model() == LensModel::fisheye ? "OPENCV_FISHEYE" : "OPENCV";
}

/// The other members of a lens and its picture.
std::string lensMembers(const WrittenCamera& camera, std::string_view between) {
  const Intrinsics k = camera.intrinsics(0.5);
  const std::optional<Lens>& lens = camera.file.lens;
  const bool isFisheye = lens && lens->model() == LensModel::fisheye;
  JsonObject out;
  const auto add = [&](std::string_view name, double value) { out.addText(name, jsonOf(value), between); };
  // The original NeRF and 3D Gaussian splatting read these alone.
  add("camera_angle_x", 2 * std::atan(camera.width() / 2 / k.fx));
  add("camera_angle_y", 2 * std::atan(camera.height() / 2 / k.fy));
  add("fl_x", k.fx);
  add("fl_y", k.fy);
  add("cx", k.cx);
  add("cy", k.cy);
  add("w", camera.width());
  add("h", camera.height());
  if (lens) {
    const std::vector<double> c = coefficientsOf(*lens);
    constexpr const char *kBrown[] = {"k1", "k2", "p1", "p2", "k3"}, *kFisheye[] = {"k1", "k2", "k3", "k4"};
    for (std::size_t i = 0; i < c.size(); ++i) add(isFisheye ? kFisheye[i] : kBrown[i], c[i]);
  }
  return out.members();
}

}  // namespace transforms

extern const Format kTransforms{
    "transforms", "a transforms.json (NeRF)", "frames.*.transform_matrix|frames.*.transform_matrix_start !asset",
    transforms::open,
    "file_path sharpness colmap_im_id *_path aabb_scale scale aabb from_na applied_transform applied_scale "
    "ply_file_path orientation_override *_filenames n_frames idx time rotation fovx fovy fov_x fov_y "
    "fisheye_crop_radius offset n_extra_learnable_dims depth_unit_scale_factor integer_depth_scale "
    "enable_depth_loading render_aabb up white_transparent black_transparent up_vector"};

std::vector<WrittenFile> writeTransforms(std::span<const WrittenCamera> cameras, std::string_view) {
  constexpr std::string_view kLine = ",\n  ";
  // Programs do not agree on a member that stands in the file and in a frame: all of a lens stands in one place.
  const std::string shared = transforms::lensMembers(cameras.front(), kLine);
  const bool isShared = std::all_of(cameras.begin(), cameras.end(), [&](const WrittenCamera& camera) {
    return transforms::lensMembers(camera, kLine) == shared;
  });
  // Nerfstudio reads the model beside frames alone.
  const std::string_view model = transforms::modelOf(cameras.front());
  const bool hasOneModel = std::all_of(cameras.begin(), cameras.end(), [&](const WrittenCamera& camera) {
    return transforms::modelOf(camera) == model;
  });
  const char* const told =
      hasOneModel ? "" : "transforms has several lens models, and nerfstudio takes one for all of a file";
  std::vector<std::string> frames;
  for (const WrittenCamera& camera : cameras) {
    const auto m = worldFromCamera(camera, CameraAxes::RUB);
    std::vector<double> rows(m.begin(), m.end());
    rows.insert(rows.end(), {0, 0, 0, 1});
    JsonObject frame;
    frame.add("file_path", camera.label());
    if (!hasOneModel) frame.add("camera_model", transforms::modelOf(camera));
    if (!isShared) frame.addMembers(transforms::lensMembers(camera, ", "));
    frames.push_back(frame.addText("transform_matrix", jsonRows(rows, 4)).text());
  }
  JsonObject out;
  if (hasOneModel) out.add("camera_model", model);
  if (isShared) out.addMembers(shared, kLine);
  return {{"", "{\n  " + out.addText("frames", jsonList(frames, ",\n    "), kLine).members() + "\n}\n", told}};
}

}  // namespace viewproj::cmd
