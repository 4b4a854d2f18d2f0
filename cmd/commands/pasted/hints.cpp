// What a name, or the lines in front of a matrix, say of its kind.
#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "commands/pasted/readings.hpp"
#include "formats/words.hpp"
#include "text/number.hpp"
#include "text/pasted_parts.hpp"

namespace viewproj::cmd {
namespace {

using pasted::isOneOf;
struct Word {
  std::string text;
  bool isApart = false;  ///< behind a blank or a mark, and no part of one name with the word before
};
using Words = std::vector<Word>;
constexpr std::size_t kMostText = 1 << 16;  ///< in which sizes and angles are sought

/// In lower case: worldToCamera, world2camera and "World to camera" are world, to or 2, camera. A word of its own is
/// the end of a clause.
Words wordsOf(std::string_view text) {
  Words words(1);
  bool isApart = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], last = i > 0 ? text[i - 1] : ' ', next = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool isUpper = c >= 'A' && c <= 'Z', isPart = isLetter(c) || isDigit(c);
    const bool begins = (isUpper && ((last >= 'a' && last <= 'z') || isDigit(last))) ||
                        (c == '2' && isLetter(last) && isLetter(next)) || (words.back().text == "2" && isLetter(c));
    const bool isEnd = pasted::isAmong(c, ".,;:!?");
    if ((!isPart || begins) && !words.back().text.empty()) words.emplace_back();
    isApart = isPart ? isApart : !pasted::isAmong(c, "_-");
    if (isPart && words.back().text.empty()) words.back().isApart = std::exchange(isApart, false);
    if (isPart) words.back().text += isUpper ? static_cast<char>(c - 'A' + 'a') : c;
    if (isEnd) words.insert(words.end() - 1, {"."});
  }
  return words;
}

/// A transform from one frame to another, and how many words name it.
struct Frames {
  std::string_view from, to;
  std::size_t words = 0;
  bool isOfVision = false;  ///< in the notation of robotics and computer vision
};

std::string_view withoutDigits(std::string_view w) { return w.substr(0, w.find_last_not_of("0123456789") + 1); }

bool isCamera(std::string_view w) { return isOneOf(withoutDigits(w), {"c", "cam", "camera", "view", "eye"}); }
bool isSensor(std::string_view w) { return isOneOf(withoutDigits(w), {"s", "sensor"}); }
bool isClip(std::string_view w) { return isOneOf(w, {"clip", "ndc"}); }
bool isRobot(std::string_view w) {
  return isSensor(w) || isOneOf(withoutDigits(w), {"imu", "body", "ego", "velo", "lidar", "base", "b", "i"});
}
bool isUsualFrame(std::string_view w) {
  return isCamera(w) || isRobot(w) || isOneOf(w, {"w", "world", "g", "l", "m", "o", "v"});
}
bool isFrame(std::string_view w) {
  return !w.empty() && isLetter(w[0]) && !isOneOf(w, {"to", "from", "t", "the", "a", "of", "in", "is"});
}

/// World to camera, cam_from_world, T_WC, T_imu_cam, body_T_cam, wTc, Twc.
Frames framesAt(const Words& words, std::size_t at) {
  const auto word = [&](std::size_t i) { return at + i < words.size() ? std::string_view(words[at + i].text) : ""; };
  const auto isApart = [&](std::size_t i) { return at + i < words.size() && words[at + i].isApart; };
  const std::string_view first = word(0), second = word(1), third = word(2);
  if (isFrame(first) && isFrame(third)) {
    const bool isOfRobots = isRobot(first) || isRobot(third);
    if (isOneOf(second, {"to", "2"})) return {first, third, 3, isOfRobots || (first == "w" && second == "2")};
    if (second == "from") return {third, first, 3, isOfRobots};
    // Of "p T_cam_world" p is a debugger's command: one name has the same marks between all its words.
    if (second == "t" && isApart(1) == isApart(2) && (!isApart(1) || isUsualFrame(first)))
      return {third, first, 3, true};
  }
  if (isFrame(first) && !isApart(1) && second.size() > 1 && second[0] == 't' && isUsualFrame(second.substr(1)))
    return {second.substr(1), first, 2, true};
  if (first == "t" && isFrame(second) && isFrame(third)) return {third, second, 3, true};
  if (first == "t" && second.size() == 2) return {second.substr(1), second.substr(0, 1), 2, true};
  if (first.size() == 3 && first[0] == 't' && isUsualFrame(first.substr(1, 1)) && isUsualFrame(first.substr(2)))
    return {first.substr(2), first.substr(1, 1), 1, true};
  return {};
}

