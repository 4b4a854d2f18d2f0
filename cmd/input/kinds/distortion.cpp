#include "input/kinds/distortion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "input/distortion_names.hpp"
#include "input/importers/importer.hpp"
#include "text/format_number.hpp"
#include "text/names.hpp"
#include "text/parse_number.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

/// In the order of OpenCV's arrays.
constexpr std::size_t kOrder[] = {0, 1, 6, 7, 2, 3, 4, 5};  // of kCoefficientNames

/// Names of lens models, whole or after the last dot, in any case.
constexpr std::string_view kPinholes[] = {
    "PINHOLE", "SIMPLE_PINHOLE", "OPENCV",    "FULL_OPENCV",         "SIMPLE_RADIAL", "RADIAL", "PERSPECTIVE",
    "brown",   "brown_conrady",  "plumb_bob", "rational_polynomial", "radtan",        "none"};
constexpr std::string_view kFisheyes[] = {"OPENCV_FISHEYE",
                                          "RADIAL_FISHEYE",
                                          "SIMPLE_RADIAL_FISHEYE",
                                          "THIN_PRISM_FISHEYE",
                                          "FOV",
                                          "FISHEYE",
                                          "fisheye_opencv",
                                          "equidistant",
                                          "kannala_brandt4",
                                          "ftheta",
                                          "f-theta",
                                          "omni",
                                          "ds",
                                          "eucm"};
/// Pinholes whose coefficients are another formula's.
constexpr std::string_view kOthers[] = {"inverse_brown_conrady", "modified_brown_conrady"};
/// Objects in which a lens is described.
constexpr std::string_view kLensObjects[] = {"lens",       "intrinsics", "calibration",      "calib",
                                             "camera",     "sensor",     "lensparameters",   "cameraparameters",
                                             "parameters", "optics",     "cameraintrinsics", "distortionmodel"};
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

template <class Names>
bool isModelAmong(const Names& names, std::string_view model) {
  return std::any_of(std::begin(names), std::end(names),
                     [&](std::string_view known) { return plainName(known) == plainName(model); });
}

/// All numbers within, in a text too; of a matrix as FileStorage writes it its data. What is no number is NaN.
void collect(const json& value, std::vector<double>& numbers) {
  if (value.is_number()) numbers.push_back(value.get<double>());
  if (value.is_boolean() && value.get<bool>()) numbers.push_back(kNoNumber);
  if (value.is_string()) {
    const std::string& text = value.get_ref<const std::string&>();
    if (text.empty()) return;
    const auto list = parseNumberList(text);
    if (list)
      numbers.insert(numbers.end(), list->begin(), list->end());
    else
      numbers.push_back(kNoNumber);
  }
  if (value.is_array())
    for (const auto& part : value) collect(part, numbers);
  if (!value.is_object()) return;
  if (const auto data = value.find("data"); data != value.end()) return collect(*data, numbers);
  for (const auto& part : value) collect(part, numbers);
}

bool isZero(double coefficient) { return coefficient == 0; }

/// Gathers what the fields say, the first that is not zero first.
class Gatherer {
 public:
  void coefficient(const Found& field, std::size_t which) {
    std::vector<double> numbers;
    collect(*field.value, numbers);
    if (std::all_of(numbers.begin(), numbers.end(), isZero)) return;
    put(field.path);
    if (numbers.size() == 1 && std::isfinite(numbers.front()))
      set(which, numbers.front());
    else
      isUnknown_ = true;
  }

  void array(const Found& field) {
    if (field.value->is_object() && !field.value->contains("data")) {
      object(field);
      return;
    }
    std::vector<double> numbers;
    collect(*field.value, numbers);
    if (std::all_of(numbers.begin(), numbers.end(), isZero)) return;
    put(field.path);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (i < std::size(kOrder) && std::isfinite(numbers[i]))
        set(kOrder[i], numbers[i]);
      else if (numbers[i] != 0)
        isUnknown_ = true;
  }

  void flag(const Found& field) {
    const json& value = *field.value;
    std::vector<double> numbers;
    collect(value, numbers);
    const bool isSaid = value == true || !std::all_of(numbers.begin(), numbers.end(), isZero) ||
                        (value.is_string() && !value.get_ref<const std::string&>().empty());
    if (isSaid) other(field.path);
  }

  void other(const Path& path) {
    put(path);
    isUnknown_ = true;
    if (found_->at == path) found_->isModel = true;
  }
  void unknown() { isUnknown_ = true; }

  std::optional<Distortion> result() {
    if (found_ && !isUnknown_) found_->brown = lens_;
    return found_;
  }

