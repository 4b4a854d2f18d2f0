// Names on a picture that meet no other name and no mark, and avoid lines where they can.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "picture/flat.hpp"

namespace viewproj::cmd {

/// A class of the style sheet, and its font.
struct TextStyle {
  const char* name;
  double size;
  bool isBold = false;
};
inline constexpr TextStyle kOfPoint{"of-dot", 14, true}, kOfCross{"of-cross", 14, true}, kOfShape{"of-shape", 14},
    kOfOutside{"of-out", 13}, kOfPixel{"of-pixel", 13}, kOfLegend{"leg", 12};

/// At least that of any common sans-serif font, of which DejaVu Sans is the widest.
double textWidth(std::string_view utf8, const TextStyle& style);

/// A place for a name, and what it costs before what lies there. leader: the mark that a line leads to.
struct Spot {
  double cost = 0;
  Rect box;
  std::optional<Vec2> leader = {};
};

struct Label {
  std::string text;
  TextStyle style;
  int rank = 0;  ///< those of lower rank choose first
  std::vector<Spot> spots = {};
  std::string note = {};  ///< in plain letters after the text
  bool isFaint = false;
  std::optional<Spot> chosen = {};

  /// Width and height.
  Vec2 size() const;
  /// Adds a place with this middle.
  void addSpot(double cost, const Vec2& middle, const std::optional<Vec2>& leader = {});
  /// Adds eight places beside a mark and on each of five rings around it. first: of the rings, 0 beside the mark.
  void addSpotsAround(const Vec2& at, double radius, int first = 0);
};

class Labels {
 public:
  explicit Labels(const Rect& frame) : frame_(frame), marks_(frame), ink_(frame), names_(frame) {}

  void addMark(const Rect& box);
  /// A drawn line.
  void addInk(const Vec2& from, const Vec2& to, double weight);
  void addInk(const std::vector<Vec2>& line, double weight);
  void add(Label label) { labels_.push_back(std::move(label)); }

  /// Chooses places. Names that have no free one are without.
  const std::vector<Label>& place();

 private:
  struct Ink {
    Vec2 from, to;
    double weight;
  };
  /// What a place costs, or `least` if that is as much or if something is there.
  double costOf(const Label& label, const Spot& spot, double least) const;

  /// Whether nothing was there yet, but for a unit. Of a heap at one place one is enough: names stay apart by as much.
  static bool isNew(std::set<std::array<double, 4>>& known, const Rect& ends);

  Rect frame_;
  std::set<std::array<double, 4>> knownMarks_, knownInk_;
  Cells<Rect> marks_;
  Cells<Ink> ink_;
  Cells<std::size_t> names_;  ///< indices, where they are or were
  std::vector<Label> labels_;
};

/// The nearest point of a box to a mark.
Vec2 leaderEnd(const Rect& box, const Vec2& mark);

}  // namespace viewproj::cmd
