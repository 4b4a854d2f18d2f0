#include "input/kinds/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "input/convention_names.hpp"
#include "input/kinds/distortion.hpp"
#include "input/kinds/lens_of.hpp"
#include "input/kinds/lookup.hpp"
#include "input/kinds/other_names.hpp"
#include "input/kinds/pose_of.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

const ConventionPreset& presetOf(const Kind& kind) { return *findPreset(kind.words.at("convention")); }

double pixelCenterOf(const Kind& kind) {
  const auto own = kind.numbers.find("pixelCenter");
  return own == kind.numbers.end() ? presetOf(kind).pixelCenter : own->second;
}

/// Throws at a field whose value the row does not allow.
void requireAllowed(const CameraPlace& camera) {
  for (const Kind::Allowed& allowed : camera.kind().only) {
    const auto found = camera.find(allowed.path);
    if (!found) continue;
    std::vector<double> numbers;
    if (found->value->is_number())
      numbers = {found->value->get<double>()};
    else if (!numbersOf(camera.document(), *found, numbers) && !found->value->empty())
      numbers = {std::numeric_limits<double>::quiet_NaN()};  // neither zeros nor an identity
    const std::string leftOut = "; --set " + dotted(found->path) + "=null leaves it out";
    if (allowed.identity) {
      const bool allZero = std::all_of(numbers.begin(), numbers.end(), [](double n) { return n == 0; });
      if (!isIdentity(numbers) && !allZero)
        camera.document().fail(found->path, "is no identity, and what it turns is not modelled" + leftOut);
      continue;
    }
    bool isAllowed = numbers.size() == 1 &&
                     std::find(allowed.numbers.begin(), allowed.numbers.end(), numbers[0]) != allowed.numbers.end();
    for (const Steps& same : allowed.sameAs)
      if (const auto other = camera.find(same); other && *other->value == *found->value) isAllowed = true;
    if (isAllowed) continue;
    std::string expected;
    for (const double number : allowed.numbers) expected += (expected.empty() ? "" : " or ") + formatNumber(number);
    for (const Steps& same : allowed.sameAs) expected += (expected.empty() ? "" : " or ") + dotted(same);
    camera.document().fail(found->path, "is not modelled; expected " + expected + leftOut);
  }
}

/// "w and h, " or "resolution, ", or nothing.
std::string sizeFields(const CameraPlace& camera) {
  const auto& size = camera.kind().at("size").paths;
  const auto &width = camera.kind().at("width").paths, &height = camera.kind().at("height").paths;
  if (!width.empty() && !height.empty()) return dotted(width.front()) + " and " + dotted(height.front()) + ", ";
  return size.empty() ? "" : dotted(size.front()) + ", ";
}

/// The text at a place of the row, or nothing.
std::string_view textAt(const CameraPlace& camera, std::string_view word) {
  const auto found = camera.find(word);
  return found && found->value->is_string() ? std::string_view(found->value->get_ref<const std::string&>()) : "";
}

/// The picture that a file states, where it does.
std::optional<Viewport> statedPicture(const CameraPlace& camera) {
  const PictureSize size = sizeOf(camera);
  if (!size.width || !size.height) return std::nullopt;
  return Viewport{.width = *size.width, .height = *size.height, .pixelCenter = pixelCenterOf(camera.kind())};
}

PinholePicture pinhole(const LensOf& lens, const Viewport& pixels) {
  return {lens.fx.hi, lens.fy.hi, lens.cx, lens.cy, pixels.width, pixels.height, pixels.pixelCenter - 0.5};
}

/// Throws for what makes a camera none that can be read, whatever its numbers are.
void requireReadable(const CameraPlace& camera) {
  if (!camera.own().value->is_object()) camera.fail("expected an object");
  for (const Steps& needed : camera.kind().needs)
    if (!camera.find(needed)) camera.fail("needs " + dotted(needed));
  camera.requireBeside();
  requireAllowed(camera);
  refuseSkew(camera);
  refuseOddP(camera);
}

}  // namespace

const Kind* kindOf(const Document& document, std::span<const Kind> kinds) {
  const auto meanwhile = document.withoutReading();
  for (const Kind& kind : kinds)
    if (isOfKind(document, kind)) return &kind;
  return nullptr;
}

KindCameras::KindCameras(const Document& document, const Kind& kind)
    : document_(&document),
      kind_(&kind),
      all_(camerasOf(document, kind)),
      poses_(all_),
      around_(fieldsAround(document, kind)),
      distortions_(distortionsAround(document, kind)),
      distortionAround_(distortionAround(around_, kind)) {}

std::optional<Distortion> KindCameras::distortion(const CameraPlace& camera) const {
  auto own = distortionOf(camera);
  for (const Found& object : distortions_)
    if (!own)
      if (const auto array = follow(*document_, object, {std::string(camera.key())})) own = distortionAt(*array);
  if (own || !distortionAround_ || camera.own().value->contains(distortionAround_->at.back())) return own;
  return distortionAround_;
}

