#include "formats/parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "formats/format.hpp"
#include "formats/words.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The lenses that a part names, and what lens_names.cpp calls them.
constexpr std::pair<std::string_view, std::string_view> kLensParts[] = {
    {"fisheye", "fisheye"}, {"omni", "omni"}, {"doubleSphere", "ds"}, {"unified", "unified"}, {"fov", "fov"}};
constexpr std::string_view kNames =
    "K P fovY fovX focalLength sensorWidth sensorHeight size distortion fisheye omni doubleSphere unified fov "
    "cameraFromWorld "
    "worldFromCamera position latLonHeight target direction up euler heading pitch roll name";
constexpr std::string_view kNamesOfRows = "lens model isFisheye xi rectified near far aspect id",
                           kTexts = "name model isFisheye id";
constexpr std::string_view kPoseParts = "cameraFromWorld worldFromCamera",
                           kTurns = "rotation rotationVector quaternion quaternionWFirst",
                           kPoseForms = "rotation rotationVector quaternion quaternionWFirst translation";

constexpr const char* kHeadingTurns[] = {"heading", "pitch", "roll"};

using FoundParts = std::map<std::string, Found, std::less<>>;

/// What the file holds for one camera, by part.
class Parts {
 public:
  Parts(FoundParts found, const Node& root) : found_(std::move(found)), root_(root) {}

  bool has(std::string_view part) const { return found_.contains(part); }
  bool hasAny(std::string_view parts) const {
    const std::vector<std::string_view> all = wordsIn(parts);
    return std::any_of(all.begin(), all.end(), [&](std::string_view part) { return has(part); });
  }
  const Found& operator[](std::string_view part) const { return found_.find(part)->second; }
  /// The value that messages name: of numbers that the line itself has, the file.
  const Node& node(std::string_view part) const {
    const std::vector<Node>& nodes = (*this)[part].nodes;
    return nodes.empty() ? root_ : nodes.front();
  }
  std::string text(std::string_view part) const { return has(part) ? (*this)[part].text : ""; }

  /// The numbers of a part: as many as one of these; none: any.
  const std::vector<double>& numbers(std::string_view part, std::initializer_list<std::size_t> counts) const {
    const std::vector<double>& numbers = (*this)[part].numbers;
    if (counts.size() > 0 && std::find(counts.begin(), counts.end(), numbers.size()) == counts.end()) {
      const auto& nodes = (*this)[part].nodes;
      const bool isShown = nodes.size() == 1 && !nodes.front().json().is_structured();  // which tells how many
      std::vector<std::string> texts;
      for (const std::size_t count : counts) texts.push_back(std::to_string(count));
      fail(part, "expected " + alternatives({texts.begin(), texts.end()}) +
                     (texts.back() == "1" ? " number" : " numbers") +
                     (isShown ? "" : ", got " + std::to_string(numbers.size())));
    }
    const bool isPose = isAmong(part.substr(0, part.find('.')), kPoseParts);
    for (const double number : numbers)
      if (!std::isfinite(number))
        fail(part, isPose ? "is not a pose: it holds inf or nan, as a pose that was lost does"
                          : "holds a number that is not finite, as what is lost or not known does");
    return numbers;
  }
  double number(std::string_view part) const { return numbers(part, {1}).front(); }
  std::optional<std::array<double, 2>> size() const {
    if (!has("size")) return std::nullopt;
    const std::vector<double>& size = numbers("size", {2});
    return std::array{size[0], size[1]};
  }

  [[noreturn]] void fail(std::string_view part, const std::string& message) const {
    const Found& found = (*this)[part];
    if (found.nodes.empty()) throw UsageError("--parts: " + std::string(part) + ": " + message);
    found.nodes.front().fail(message);
  }

 private:
  FoundParts found_;
  Node root_;
};

