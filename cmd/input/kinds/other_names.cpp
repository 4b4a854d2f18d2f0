#include "input/kinds/other_names.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "input/distortion_names.hpp"
#include "input/importers/importer.hpp"
#include "input/kinds/pose_names.hpp"
#include "input/kinds/pose_of.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

enum class Says { focalX, focalY, centerX, centerY, width, height, angleX, angleY };

/// A field that says of the lens or the picture what another may say.
struct LensName {
  std::string_view name;     ///< plain
  std::vector<Says> each;    ///< of an array, or of a 3x3 matrix
  std::vector<Says> number;  ///< what a number may be: any of these
};
const std::vector<LensName>& lensNames() {
  using enum Says;
  const auto array = [](std::string_view name, std::vector<Says> each) { return LensName{name, std::move(each), {}}; };
  const auto number = [](std::string_view name, std::vector<Says> any) { return LensName{name, {}, std::move(any)}; };
  const auto focal = [](std::string_view name) { return LensName{name, {focalX, focalY}, {focalX, focalY}}; };
  static const std::vector<LensName> kNames = {
      number("fx", {focalX}),
      number("flx", {focalX}),
      number("focalx", {focalX}),
      number("focallengthx", {focalX}),
      number("fy", {focalY}),
      number("fly", {focalY}),
      number("focaly", {focalY}),
      number("focallengthy", {focalY}),
      focal("f"),
      focal("focal"),
      focal("focallength"),
      number("cx", {centerX}),
      number("ppx", {centerX}),
      number("principalpointx", {centerX}),
      number("cy", {centerY}),
      number("ppy", {centerY}),
      number("principalpointy", {centerY}),
      array("principalpoint", {centerX, centerY}),
      array("opticalcenter", {centerX, centerY}),
      array("intrinsics", {focalX, focalY, centerX, centerY}),
      array("intrinsic", {focalX, focalY, centerX, centerY}),
      array("cameraintrinsics", {focalX, focalY, centerX, centerY}),
      array("intrinsicmatrix", {focalX, focalY, centerX, centerY}),
      array("cameramatrix", {focalX, focalY, centerX, centerY}),
      array("k", {focalX, focalY, centerX, centerY}),
      array("mtx", {focalX, focalY, centerX, centerY}),
      number("fovx", {angleX}),
      number("hfov", {angleX}),
      number("cameraanglex", {angleX}),
      number("fovy", {angleY}),
      number("vfov", {angleY}),
      number("yfov", {angleY}),
      number("cameraangley", {angleY}),
      number("fov", {angleX, angleY}),
      number("w", {width}),
      number("h", {height}),
      number("width", {width}),
      number("imagewidth", {width}),
      number("imgwidth", {width}),
      number("height", {height}),
      number("imageheight", {height}),
      number("imgheight", {height}),
      array("size", {width, height}),
      array("imagesize", {width, height}),
      array("imgsize", {width, height}),
      array("resolution", {width, height}),
  };
  return kNames;
}

enum class Change { crop, region, binning, flip, scale };

struct ChangeName {
  std::string_view name;  ///< plain
  Change is;
};
/// What pixels may have gone through. A region is often that of the pixels that undistortion leaves, and cuts nothing
/// off.
constexpr ChangeName kChangeNames[] = {
    {"crop", Change::crop},
    {"cropbox", Change::crop},
    {"cropped", Change::crop},
    {"cropregion", Change::crop},
    {"roi", Change::region},
    {"regionofinterest", Change::region},
    {"cropx", Change::crop},
    {"cropy", Change::crop},
    {"cropoffset", Change::crop},
    {"zoom", Change::scale},
    {"scalefactor", Change::scale},
    {"resize", Change::scale},
    {"downscalefactor", Change::scale},
    {"rotate", Change::flip},
    {"imagerotation", Change::flip},
    {"binningfactor", Change::binning},
    {"binning", Change::binning},
    {"binningx", Change::binning},
    {"binningy", Change::binning},
    {"binninghorizontal", Change::binning},
    {"binningvertical", Change::binning},
    {"flip", Change::flip},
    {"flipped", Change::flip},
    {"fliph", Change::flip},
    {"flipv", Change::flip},
    {"flipx", Change::flip},
    {"flipy", Change::flip},
    {"hflip", Change::flip},
    {"vflip", Change::flip},
    {"fliphorizontal", Change::flip},
    {"flipvertical", Change::flip},
    {"horizontalflip", Change::flip},
    {"verticalflip", Change::flip},
    {"mirror", Change::flip},
    {"mirrored", Change::flip},
};

