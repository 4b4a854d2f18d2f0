#include "formats/parts.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::string_view kNames[] = {"K",
                                       "P",
                                       "fovY",
                                       "fovX",
                                       "size",
                                       "distortion",
                                       "fisheye",
                                       "omni",
                                       "doubleSphere",
                                       "unified",
                                       "fov",
                                       "cameraFromWorld",
                                       "worldFromCamera",
                                       "position",
                                       "target",
                                       "direction",
                                       "up",
                                       "euler",
                                       "name"};
/// Of rows alone: coefficients, the model's name, whether it is a fisheye, and xi beside OpenCV's coefficients.
constexpr std::string_view kNamesOfRows[] = {"lens", "model", "isFisheye", "xi", "near", "far", "id"};
constexpr std::string_view kTurns[] = {"rotation", "rotationVector", "quaternion", "quaternionWFirst", "translation"};
constexpr std::string_view kPoseParts[] = {"cameraFromWorld", "worldFromCamera"};

template <class Range>
bool contains(const Range& range, std::string_view name) {
  return std::find(std::begin(range), std::end(range), name) != std::end(range);
}

bool isText(std::string_view part) { return part == "name" || part == "model" || part == "isFisheye" || part == "id"; }

/// What the file holds for one camera, by part.
class Parts {
 public:
  explicit Parts(std::map<std::string, Found, std::less<>> found) : found_(std::move(found)) {}

  bool has(std::string_view part) const { return found_.contains(part); }
  const Found& operator[](std::string_view part) const { return found_.find(part)->second; }
  /// The value that messages name.
  const Node& node(std::string_view part) const { return (*this)[part].nodes.front(); }
  std::string text(std::string_view part) const { return has(part) ? (*this)[part].text : ""; }

  /// The numbers of a part: as many as one of these.
  const std::vector<double>& numbers(std::string_view part, std::initializer_list<std::size_t> counts) const {
    const std::vector<double>& numbers = (*this)[part].numbers;
    if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end()) {
      std::string expected;
      for (const std::size_t* count = counts.begin(); count != counts.end(); ++count)
        expected += (count == counts.begin() ? "" : count + 1 == counts.end() ? " or " : ", ") + std::to_string(*count);
      fail(part, "expected " + expected + (expected == "1" ? " number" : " numbers") + ", got " +
                     std::to_string(numbers.size()));
    }
    for (const double number : numbers)
      if (!std::isfinite(number)) fail(part, "holds a number that is not finite, as what is lost or not known does");
    return numbers;
  }

  [[noreturn]] void fail(std::string_view part, const std::string& message) const {
    const Found& found = (*this)[part];
    if (found.nodes.empty()) throw UsageError("--parts: " + std::string(part) + ": " + message);
    found.nodes.front().fail(message);
  }

 private:
  std::map<std::string, Found, std::less<>> found_;
};

std::optional<std::array<double, 2>> sizeOf(const Parts& parts) {
  if (!parts.has("size")) return std::nullopt;
  const std::vector<double>& size = parts.numbers("size", {2});
  return std::array{size[0], size[1]};
}

/// Whether a principal point lies outside the picture and inside the one with its sides exchanged.
void requireSides(const Parts& parts, double cx, double cy) {
  const auto size = sizeOf(parts);
  if (!size) return;
  const auto [w, h] = *size;
  if ((cx > w || cy > h) && cx < h && cy < w && cx > 0 && cy > 0)
    parts.fail("size", "is " + formatNumber(w) + "x" + formatNumber(h) + ", but cx, cy fit " + formatNumber(h) + "x" +
                           formatNumber(w));
}