 private:
  void object(const Found& field) {
    bool allNamed = true;
    for (const auto& [name, value] : field.value->items()) {
      const auto at = std::find(std::begin(kCoefficientNames), std::end(kCoefficientNames), std::string_view(name));
      Found part{field.path, &value};
      part.path.push_back(name);
      if (at != std::end(kCoefficientNames))
        coefficient(part, static_cast<std::size_t>(at - std::begin(kCoefficientNames)));
      else if (std::vector<double> others; collect(value, others), !std::all_of(others.begin(), others.end(), isZero))
        allNamed = false;
    }
    if (allNamed) return;
    put(field.path);
    isUnknown_ = true;
  }

  void put(const Path& path) {
    if (!found_) found_ = Distortion{path, false, std::nullopt};
  }
  void set(std::size_t which, double value) { (which < 6 ? lens_.k[which] : lens_.p[which - 6]) = value; }

  std::optional<Distortion> found_;
  BrownLens lens_;
  bool isUnknown_ = false;
};

/// Numbers as of a distortion: several, and fewer than a matrix has.
bool isRow(const json& value) {
  constexpr std::size_t kMatrix = 9;
  std::vector<double> numbers;
  collect(value, numbers);
  return numbers.size() > 1 && numbers.size() < kMatrix;
}

/// Whether a field is that of another camera of the file: D2 beside the view M1.
bool isOfAnother(const std::string& plain, std::string_view view) {
  constexpr std::string_view kDigits = "0123456789";
  const auto number = [&](std::string_view name) {
    return name.substr(std::min(name.size(), name.find_last_not_of(kDigits) + 1));
  };
  return !number(view).empty() && !number(plain).empty() && number(view) != number(plain);
}

/// Takes what a field says by its name; false where it says nothing. hidden: the names of those that another said
/// before.
bool gatherField(Gatherer& gatherer, const Found& field, const Kind& kind, std::unordered_set<std::string>& hidden) {
  const std::string& key = field.path.back();
  const DistortionName said = distortionName(key);
  if (said == DistortionName::none || said == DistortionName::flag || isAmong(kind.passedOver, key)) return false;
  if (readsField(kind, key, *field.value)) return false;
  // d and k alone are many things, and K and K1 matrices.
  const json& given = *field.value;
  const std::string plain = plainName(key);
  const bool isLetter = withoutOwner(plain).size() == 1 && key != "D";
  if (said == DistortionName::array && (key == "K" || (isLetter && !isRow(given)))) return false;
  if (said == DistortionName::array && isOfAnother(plain, kind.view)) return false;
  if (said == DistortionName::coefficient && given.is_structured() && !isAmong(kCoefficientNames, key)) return false;
  if (given.is_string() && saysNone(given.get_ref<const std::string&>())) return false;
  if (!hidden.insert(key).second) return false;
  if (said == DistortionName::array)
    gatherer.array(field);
  else
    gatherer.coefficient(field, *coefficientIndex(key));
  return true;
}

/// What the fields of an object say by their names.
void gather(Gatherer& gatherer, const Document& document, const Found& object, const Kind& kind,
            std::unordered_set<std::string>& hidden) {
  if (!object.value->is_object()) return;
  const ObjectReader reader(document, *object.value, object.path);
  for (const auto& item : object.value->items()) {
    const std::string& key = item.key();
    Found field{object.path, &item.value()};
    field.path.push_back(key);
    if (item.value().is_object() && isAmong(kLensObjects, plainName(key)) && !isAmong(kind.passedOver, key))
      gather(gatherer, document, field, kind, hidden);
    else if (!item.value().is_null() && gatherField(gatherer, field, kind, hidden))
      (void)reader.find(key);  // counts as read
  }
}

/// What an object says of the model beside its numbers.
void gatherModelNames(Gatherer& gatherer, const Document& document, const Found& object,
                      const std::vector<std::string>& passedOver) {
  constexpr std::size_t kLongest = 40;  // of a name
  if (!object.value->is_object()) return;
  const ObjectReader reader(document, *object.value, object.path);
  for (const auto& item : object.value->items()) {
    const std::string& key = item.key();
    if (key.size() > kLongest || isAmong(passedOver, key)) continue;
    const bool isXi = key == "xi", isFlag = distortionName(key) == DistortionName::flag;
    const bool isModel = item.value().is_string() && isAmong(kLensModels, plainName(key));
    if (!isXi && !isFlag && !isModel) continue;
    const json* const value = reader.find(key);
    if (!value) continue;
    Path path = object.path;
    path.push_back(key);
    if (isFlag)
      gatherer.flag({path, value});
    else if (isXi ? value->is_number() && *value != 0 : isNoPlaneModel(value->get_ref<const std::string&>()))
      gatherer.other(path);
  }
}

