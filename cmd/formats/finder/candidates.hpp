// What in a file looks like a part of a camera, by the shape of its numbers and the words of its name.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// kind: K P X (a pose) R V Q (turns) T E (a translation, an eye) D d (a lens, and what may be one) S F C (focal
/// lengths, a centre), or the name of a scalar: fx fy cx cy f sensor w h fovX fovY fov k1 … p2, r11 …, qx …, tx …, x y
/// z, pixel (its size). "?": 3 to 16 numbers that are none of these.
struct Candidate {
  std::string kind;
  std::vector<std::string> steps;  ///< of the path
  std::vector<double> numbers;
  double name = 0;     ///< how well the name fits
  std::string suffix;  ///< "^T", or "[0:9]"
  /// Of several of a kind whose paths differ in one step, or a part of it, at that step: by the text that differs.
  std::map<std::string, std::shared_ptr<const Candidate>> star{};
  std::size_t at = 0;
  bool isOrdered = false;                                 ///< an object, whose names tell which number is which
  bool isFlat = false;                                    ///< one list, whose numbers may go by rows or by columns
  std::vector<std::shared_ptr<const Candidate>> terms{};  ///< of scalars that stand one after the other
  std::vector<std::string> tag{};  ///< words of the path that say which camera it is of, and not what it is

  bool isStarred() const { return !star.empty(); }
  std::string path() const;
};
using Candidates = std::vector<std::shared_ptr<const Candidate>>;

/// Every one of them, those that stand for several included. At most 20,000.
Candidates candidatesIn(const Document& file);

/// "color" of fx_color, depthWidth without width: the words beside the name of a scalar; empty where it is alone.
std::string besideScalar(std::string_view name);

/// The tag of a candidate without one.
std::vector<std::string> findTag(const Candidate& candidate);

}  // namespace viewproj::cmd