/// Whether the row looks for the field, or for something in it, or says that it is nothing.
bool isNamed(const Kind& kind, const std::string& name, const nlohmann::json& value) {
  const auto leads = [&](const Steps& path) { return leadsTo(path, name, value); };
  const auto has = [&](const std::vector<Steps>& paths) { return std::any_of(paths.begin(), paths.end(), leads); };
  return isAmong(kind.passedOver, name) || readsField(kind, name, value) || has(kind.needs) || has(kind.models) ||
         (kind.distortion && has(*kind.distortion)) ||
         std::any_of(kind.notes.begin(), kind.notes.end(), [&](const auto& note) { return has(note.paths); }) ||
         std::any_of(kind.only.begin(), kind.only.end(), [&](const auto& only) { return leads(only.path); });
}

/// What messages call a field: image_size of image_size.0.
std::string nameOf(const Path& path) {
  for (auto step = path.rbegin(); step != path.rend(); ++step)
    if (step->find_first_not_of("0123456789") != std::string::npos) return *step;
  return dotted(path);
}

bool holds(const Found& spot, const Path& path) {
  return spot.path.size() <= path.size() && std::equal(spot.path.begin(), spot.path.end(), path.begin());
}

/// The field, where the row does not read it. Does not count as read: --set of such a field is refused.
std::optional<Found> unread(const CameraPlace& camera, const Found& spot, std::string_view name) {
  if (!spot.value->is_object()) return std::nullopt;
  const auto item = spot.value->find(name);
  if (item == spot.value->end() || item->is_null()) return std::nullopt;
  if (isNamed(camera.kind(), std::string(name), *item)) return std::nullopt;
  Found field{spot.path, &*item};
  field.path.emplace_back(name);
  return field;
}

/// Numbers that are neither an identity nor all 0, or what cannot be told.
bool saysSomething(const Document& document, const Found& found) {
  if (found.value->is_number()) return *found.value != 0 && isTurnName(found.path.back());
  std::vector<double> numbers;
  if (!numbersOf(document, found, numbers)) return found.value->is_structured() && !found.value->empty();
  return !isIdentity(numbers) && !std::all_of(numbers.begin(), numbers.end(), [](double n) { return n == 0; });
}

/// Whether a value of a crop, a binning or a flip leaves the picture as it is.
bool leavesPicture(const nlohmann::json& value, Change change, const std::optional<Viewport>& pixels) {
  const bool cuts = change == Change::crop || change == Change::region;
  if (value.is_structured()) {
    // An object of arrays is a box in the world, as a path of nerfstudio has.
    const auto isDeep = [](const nlohmann::json& part) { return part.is_structured(); };
    if (value.is_object() && std::any_of(value.begin(), value.end(), isDeep)) return true;
    return std::all_of(value.begin(), value.end(), [&](const nlohmann::json& part) {
      return (cuts && value.is_object() && !part.is_number()) || leavesPicture(part, change, pixels);
    });
  }
  if (value.is_string()) return saysNone(value.get_ref<const std::string&>());
  if (!value.is_number()) return value != true;
  const double number = value.get<double>();
  if (number == 0 || ((change == Change::binning || change == Change::scale) && number == 1)) return true;
  // The last pixel is one less.
  return cuts && (!pixels || number == pixels->width || number == pixels->height || number == pixels->width - 1 ||
                  number == pixels->height - 1);
}

}  // namespace

void requireWholePicture(const CameraPlace& camera, const std::optional<Viewport>& pixels) {
  const auto meanwhile = camera.document().withoutReading();
  const Document& document = camera.document();
  for (const Found& spot : camera.lensSpots())
    for (const auto& item : spot.value->items()) {
      const auto known = std::find_if(std::begin(kChangeNames), std::end(kChangeNames), [&](const ChangeName& name) {
        return item.key().size() < 2 * name.name.size() && name.name == plainName(item.key());
      });
      if (known == std::end(kChangeNames) || leavesPicture(item.value(), known->is, pixels)) continue;
      const auto found = unread(camera, spot, item.key());
      if (!found) continue;
      if (known->is == Change::region)
        document.note(found->path,
                      "is passed over: pixels count in the whole picture; --set viewport.crop={\"x\":..,\"y\":..,"
                      "\"width\":..,\"height\":..} counts them from a corner in it");
      else if (known->is == Change::scale)
        document.note(found->path, "is passed over: the lens counts pixels of the size that the file states");
      else
        document.fail(found->path, "is not modelled, and the lens may count other pixels; --set " +
                                       dotted(found->path) + "=null leaves it out");
    }
}

