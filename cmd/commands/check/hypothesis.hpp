// What may be wrong: a changed camera, a map of the points, or a map of the pixels. Rows have no free number; families
// have a few, found by least squares.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "camera/patch.hpp"
#include "camera/read_camera.hpp"
#include "commands/plain_camera.hpp"

namespace viewproj::cmd::mistakes {

using cmd::operator*;

struct Pair {
  Vec4 point;
  Vec2 pixel;
  std::size_t line = 0;
  Vec2 miss = {};  ///< by which the camera's pixel is off, as it is given; NaN without one
};

/// The mended pixel of a given one: xx x + xy y + x0, yx x + yy y + y0.
struct PixelMap {
  double xx = 1, xy = 0, x0 = 0, yx = 0, yy = 1, y0 = 0;

  Vec2 operator()(const Vec2& p) const { return {xx * p.x + xy * p.y + x0, yx * p.x + yy * p.y + y0}; }
  double size() const { return std::fabs(xx * yy - xy * yx); }
  friend bool operator==(const PixelMap&, const PixelMap&) = default;
};
/// The second map of what the first gives.
PixelMap operator*(const PixelMap& second, const PixelMap& first);

/// What is done to points that are places on the Earth.
enum class PlaceMap : std::uint8_t { none, exchange, negateLon, negateLat };

/// A field of the document and its value; null removes it.
using Set = std::pair<std::string, Json>;

struct Hypothesis {
  std::string mistake;  ///< "y-flipped", "y-flipped + pixel-centre"
  Json value = nullptr;
  PlainCamera camera;          ///< the mended one
  std::vector<Set> sets = {};  ///< laid over the document; what else camera differs in was solved
  bool stretch = false;        ///< they need --allow-stretch
  Rows points = kUnit;         ///< of the mended points
  PlaceMap places = PlaceMap::none;
  PixelMap pixels = {};    ///< of the mended pixels
  int lensPasses = 0;      ///< how often the lens then bends them; negative: unbends them
  double scale = 1;        ///< of the area of the picture, where camera is of a smaller or larger one
  bool isResized = false;  ///< about its corner
  int parameters = 0;
  bool isRead = false;     ///< its value, from a family's number
  std::string words = "";  ///< what else is done to the pairs

  /// The mended point and pixel of given ones.
  Vec4 point(const Vec4& given) const;
  Vec2 pixel(const Vec2& given) const;
  bool movesPixels() const { return pixels != PixelMap{} || lensPasses != 0; }
};

/// What it leaves of a pair, and of each; NaN where the point has no pixel.
Vec2 missOf(const Hypothesis& hypothesis, const Pair& pair);
std::vector<Vec2> missesOf(const Hypothesis& hypothesis, std::span<const Pair> pairs);

/// As --set has them.
std::vector<Patch> patchesOf(const std::vector<Set>& sets);
/// The document with patches laid over it. Throws as readCamera does.
CameraFile changed(const CameraFile& file, const std::vector<Patch>& patches, bool stretch);
/// Its camera; nothing where it makes none.
std::optional<PlainCamera> plainWith(const CameraFile& file, const std::vector<Patch>& patches, bool stretch);

/// Of the world at a point: x, y, z; or east, north, up on the Earth.
Rows worldAt(const CameraFile& file, const Vec3& point);

/// A camera document with its camera, and hypotheses about it as they are found.
class Trials {
 public:
  /// Throws as readCamera and makeCamera do.
  explicit Trials(const CameraFile& file);

  const CameraFile& file() const { return file_; }
  Viewport viewport() const { return camera_.viewport(); }
  Projection projection() const { return camera_.projection(); }
  const PlainCamera& plain() const { return plain_; }
  Vec3 up() const;                        ///< of the world at the eye
  std::pair<Vec2, Vec2> corners() const;  ///< of the picture in pixels: the first and the last

  const Json* find(std::string_view path) const { return valueAt(*file_.document.root, path); }
  bool has(std::string_view path) const { return find(path) != nullptr; }
  double numberOr(std::string_view path, double fallback) const;
  double degreesOr(std::string_view path, double fallback) const;

  /// What cannot be read then is no hypothesis.
  void change(const std::string& mistake, std::vector<Set> sets, Json value = nullptr, bool stretch = false);
  void pixels(const std::string& mistake, const PixelMap& map, Json value = nullptr);
  void points(const std::string& mistake, const Rows& rows, Json value = nullptr);
  void pose(const std::string& mistake, const Rows& axes, const Vec3& eye, Json value = nullptr);
  void add(Hypothesis hypothesis) { found_.push_back(std::move(hypothesis)); }
  std::vector<Hypothesis> take() { return std::exchange(found_, {}); }

 private:
  CameraFile file_;
  Camera camera_;
  PlainCamera plain_;
  std::vector<Hypothesis> found_;
};

void addWindowRows(Trials& trials);
void addPoseRows(Trials& trials);
void addPixelRows(Trials& trials);
/// Of a family with one number, read as a field that is a ratio of small numbers.
void addRatioRows(Trials& trials, const Hypothesis& fitted);
/// All of them.
std::vector<Hypothesis> rowsOf(const CameraFile& file);
/// Signed permutations of three axes, each with its name, as in "-y,-z,x".
std::vector<std::pair<std::string, Rows>> signedAxes();

}  // namespace viewproj::cmd::mistakes
