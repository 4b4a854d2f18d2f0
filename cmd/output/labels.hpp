// Labels that lie on nothing: each takes the first good place beside its mark, or none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "output/svg.hpp"

namespace viewproj::cmd {

inline constexpr double kLabelText = 13;

/// Not less than the width of words in any usual sans-serif face.
double widthOf(std::string_view words, double size);
/// Of their first character, which is taken off.
double widthOfFirst(std::string_view& words, double size);

/// Text of a record as a label: characters that XML has not replaced, cut off after kLongestLabel of them.
std::string asLabel(std::string_view text);
inline constexpr std::size_t kLongestLabel = 24;

class Labels {
 public:
  /// Nothing goes outside of the frame. farther: a label may stand a line away from its mark where there is no other
  /// room.
  explicit Labels(const svg::Box& frame, double textSize = kLabelText, bool farther = false)
      : frame_(frame), textSize_(textSize), farther_(farther) {}

  /// No label lies on these.
  void avoid(const svg::Box& box);
  /// Nor, if there is another place as good, on these.
  void avoidLine(double x1, double y1, double x2, double y2);

  /// A text element beside what is marked; nothing where there is no room.
  std::optional<std::string> place(const svg::Box& marked, const std::string& words, const std::string& style);

  std::size_t dropped() const { return dropped_; }

 private:
  struct Line {
    double x1, y1, x2, y2;
    mutable std::size_t query = 0;  ///< that has counted it
  };

  bool isFree(const svg::Box& box) const;
  int linesThrough(const svg::Box& box) const;

  svg::Box frame_;
  double textSize_;
  bool farther_;
  std::unordered_map<int, std::vector<svg::Box>> taken_;  ///< by cell
  std::vector<Line> lines_;
  std::unordered_map<int, std::vector<std::size_t>> linesIn_;  ///< by cell: numbers of lines that may cross it
  mutable std::size_t queries_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace viewproj::cmd
