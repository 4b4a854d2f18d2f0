#include "commands/check/mend.hpp"

#include <algorithm>
#include <cmath>

#include "camera/write_camera.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kRounding = 1e-12;
constexpr int kAllDigits = 17;

std::string inShell(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,:/=+";
  return word.find_first_not_of(kPlain) == std::string::npos ? word : "'" + word + "'";
}

/// As --set reads it: "60", "60deg", "1,2,3", or JSON.
std::string textOf(const Json& value) {
  if (value.is_number()) return formatNumber(value);
  const bool isList =
      value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& part) { return part.is_number(); });
  if (!isList) return value.is_string() ? value.get<std::string>() : value.dump();
  std::string text;
  for (const Json& part : value) text += (text.empty() ? "" : ",") + textOf(part);
  return text;
}

/// Numbers that have changed, with fewer digits. scale: of the numbers beside it, of which rounding is a part.
void roundChanged(Json& to, const Json& from, int digits, double scale = 0) {
  if (to.is_array())
    for (const Json& part : to)
      if (part.is_number()) scale = std::max(scale, std::fabs(part.get<double>()));
  if (to.is_structured())
    for (const auto& [key, part] : to.items()) {
      const auto at = Json::json_pointer() / key;
      roundChanged(part, from.contains(at) ? from[at] : Json(), digits, to.is_array() ? scale : 0);
    }
  if (!to.is_number_float()) return;
  const double now = to, was = from.is_number() ? from.get<double>() : NAN;
  const double rounding = kRounding * std::max(scale, std::fabs(now));
  if (std::fabs(now - was) <= rounding)
    to = from;
  else
    to = std::fabs(now) <= rounding ? 0 : toDigits(now, digits);
}

/// Shifts the window, where the form of the projection is of a centred one. Whether it has one.
bool putShift(const CameraFile& file, Json& root, const Vec2& pixels) {
  const Json* const type = valueAt(root, "projection.type");
  if (!type || (*type != "perspective" && *type != "orthographic") || valueAt(root, "projection.left")) return false;
  Json& fields = root["projection"];
  const double down = file.viewport->origin == Origin::topLeft ? 1 : -1;
  const auto [x, y] = fields.value("shift", std::array<double, 2>{});
  fields["shift"] = {x + 2 * pixels.x / root["viewport"]["width"].get<double>(),
                     y - 2 * down * pixels.y / root["viewport"]["height"].get<double>()};
  return true;
}

/// The document with the numbers of a camera, in its own forms. Throws InputError if it has none for them.
Document withCamera(const CameraFile& file, const PlainCamera& from, const PlainCamera& to) {
  CameraFile changing = file;
  changing.document = copied(file.document);
  if (angleOf(to.axes * transposed(from.axes)) > kRounding || to.eye != from.eye) {
    changing.document = withPose(file, poseOf(to));
    Json &root = *changing.document.root, &old = *file.document.root;
    for (const char* const name : {"heading", "roll"})  // within half a turn of the old one
      if (root.contains(name) && old.contains(name) && old[name].is_number()) {
        const double was = old[name];
        root[name] = was + std::remainder(root[name].get<double>() - was, 360);
      }
  }
  const Vec2 times{to.focal.x / from.focal.x, to.focal.y / from.focal.y}, moved = to.centre - from.centre;
  Vec2 centre = to.centre;
  bool isMoved = std::max(std::fabs(moved.x), std::fabs(moved.y)) > 1e-9;
  if (isMoved && std::fabs(times.x / times.y - 1) < 1e-9 && putShift(file, *changing.document.root, moved)) {
    centre = from.centre;
    isMoved = false;
  }
  if (isMoved || std::max(std::fabs(times.x - 1), std::fabs(times.y - 1)) > kRounding) {
    const Projection& own = *file.projection;
    const bool isFlat = own.isOrthographic();
    Projection shown = frameProjection(file, {to.focal.x, std::fabs(to.focal.y), centre.x, centre.y},
                                       isFlat ? 1 : own.zNear(), isFlat ? 2 : own.zFar());
    if (isFlat) shown = orthographic(shown.left(), shown.right(), shown.bottom(), shown.top(), own.zNear(), own.zFar());
    changing.document = withProjection(changing, shown);
  }
  if (to.trial) {
    std::vector<double> k(to.trial->k.begin(), to.trial->k.end());
    while (k.size() > 1 && k.back() == 0) k.pop_back();
    Json& lens = (*changing.document.root)["distortion"] = {{"model", "brown"}, {"k", k}};
    if (to.trial->p != std::array<double, 2>{}) lens["p"] = to.trial->p;
  }
  return changing.document;
}

