#include "commands/draw/records.hpp"

#include <cmath>
#include <optional>
#include <variant>

#include "camera/read_camera.hpp"
#include "output/labels.hpp"
#include "records/points.hpp"
#include "records/shapes.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"
#include "viewproj/scene.hpp"

namespace viewproj::cmd {
namespace {

/// JSON text, a string without its quotes.
std::string labelOfJson(std::string_view value) {
  if (value.starts_with('"')) return asLabel(unescaped(value.substr(1, value.size() - 2)));
  return asLabel(value);
}

std::optional<std::string> labelOf(const Record& record) {
  for (const char* name : {"id", "name"})
    if (const auto field = record.shape->isArray ? std::nullopt : record.shape->find(name)) {
      const std::string_view value = valuesOf(record)[*field];
      const std::string label = record.shape->form == Form::csv ? asLabel(csvValue(value)) : labelOfJson(value);
      if (!label.empty() && !(record.shape->form == Form::json && value == "null")) return label;
    }
  return std::nullopt;
}

class DrawWork final : public RecordWork {
 public:
  DrawWork(View& view, const Frustum& frustum, const PointReading& reading)
      : view_(view), frustum_(frustum), reading_(reading) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, reading_); }

  Results results(const Layout&, OutputForm) const override { return {}; }

  void add(const Layout& layout, const Numbers& n) override {
    if (!isPoint(layout) && !hasDepth(view_.camera.projection()))
      throw RecordError(0, "a shape needs a camera with near; --near gives it");
    if (isSegment(layout))
      drawn_.push_back(Segment{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    else if (isPoint(layout))
      drawn_.push_back(toPoint(layout, n));
    else
      std::visit([&](const auto& shape) { keep(shape); }, toShape(layout, n));
  }

  void read(std::size_t i, const Record& record) override {
    ++count_;
    const std::string label = labelOf(record).value_or(std::to_string(count_));
    std::visit([&](const auto& what) { draw(label, what); }, drawn_[i]);
  }

  void write(std::size_t, ResultSink&) override {}  // records are read alone
  void clear() override { drawn_.clear(); }

 private:
  template <class Shape>
  void keep(const Shape& shape) {
    // Points have been kept, whole.
    if constexpr (!std::is_same_v<Shape, Vec3>) drawn_.push_back(shape);
  }

  void draw(const std::string& label, const Vec4& point) { addPoint(view_, label, point); }
  template <class Shape>
  void draw(const std::string& label, const Shape& shape) {
    addOutline(view_, frustum_, label, shape);
  }

  View& view_;
  const Frustum& frustum_;
  const PointReading& reading_;
  std::vector<std::variant<Vec4, Segment, Sphere, Box, Triangle>> drawn_;
  std::size_t count_ = 0;  ///< records read
};

}  // namespace

int addRecords(View& view, const Frustum& frustum, const FilterSetup& setup, bool worldIsEcef) {
  const PointReading reading{
      .columns = setup.columns, .worldIsEcef = worldIsEcef, .segments = true, .shapes = "drawn from a record"};
  return readRecords(setup, [&] { return std::make_unique<DrawWork>(view, frustum, reading); });
}

void addScene(View& view, const Frustum& frustum, const std::vector<SceneObject>& scene) {
  std::string planes;
  for (const SceneObject& object : scene) {
    const std::string label = labelOfJson(object.id);
    std::visit(
        [&](const auto& shape) {
          if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, Plane>)
            planes += (planes.empty() ? "" : ", ") + label;
          else
            addOutline(view, frustum, label, shape);
        },
        object.shape);
  }
  if (!planes.empty()) view.notes.push_back("a plane has no outline: " + planes);
}

void addPixel(View& view, const Vec2& screen, const std::vector<SceneObject>* scene) {
  const std::string numbers = formatNumber(screen.x) + ", " + formatNumber(screen.y);
  if (!scene) {
    view.pixels.push_back({screen, numbers, "pixel " + numbers});
    return;
  }
  const Ray ray = screenToRay(view.camera, screen);
  const SceneObject* nearest = nullptr;
  double distance = INFINITY;
  for (const SceneObject& object : *scene)
    std::visit(
        [&](const auto& shape) {
          const Hits hits = intersect(ray, shape);
          if (hits.count > 0 && (!nearest || hits.begin()->distance < distance)) {
            nearest = &object;
            distance = hits.begin()->distance;
          }
        },
        object.shape);
  if (nearest)
    view.pixels.push_back(
        {screen, labelOfJson(nearest->id) + " at " + formatDigits(distance, 6),
         "pixel " + numbers + ": " + labelOfJson(nearest->id) + " at distance " + formatNumber(distance)});
  else
    view.pixels.push_back({screen, "no hit", "pixel " + numbers + ": no hit"});
}

}  // namespace viewproj::cmd