Json projectionOfK(const Parts& parts) {
  const std::vector<double>& k = parts.numbers("K", {1, 2, 3, 4, 9, 12, 16});
  const auto size = parts.size();
  const auto [w, h] = size.value_or(std::array{0.0, 0.0});
  Json projection{{"type", "intrinsics"}};
  if (k.size() < 3) {
    projection.update({{"fx", k.front()}, {"fy", k.back()}});
  } else {
    const auto [fx, fy, cx, cy] = k.size() >= 9   ? intrinsicsOf(parts.node("K"), k)
                                  : k.size() == 4 ? std::array{k[0], k[1], k[2], k[3]}
                                                  : std::array{k[0], k[0], k[1], k[2]};
    // An axis off the picture is right of a cropped one; in the middle of the picture lying down it is an exchange.
    const auto isMiddle = [](double c, double extent) { return std::fabs(c - extent / 2) < extent / 8; };
    if (size && (cx > w || cy > h) && isMiddle(cx, h) && isMiddle(cy, w))
      parts.fail("size", "is " + formatNumber(w) + "x" + formatNumber(h) + ", but cx, cy fit " + formatNumber(h) + "x" +
                             formatNumber(w));
    projection.update({{"fx", fx}, {"fy", fy}, {"cx", cx}, {"cy", cy}});
  }
  // DSO's and PTAM's numbers are fractions of the picture.
  constexpr double kFraction = 5;
  if (size && k.front() > 0 && k.front() < kFraction && w > 10 * kFraction)
    parts.fail("K",
               "has a focal length below 5 pixels, which is a fraction of the picture or millimetres; multiply it");
  if (size) projection["pixels"] = *size;
  return projection;
}

/// What --parts takes for a fisheye of a file whose lens has no name.
std::string fisheyeLine(const Parts& parts) {
  std::string line = "--parts 'K=" + parts.node("K").path() + ", fisheye=" + parts.node("lens").path();
  std::vector<std::string> sides;
  if (parts.has("size"))
    for (const Node& side : parts["size"].nodes) sides.push_back(side.path());
  return line + (sides.empty() ? "'" : ", size=" + joined(sides, "+") + "'");
}

/// The coefficients of a lens that the file names.
void readNamedLens(const Parts& parts, Json& camera) {
  const std::string_view stated = parts.has("model") ? "model" : "isFisheye";
  std::string model = parts.text(stated);
  if (stated == "isFisheye" && parts.has(stated)) model = model == "true" || model == "1" ? "fisheye" : "plumb_bob";
  if (!parts.has("lens")) {
    const bool isBent = !mayBePinhole(model) || isAmong(lowered(model), "rational thin_prism tilted");
    if (parts.has(stated) && isBent) parts.fail(stated, "needs the coefficients of this lens");
    return;
  }
  const Node& node = parts.node("lens");
  if (model.empty() && hasWord(node.path(), "fisheye equidistant")) model = "fisheye";
  if (const auto& named = parts["lens"].named; !named.empty()) return setLens(camera, node, model, named);
  std::vector<double> c = parts.numbers("lens", {});
  if (parts.has("xi")) {
    c.insert(c.begin(), parts.number("xi"));
    model = "omni";
  } else if (c.size() == 4 && model.empty() && !areZero(c)) {
    node.fail(
        "4 coefficients may be k1, k2, p1, p2, or k1 to k4 of a fisheye; add distortion_model to the file, "
        "\"plumb_bob\" or \"fisheye\"" +
        (parts.has("K") ? ", or say " + fisheyeLine(parts) : ""));
  }
  setLens(camera, node, model, c);
}

void readLens(const Parts& parts, Json& camera) {
  std::string_view first = parts.has("distortion") ? "distortion" : "";
  for (const auto& [part, model] : kLensParts) {
    if (!parts.has(part)) continue;
    if (!first.empty()) parts.fail(part, std::string(first) + " is the lens too; leave one of them out");
    first = part;
    setLens(camera, parts.node(part), model, parts.numbers(part, {}));
  }
  if (parts.has("distortion")) {
    const std::size_t count = parts["distortion"].numbers.size();
    if (count == 3 || count == 6)
      parts.fail("distortion",
                 "holds " + std::to_string(count) +
                     " numbers, which may be any of k1 k2 p1 p2 k3 … k6; say which, as in distortion=d[0,1,4,5,2]");
    setLens(camera, parts.node("distortion"), "plumb_bob", parts.numbers("distortion", {1, 2, 4, 5, 8, 12, 14}));
  }
  readNamedLens(parts, camera);
}