/// "800 x 600, fx 1111, fy 1111, distorts by up to 3 pixels".
std::string KindCameras::noteOn(const CameraPlace& camera) {
  std::string note;
  const auto meanwhile = camera.document().withoutPlaces();
  const auto add = [&](const std::string& text) { note += (note.empty() ? "" : ", ") + text; };
  try {
    requireReadable(camera);
    const auto pixels = statedPicture(camera);
    std::optional<PinholePicture> picture;
    requireWholePicture(camera, pixels);
    if (pixels) add(shortNumber(pixels->width) + " x " + shortNumber(pixels->height));
    if (!isPinhole(camera)) {
      add("no pinhole: cannot be read");
      return note;
    }
    const auto angle = [&] {
      for (const char* const word : {"fx", "fy", "fovX", "fovY"})
        if (auto found = camera.find(word); found && found->value->is_number()) return found;
      return std::optional<Found>();
    }();
    if (pixels || countsInPixels(camera) || !angle) {
      const LensOf lens = lensOf(camera, pixels.value_or(Viewport{.width = 1, .height = 1}));
      add("fx " + shortNumber(lens.fx.hi) + ", fy " + shortNumber(lens.fy.hi));
      if (pixels) picture = pinhole(lens, *pixels);
    } else {
      add(angle->path.back() + " " + shortNumber(angle->value->get<double>()));
    }
    requirePoseRead(camera, {});
    poses_.require(camera);
    if (!poseField(camera)) add("no pose: at the origin");
    if (const auto distortion = this->distortion(camera))
      add(distortion->isModel ? "no pinhole" : "distorts " + sizeOf(*distortion, picture));
  } catch (const InputError& e) {
    add("cannot be read: " + std::string(e.what()));
  }
  return note;
}

std::vector<HeldCamera> KindCameras::list(bool withNotes) {
  std::vector<HeldCamera> result;
  const bool ofList = !kind_->cameras.empty();
  for (const CameraPlace& camera : all_) {
    HeldCamera held;
    held.number = std::to_string(result.size());
    held.name = textAt(camera, "name");
    if (held.name.starts_with("./")) held.alias = held.name.substr(2);
    if (!kind_->views.empty()) held.name = camera.view();
    held.kind = "intrinsics";
    if (const auto id = camera.find("id"); id && !id->value->is_structured())
      held.id = id->value->is_string() ? id->value->get<std::string>() : id->value->dump();
    if (ofList && held.name.empty())
      held.name = camera.keyInFile();
    else if (ofList && held.alias.empty())
      held.alias = camera.keyInFile();
    if (withNotes) held.note = noteOn(camera);
    result.push_back(std::move(held));
  }
  return result;
}

CameraFile KindCameras::read(std::size_t which, const CameraReading& reading) {
  const Document& document = *document_;
  const CameraPlace& camera = all_[which];
  const PictureSize size = sizeOf(camera);
  requireReadable(camera);
  const ObjectReader place(document, *camera.own().value, camera.own().path);
  requirePoseRead(camera, reading);
  const auto distortion = this->distortion(camera);
  const auto viewport = importedViewport(
      document, {.width = size.width, .height = size.height, .pixelCenter = pixelCenterOf(camera.kind())});
  if (!viewport && reading.needsPicture) {
    const std::string fields = sizeFields(camera);
    camera.fail((fields.empty() ? "does not tell " : "has no " + fields) +
                "the size of its pictures; --viewport WIDTHxHEIGHT gives one");
  }
  // The pixels that focal lengths count are the file's own; a viewport of another size shows the same picture. Where no
  // size is known any stands in for it.
  const Viewport frame =
      viewport ? viewport->frame : Viewport{.width = 1, .height = 1, .pixelCenter = pixelCenterOf(camera.kind())};
  const Viewport pixels{.width = size.width.value_or(frame.width),
                        .height = size.height.value_or(frame.height),
                        .pixelCenter = frame.pixelCenter};
  requireWholePicture(camera, viewport ? std::optional(pixels) : std::nullopt);
  const LensOf lens = lensOf(camera, pixels);
  refuseDistortion(document, distortion, viewport ? std::optional(pinhole(lens, pixels)) : std::nullopt, reading);
  auto near = camera.number("near"), far = camera.number("far");
  if (const auto scale = camera.kind().numbers.find("scale"); scale != camera.kind().numbers.end())
    for (auto* const plane : {&near, &far})
      if (*plane) **plane *= scale->second;
  const auto projection = [&] {
    try {
      return intrinsics(lens.fx, lens.fy, lens.cx, lens.cy, pixels, near.value_or(kDefaultNear),
                        far.value_or(kInfiniteFar));
    } catch (const CameraError& e) {
      const bool isPlane = (e.field() == "near" && near) || (e.field() == "far" && far);
      if (isPlane) camera.fail(e.field(), e.message());
      if (e.field() == "near" || e.field() == "far") camera.fail(e.message());
      camera.fail(lens.word, e.message());
    }
  }();
  if (viewport && !reading.allowStretch)
    requireShape(DoubleDouble(pixels.width) / DoubleDouble(pixels.height), frame, place);
  const auto pose = reading.replacesPose ? std::nullopt : std::optional(poses_.of(camera));
  CameraFile file = imported(document, presetOf(camera.kind()).convention, pose, projection, viewport);
  return file;
}

}  // namespace viewproj::cmd
