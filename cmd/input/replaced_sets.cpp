#include "input/replaced_sets.hpp"

#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Json = nlohmann::json;

/// All that a camera is.
void append(const CameraFile& camera, std::vector<double>& numbers) {
  const auto add = [&](const DoubleDouble& a) { numbers.insert(numbers.end(), {a.hi, a.lo}); };
  if (camera.pose) {
    const PoseParts& pose = parts(*camera.pose);
    const DDVec3 eye = unroundedEye(pose);
    for (const DDVec3& v : {pose.columns.right, pose.columns.up, pose.columns.forward, eye})
      for (const DoubleDouble& a : {v.x, v.y, v.z}) add(a);
  }
  if (camera.projection) {
    const ProjectionParts& lens = parts(*camera.projection);
    for (const DoubleDouble& a : {lens.left, lens.right, lens.bottom, lens.top}) add(a);
    numbers.insert(numbers.end(), {lens.near, lens.far});
  }
  if (camera.viewport)
    numbers.insert(numbers.end(), {camera.viewport->width, camera.viewport->height, camera.viewport->x,
                                   camera.viewport->y, camera.viewport->pixelCenter});
}

/// The numbers of a value, which stay its own.
void collect(Json& value, std::vector<Json*>& numbers) {
  constexpr std::size_t kMost = 64;
  if (value.is_number() && numbers.size() < kMost) numbers.push_back(&value);
  if (value.is_structured())
    for (Json& part : value) collect(part, numbers);
}

/// A number close by, so that what is a rotation stays one.
double besides(double number) {
  constexpr double kStep = 0x1p-20;
  return number == 0 ? kStep : number * (1 + kStep);
}

/// Nothing of cameras that cannot be read.
using Numbers = std::optional<std::vector<double>>;

class Trial {
 public:
  Trial(Document& document, const CameraReading& reading, const std::function<std::vector<CameraFile>()>& read)
      : document_(document), reading_(reading), read_(read) {}

  /// The file's, as it stands.
  std::vector<CameraFile> file() const {
    try {
      return read_();
    } catch (const InputError&) {
      return {};
    }
  }

  /// The file's with another value at a path.
  std::vector<CameraFile> with(const Path& path, const Json& value) const {
    std::vector<CameraFile> cameras;
    document_.tryOut(path, value, [&] { cameras = file(); });
    return cameras;
  }

  static Numbers numbersOf(const std::vector<CameraFile>& cameras) {
    if (cameras.empty()) return std::nullopt;
    std::vector<double> numbers;
    for (const CameraFile& camera : cameras) append(camera, numbers);
    return numbers;
  }

  Numbers under(const TypedCamera& typed, const std::vector<CameraFile>& cameras) const {
    try {
      std::vector<CameraFile> all;
      for (const CameraFile& camera : cameras) all.push_back(typed.over(camera, document_, reading_));
      return numbersOf(all);
    } catch (const InputError&) {
      return std::nullopt;
    } catch (const UsageError&) {
      return std::nullopt;
    }
  }

 private:
  Document& document_;
  const CameraReading& reading_;
  const std::function<std::vector<CameraFile>()>& read_;
};

}  // namespace

void requireSetsCount(Document& document, const TypedCamera& typed, const CameraReading& reading,
                      const std::function<std::vector<CameraFile>()>& read) {
  const Trial trial(document, reading, read);
  std::vector<CameraFile> file;
  for (const Path& path : document.sets()) {
    const Json* const set = document.at(path);
    if (!set || path.front() == "viewport") continue;
    if (file.empty()) document.tryOut(path, *set, [&] { file = trial.file(); });
    const Numbers own = Trial::numbersOf(file), result = trial.under(typed, file);
    if (!own || !result) return;  // which reading it tells
    Json value = *set;
    std::vector<Json*> numbers;
    collect(value, numbers);
    std::string_view replacing;
    bool counts = false;
    for (Json* const number : numbers) {
      const Json before = *number;
      *number = besides(number->get<double>());
      const std::vector<CameraFile> other = trial.with(path, value);
      *number = before;
      const Numbers ofOther = Trial::numbersOf(other);
      if (!ofOther || ofOther == own) continue;
      counts = counts || trial.under(typed, other) != result;
      for (const std::string_view name : typed.names()) {
        const TypedCamera rest = typed.without(name);
        if (replacing.empty() && trial.under(rest, other) != trial.under(rest, file)) replacing = name;
      }
      if (replacing.empty()) replacing = typed.names().front();
    }
    if (!counts && !replacing.empty())
      throw UsageError(std::string(replacing) + " takes the place of what --set " + dotted(path) +
                       " gives; leave out one of them");
  }
}

}  // namespace viewproj::cmd