/// The picture is so many times as wide and high: as another size of the viewport. Empty where it has no such form.
std::vector<std::string> otherSize(const CameraFile& file, const Vec2& times) {
  const auto has = [&](const char* path) { return valueAt(*file.document.root, path) != nullptr; };
  if (!has("viewport") || has("viewport.crop")) return {};
  const Json& viewport = (*file.document.root)["viewport"];
  const double width = viewport["width"], height = viewport["height"];
  std::vector<std::string> sets{"viewport.width=" + formatNumber(std::round(width * times.x)),
                                "viewport.height=" + formatNumber(std::round(height * times.y))};
  if (has("projection.fx") && !has("projection.pixels"))
    sets.push_back("projection.pixels=" + formatNumber(width) + "," + formatNumber(height));
  if (!has("projection.fx") && times.x != times.y && !has("projection.aspect"))
    sets.push_back("projection.aspect=" + formatNumber(width) + "/" + formatNumber(height));
  return sets;
}

std::vector<Patch> patchesOf(const Mend& mend) {
  std::vector<Patch> patches;
  for (const std::string& set : mend.sets) patches.push_back(setPatch(set));
  return patches;
}

/// Of the pairs that the explanation is of, by component.
double rmsWith(const CameraFile& file, const Mend& mend, const Explanation& e, std::span<const Pair> pairs) {
  const auto misses = missesWith(file, mend, e.hypothesis, pairs);
  double squares = 0, count = 0;
  for (std::size_t i = 0; misses && i < pairs.size(); ++i) {
    if (std::find(e.wrong.begin(), e.wrong.end(), pairs[i].line) != e.wrong.end()) continue;
    squares += (*misses)[i].x * (*misses)[i].x + (*misses)[i].y * (*misses)[i].y;
    count += 2;
  }
  return misses && std::isfinite(squares) ? std::sqrt(squares / count) : HUGE_VAL;
}

}  // namespace

std::string Mend::options() const {
  std::string text;
  for (const std::string& set : sets) text += (text.empty() ? "--set " : " --set ") + inShell(set);
  return text + (stretch ? " --allow-stretch" : "");
}

std::optional<std::vector<Vec2>> missesWith(const CameraFile& file, const Mend& mend, Hypothesis h,
                                            std::span<const Pair> pairs) {
  const auto camera = plainWith(file, patchesOf(mend), mend.stretch);  // of too few digits there may be none
  if (!camera) return std::nullopt;
  h.camera = *camera;
  h.pixels = mend.pixels;
  return missesOf(h, pairs);
}

Mend mendOf(const CameraFile& file, const Explanation& e, std::span<const Pair> pairs) {
  const Hypothesis& h = e.hypothesis;
  Mend mend{{}, h.stretch, h.pixels};
  for (const auto& [path, value] : h.sets) mend.sets.push_back(path + "=" + textOf(value));
  const CameraFile base = h.sets.empty() ? file : changed(file, patchesOf(mend), h.stretch);
  const PlainCamera own = plainOf(makeCamera(base));
  const double most = std::max(1.01 * e.rms, e.rms + 1e-4);
  const Vec2 times{h.camera.focal.x / own.focal.x, h.camera.focal.y / own.focal.y};
  const bool isPose = h.camera.eye != own.eye || h.camera.axes != own.axes || h.camera.trial;
  if (!isPose && times == Vec2{1, 1} && h.camera.centre == own.centre) return mend;
  if (h.scale != 1 && !isPose && h.sets.empty())
    for (const bool stretch : {false, true})
      if (const Mend other{otherSize(file, times), stretch, h.pixels};
          !other.sets.empty() && rmsWith(file, other, e, pairs) <= most)
        return other;
  if (h.scale == 1 || isPose) try {
      const Document exact = withCamera(base, own, h.camera);
      for (int digits = 3; digits <= kAllDigits; ++digits) {
        const Document rounded = copied(exact);
        roundChanged(*rounded.root, *base.document.root, digits);
        Mend tried = mend;
        for (std::string& set : setsBetween(base.document, rounded)) tried.sets.push_back(std::move(set));
        if (rmsWith(file, tried, e, pairs) <= (digits < kAllDigits ? most : 1.01 * e.rms + 1e-3)) return tried;
      }
    } catch (const InputError&) {
    }
  // Words are the mend of a window that the document has no form for, and of another size but of whole numbers.
  if (isPose)
    mend.sets.clear();
  else
    mend.pixels = PixelMap{1 / times.x, 0,           own.centre.x - h.camera.centre.x / times.x,
                           0,           1 / times.y, own.centre.y - h.camera.centre.y / times.y} *
                  h.pixels;
  return mend;
}

}  // namespace viewproj::cmd::mistakes
