// The sheet that a picture is drawn on: layers of elements, names, and a legend of the symbols that occur.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "picture/curve.hpp"
#include "picture/labels.hpp"

namespace viewproj::cmd {

/// In the order in which they are painted.
enum class Layer { photo, land, horizon, faces, grid, areas, lines, marks };
inline constexpr std::size_t kLayers = 8;

/// In the order of the legend.
// clang-format off
enum class Symbol {
  point, hiddenPoint, hiddenLine, ghost, cross, normal, pairPixel, miss, outside, behind, area, stem, grid, horizon
};
// clang-format on

class Sheet {
 public:
  Sheet(const Rect& frame, bool hasPhoto) : labels(frame), frame_(frame), hasPhoto_(hasPhoto) {}

  Labels labels;

  const Rect& frame() const { return frame_; }
  bool hasPhoto() const { return hasPhoto_; }

  void add(Layer layer, const std::string& element) { layers_[static_cast<std::size_t>(layer)] += element; }
  /// url: of the photo that is under all else.
  void addPhoto(const std::string& url);
  /// Lines of a style, thin and dashed where hidden. weight: how much names avoid them.
  void addLines(const std::vector<Piece>& pieces, const std::string& style, double weight);
  /// A dot, a cross: names keep away from it.
  void addMark(const Vec2& at, double radius, const std::string& element);
  void addArrow(const Vec2& from, const Vec2& to, const std::string& style);
  void addFilled(Layer layer, const std::string& style, const std::vector<Vec2>& corners);
  /// Adds a symbol to the legend. text: in place of its usual one; several are joined.
  void explain(Symbol symbol, const std::string& text = "");
  /// A line of the legend.
  void note(const std::string& text) { notes_.push_back(text); }

  /// facts: of the camera. ticks: elements outside the frame. ticksBelow: whether some stand below it.
  std::string svg(const std::string& title, const std::vector<std::string>& facts, const std::string& ticks,
                  bool ticksBelow);

 private:
  Rect frame_;
  bool hasPhoto_;
  std::array<std::string, kLayers> layers_;
  std::map<Symbol, std::string> symbols_;
  std::vector<std::string> notes_;
};

}  // namespace viewproj::cmd
