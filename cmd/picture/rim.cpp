#include "picture/rim.hpp"

#include <numbers>

#include "camera/plain_vectors.hpp"
#include "picture/flat.hpp"

namespace viewproj::cmd {
namespace {

constexpr double kPi = std::numbers::pi;

bool isRight(int corner) { return corner % 4 == 1 || corner % 4 == 2; }
bool isBottom(int corner) { return corner % 4 > 1; }
double length(const Vec2& a) { return std::hypot(a.x, a.y); }
double clampBetween(double a, double b) { return std::clamp(0.0, std::min(a, b), std::max(a, b)); }

}  // namespace

Rim::Rim(const Camera& camera) : camera_(camera), lens_(lensOf(camera)) {
  const auto [first, last] = pictureCorners(camera.viewport());
  const bool fromTop = camera.viewport().origin == Origin::topLeft;
  topLeft_ = {first.x, fromTop ? first.y : last.y};
  bottomRight_ = {last.x, fromTop ? last.y : first.y};
  if (!lens_) return;
  constexpr double kWithin = 0x1p-45;  // at the end itself nothing is seen
  const double widest = lens_->model() == LensModel::brown ? 90 : 180;
  const double angle = std::min(lens_->limitDegrees(), widest) * kPi / 180 - kWithin;
  sine_ = std::sin(angle);
  cosine_ = std::cos(angle);
  const Vec2 a = cornerOnPlane(0), b = cornerOnPlane(2);
  inmost_ = {clampBetween(a.x, b.x), clampBetween(a.y, b.y)};
  turnOfInmost_ = turnTowards(inmost_);
  isBlind_ = length(inmost_) > length(endAt(turnOfInmost_));
}

Vec2 Rim::corner(int which, double in) const {
  const double down = topLeft_.y < bottomRight_.y ? in : -in;
  return {isRight(which) ? bottomRight_.x - in : topLeft_.x + in,
          isBottom(which) ? bottomRight_.y - down : topLeft_.y + down};
}

Vec2 Rim::cornerOnPlane(int which) const {
  const Projection window = camera_.projection();
  return {isRight(which) ? window.right() : window.left(), isBottom(which) ? -window.bottom() : -window.top()};
}

Vec3 Rim::lastDirection(double turn) const { return {sine_ * std::cos(turn), sine_ * std::sin(turn), cosine_}; }

Vec2 Rim::endAt(double turn) const { return distorted(*lens_, lastDirection(turn)); }

/// By false position (Illinois).
double Rim::turnOnLine(const Vec2& from, const Vec2& to, double low, double high) const {
  constexpr int kSteps = 60;
  constexpr double kLeast = 0x1p-51;
  const Vec2 way = sum(to, -1, from);
  const double least = kLeast * length(way);
  const auto aside = [&](double turn) {
    const Vec2 end = sum(endAt(turn), -1, from);
    const double off = way.x * end.y - way.y * end.x;
    return std::fabs(off) > least * length(end) ? off : 0;
  };
  double atLow = aside(low), atHigh = aside(high), turn = low;
  if (atLow == 0) return low;
  const bool isBetween = (atLow < 0) != (atHigh < 0);  // else they are one turn
  for (int i = 0; i < kSteps && isBetween && atHigh != 0; ++i) {
    turn = high - atHigh * (high - low) / (atHigh - atLow);
    const double at = aside(turn);
    if (at == 0) return turn;
    if ((at < 0) != (atHigh < 0))
      low = high, atLow = atHigh;
    else
      atLow /= 2;
    high = turn;
    atHigh = at;
  }
  return high;
}

/// The lens is the gradient of something convex, so that no direction is turned by a quarter or more.
double Rim::turnTowards(const Vec2& to) const {
  const double turn = std::atan2(to.y, to.x);
  return turnOnLine({}, to, turn - kPi / 2, turn + kPi / 2);
}

/// What lies beyond the end of the lens is found forwards: the lens has no inverse there.
Rim::Place Rim::at(double s) const {
  constexpr double kClearly = 1 + 1e-9;
  const int side = static_cast<int>(s);
  const Vec2 pixel = between(corner(side), corner(side + 1), s - side);
  if (!lens_) return {pixel, screenToRay(camera_, pixel)};
  const Vec2 to = between(cornerOnPlane(side), cornerOnPlane(side + 1), s - side);
  double turn = turnTowards(to);
  if (isBlind_ || !(length(to) > kClearly * length(endAt(turn))))
    if (const Ray ray = screenToRay(camera_, pixel); isBlind_ || std::isfinite(ray.direction.x)) return {pixel, ray};
  if (length(inmost_) > 0) turn = turnOnLine(inmost_, to, turn - std::remainder(turn - turnOfInmost_, 2 * kPi), turn);
  const Vec2 end = endAt(turn), first = cornerOnPlane(0), last = cornerOnPlane(2);
  const Vec3 way = lastDirection(turn);
  const Pose pose = camera_.pose();
  return {{topLeft_.x + (end.x - first.x) / (last.x - first.x) * (bottomRight_.x - topLeft_.x),
           topLeft_.y + (end.y - first.y) / (last.y - first.y) * (bottomRight_.y - topLeft_.y)},
          {pose.eye(), sum(sum(scaled(pose.forward(), way.z), way.x, pose.right()), -way.y, pose.up())},
          true};
}

}  // namespace viewproj::cmd
