// transforms.json of NeRFs. Sources: nerfstudio, "Data conventions"; instant-ngp, "NeRF dataset tips".
#include <nlohmann/json.hpp>

#include "camera/importers/importer.hpp"
#include "numbers/degrees.hpp"
#include "numbers/vectors.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace nerf {

/// A member of a frame overrides the same member of the file.
struct Frame {
  Node file, frame;

  std::optional<Node> find(std::string_view key) const {
    const auto inFrame = frame.find(key);
    return inFrame ? inFrame : file.find(key);
  }
  std::optional<double> number(std::string_view key) const {
    const auto value = find(key);
    return value ? std::optional(value->number()) : std::nullopt;
  }
};

Json lensModelOf(const Frame& at) {
  const auto model = at.find("camera_model"), flag = at.find("is_fisheye");
  std::string name = model ? model->text() : "";
  if (flag && flag->flag()) name = "OPENCV_FISHEYE";
  const bool isFisheye = name.ends_with("FISHEYE");
  for (const Node& node : {at.file, at.frame}) {
    if (isFisheye) refuse(node, {"p1", "p2"}, "is not supported beside a fisheye lens");
    if (!isFisheye) refuse(node, {"k4"}, "is not supported: programs do not agree on what it means");
  }
  Json coefficients;
  for (const char* key : {"k1", "k2", isFisheye ? "k3" : "p1", isFisheye ? "k4" : "p2", isFisheye ? "p1" : "k3"})
    coefficients.push_back(at.number(key).value_or(0));
  return distortionOf(Node(at.frame.document(), coefficients, at.frame.path()), name);
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
  if (const auto focal = at.number(axis.focal)) return focal;
  const auto angle = at.number(axis.angle);
  if (!angle) return std::nullopt;
  return rounded(DoubleDouble(halfSize(at, axis)) / tanHalfRadians(*angle));
}

Json lensOf(const Frame& at) {
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
  Json document{{"convention", "opengl"},
                {"worldFromCamera", rowsOf(at.frame.require("transform_matrix").mat4())},
                {"projection", lensOf(at)}};
  if (Json distortion = lensModelOf(at); !distortion.is_null()) document["distortion"] = std::move(distortion);
  const auto w = at.number("w"), h = at.number("h");
  if (w && h) document["viewport"] = {{"width", *w}, {"height", *h}};
  return document;
}

bool recognises(const Json& root) {
  const auto frames = root.find("frames");
  return frames != root.end() && frames->is_array();
}

Import open(const Node& root) {
  const Node frames = root.require("frames");
  Import result;
  for (const Json& frame : frames.json()) {
    const Json value = frame.is_object() ? frame.value("file_path", Json()) : Json();
    const std::string path = value.is_string() ? value.get<std::string>() : "";
    result.cameras.push_back({path, path.starts_with("./") ? path.substr(2) : ""});
  }
  result.document = [root, frames](std::size_t which) { return documentOf({root, frames[which]}); };
  return result;
}

}  // namespace nerf

extern const Importer kNerf{"transforms", "a transforms.json (NeRF)", nerf::recognises, nerf::open};

}  // namespace viewproj::cmd
