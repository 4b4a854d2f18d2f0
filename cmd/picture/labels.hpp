// Names on a picture that meet no other name and no mark, and avoid lines where they can.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "picture/flat.hpp"

namespace viewproj::cmd {

/// A class of the style sheet, and its font.
struct TextStyle {
  const char* name;
  double size;
  bool isBold = false;
};

/// At least that of any common sans-serif font, of which DejaVu Sans is the widest.
double textWidth(std::string_view utf8, const TextStyle& style);

/// A place for a name, and what it costs before what lies there. mark: what a line leads to.
struct Spot {
  double cost = 0;
  Rect box;
  std::optional<Vec2> mark = {};

  /// Where the line to the mark begins.
  Vec2 leaderEnd() const;
  /// Of the name and the line.
  Rect bounds() const;
};

struct Label {
  std::string text;
  TextStyle style;
  int rank = 0;  ///< those of lower rank choose first
  bool isFaint = false;
  std::string note = {};  ///< in plain letters after the text
  std::vector<Spot> spots = {};
  std::optional<Spot> chosen = {};

  /// Width and height.
  Vec2 size() const;
  /// Adds a place with this middle.
  void addSpot(double cost, const Vec2& middle, const std::optional<Vec2>& mark = {});
  /// Adds eight places beside a mark and on each of five rings around it. first: of the rings, 0 beside the mark.
  void addSpotsAround(const Vec2& at, double radius, int first = 0);
};

class Labels {
 public:
  explicit Labels(const Rect& frame) : frame_(frame), marks_(frame), ink_(frame), names_(frame) {}

  void addMark(const Rect& box);
  bool hasMark(const Rect& box) const;
  /// A drawn line, and how much names avoid it.
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

}  // namespace viewproj::cmd