/// A matrix of 12 or 16 numbers, or a rotation of 9.
Json matrixOf(const Node& node, std::vector<double> m) {
  if (m.size() == 9) return {{"rotation", rowsOf(m, 3)}, {"translation", {0, 0, 0}}};
  if (m.size() != 12 && m.size() != 16) node.fail("expected 12 or 16 numbers, got " + std::to_string(m.size()));
  // A matrix and its multiples are the same map; phones write a last number next to 1.
  if (m.size() == 16 && m[15] != 1 && std::fabs(m[15] - 1) < 1e-5)
    for (double& entry : m) entry /= m[15];
  return rowsOf(m, 4);
}

/// Matrices whose product is the pose, or one whose numbers may be terms of their own.
Json chainOf(const Parts& parts, std::string_view pose) {
  const Found& found = parts[pose];
  const std::vector<double>& all = parts.numbers(pose, {});
  if (found.nodes.size() < 2 || all.size() == 12 || all.size() == 16) {
    const std::string name(pose);
    if (all.size() == 7)
      parts.fail(pose, "expected 12 or 16 numbers, got 7; --parts '" + name +
                           ".translation=" + parts.node(pose).path() + "[0:3], " + name +
                           ".quaternion=" + parts.node(pose).path() + "[3:7]' says their order");
    if (!parts.has("P")) (void)parts.numbers(pose, {12, 16});
    return Json::array({matrixOf(parts.node(pose), all)});
  }
  Json chain = Json::array();
  std::size_t begin = 0;
  for (std::size_t i = 0; i < found.ends.size(); begin = found.ends[i++])
    chain.push_back(matrixOf(found.nodes[i], {all.begin() + static_cast<std::ptrdiff_t>(begin),
                                              all.begin() + static_cast<std::ptrdiff_t>(found.ends[i])}));
  return chain;
}

/// A turn of one of the forms, and a translation or the part position.
Json rigidOf(const Parts& parts, const std::string& pose, const std::string& turn) {
  const std::string translation = pose + ".translation";
  if (!parts.has(translation) && !parts.has("position"))
    parts.fail(turn, "needs t or tvec beside it (" + translation + ")");
  Json rigid{{"translation", parts.has(translation) ? parts.numbers(translation, {3}) : std::vector<double>{0, 0, 0}}};
  if (turn.ends_with("rotation")) {
    const std::size_t count = parts[turn].numbers.size();
    if (count == 3 || count == 4)
      parts.fail(turn, "expected 9 numbers, got " + std::to_string(count) + "; say " + pose +
                           (count == 3 ? ".rotationVector" : ".quaternion"));
    rigid["rotation"] = rowsOf(withThirdRow(parts.numbers(turn, {6, 9})), 3);
  } else if (turn.ends_with("rotationVector")) {
    rigid["rotationVector"] = parts.numbers(turn, {3});
  } else {
    std::vector<double> q = parts.numbers(turn, {4});
    // A name states the order of a list as it stands in the file, and names that of an object.
    const Node& first = parts.node(turn);
    const bool isWhole = parts[turn].nodes.size() == 1 && numbersIn(first.json()) == q;
    const bool isNamed = isWhole && contentOf(first.json()).is_object();
    const std::string_view order = isWhole && !isNamed ? quaternionOrderOf(first.path()) : "";
    const bool isWFirst = turn.ends_with("WFirst");
    if (isWFirst && order == "xyzw") parts.fail(turn, "is called x, y, z, w; say " + pose + ".quaternion");
    if ((isWFirst && !isNamed) || order == "wxyz") std::rotate(q.begin(), q.begin() + 1, q.end());
    rigid["rotation"] = q;
  }
  return rigid;
}

