// Mistakes of the pixels: each a map of the given pixels that mends them.
#include "commands/check/hypothesis.hpp"

namespace viewproj::cmd::mistakes {

void addPixelRows(Trials& t) {
  const auto [first, last] = t.corners();
  const auto [x0, y0] = first;
  const double w = last.x - x0, h = last.y - y0, xs = x0 + last.x, ys = y0 + last.y, cx = t.plain().centre.x;
  t.pixels("y-flipped", {1, 0, 0, 0, -1, ys});
  for (const double one : {-1.0, 1.0}) t.pixels("y-flipped-index", {1, 0, 0, 0, -1, ys + one});
  t.pixels("x-mirrored", {-1, 0, xs, 0, 1, 0}, "pixels");
  if (2 * cx != xs) t.pixels("x-mirrored", {-1, 0, 2 * cx, 0, 1, 0}, "pixels");
  for (const double one : {-1.0, 1.0}) t.pixels("x-mirrored", {-1, 0, xs + one, 0, 1, 0}, "pixels");
  for (const double half : {-0.5, 0.5}) t.pixels("pixel-centre", {1, 0, half, 0, 1, half});
  for (const double ratio : {1.25, 1.5, 2.0, 3.0, 1 / 1.25, 1 / 1.5, 0.5, 1 / 3.0}) {
    t.pixels("pixel-ratio", {1 / ratio, 0, 0, 0, 1 / ratio, 0}, ratio);
    if (t.viewport().pixelCenter != 0.5)
      t.pixels("pixel-ratio", {1 / ratio, 0, x0 - x0 / ratio, 0, 1 / ratio, y0 - y0 / ratio}, ratio);
  }
  // From low to 1 across the picture, or across the centres of its outer pixels, y downwards or upwards.
  for (const double low : {0.0, -1.0})
    for (const double inset : {0.0, 0.5})
      for (const double down : {1.0, -1.0}) {
        const double sx = (w - 2 * inset) / (1 - low), sy = down * (h - 2 * inset) / (1 - low);
        const double top = down > 0 ? y0 + inset : last.y - inset;
        t.pixels(low == 0 ? "normalized" : "ndc", {sx, 0, x0 + inset - sx * low, 0, sy, top - sy * low});
      }
  // As if both focal lengths were 1, without a lens, y downwards or upwards.
  PlainCamera pinhole = t.plain();
  pinhole.lens = std::nullopt;
  pinhole.lensOfFile = std::nullopt;
  const std::vector<Set> sets = t.has("distortion") ? std::vector<Set>{{"distortion", nullptr}} : std::vector<Set>{};
  const auto [fx, fy] = pinhole.focal;
  for (const double down : {fy, -fy})
    if (!pinhole.isOrthographic)
      t.add({.mistake = "image-coordinates",
             .camera = pinhole,
             .sets = sets,
             .pixels = {fx, 0, cx, 0, down, pinhole.centre.y}});
  // Of a picture with these sides, or with them exchanged; as positions or as indices.
  for (const double one : {0.0, -1.0, 1.0}) {
    t.pixels("picture-turned", {-1, 0, xs + one, 0, -1, ys + one}, 180);
    for (const auto& [side, other] : {std::pair(h, w), {w, h}}) {
      t.pixels("picture-turned", {0, 1, x0 - y0, -1, 0, x0 + y0 + side + one}, 90);
      t.pixels("picture-turned", {0, -1, x0 + y0 + other + one, 1, 0, y0 - x0}, 270);
    }
  }
  t.pixels("row-column", {0, 1, 0, 1, 0, 0});
  for (const double sign : {1.0, -1.0}) {
    const double a = w / (w + 2), b = h / (h + 2 * sign);
    t.pixels("ndc-twice", {a, 0, (x0 + w / 2) * (1 - a), 0, b, (y0 + h / 2) * (1 - b)});
  }
}

}  // namespace viewproj::cmd::mistakes