/// The word for the matrix that maps between two frames, or an empty one.
std::string_view kindWord(const Frames& f) {
  if (isClip(f.to)) return isCamera(f.from) ? "_proj" : "_viewproj";
  if (isClip(f.from)) return isCamera(f.to) ? "_proj_inverse" : "_viewproj_inverse";
  if (isCamera(f.from) != isCamera(f.to)) return isCamera(f.from) ? "_pose" : "_view";
  if (isSensor(f.from) != isSensor(f.to)) return isSensor(f.from) ? "_pose" : "_view";
  return !isCamera(f.from) && isOneOf(f.to, {"world", "w", "global", "map"}) ? "_pose" : "";
}

/// _ stands before each word, and after one that must end there.
struct KindWords {
  ReadingKind kind;
  std::string_view words;
};

/// Of two that end at the same place the first counts.
constexpr KindWords kKindWords[] = {
    {ReadingKind::viewProjection, "_viewproj _view_proj _proj_view _projection_view _projection_matrix_view"},
    {ReadingKind::viewProjection, "_mvp_ _wvp_ _vp_ _full_proj _culling"},
    {ReadingKind::pose, "_pose _matrix_world _eye_transform _eyetransform"},
    {ReadingKind::view, "_extrin _look_at _lookat _world_view _view _r_t_"},
    {ReadingKind::projection, "_proj _persp _frustum _ortho"},
    {ReadingKind::k, "_intrin _camera_matrix _mtx_ _linemod _calib"},
    {ReadingKind::rotation, "_rot"}};
/// Letters are names, and no words of prose.
constexpr KindWords kKindLetters[] = {{ReadingKind::k, "_k_"},
                                      {ReadingKind::rotation, "_r_"},
                                      {ReadingKind::view, "_v_ _mv_ _rt_"},
                                      {ReadingKind::projection, "_p_"}};
/// What an object has too.
constexpr KindWords kWeakWords[] = {{ReadingKind::pose, "_world_matrix _model _transform _root"},
                                    {ReadingKind::view, "_modelview"}};
constexpr double kWeakly = 3;

ReadingKind inverted(ReadingKind kind) {
  using enum ReadingKind;
  return kind == view             ? pose
         : kind == pose           ? view
         : kind == projection     ? projectionInverse
         : kind == viewProjection ? viewProjectionInverse
                                  : kind;
}

/// The kind that the last known word speaks of, inverted where a word says so: of a name any, else one beside it.
KindHint lastHint(std::string_view text, std::initializer_list<std::span<const KindWords>> lists, bool isName) {
  KindHint hint;
  std::size_t begin = 0, end = 0;
  for (const auto& list : lists)
    for (const auto& [kind, words] : list)
      for (std::size_t first = 0, after = 0; after < words.size(); first = after + 1) {
        after = std::min(words.find(' ', first), words.size());
        const std::size_t at = text.rfind(words.substr(first, after - first)), size = after - first;
        if (at == text.npos || at + size <= end) continue;
        begin = at;
        end = at + size;
        hint.kind = kind;
      }
  constexpr std::size_t kBeside = 16;  // "inverse of the"
  if (!isName) {
    const std::size_t first = begin - std::min(begin, kBeside);
    text = text.substr(first, end + kBeside - first);
    begin -= first;
  }
  if (hint.kind && (text.find("_inv") != text.npos || text.substr(0, begin).ends_with("_i")))
    hint.kind = inverted(*hint.kind);
  return hint;
}

KindHint hintIn(std::string_view text, bool isName) {
  const Words words = wordsOf(text);
  std::string joined;
  bool isOfVision = false;
  for (std::size_t i = 0; i < words.size();) {
    const Frames frames = framesAt(words, i);
    const std::string_view kind = frames.words > 0 ? kindWord(frames) : "";
    isOfVision = isOfVision || (!kind.empty() && frames.isOfVision);
    const std::string& word = words[i].text;
    const bool isOther = isOneOf(word, {"viewport", "viewer", "viewing", "viewpoint"}) ||
                         (i > 0 && word == "view" && words[i - 1].text == "of") ||
                         (i > 0 && word == "mtx" && words[i - 1].text == "rot");
    if (!kind.empty())
      joined += kind;
    else if (!isOther)
      joined += "_" + word;
    i += kind.empty() ? 1 : frames.words;
  }
  joined += "_";
  KindHint hint = isName ? lastHint(joined, {kKindWords, kKindLetters}, true) : lastHint(joined, {kKindWords}, false);
  hint.weight = kSpoken;
  if (!hint.kind) {
    hint = lastHint(joined, {kWeakWords}, isName);
    hint.weight = kWeakly;
  }
  const auto has = [&](std::initializer_list<const char*> all) {
    return std::any_of(all.begin(), all.end(), [&](const char* word) { return joined.find(word) != joined.npos; });
  };
  // w2c is OpenCV's, as camera libraries of neural rendering write it; 3DGS has it transposed as world_view_transform.
  hint.isTransposed = has({"_world_view_transform", "_full_proj_transform"});
  isOfVision = isOfVision || hint.isTransposed || has({"_extrin", "_rvec", "_tvec", "_opencv", "_colmap", "_kalibr"});
  if (has({"_simd", "_arkit", "_arframe", "_arcamera", "_bpy", "_matrix_world", "_opengl"})) hint.axes = ViewAxes::RUB;
  if (has({"_d3d", "_d3_d", "_directx", "_xmm", "_xmfloat", "_log_temp", "_f_matrix"})) hint.axes = ViewAxes::RUF;
  if (isOfVision) hint.axes = ViewAxes::RDF;
  return hint;
}

}  // namespace