Json projectionOfK(const Parts& parts) {
  const std::vector<double>& k = parts.numbers("K", {1, 2, 3, 4, 9, 12, 16});
  const auto size = sizeOf(parts);
  Json projection{{"type", "intrinsics"}};
  if (k.size() < 3) {
    projection["fx"] = k.front();
    projection["fy"] = k.back();
  } else {
    const std::array<double, 4> n = k.size() >= 9   ? intrinsicsOf(parts.node("K"), k)
                                    : k.size() == 4 ? std::array{k[0], k[1], k[2], k[3]}
                                                    : std::array{k[0], k[0], k[1], k[2]};
    requireSides(parts, n[2], n[3]);
    projection.update({{"fx", n[0]}, {"fy", n[1]}, {"cx", n[2]}, {"cy", n[3]}});
  }
  // DSO's and PTAM's numbers are fractions of the picture.
  constexpr double kFraction = 5;
  if (size && k.front() > 0 && k.front() < kFraction && size->front() > 10 * kFraction)
    parts.fail("K",
               "has a focal length below 5 pixels, which is a fraction of the picture or millimetres; multiply it");
  if (size) projection["pixels"] = *size;
  return projection;
}

void readLens(const Parts& parts, Json& camera) {
  const auto put = [&](Json lens) {
    if (!lens.is_null()) camera["distortion"] = std::move(lens);
  };
  for (const auto& [part, model] : {std::pair{"fisheye", "fisheye"},
                                    {"omni", "omni"},
                                    {"doubleSphere", "ds"},
                                    {"unified", "unified"},
                                    {"fov", "fov"}})
    if (parts.has(part)) put(lensOf(parts.node(part), model, parts[part].numbers));
  if (parts.has("distortion")) {
    const std::vector<double>& d = parts["distortion"].numbers;
    if (d.size() == 3 || d.size() == 6)
      parts.fail("distortion",
                 "holds " + std::to_string(d.size()) +
                     " numbers, which may be any of k1 k2 p1 p2 k3 … k6; say which, as in distortion=d[0,1,4,5,2]");
    put(lensOf(parts.node("distortion"), "plumb_bob", parts.numbers("distortion", {1, 2, 4, 5, 8, 12, 14})));
  }
  const std::string_view stated = parts.has("model") ? "model" : "isFisheye";
  std::string model = parts.text(stated);
  if (stated == "isFisheye" && parts.has(stated)) model = model == "true" || model == "1" ? "fisheye" : "plumb_bob";
  if (!parts.has("lens")) {
    if (parts.has(stated) && !mayBePinhole(model)) parts.fail(stated, "needs the coefficients of this lens");
    return;
  }
  const Found& lens = parts["lens"];
  if (!lens.named.empty()) return put(lensOf(lens.nodes.front(), model, lens.named));
  std::vector<double> c = lens.numbers;
  for (const double coefficient : c)
    if (!std::isfinite(coefficient)) parts.fail("lens", "holds a number that is not finite");
  if (parts.has("xi")) {
    c.insert(c.begin(), parts.numbers("xi", {1}).front());
    return put(lensOf(parts.node("lens"), "omni", c));
  }
  if (c.size() == 4 && model.empty() && std::any_of(c.begin(), c.end(), [](double n) { return n != 0; }))
    parts.fail("lens",
               "4 coefficients may be k1, k2, p1, p2, or k1 to k4 of a fisheye; add distortion_model to the file, "
               "\"plumb_bob\" or \"fisheye\"");
  put(lensOf(parts.node("lens"), model, c));
}

