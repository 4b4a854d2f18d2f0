#include "commands/check/mend.hpp"

#include <algorithm>
#include <cmath>

#include "camera/write_camera.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd::mistakes {
namespace {

constexpr double kRounding = 1e-12;
constexpr int kAllDigits = 17;

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

/// The document with the numbers of a camera, in its own forms. Throws InputError if it has none for them.
Document withCamera(CameraFile file, const PlainCamera& from, const PlainCamera& to) {
  if (angleOf(to.axes * transposed(from.axes)) > kRounding || to.eye != from.eye)
    file.document = withPose(file, poseOf(to));
  const Vec2 moved = to.centre - from.centre;
  const double larger = std::max(std::fabs(to.focal.x / from.focal.x - 1), std::fabs(to.focal.y / from.focal.y - 1));
  if (larger > kRounding || std::max(std::fabs(moved.x), std::fabs(moved.y)) > 1e-9) {
    const Projection& own = *file.projection;
    const bool isFlat = own.isOrthographic();
    const Projection p = frameProjection(file, {to.focal.x, std::fabs(to.focal.y), to.centre.x, to.centre.y},
                                         isFlat ? 1 : own.zNear(), isFlat ? 2 : own.zFar());
    file.document = withProjection(
        file, isFlat ? orthographic(p.left(), p.right(), p.bottom(), p.top(), own.zNear(), own.zFar()) : p);
  }
  const Document changed = copied(file.document);
  if (to.lens && to.lens != from.lens) {
    std::vector<double> k(to.lens->k.begin(), to.lens->k.end());
    while (k.size() > 1 && k.back() == 0) k.pop_back();
    Json lens{{"model", "brown"}, {"k", k}};
    if (to.lens->p != std::array<double, 2>{}) lens["p"] = to.lens->p;
    (*changed.root)["distortion"] = std::move(lens);
  }
  return changed;
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
  std::vector<Patch> patches;
  for (const std::string& set : mend.sets) patches.push_back(setPatch(set));
  const auto camera = plainWith(file, patches, mend.stretch);  // of too few digits there may be none
  if (!camera) return std::nullopt;
  h.camera = *camera;
  h.pixels = mend.pixels;
  return missesOf(h, pairs);
}

Mend mendOf(const CameraFile& file, const Explanation& e, std::span<const Pair> pairs) {
  const Hypothesis& h = e.hypothesis;
  const CameraFile base = changed(file, patchesOf(h.sets), h.stretch);
  const PlainCamera own = plainOf(makeCamera(base));
  const Vec2 times{h.camera.focal.x / own.focal.x, h.camera.focal.y / own.focal.y};
  const bool isPose = h.camera.eye != own.eye || h.camera.axes != own.axes || h.camera.lens != own.lens;
  const Mend ofFields{setsBetween(file.document, base.document), h.stretch, h.pixels};
  if (!isPose && times == Vec2{1, 1} && h.camera.centre == own.centre) return ofFields;
  const double most = std::max(1.01 * e.rms, e.rms + 1e-4);
  if (!h.isResized) {
    try {
      const Document exact = withCamera(base, own, h.camera);
      for (int digits = 3; digits <= kAllDigits; ++digits) {
        const Document rounded = copied(exact);
        roundChanged(*rounded.root, *base.document.root, digits);
        Mend tried{setsBetween(file.document, rounded), h.stretch, h.pixels};
        if (rmsWith(file, tried, e, pairs) > (digits < kAllDigits ? most : 1.01 * e.rms + 1e-3)) continue;
        for (std::size_t i = tried.sets.size(); i-- > 0;) {  // what changes nothing
          Mend fewer = tried;
          fewer.sets.erase(fewer.sets.begin() + static_cast<std::ptrdiff_t>(i));
          if (rmsWith(file, fewer, e, pairs) <= most) tried = fewer;
        }
        return tried;
      }
    } catch (const InputError&) {
    }
    if (isPose) return {{}, h.stretch, h.pixels};
  } else if (h.sets.empty()) {
    for (const bool stretch : {false, true})
      if (const Mend tried{otherSize(file, times), stretch, h.pixels}; rmsWith(file, tried, e, pairs) <= most)
        return tried;
  }
  // Words are the mend of a window that the document has no form for, and of another size but of whole numbers.
  const auto [x, y] = h.camera.centre;
  const PixelMap pixels{1 / times.x, 0, own.centre.x - x / times.x, 0, 1 / times.y, own.centre.y - y / times.y};
  return {ofFields.sets, h.stretch, pixels * h.pixels};
}

}  // namespace viewproj::cmd::mistakes
