// Pairs of a point and its pixel as they come, by how much they miss, and what explains it; of one camera, or of a set.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "camera/read_camera.hpp"
#include "output/report.hpp"

namespace viewproj::cmd::mistakes {

struct CheckedCamera;

class PairReport {
 public:
  /// Of a set of cameras. within: the largest miss, in pixels, that still agrees.
  explicit PairReport(double within);
  /// Of one camera.
  PairReport(const CameraFile& file, double within);

  /// pixel: nothing where the record says that the point has none. camera: its place in the set. read: makes it, with
  /// its name, when it is first used.
  void add(const Vec4& point, const std::optional<Vec2>& pixel, std::size_t line, std::size_t camera = 0,
           const std::function<std::pair<std::string, CameraFile>()>& read = nullptr);

  /// The other cameras of the file, each with what picks it.
  using Others = std::function<std::vector<std::pair<std::string, CameraFile>>()>;

  std::size_t records() const;
  /// Every member is always there; what has no value is null. Its size, and that of what is kept, does not grow with
  /// the pairs. others: of one camera, asked for where the pairs disagree.
  OrderedJson report(const Others& others = nullptr) const;

 private:
  OrderedJson explanations(const CheckedCamera& of, const Others& others) const;

  double within_;
  bool isSet_;
  std::shared_ptr<CheckedCamera> all_;                             ///< the pairs of all cameras, without a camera
  std::map<std::size_t, std::shared_ptr<CheckedCamera>> cameras_;  ///< by their places
};

}  // namespace viewproj::cmd::mistakes