/// The one part that turns the camera; empty if there is none.
std::string turnOf(const Parts& parts) {
  std::string turn;
  const auto add = [&](const std::string& name) {
    if (!parts.has(name)) return false;
    if (!turn.empty())
      parts.fail(name, turn.find('.') != std::string::npos && name.starts_with(turn.substr(0, turn.find('.')))
                           ? "is the same thing as " + parts.node(turn).path() + "; leave one of them out"
                           : "the camera has another pose; leave one of them out");
    turn = name;
    return true;
  };
  for (const std::string_view pose : wordsIn(kPoseParts)) {
    const std::string name(pose), translation = name + ".translation";
    bool hasTurn = add(name);
    for (const std::string_view form : wordsIn(kTurns)) hasTurn = add(name + "." + std::string(form)) || hasTurn;
    if (hasTurn || !parts.has(translation)) continue;
    if (!areZero(parts[translation].numbers))  // zeros say as little as no pose
      parts.fail(translation, "needs R or rvec beside it");
  }
  return turn;
}

/// The pose. Whether it has axes of its own.
bool readPose(const Parts& parts, Json& camera) {
  const std::string turn = turnOf(parts);
  if (!turn.empty()) {
    const std::string pose = turn.substr(0, turn.find('.'));
    Json value = turn == pose ? chainOf(parts, pose) : rigidOf(parts, pose, turn);
    setPose(camera, pose, value.is_array() && value.size() == 1 ? value.front() : value);
  }
  for (const char* field : {"position", "direction", "target", "up", "euler"}) {
    if (!parts.has(field)) continue;
    const std::vector<double>& v = parts.numbers(field, {3});
    camera[field] = std::string_view(field) == "euler" ? Json{{"degrees", v}} : Json(v);
  }
  if (parts.has("latLonHeight")) {
    const std::vector<double>& place = parts.numbers("latLonHeight", {3});
    camera["position"] = {{"lat", place[0]}, {"lon", place[1]}, {"height", place[2]}};
  }
  if (parts.has("heading")) {
    const std::vector<double>& turns = parts.numbers("heading", {1, 2, 3});
    for (std::size_t i = 0; i < turns.size(); ++i) camera[kHeadingTurns[i]] = turns[i];
    if (!parts.has("latLonHeight")) camera["world"] = "enu";
  }
  for (const char* field : {"pitch", "roll"}) {
    if (!parts.has(field)) continue;
    if (camera.contains(field)) parts.fail(field, "heading has it too; leave one of them out");
    camera[field] = parts.number(field);
  }
  for (const char* field : {"direction", "target"})
    if (parts.has(field) && !parts.has("up"))
      parts.fail(field, "needs up: up=0+1+0 where y is up, up=0+0+1 where z is");
  // What turns it may be an option's.
  if (turn.empty() && parts.hasAny("position latLonHeight direction target up euler heading")) camera.erase("rotation");
  return !turn.empty() || parts.has("euler");
}

