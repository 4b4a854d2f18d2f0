#include "picture/picture.hpp"

#include "picture/drawing.hpp"
#include "picture/rim.hpp"

namespace viewproj::cmd {
namespace {

struct PictureRim {
  Line places;
  bool isDrawnIn = false;  ///< somewhere to the end of the lens
};

/// The end of the lens a little nearer to its axis, so that there is a ray.
PictureRim rimOf(const View& view) {
  constexpr int kOfLens = 1024;
  constexpr double kNearer = 1e-7;
  const int count = view.hasLens() ? kOfLens : 4;
  const Rim rim(view.camera());
  const auto axis = view.pixelOf(directionOf(view.camera().pose().forward()));
  PictureRim found;
  for (int k = 0; k < count; ++k) {
    const Rim::Place place = rim.at(4.0 * k / count);
    const Vec2 at = view.onSheet(place.pixel);
    found.places.push_back(place.isDrawnIn && axis ? between(at, *axis, kNearer) : at);
    found.isDrawnIn = found.isDrawnIn || place.isDrawnIn;
  }
  return found;
}

}  // namespace

std::string pictureOf(const Camera& camera, const PictureContent& content) {
  const View view(camera, content.shapes, content.worldIsEcef);
  Sheet sheet(view.frame(), !content.photo.empty());
  const auto [rim, isDrawnIn] = rimOf(view);
  Drawing drawing{view, sheet, rim, {}, {}};
  for (const NamedPoint& point : content.points) drawing.namesOfPoints.insert(point.name);
  if (sheet.hasPhoto) sheet.addPhoto(content.photo);
  if (isDrawnIn) {
    sheet.addThin(Layer::horizon, "end", simplified(rim), true);
    sheet.explain("end of the lens");
  }
  settleDots(drawing, content.points);
  drawShapes(drawing);
  drawGrounds(drawing, content.hasStems ? content.points : std::vector<NamedPoint>());
  for (const NamedArea& area : content.areas) drawArea(drawing, area);
  for (const NamedSegment& segment : content.segments) drawSegment(drawing, segment);
  for (const NamedPoint& point : content.points) drawPoint(drawing, point);
  for (const Vec2& pixel : content.pixels) drawPixel(drawing, pixel);
  drawPairs(drawing, content.points);
  drawing.notes.insert(drawing.notes.end(), content.notes.begin(), content.notes.end());
  drawOutside(drawing);
  if (const std::size_t missing = sheet.addNames(); missing > 0)
    drawing.notes.push_back(std::to_string(missing) + " of the names " + (missing == 1 ? "has" : "have") + " no room");
  drawLegend(drawing);
  return sheet.svg(content.title);
}

}  // namespace viewproj::cmd
