#include "input/shapes.hpp"

#include <optional>

#include "input/points.hpp"
#include "input/scene.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// Beside those of points.
enum ShapeKind : unsigned { kindSphere = 100, kindBox, kindTriangle };

/// The columns of these names, if the first is there. Throws RecordError if another is missing.
std::optional<Layout> allColumns(const Shape& shape, std::initializer_list<const char*> names, unsigned kind) {
  Layout layout;
  layout.kind = kind;
  for (const char* name : names) {
    const auto field = shape.find(name);
    if (!field && layout.parts.empty()) return std::nullopt;
    if (!field) throw RecordError(0, std::string("has ") + *names.begin() + " but no " + name);
    layout.parts.push_back({*field});
  }
  return layout;
}

Vec3 vec3(const double* n) { return {n[0], n[1], n[2]}; }

}  // namespace

Layout findShape(const RecordParts& record, const std::vector<std::string>& columns, bool worldIsEcef) {
  const Shape& shape = record.shape;
  if (shape.form == Form::csv) {
    if (const auto sphere = allColumns(shape, {"center_x", "center_y", "center_z", "radius"}, kindSphere))
      return *sphere;
    if (const auto box = allColumns(shape, {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z"}, kindBox))
      return *box;
  } else if (!shape.isArray) {
    const auto part = [](std::size_t field, const char* inner) { return NumberField{field, 3, 3, true, false, inner}; };
    if (const auto sphere = shape.find("sphere"))
      return {{part(*sphere, "center"), {*sphere, 1, 1, false, false, "radius"}}, kindSphere};
    if (const auto box = shape.find("box")) return {{part(*box, "min"), part(*box, "max")}, kindBox};
    if (const auto triangle = shape.find("triangle")) {
      Layout layout{{}, kindTriangle};
      for (std::size_t corner : {0u, 1u, 2u}) layout.parts.push_back({*triangle, 3, 3, true, false, {}, corner, 3});
      return layout;
    }
    for (const char* name : {"plane", "ellipsoid"})
      if (const auto field = shape.find(name))
        throw RecordError(record.offset(*field),
                          std::string("a ") + name + " is not culled; expected a point, sphere, box or triangle");
  }
  return findPoint(record, columns, worldIsEcef);
}

CullShape toShape(const Layout& layout, const Numbers& n) {
  switch (layout.kind) {
    case kindSphere: {
      const Sphere sphere{vec3(&n[0]), n[3]};
      if (const auto fault = faultOf(sphere); !fault.empty()) throw RecordError(0, "radius " + std::string(fault));
      return sphere;
    }
    case kindBox: {
      const Box box{vec3(&n[0]), vec3(&n[3])};
      if (const auto fault = faultOf(box); !fault.empty()) throw RecordError(0, "max " + std::string(fault));
      return box;
    }
    case kindTriangle:
      return Triangle{vec3(&n[0]), vec3(&n[3]), vec3(&n[6])};
    default:
      break;
  }
  const Vec4 point = toPoint(layout, n);
  if (point.w == 0) throw RecordError(0, "is a direction, which is nowhere in the view; expected a point or a shape");
  return Vec3{point.x / point.w, point.y / point.w, point.z / point.w};
}

}  // namespace viewproj::cmd