void refuseSkew(const CameraPlace& camera) {
  for (const Found& spot : camera.lensSpots())
    for (const std::string_view name : {"skew", "alpha_c", "shear", "skew_coefficient"})
      if (const auto skew = unread(camera, spot, name); skew && skew->value->is_number() && *skew->value != 0)
        camera.document().fail(skew->path, "is a skew, and pixels of a skewed grid are not modelled; --set " +
                                               dotted(skew->path) + "=null leaves it out");
}

void refuseOddP(const CameraPlace& camera) {
  if (!camera.kind().has("K") || !camera.document().ownKinds().empty()) return;
  for (const std::string_view name : {"projection_matrix", "P", "p"}) {
    const auto odd = unread(camera, camera.own(), name);
    if (!odd || (name == "p" && !camera.own().value->contains("k"))) continue;
    std::vector<double> numbers;
    if (!numbersOf(camera.document(), *odd, numbers) || numbers.size() != 12)
      camera.document().fail(odd->path, "expected 12 numbers, the 3 rows of K [R | t]; --set " + dotted(odd->path) +
                                            "=null leaves it out");
  }
}

namespace {

bool isSize(Says says) { return says == Says::width || says == Says::height; }

/// What counts of a lens and its picture, and where in the file it stands.
class Counted {
 public:
  Counted(const CameraPlace& camera, const LensOf& lens, const Viewport& pixels)
      : camera_(&camera), lens_(&lens), pixels_(&pixels) {
    for (std::size_t i = 0; i < kSays; ++i) source_[i] = sourceOf(static_cast<Says>(i));
  }

  /// No size of the picture counts where the file reads none.
  bool counts(Says says) const { return !isSize(says) || camera_->find("size") || camera_->find("width"); }
  const Path& source(Says says) const { return source_[static_cast<std::size_t>(says)]; }
  /// The middle of the picture, which no field says.
  bool isMiddle(Says says) const {
    const bool isCenter = says == Says::centerX || says == Says::centerY;
    return isCenter && !camera_->find(centerWord(says)) && lens_->word.starts_with('f');
  }

  /// An angle in degrees.
  double value(Says says) const {
    switch (says) {
      case Says::focalX:
        return lens_->fx.hi;
      case Says::focalY:
        return lens_->fy.hi;
      case Says::centerX:
        return lens_->cx;
      case Says::centerY:
        return lens_->cy;
      case Says::width:
        return pixels_->width;
      case Says::height:
        return pixels_->height;
      case Says::angleX:
        return angle(pixels_->width, lens_->fx.hi);
      case Says::angleY:
        return angle(pixels_->height, lens_->fy.hi);
    }
    return 0;
  }

  bool isSame(Says says, double said) const {
    const auto agree = [](double a, double b, double share) {
      return std::fabs(a - b) <= share * std::max(std::fabs(a), std::fabs(b));
    };
    const double counted = value(says);
    if (says != Says::angleX && says != Says::angleY) return agree(said, counted, 1e-6);
    constexpr double kAngles = 1e-3;  // which are often rounded, and may be in radians
    return agree(said, counted, kAngles) || agree(said, counted * (std::numbers::pi / 180), kAngles);
  }

 private:
  static constexpr std::size_t kSays = static_cast<std::size_t>(Says::angleY) + 1;

  static const char* centerWord(Says says) { return says == Says::centerX ? "cx" : "cy"; }
  static double angle(double size, double focal) { return 2 * std::atan2(size / 2, focal) * (180 / std::numbers::pi); }

  Path sourceOf(Says says) const {
    if (isMiddle(says)) return {};
    const auto placeOf = [&](const char* word) { return camera_->find(word) ? camera_->pathOf(word) : Path(); };
    if (isSize(says)) {
      const Path own = placeOf(says == Says::width ? "width" : "height");
      return !own.empty() ? own : camera_->pathOf("size");
    }
    const bool isCenter = says == Says::centerX || says == Says::centerY;
    const Path center = isCenter ? placeOf(centerWord(says)) : Path();
    return center.empty() ? camera_->pathOf(lens_->word) : center;
  }