KindHint hintOf(const PastedMatrix& m) {
  KindHint around = hintIn(m.context, false);
  for (const char* mark : {"<Matrix ", " O: (", "matrix3 ["})
    if (m.context.find(mark) != std::string::npos)
      return {ReadingKind::pose, kSpoken, around.axes.value_or(ViewAxes::RUB)};
  constexpr std::size_t kMost = 300;
  const std::string_view name = std::string_view(m.name).substr(0, kMost);
  std::size_t part = 0;  // transform of scene.camera.transform
  for (std::size_t i = 1; i + 1 < name.size(); ++i)
    if (name[i] == '.' && (isLetter(name[i + 1]) || name[i + 1] == '_') && name[i - 1] != ' ') part = i + 1;
  for (const std::string_view text : {name.substr(part), name})
    if (KindHint hint = hintIn(text, true); hint.kind) {
      if (!hint.axes) hint.axes = around.axes;
      return hint;
    }
  return around;
}

std::string fovIn(const std::string& text) {
  const std::string front = lowered(std::string_view(text).substr(0, kMostText));
  constexpr std::string_view kDigits = "0123456789";
  for (const std::string_view name : {"fov", "field of view", "fieldofview", "field_of_view"}) {
    const std::size_t at = front.find(name);
    if (at == front.npos) continue;
    std::string_view rest = std::string_view(front).substr(at + name.size());
    const bool isAcross = (at > 0 && front[at - 1] == 'h') || rest.starts_with("x") || rest.starts_with("_x");
    constexpr std::size_t kFar = 24;  // marks and words between, on this line or the next
    const std::size_t first = rest.find_first_of(kDigits);
    if (first > kFar) continue;
    rest.remove_prefix(first);
    const auto degrees = parseNumber(rest.substr(0, rest.find_first_not_of("0123456789.")));
    if (degrees && *degrees >= kNarrowFov && *degrees < 180)
      return (isAcross ? " --fov-x " : " --fov-y ") + formatNumber(*degrees);
  }
  return " --fov-y DEGREES";
}

std::optional<Vec2> sizeIn(const std::string& text, const std::optional<Vec2>& middle, double aspect) {
  constexpr double kMiddle = 0.2, kSquare = 2e-3, kLeast = 16, kMost = 65535;
  const auto fits = [&](double width, double height) {
    if (middle)
      return std::fabs(2 * middle->x - width) < kMiddle * width && std::fabs(2 * middle->y - height) < kMiddle * height;
    return std::min(width, height) >= 100 && std::fabs(width / height - aspect) < kSquare * aspect;
  };
  // Two whole numbers in a row, "1920x1080" among them.
  std::set<std::pair<double, double>> sizes;
  double before = 0;
  for (const std::string_view word : partsOf(std::string_view(text).substr(0, kMostText), " \t\r\n,;*()[]{}:=<>|\"'"))
    for (const std::string_view part : isDigit(word.front()) ? partsOf(word, "x") : std::vector{word}) {
      const double number = parseNumber(part).value_or(0);
      const bool isSide = number == std::floor(number) && number >= kLeast && number <= kMost;
      if (isSide && fits(before, number))
        sizes.emplace(before, number);
      else if (isSide && fits(number, before))
        sizes.emplace(number, before);
      before = isSide ? number : 0;
    }
  if (sizes.size() != 1) return std::nullopt;
  return Vec2{sizes.begin()->first, sizes.begin()->second};
}

std::string viewportOption(const std::optional<Vec2>& size) {
  return " --viewport " + (size ? formatNumber(size->x) + "x" + formatNumber(size->y) : "WIDTHxHEIGHT");
}

bool countsFromOne(const PastedMatrix& m) {
  return !m.isByColumns && (m.context + m.name).find("IntrinsicMatrix") != std::string::npos;
}

}  // namespace viewproj::cmd