/// The pose in the world of rectified pictures: R turns to their axes, and P = K [1 | t] has the same eye.
void placeRectified(const Parts& parts, Json& camera) {
  std::vector<double> all = parts.numbers("rectified", {12, 21});
  if (all.size() == 12) all.insert(all.begin(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  const std::span<const double> turn(all.data(), 9), p(all.data() + 9, 12);
  const Json rectified = cameraOfMatrix(parts["rectified"].nodes.back(), p, std::nullopt)["worldFromCamera"];
  setPose(camera, "worldFromCamera", {{"rotation", rowsOf(turn, 3)}, {"translation", rectified["translation"]}});
}

Json cameraOf(const Parts& parts, const PartsForm& form) {
  const auto size = parts.size();
  Json camera{{"convention", "opencv"}, {"position", {0, 0, 0}}, {"rotation", {0, 0, 0, 1}}};
  if (parts.has("P")) {
    for (const char* other :
         {"K", "fovX", "fovY", "focalLength", "position", "direction", "target", "up", "euler", "worldFromCamera"})
      if (parts.has(other)) parts.fail(other, "P says it too; leave one of them out");
    std::vector<double> p = parts.numbers("P", {12, 16});
    p.resize(12);
    const bool isInFront = parts.has("cameraFromWorld");
    camera = isInFront ? cameraBehind(parts.node("P"), p, size, chainOf(parts, "cameraFromWorld"))
                       : cameraOfMatrix(parts.node("P"), p, size);
  } else {
    if (parts.has("K")) camera["projection"] = projectionOfK(parts);
    for (const char* field : {"fovX", "fovY", "focalLength", "sensorWidth", "sensorHeight"})
      if (parts.has(field)) camera["projection"].update({{"type", "perspective"}, {field, parts.number(field)}});
    if (size) camera["viewport"] = {{"width", size->front()}, {"height", size->back()}};
    if (readPose(parts, camera) && form.cameraAxes != "RDF") camera["cameraAxes"] = form.cameraAxes;
  }
  if (parts.has("rectified")) placeRectified(parts, camera);
  for (const char* field : {"near", "far", "aspect"})
    if (parts.has(field)) camera["projection"][field] = parts.number(field);
  if (form.pixelCenter != 0) camera["viewport"]["pixelCenter"] = form.pixelCenter;
  readLens(parts, camera);
  return camera;
}

/// "; did you mean 'calib.fx'?", or what numbers the file has.
std::string nearPath(const Node& root, const std::string& path) {
  const std::vector<std::string> paths = pathsOfNumbers(root.json());
  const auto lastOf = [](const std::string& of) { return lettersOf(of.substr(of.rfind('.') + 1)); };
  for (const std::string& each : paths)
    if (lastOf(each) == lastOf(path)) return "; did you mean '" + visible(each) + "'?";
  if (const std::string_view near = nearestName(path, std::vector<std::string_view>(paths.begin(), paths.end()));
      !near.empty())
    return "; did you mean '" + visible(near) + "'?";
  constexpr std::size_t kMost = 8;
  return paths.empty() ? "" : "; it has " + visible(someOf(paths, kMost));
}

/// A line of parts in a file.
struct PartsLine {
  Node root;
  std::vector<Part> parts;
  PartsForm form;

  /// The parts of one camera. Throws InputError if one is missing or of another form.
  FoundParts find(const std::string& star) const {
    FoundParts found;
    for (const Part& part : parts) {
      auto value = cmd::find(root, part, star, isAmong(part.name, kTexts));
      const std::string path = withStar(part.value.front().front().paths.front().text, star);
      if (!value && !part.isOptional)
        root.fail(part.name + ": " + path + ": is not in the file" + nearPath(root, path));
      if (value) found.emplace(part.name, std::move(*value));
    }
    return found;
  }

  /// The camera of a star, called so unless the line has its name; what the line reads of it is marked. Nothing if its
  /// P is zeros, which stand for a camera that is absent.
  std::optional<CameraEntry> entry(const std::string& star, const std::string& name) const {
    CameraEntry camera{name, name == star ? "" : star};
    for (const Part& part : parts) {
      std::optional<Found> value;
      try {
        value = cmd::find(root, part, star, isAmong(part.name, kTexts));
      } catch (const InputError&) {  // is told when the camera is asked for
      }
      if (!value) continue;
      for (const Node& node : value->nodes) node.mark();
      if (part.name == "P" && !star.empty() && areZero(value->numbers)) return std::nullopt;
      if (part.name == "name") camera = {value->text, star};
      if (part.name == "id") camera.id = value->text;
    }
    return camera;
  }

  /// The segment that holds the star, of the first part that has one.
  std::string segment() const {
    for (const Part& part : parts)
      for (const Path* path : part.starredPaths()) {
        const std::string_view text = path->text;
        const std::size_t star = text.find('*'), begin = text.rfind('.', star) + 1;
        return std::string(text.substr(begin, text.find('.', star) - begin));
      }
    return "";
  }
};

}  // namespace

void requireNames(const std::vector<Part>& parts, const std::string& label, bool isRow) {
  for (const Part& part : parts) {
    const std::size_t dot = std::min(part.name.find('.'), part.name.size());
    const std::string first = part.name.substr(0, dot), form = part.name.substr(std::min(dot + 1, part.name.size()));
    if (dot == part.name.size() ? isAmong(first, kNames) || (isRow && isAmong(first, kNamesOfRows))
                                : isAmong(first, kPoseParts) && isAmong(form, kPoseForms))
      continue;
    std::vector<std::string> all;
    for (const std::string_view each : wordsIn(kNames)) all.emplace_back(each);
    for (const std::string_view pose : wordsIn(kPoseParts))
      for (const std::string_view turn : wordsIn(kPoseForms))
        all.push_back(std::string(pose) + "." + std::string(turn));
    throw UsageError(label + ": " + inQuotes(part.name) + " is no part" +
                     suggestion(part.name, std::vector<std::string_view>(all.begin(), all.end()), "help parts"));
  }
}

/// Items of two lists are joined by their place, which says nothing where one of the lists is shorter.
void requireOneLength(const Node& root, const std::vector<const Path*>& starred) {
  std::string first;
  std::size_t size = 0;
  for (const Path* path : starred) {
    const std::string list = path->text.substr(0, path->text.find('*'));
    const auto node = list.size() > 1 ? valueAt(root, list.substr(0, list.size() - 1)) : std::nullopt;
    if (!node || !node->json().is_array() || !list.ends_with('.')) continue;
    if (!first.empty() && node->json().size() != size)
      root.fail(first + "* has " + std::to_string(size) + " items and " + list + "* " +
                std::to_string(node->json().size()) + ", so that places do not tell which belong together");
    first = list;
    size = node->json().size();
  }
}

std::vector<CameraEntry> camerasOfParts(const Node& root, std::vector<Part> parts, PartsForm form,
                                        std::string_view names) {
  const auto line = std::make_shared<const PartsLine>(PartsLine{root, std::move(parts), form});
  std::vector<std::string> stars;
  std::unordered_set<std::string> known;
  std::vector<const Path*> starred;
  for (const Part& part : line->parts) {
    const auto paths = part.starredPaths();
    if (part.isOptional || part.name == "name" || paths.empty()) continue;
    starred.push_back(paths.front());
    for (std::string& star : starsOf(root, paths))
      if (known.insert(star).second) stars.push_back(std::move(star));
  }
  requireOneLength(root, starred);
  // "b_to_a" is a pose of b.
  std::erase_if(stars, [&](const std::string& star) {
    return known.contains(star.substr(0, star.find("_to_"))) && star.find("_to_") != std::string::npos;
  });
  if (starred.empty()) stars.emplace_back();
  if (stars.empty()) root.fail(starred.front()->text + ": is not in the file" + nearPath(root, starred.front()->text));
  const std::string pattern = names.empty() ? line->segment() : std::string(names);
  std::vector<CameraEntry> cameras;
  for (const std::string& star : stars) {
    auto camera = line->entry(star, withStar(pattern, star));
    if (!camera) continue;
    camera->document = [line, star] { return cameraOf(Parts(line->find(star), line->root), line->form); };
    cameras.push_back(std::move(*camera));
  }
  return cameras;
}

bool hasParts(const Node& root, const std::vector<Part>& parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const Part& part) {
    if (part.isOptional) return true;
    if (const auto paths = part.starredPaths(); !paths.empty()) return !starsOf(root, paths, 1).empty();
    try {
      return find(root, part, "", isAmong(part.name, kTexts)).has_value();
    } catch (const InputError&) {
      return true;
    }
  });
}

}  // namespace viewproj::cmd