/// A pose as {rotation, translation}; nothing if none of its parts is there.
std::optional<Json> rigidOf(const Parts& parts, const std::string& pose) {
  std::string turn;
  for (const std::string_view part : kTurns) {
    const std::string name = pose + "." + std::string(part);
    if (!parts.has(name) || part == "translation") continue;
    if (!turn.empty()) parts.fail(name, "is the same thing as " + parts.node(turn).path() + "; leave one of them out");
    turn = name;
  }
  const std::string translation = pose + ".translation";
  if (turn.empty() && !parts.has(translation)) return std::nullopt;
  const auto isZero = [](double number) { return number == 0; };
  if (const auto& t = parts[turn.empty() ? translation : turn].numbers;
      turn.empty() && std::all_of(t.begin(), t.end(), isZero))
    return std::nullopt;  // says as little as no pose
  if (turn.empty()) parts.fail(translation, "needs R or rvec beside it");
  if (!parts.has(translation) && !parts.has("position")) parts.fail(turn, "needs t or tvec beside it");
  Json rigid{{"translation", parts.has(translation) ? parts.numbers(translation, {3}) : std::vector<double>{0, 0, 0}}};
  if (turn.ends_with("rotation")) {
    rigid["rotation"] = rowsOf(parts.numbers(turn, {9}), 3);
  } else if (turn.ends_with("rotationVector")) {
    rigid["rotationVector"] = parts.numbers(turn, {3});
  } else {
    std::vector<double> q = parts.numbers(turn, {4});
    if (turn.ends_with("WFirst")) std::rotate(q.begin(), q.begin() + 1, q.end());
    rigid["rotation"] = q;
  }
  return rigid;
}

/// The pose, and whether it has axes of its own.
bool readPose(const Parts& parts, Json& camera) {
  std::string_view first;
  for (const std::string_view pose : kPoseParts) {
    const std::string name(pose);
    std::optional<Json> value;
    if (parts.has(name)) {
      // A matrix and its multiples are the same map; phones write a last number next to 1.
      std::vector<double> m = parts.numbers(name, {12, 16});
      if (m.size() == 16 && m[15] != 1 && std::fabs(m[15] - 1) < 1e-5)
        for (double& entry : m) entry /= m[15];
      value = rowsOf(m, 4);
    }
    std::optional<Json> rigid = rigidOf(parts, name);
    const bool isTwice = value && rigid;
    if (!value) value = std::move(rigid);
    if (!value) continue;
    if (!first.empty() || isTwice) {
      for (const std::string& part :
           {name, name + ".rotation", name + ".rotationVector", name + ".quaternion", name + ".quaternionWFirst"})
        if (parts.has(part) && !(part == name && isTwice))
          parts.fail(part, "the camera has another pose; leave one of them out");
    }
    first = pose;
    setPose(camera, pose, std::move(*value));
  }
  for (const char* field : {"position", "direction", "target", "up", "euler"}) {
    if (!parts.has(field)) continue;
    if (first.empty()) camera.erase("rotation");
    const std::vector<double>& v = parts.numbers(field, {3});
    camera[field] = std::string_view(field) == "euler" ? Json{{"degrees", v}} : Json(v);
  }
  for (const char* field : {"direction", "target"})
    if (parts.has(field) && !parts.has("up"))
      parts.fail(field, "needs up: up=0+1+0 where y is up, up=0+0+1 where z is");
  if (first.empty() && parts.has("position") && !camera.contains("direction") && !camera.contains("target") &&
      !camera.contains("euler"))
    parts.fail("position", "needs a rotation, direction or target beside it");
  return !first.empty() || parts.has("euler");
}

Json cameraOf(const Parts& parts, const PartsForm& form) {
  Json camera{{"convention", "opencv"}, {"position", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}};
  if (parts.has("P")) {
    std::vector<double> p = parts.numbers("P", {12, 16});
    p.resize(12);
    camera = cameraOfMatrix(parts.node("P"), p, sizeOf(parts));
  } else {
    if (parts.has("K")) camera["projection"] = projectionOfK(parts);
    for (const char* field : {"fovX", "fovY"})
      if (parts.has(field)) {
        camera["projection"]["type"] = "perspective";
        camera["projection"][field] = parts.numbers(field, {1}).front();
      }
    if (const auto size = sizeOf(parts)) camera["viewport"] = {{"width", size->front()}, {"height", size->back()}};
    if (readPose(parts, camera) && form.cameraAxes != "RDF") camera["cameraAxes"] = form.cameraAxes;
  }
  for (const char* field : {"near", "far"})
    if (parts.has(field)) camera["projection"][field] = parts.numbers(field, {1}).front();
  if (form.pixelCenter != 0) camera["viewport"]["pixelCenter"] = form.pixelCenter;
  readLens(parts, camera);
  return camera;
}

