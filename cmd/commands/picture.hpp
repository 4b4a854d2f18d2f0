// An SVG of what a camera sees.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viewproj/lens.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {

class Picture {
 public:
  explicit Picture(const Camera& camera);

  const Camera& camera() const { return camera_; }

  /// Each under its label. What does not lie in the view is left out, and counted.
  void add(const std::string& label, const Vec4& point);
  void add(const std::string& label, const std::array<Vec3, 2>& segment);
  void add(const std::string& label, const Box& box);
  void add(const std::string& label, const Triangle& triangle);
  void add(const std::string& label, const Sphere& sphere) { addSilhouette(label, sphere, 1); }
  void add(const std::string& label, const Ellipsoid& ellipsoid);
  /// A mark on the picture, whatever lies there.
  void addPixel(const std::string& label, const Vec2& pixel);

  std::string svg(const std::string& title) const;

 private:
  /// Of a sphere whose z is stretched.
  void addSilhouette(const std::string& label, const Sphere& sphere, double stretch);
  /// The lines from each point to the next, and back to the first. middle: where the label stands, where that is in
  /// view.
  void addRound(const std::string& label, const Vec3& middle, std::span<const Vec3> points);
  void addPath(const std::string& label, const Vec2& middle, const std::string& path);
  /// What the picture shows of a segment, on the sheet: points of it; NaN where it is out of the picture between two.
  std::vector<Vec2> lineOf(const Vec3& a, const Vec3& b) const;
  /// Through a lens that bends it.
  std::vector<Vec2> bentLineOf(const Vec3& a, const Vec3& b) const;
  static std::string pathOf(const std::vector<Vec2>& line);
  Vec2 onSheet(const Vec2& screen) const;
  /// Where a point is seen on the sheet; NaN where it is not.
  Vec2 placeOf(const Vec4& point) const;
  std::string textBeside(const Vec2& at, const std::string& label, const char* style) const;

  Camera camera_;
  std::optional<Frustum> frustum_;  ///< of a camera without distortion
  double scale_;
  std::string shapes_, points_, pixels_;
  std::size_t added_ = 0, seen_ = 0;
};

}  // namespace viewproj::cmd