  const CameraPlace* camera_;
  const LensOf* lens_;
  const Viewport* pixels_;
  std::array<Path, kSays> source_;
};

/// What the numbers of a field say; nothing where they say nothing of the kind.
std::vector<Says> saidBy(const LensName& name, std::vector<double>& numbers) {
  constexpr std::size_t kMatrix = 9;
  if (name.name == "k" && numbers.size() != kMatrix) return {};
  if (numbers.size() == kMatrix && name.each.size() == 4) numbers = {numbers[0], numbers[4], numbers[2], numbers[5]};
  return numbers.size() == name.each.size() ? name.each : std::vector<Says>();
}

}  // namespace

void noteOtherLens(const CameraPlace& camera, const LensOf& lens, const Viewport& pixels) {
  const auto meanwhile = camera.document().withoutReading();
  const Document& document = camera.document();
  const Counted counted(camera, lens, pixels);
  const std::vector<Found> spots = camera.lensSpots();
  const std::size_t nearest = camera.spots().size();
  // What stands nearer to the camera goes before what stands farther, and contradicts nothing.
  const auto isFarther = [&](std::size_t spot, Says says) {
    for (std::size_t i = 0; i < spot && spot < nearest; ++i)
      if (holds(spots[i], counted.source(says))) return true;
    return false;
  };
  const auto note = [&](const Found& field, const std::vector<double>& numbers, const std::vector<Says>& says) {
    std::string said, counts;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const char* const between = i == 0 ? "" : isSize(says[i]) ? " x " : ", ";
      said += between + shortNumber(numbers[i]);
      counts += between + shortNumber(counted.value(says[i]));
    }
    const bool isPicture = numbers.size() > 1 && isSize(says[0]);
    document.note(field.path, "is " + said + "; " +
                                  (counted.isMiddle(says[0]) ? "the middle of the picture counts, which is "
                                                             : nameOf(counted.source(says[0])) + " counts, " +
                                                                   (isPicture ? "for " : "which has ")) +
                                  counts);
  };
  for (std::size_t spot = 0; spot < spots.size(); ++spot)
    for (const auto& item : spots[spot].value->items()) {
      constexpr std::size_t kLongest = 40;
      if (item.key().size() > kLongest) continue;
      const std::string plain = plainName(item.key());
      const auto name = std::find_if(lensNames().begin(), lensNames().end(),
                                     [&](const LensName& each) { return each.name == plain; });
      if (name == lensNames().end()) continue;
      const auto field = unread(camera, spots[spot], item.key());
      std::vector<double> numbers;
      if (!field) continue;
      const auto text =
          field->value->is_string() ? parseNumber(field->value->get_ref<const std::string&>()) : std::nullopt;
      if (field->value->is_number() || text)
        numbers = {text ? *text : field->value->get<double>()};
      else if (!numbersOf(document, *field, numbers))
        continue;
      if (numbers.size() == 1) {
        const auto& any = name->number;
        if (any.empty() || !counted.counts(any[0]) || isFarther(spot, any[0])) continue;
        if (std::any_of(any.begin(), any.end(), [&](Says says) { return counted.isSame(says, numbers[0]); })) continue;
        note(*field, numbers, any);
        continue;
      }
      const std::vector<Says> each = saidBy(*name, numbers);
      if (each.empty() || !counted.counts(each[0]) || isFarther(spot, each[0])) continue;
      bool isSame = true;
      for (std::size_t i = 0; i < each.size(); ++i) isSame = isSame && counted.isSame(each[i], numbers[i]);
      if (!isSame) note(*field, numbers, each);
    }
}

namespace {

/// A pose in an object in the field, or in the first of several there: under its name, or in two parts.
std::optional<Found> poseWithin(const CameraPlace& camera, const Found& field) {
  const auto within = [&](const Found& object) -> std::optional<Found> {
    if (!object.value->is_object()) return std::nullopt;
    std::optional<Found> first;
    for (const auto& item : object.value->items()) {
      const PoseName said = poseName(item.key());
      if (said != PoseName::certain && said != PoseName::vague) continue;
      const auto found = unread(camera, object, item.key());
      if (!found || !found->value->is_structured() || !saysSomething(camera.document(), *found)) continue;
      if (said == PoseName::certain || first) return first ? first : found;
      first = found;
    }
    return std::nullopt;
  };
  if (!field.value->is_structured() || field.value->empty()) return std::nullopt;
  if (auto found = within(field)) return found;
  const auto first = follow(camera.document(), field, {field.value->is_array() ? "0" : field.value->begin().key()});
  return first ? within(*first) : std::nullopt;
}

/// Whether it places something, whatever its name: a rotation with a translation, or the centre that goes with K.
bool isPlacing(const Document& document, const Found& field) {
  constexpr double kSlack = 1e-3;
  std::vector<double> n;
  if (!numbersOf(document, field, n)) return false;
  if (field.path.back() == "C") return n.size() == 3;
  if (n.size() != 12 && n.size() != 16) return false;
  const bool isTransposed = n.size() == 16 && (n[12] != 0 || n[13] != 0 || n[14] != 0);
  const auto entry = [&](std::size_t i, std::size_t j) { return isTransposed ? n[4 * j + i] : n[4 * i + j]; };
  if (n.size() == 16 && (entry(3, 0) != 0 || entry(3, 1) != 0 || entry(3, 2) != 0 || entry(3, 3) != 1)) return false;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double dot = 0;
      for (std::size_t k = 0; k < 3; ++k) dot += entry(i, k) * entry(j, k);
      if (!(std::fabs(dot - (i == j ? 1 : 0)) <= kSlack)) return false;
    }
  return true;
}

}  // namespace

