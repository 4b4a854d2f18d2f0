#include "picture/picture.hpp"

#include "picture/drawing.hpp"

namespace viewproj::cmd {

std::string pictureOf(const Camera& camera, const PictureContent& content) {
  const View view(camera, content.shapes, content.worldIsEcef);
  Sheet sheet(view.frame(), !content.photo.empty());
  Markers markers(view);
  Drawing drawing{view, sheet, markers, {}, rimOf(view)};
  for (const NamedPoint& point : content.points) drawing.namesOfPoints.insert(point.name);
  if (!content.photo.empty()) sheet.addPhoto(content.photo);
  drawFaces(drawing);
  for (const SceneObject& shape : view.shapes()) drawShape(drawing, shape);
  for (const NamedArea& area : content.areas) drawArea(drawing, area);
  if (const SceneObject* const ground = firstGround(view.shapes()); ground && content.hasStems)
    for (const NamedPoint& point : content.points) drawStem(drawing, *ground, point);
  for (const NamedSegment& segment : content.segments) drawSegment(drawing, segment);
  for (const NamedPoint& point : content.points) drawPoint(drawing, point);
  for (const Vec2& pixel : content.pixels) drawPixel(drawing, pixel);
  drawPairs(drawing, content.points);
  for (const std::string& note : content.notes) sheet.note(note);
  markers.draw(sheet);
  return sheet.svg(content.title, factsOf(view), ticksOf(view), !view.isFromTop());
}

}  // namespace viewproj::cmd
