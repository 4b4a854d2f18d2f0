// The sheet that a picture is drawn on, as an SVG: layers of lines and areas, names, and a legend.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "picture/curve.hpp"
#include "picture/labels.hpp"

namespace viewproj::cmd {

/// In the order in which they are painted. Those from texts on reach beyond the frame.
enum class Layer { photo, land, horizon, faces, grid, areas, halo, lines, marks, texts };
inline constexpr std::size_t kLayers = 10;

inline constexpr TextStyle kTitle{"title", 17, true}, kOfLegend{"leg", 12}, kOfTick{"num", 11},
    kOfAzimuth{"azimuth", 12}, kOfPoint{"of-dot", 14, true}, kOfCross{"of-cross", 14, true}, kOfShape{"of-shape", 14},
    kOfOutside{"of-out", 13}, kOfPixel{"of-pixel", 13};

class Sheet {
 public:
  Sheet(const Rect& picture, bool isOnPhoto) : labels(picture), frame(picture), hasPhoto(isOnPhoto) {}

  Labels labels;
  const Rect frame;
  const bool hasPhoto;

  void addPhoto(const std::string& url);
  /// All lines of a style and a layer are one path.
  void addLine(Layer layer, const std::string& style, const std::vector<Vec2>& line, bool isClosed = false);
  /// Lines of a style, thin and dashed where hidden. weight: how much names avoid them.
  void addPieces(const Pieces& pieces, const std::string& style, double weight);
  /// As addLine, but on a photo set off from it.
  void addThin(Layer layer, const std::string& style, const Line& line, bool isClosed = false);
  void addFilled(Layer layer, const std::string& style, const std::vector<Line>& outlines);
  void addText(Layer layer, const TextStyle& style, const Vec2& at, const char* anchor, const std::string& text);
  /// Of another svg, moved.
  void addSymbol(const std::string& elements, const Vec2& at);

  // Names keep away from these.
  void addDot(const Vec2& at, double radius, bool isHollow);
  /// Two lines through a place, so far to both sides, upright or aslant.
  void addCross(const Vec2& at, double size, bool isUpright);
  void addArrow(const Vec2& from, const Vec2& to, const std::string& style);

  /// Adds a symbol to the legend, by its usual text. text: in its place; several are joined.
  void explain(const std::string& symbol, const std::string& text = "");
  const std::map<std::string, std::string>& symbols() const { return symbols_; }

  /// Writes the names where there is room for them. Returns how many have none.
  std::size_t addNames();
  std::string svg(const std::string& title);

 private:
  struct Elements {
    std::string areas;
    std::vector<std::pair<std::string, std::string>> lines;  ///< data of each style
  };
  Elements& in(Layer layer) { return layers_[static_cast<std::size_t>(layer)]; }
  void addName(const Label& label);

  std::array<Elements, kLayers> layers_;
  std::map<std::string, std::string> symbols_;
  Vec2 end_;  ///< of the texts, to the right and below
};

}  // namespace viewproj::cmd
