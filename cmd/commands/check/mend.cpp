#include "commands/check/mend.hpp"

#include <algorithm>
#include <cmath>

#include "camera/patch.hpp"
#include "camera/plain_camera.hpp"
#include "camera/write_camera.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kRounding = 1e-12;

std::string inShell(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,:/=+";
  return word.find_first_not_of(kPlain) == std::string::npos ? word : "'" + word + "'";
}

/// As --set reads it: "60", "60deg", "1,2,3", or JSON.
std::string textOf(const Json& value) {
  if (value.is_number()) return formatNumber(value.get<double>());
  const bool isList =
      value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& part) { return part.is_number(); });
  if (!isList) return value.is_string() ? value.get<std::string>() : value.dump();
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ",") + textOf(part);
  return text;
}

/// Numbers that have changed, with fewer digits. scale: of the numbers beside it, of which rounding is a part.
void roundChanged(Json& to, const Json* from, int digits, double scale = 0) {
  if (to.is_number_float()) {
    const double now = to.get<double>(), was = from && from->is_number() ? from->get<double>() : NAN;
    scale = kRounding * std::max(scale, std::fabs(now));
    if (std::fabs(now - was) <= scale)
      to = *from;
    else
      to = std::fabs(now) <= scale ? 0 : digits < 17 ? *parseNumber(formatDigits(now, digits)) : now;
  } else if (to.is_structured()) {
    double largest = scale;
    if (to.is_array())
      for (const Json& part : to)
        if (part.is_number()) largest = std::max(largest, std::fabs(part.get<double>()));
    if (to.is_object())
      for (const auto& [name, part] : to.items())
        roundChanged(part, from && from->is_object() && from->contains(name) ? &(*from)[name] : nullptr, digits);
    else
      for (std::size_t i = 0; i < to.size(); ++i)
        roundChanged(to[i], from && from->is_array() && i < from->size() ? &(*from)[i] : nullptr, digits, largest);
  }
}

/// Sets the shift, where the form of the projection is of a centred window. Whether it has one.
bool putShift(const CameraFile& file, Json& root, const Vec2& moved) {
  const Json* const type = valueAt(root, "projection.type");
  if (!type || (*type != "perspective" && *type != "orthographic") || valueAt(root, "projection.left")) return false;
  Json& fields = root["projection"];
  const double down = file.viewport->origin == Origin::topLeft ? 1 : -1;
  const Json old = fields.value("shift", Json{0, 0});
  const auto side = [&](const char* path) { return valueAt(root, path)->get<double>(); };
  fields["shift"] = {old[0].get<double>() + 2 * moved.x / side("viewport.width"),
                     old[1].get<double>() - 2 * down * moved.y / side("viewport.height")};
  return true;
}

double rmsOf(const PlainCamera& camera, const Hypothesis& h, std::span<const Pair> pairs,
             const std::vector<std::size_t>& wrong) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (std::find(wrong.begin(), wrong.end(), i) != wrong.end()) continue;
    const Vec2 at = pixelOf(camera, h.point(pairs[i].point)), given = h.pixels(pairs[i].pixel);
    squares += (at.x - given.x) * (at.x - given.x) + (at.y - given.y) * (at.y - given.y);
    count += 2;
  }
  return std::isfinite(squares) ? std::sqrt(squares / std::max(count, 1.0)) : HUGE_VAL;
}

/// The document with the numbers of a camera, in its own forms.
Document withCamera(const CameraFile& file, const PlainCamera& from, const PlainCamera& to) {
  CameraFile changing = file;
  changing.document = copied(file.document);
  if (angleOf(to.axes * transposed(from.axes)) > kRounding || to.eye != from.eye) {
    changing.document = withPose(file, poseOf(to));
    Json &root = *changing.document.root, &old = *file.document.root;
    for (const char* const name : {"heading", "roll"})  // within half a turn of the old one
      if (root.contains(name) && old.contains(name) && old[name].is_number()) {
        const double was = old[name].get<double>();
        root[name] = was + std::remainder(root[name].get<double>() - was, 360);
      }
  }
  Vec2 centre = to.centre;
  const Vec2 moved{centre.x - from.centre.x, centre.y - from.centre.y};
  const bool isScaled =
      std::fabs(to.focal.x / from.focal.x - 1) > kRounding || std::fabs(to.focal.y / from.focal.y - 1) > kRounding;
  const bool isMoved = std::max(std::fabs(moved.x), std::fabs(moved.y)) > 1e-9;
  const bool isSquare = std::fabs(to.focal.x * from.focal.y / (to.focal.y * from.focal.x) - 1) < 1e-9;
  const bool isShifted = isMoved && isSquare && putShift(file, *changing.document.root, moved);
  if (isShifted) centre = from.centre;
  if (isScaled || (isMoved && !isShifted)) {
    const Projection& own = *file.projection;
    Projection shown = frameProjection(file, {to.focal.x, std::fabs(to.focal.y), centre.x, centre.y},
                                       own.isOrthographic() ? 1 : own.zNear(), own.isOrthographic() ? 2 : own.zFar());
    if (own.isOrthographic())
      shown = orthographic(shown.left(), shown.right(), shown.bottom(), shown.top(), own.zNear(), own.zFar());
    changing.document = withProjection(changing, shown);
  }
  if (to.trial) {
    const auto& [k, p] = *to.trial;
    Json lens{{"model", "brown"}, {"k", {k[0], k[1], k[2]}}};
    while (lens["k"].size() > 1 && lens["k"].back() == 0) lens["k"].erase(lens["k"].size() - 1);
    if (p != std::array<double, 2>{}) lens["p"] = p;
    (*changing.document.root)["distortion"] = lens;
  }
  return changing.document;
}