/// The segment that holds the star, of the first part that has one.
std::string segmentOf(const std::vector<Part>& parts) {
  for (const Part& part : parts)
    for (const Sum& sum : part.value)
      for (const Term& term : sum)
        for (const Path& path : term.paths)
          if (const std::size_t star = path.text.find('*'); star != std::string::npos) {
            const std::size_t first = path.text.rfind('.', star), begin = first == std::string::npos ? 0 : first + 1;
            return path.text.substr(begin, path.text.find('.', star) - begin);
          }
  return "*";
}

}  // namespace

void requireNames(const std::vector<Part>& parts, const std::string& label, bool isRow) {
  std::vector<std::string_view> known(std::begin(kNames), std::end(kNames));
  for (const Part& part : parts) {
    const std::size_t dot = part.name.find('.');
    const std::string_view first = std::string_view(part.name).substr(0, dot);
    if (dot == std::string::npos && (contains(kNames, part.name) || (isRow && contains(kNamesOfRows, part.name))))
      continue;
    if (dot != std::string::npos && contains(kPoseParts, first) &&
        contains(kTurns, std::string_view(part.name).substr(dot + 1)))
      continue;
    if (first == "pose")
      throw UsageError(
          label +
          ": pose is no part: say cameraFromWorld (as solvePnP and COLMAP give it) or worldFromCamera (its "
          "translation is the camera's place)");
    throw UsageError(label + ": " + inQuotes(part.name) + " is no part" + suggestion(part.name, known));
  }
}

Import importParts(const Node& root, std::vector<Part> parts, PartsForm form, std::string_view names) {
  const auto shared = std::make_shared<const std::vector<Part>>(std::move(parts));
  std::vector<std::string> stars;
  std::unordered_set<std::string> known;
  bool isStarred = false;
  for (const Part& part : *shared) {
    if (part.isOptional || !hasStar(part) || part.name == "name") continue;
    isStarred = true;
    for (std::string& star : starsOf(root, part.value))
      if (known.insert(star).second) stars.push_back(std::move(star));
  }
  if (!isStarred) stars.emplace_back();
  const std::string pattern = names.empty() && isStarred ? segmentOf(*shared) : std::string(names);
  const auto partsOf = [root, shared](const std::string& star, bool isMark) {
    std::map<std::string, Found, std::less<>> found;
    for (const Part& part : *shared) {
      std::optional<Found> value;
      try {
        value = find(root, part, star, isText(part.name));
      } catch (const InputError&) {
        if (!isMark) throw;  // is told when the camera is asked for
      }
      if (!value && !part.isOptional && !isMark) root.fail(placeOf(part, star) + ": is not in the file");
      if (value && isMark) mark(*value);
      if (value) found.emplace(part.name, std::move(*value));
    }
    return found;
  };
  Import result;
  for (const std::string& star : stars) {
    CameraEntry entry{withStar(pattern, star), ""};
    const auto found = partsOf(star, true);
    const auto name = found.find("name"), id = found.find("id");
    if (name != found.end()) entry = {name->second.text, star};
    if (id != found.end()) entry.id = id->second.text;
    result.cameras.push_back(std::move(entry));
  }
  result.document = [partsOf, form, stars](std::size_t which) {
    return cameraOf(Parts(partsOf(stars[which], false)), form);
  };
  return result;
}  // namespace viewproj::cmd

bool hasParts(const Node& root, const std::vector<Part>& parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const Part& part) {
    if (part.isOptional) return true;
    if (hasStar(part)) return hasStars(root, part.value);
    try {
      return find(root, part, "", isText(part.name)).has_value();
    } catch (const InputError&) {
      return true;
    }
  });
}

}  // namespace viewproj::cmd
