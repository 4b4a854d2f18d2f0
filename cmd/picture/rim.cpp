#include "picture/rim.hpp"

#include "picture/flat.hpp"

namespace viewproj::cmd {

Rim::Rim(const Camera& camera) : camera_(camera) {
  const auto [first, last] = pictureCorners(camera.viewport());
  const bool fromTop = camera.viewport().origin == Origin::topLeft;
  topLeft_ = {first.x, fromTop ? first.y : last.y};
  bottomRight_ = {last.x, fromTop ? last.y : first.y};
}

Vec2 Rim::corner(int which, double in) const {
  const bool isRight = which % 4 == 1 || which % 4 == 2, isBottom = which % 4 > 1;
  const double down = topLeft_.y < bottomRight_.y ? in : -in;
  return {isRight ? bottomRight_.x - in : topLeft_.x + in, isBottom ? bottomRight_.y - down : topLeft_.y + down};
}

Rim::Place Rim::at(double s) const {
  constexpr int kHalvings = 50;
  const auto rayAt = [&](const Vec2& pixel) { return screenToRay(camera_, pixel); };
  const auto isRay = [](const Ray& ray) { return std::isfinite(ray.direction.x); };
  const int side = static_cast<int>(s);
  const Vec2 pixel = between(corner(side), corner(side + 1), s - side);
  if (const Ray ray = rayAt(pixel); isRay(ray)) return {pixel, ray};
  double inside = 0, outside = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = (inside + outside) / 2;
    (isRay(rayAt(between(center(), pixel, t))) ? inside : outside) = t;
  }
  const Vec2 end = between(center(), pixel, inside);
  return {end, rayAt(end), true};
}

}  // namespace viewproj::cmd