/// The pixels' picture is so many times as wide and high: as another size of the viewport.
std::optional<std::vector<std::string>> otherSize(const CameraFile& file, const Vec2& times) {
  const auto side = [&](const char* path) { return valueAt(*file.document.root, path)->get<double>(); };
  if (!file.viewport || valueAt(*file.document.root, "viewport.crop")) return std::nullopt;
  const double width = side("viewport.width"), height = side("viewport.height");
  std::vector<std::string> sets{"viewport.width=" + formatNumber(std::round(width * times.x)),
                                "viewport.height=" + formatNumber(std::round(height * times.y))};
  if (valueAt(*file.document.root, "projection.fx")) {
    if (!valueAt(*file.document.root, "projection.pixels"))
      sets.push_back("projection.pixels=" + formatNumber(width) + "," + formatNumber(height));
  } else if (times.x != times.y && !valueAt(*file.document.root, "projection.aspect")) {
    sets.push_back("projection.aspect=" + formatNumber(width) + "/" + formatNumber(height));
  }
  return sets;
}

}  // namespace

std::string Mend::options() const {
  std::string text;
  for (const std::string& set : sets) text += (text.empty() ? "--set " : " --set ") + inShell(set);
  return text + (stretch ? " --allow-stretch" : "");
}

std::vector<Patch> Mend::patches() const {
  std::vector<Patch> patches;
  for (const std::string& set : sets) patches.push_back(setPatch(set));
  return patches;
}

Mend mendOf(const CameraFile& file, const Explanation& e, std::span<const Pair> pairs) {
  const Hypothesis& h = e.hypothesis;
  Mend mend{{}, h.stretch, h.pixels};
  for (const auto& [path, value] : h.sets) mend.sets.push_back(path + "=" + textOf(value));
  if (!h.isSolved) return mend;
  const double most = std::max(1.01 * e.rms, e.rms + 1e-4);
  const auto isEnough = [&](const Mend& tried, double limit) {
    const auto camera = plainWith(file, tried.patches(), tried.stretch);  // of so few digits there may be none
    return camera && rmsOf(*camera, h, pairs, e.wrong) <= limit;
  };
  const CameraFile base = h.sets.empty() ? file : changed(file, mend.patches(), h.stretch);
  const PlainCamera own = plainOf(makeCamera(base));
  // Words are the mend of a window that the document has no form for, and of another size but of whole numbers.
  const bool isWindow = h.camera.eye == own.eye && h.camera.axes == own.axes && !h.camera.trial;
  const auto inWords = [&] {
    const double x = own.focal.x / h.camera.focal.x, y = own.focal.y / h.camera.focal.y;
    if (isWindow)
      mend.pixels =
          PixelMap{x, 0, own.centre.x - x * h.camera.centre.x, 0, y, own.centre.y - y * h.camera.centre.y} * h.pixels;
    else
      mend.sets.clear();
    return mend;
  };
  if (h.scale != 1 && isWindow) {
    const Vec2 times{h.camera.focal.x / own.focal.x, h.camera.focal.y / own.focal.y};
    if (const auto sets = otherSize(file, times); sets && h.sets.empty())
      for (const bool stretch : {false, true})
        if (const Mend other{*sets, stretch, h.pixels}; isEnough(other, most)) return other;
    return inWords();
  }
  Document exact;
  try {
    exact = withCamera(base, own, h.camera);
  } catch (const InputError&) {
    return inWords();
  }
  for (int digits = 3; digits <= 17; ++digits) {
    const Document rounded = copied(exact);
    roundChanged(*rounded.root, base.document.root.get(), digits);
    Mend tried = mend;
    for (std::string& set : setsBetween(base.document, rounded)) tried.sets.push_back(std::move(set));
    if (isEnough(tried, digits < 17 ? most : 1.01 * e.rms + 1e-3)) return tried;
  }
  return inWords();
}

}  // namespace viewproj::cmd::mistakes