void requirePoseRead(const CameraPlace& camera, const CameraReading& reading) {
  const auto meanwhile = camera.document().withoutReading();
  const Document& document = camera.document();
  if (reading.replacesPose) return;
  const auto read = poseField(camera);
  const auto note = [&](const Found& found) {
    document.note(found.path, read ? "is passed over: the pose that counts is that of " + nameOf(read->path)
                                   : "is passed over, and the camera is at the origin; --position and --rotation place "
                                     "it");
  };
  for (const auto& item : camera.own().value->items()) {
    const PoseName said = poseName(item.key());
    const auto found = unread(camera, camera.own(), item.key());
    if (!found) continue;
    if (said == PoseName::none && !read && isPlacing(document, *found) && saysSomething(document, *found)) {
      note(*found);
    } else if (said == PoseName::none || !saysSomething(document, *found)) {
      if (const auto within = read ? std::nullopt : poseWithin(camera, *found)) note(*within);
    } else if (read) {
      if (said != PoseName::loose) note(*found);
    } else if (said != PoseName::certain) {
      note(*found);
    } else {
      const bool isNextToK = camera.find("K") && camera.kind().cameras.empty();
      document.fail(found->path,
                    "is a pose that is not read of " + camera.kind().form + "; " +
                        (isNextToK ? "call it T_cam_world or T_world_cam, which say what they map, or " : "") +
                        "give --position and --rotation; --set " + dotted(found->path) + "=null leaves it out");
    }
  }
}

void notePosesAround(const Document& document, std::span<const Found> fields, const Kind& kind) {
  const auto meanwhile = document.withoutReading();
  for (const Found& field : fields)
    if (poseName(field.path.back()) >= PoseName::vague && !isAmong(kind.passedOver, field.path.back()) &&
        field.value->is_structured() && saysSomething(document, field))
      document.note(field.path, "stands beside the cameras and is passed over: it places none of them");
}

void noteUnreadMeaning(const CameraPlace& camera) {
  const auto meanwhile = camera.document().withoutReading();
  constexpr std::string_view kConventions[] = {"convention",           "coordinatesystem", "cameraconvention",
                                               "coordinateconvention", "axisconvention",   "coordinateframe"};
  constexpr std::string_view kPlanes[] = {"near",      "far",      "znear",     "zfar",        "nearplane",
                                          "farplane",  "nearclip", "farclip",   "clipnear",    "clipfar",
                                          "nearbound", "farbound", "clipstart", "clippingnear"};
  constexpr std::size_t kLongest = 24;
  const Document& document = camera.document();
  for (const Found& spot : camera.spots())
    for (const auto& item : spot.value->items()) {
      if (item.key().size() > kLongest) continue;
      const std::string plain = plainName(item.key());
      const bool isPlane = isAmong(kPlanes, plain) && item.value().is_number();
      if (!isPlane && !(isAmong(kConventions, plain) && (item.value().is_string() || item.value().is_object())))
        continue;
      const auto field = unread(camera, spot, item.key());
      if (!field) continue;
      if (isPlane)
        document.note(field->path, "is not read of " + camera.kind().form + "; --near and --far give the planes");
      else if (item.value() != camera.kind().words.at("convention"))
        document.note(field->path,
                      "is not read of " + camera.kind().form + ", which counts as in " +
                          camera.kind().words.at("convention") +
                          (camera.kind().words.count("axes") ? " with axes " + camera.kind().words.at("axes") : ""));
    }
}

}  // namespace viewproj::cmd