/// Throws for a model that is neither a pinhole nor a fisheye.
void gatherModels(Gatherer& gatherer, const CameraPlace& camera) {
  for (const Steps& path : camera.kind().models) {
    const auto model = camera.find(path);
    if (!model || !model->value->is_string()) continue;
    std::string_view name = model->value->get_ref<const std::string&>();
    if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name.remove_prefix(dot + 1);
    if (name.empty() || isModelAmong(kPinholes, name)) continue;
    if (isModelAmong(kFisheyes, name) || isNoPlaneModel(name))
      gatherer.other(model->path);
    else if (isModelAmong(kOthers, name))
      gatherer.unknown();
    else
      camera.document().fail(model->path, "is no pinhole camera; known are " + joined(kPinholes));
  }
}

}  // namespace

std::optional<Distortion> distortionIn(const Document& document, const Found& object) {
  static const Kind kNone;
  Gatherer gatherer;
  std::unordered_set<std::string> hidden;
  gatherModelNames(gatherer, document, object, {});
  gather(gatherer, document, object, kNone, hidden);
  return gatherer.result();
}

std::optional<Distortion> distortionOf(const CameraPlace& camera) {
  const Kind& kind = camera.kind();
  const Document& document = camera.document();
  Gatherer gatherer;
  gatherModels(gatherer, camera);
  if (kind.distortion && kind.distortion->empty()) return gatherer.result();
  std::unordered_set<std::string> hidden;
  if (kind.distortion)
    for (const Steps& path : *kind.distortion)
      if (const auto field = camera.find(path)) {
        gatherer.array(*field);
        hidden.insert(field->path.back());
      }
  for (const Found& spot : camera.lensSpots()) {
    gatherModelNames(gatherer, document, spot, kind.passedOver);
    gather(gatherer, document, spot, kind, hidden);
  }
  return gatherer.result();
}

std::optional<Distortion> distortionAround(std::span<const Found> fields, const Kind& kind) {
  if (kind.distortion && kind.distortion->empty()) return std::nullopt;
  Gatherer gatherer;
  std::unordered_set<std::string> hidden;
  for (const Found& field : fields) gatherField(gatherer, field, kind, hidden);
  return gatherer.result();
}

std::optional<Distortion> distortionAt(const Found& field) {
  Gatherer gatherer;
  gatherer.array(field);
  return gatherer.result();
}

std::string sizeOf(const Distortion& distortion, const std::optional<PinholePicture>& picture) {
  if (!distortion.brown) return "by an amount that is not known here";
  if (!picture) return "by an amount that focal lengths and the size of the picture would tell";
  const PinholePicture& p = *picture;
  const auto& k = distortion.brown->k;
  const auto& t = distortion.brown->p;
  constexpr int kSteps = 64;
  double most = -1, atX = 0, atY = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double u = p.corner + p.width * i / kSteps, v = p.corner + p.height * j / kSteps;
      const double x = (u - p.cx) / p.fx, y = (v - p.cy) / p.fy, r = x * x + y * y;
      const double radial = (1 + r * (k[0] + r * (k[1] + r * k[2]))) / (1 + r * (k[3] + r * (k[4] + r * k[5])));
      const double dx = x * (radial - 1) + 2 * t[0] * x * y + t[1] * (r + 2 * x * x);
      const double dy = y * (radial - 1) + t[0] * (r + 2 * y * y) + 2 * t[1] * x * y;
      const double shift = std::hypot(dx * p.fx, dy * p.fy);
      if (!std::isfinite(shift)) return "without a bound within the picture (Brown's model)";
      if (!(shift > most)) continue;
      most = shift;
      atX = u;
      atY = v;
    }
  return "by up to " + shortNumber(most) + " pixels, at " + formatDigits(atX, 6) + ", " + formatDigits(atY, 6) +
         " (Brown's model)";
}

void refuseDistortion(const Document& document, const std::optional<Distortion>& distortion,
                      const std::optional<PinholePicture>& picture, const CameraReading& reading) {
  if (!distortion) return;
  if (distortion->isModel) {
    if (!reading.ignoreDistortion)
      document.fail(distortion->at,
                    "is no pinhole camera; --ignore-distortion takes it as one, for pixels near its middle");
    document.note(distortion->at, "is no pinhole camera and taken as one: pixels are right near its middle alone");
    return;
  }
  const std::string size = sizeOf(*distortion, picture);
  if (!reading.ignoreDistortion)
    document.fail(distortion->at, "distorts the picture, " + size +
                                      ", which is not modelled; undistort points or picture first, or give "
                                      "--ignore-distortion for pixels of an ideal lens");
  document.note(distortion->at,
                "distorts the picture, " + size + ", and is left out: pixels are those of an ideal lens");
}

}  // namespace viewproj::cmd
