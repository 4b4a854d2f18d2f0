// What may be wrong: a changed camera, a map of the points, or a map of the pixels. Rows have no free number; families
// have a few, found by least squares.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "camera/patch.hpp"
#include "camera/read_camera.hpp"
#include "commands/check/plain_camera.hpp"

namespace viewproj::cmd::mistakes {

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

struct Pair {
  Vec4 point;
  Vec2 pixel;
};

/// A field of the document and its value; null removes it.
using Set = std::pair<std::string, Json>;

struct Hypothesis {
  std::string mistake;  ///< "y-flipped", "y-flipped + pixel-centre"
  Json value = nullptr;
  PlainCamera camera;          ///< the mended one
  std::vector<Set> sets = {};  ///< laid over the document
  bool stretch = false;        ///< they need --allow-stretch
  bool isSolved = false;       ///< camera is changed by numbers: the document that has them is its mend
  Rows points = kUnit;         ///< of the mended points
  PlaceMap places = PlaceMap::none;
  PixelMap pixels = {};  ///< of the mended pixels
  int lensPasses = 0;    ///< how often the lens then bends them; negative: unbends them
  double scale = 1;      ///< of the area of the picture, where camera is of a resized one
  int parameters = 0;

  bool movesPixels() const { return pixels != PixelMap{} || lensPasses != 0; }
  bool movesPoints() const { return points != kUnit || places != PlaceMap::none; }
  Vec4 point(const Vec4& given) const;
};

/// A camera document with its camera, and hypotheses about it as they are found.
class Trials {
 public:
  /// Throws as readCamera and makeCamera do.
  Trials(const Document& document, const ReadOptions& reading);

  const CameraFile& file() const { return file_; }
  const Camera& camera() const { return camera_; }
  const PlainCamera& plain() const { return plain_; }
  Vec3 up() const { return up_; }                   ///< of the world at the eye
  const Rows& ownAxes() const { return ownAxes_; }  ///< right, down and forward in the axes of the document's rotations
  Vec2 first() const;                               ///< the picture's corners in pixels
  Vec2 last() const;
  double pixelCenter() const { return camera_.viewport().pixelCenter; }

  const Json* find(std::string_view path) const;
  bool has(std::string_view path) const { return find(path) != nullptr; }
  double numberOr(std::string_view path, double fallback) const;
  double degreesOr(std::string_view path, double fallback) const;

  /// What cannot be read then is no hypothesis.
  void change(const std::string& mistake, std::vector<Set> sets, Json value = nullptr, bool stretch = false);
  void pixels(const std::string& mistake, const PixelMap& map, Json value = nullptr);
  void points(const std::string& mistake, const Rows& rows, Json value = nullptr);
  void pose(const std::string& mistake, const Rows& axes, const Vec3& eye, Json value = nullptr);
  void add(Hypothesis hypothesis) { found_.push_back(std::move(hypothesis)); }
  Hypothesis next(const std::string& mistake, Json value = nullptr) const;

  std::vector<Hypothesis> take() { return std::move(found_); }

 private:
  CameraFile file_;
  ReadOptions reading_;
  Camera camera_;
  PlainCamera plain_;
  Vec3 up_;
  Rows ownAxes_;
  std::vector<Hypothesis> found_;
};

/// As --set has them.
std::vector<Patch> patchesOf(const std::vector<Set>& sets);
/// The document with patches laid over it. Throws as readCamera does.
CameraFile changed(const CameraFile& file, const std::vector<Patch>& patches, bool stretch);
/// Its camera; nothing where it makes none.
std::optional<PlainCamera> plainWith(const CameraFile& file, const std::vector<Patch>& patches, bool stretch);

void addDocumentRows(Trials& trials);
void addPixelRows(Trials& trials);
void addPoseRows(Trials& trials);
/// Signed permutations of three axes, each with its name, as in "-y,-z,x".
std::vector<std::pair<std::string, Rows>> signedAxes();

}  // namespace viewproj::cmd::mistakes
