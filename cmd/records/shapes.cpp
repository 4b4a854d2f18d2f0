#include "records/shapes.hpp"

#include "numbers/vectors.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

Vec3 vec3(const double* n) { return {n[0], n[1], n[2]}; }

Sphere checked(const Sphere& sphere) {
  if (const auto fault = faultOf(sphere); !fault.empty()) throw RecordError(0, "radius " + std::string(fault));
  return sphere;
}

}  // namespace

CullShape toShape(const Layout& layout, const Numbers& n) {
  switch (layout.kind) {
    case kindSphere:
      return checked({vec3(&n[0]), n[3]});
    case kindBox: {
      const Box box{vec3(&n[0]), vec3(&n[3])};
      if (const auto fault = faultOf(box, layout.parts[0].point == PointForm::ofTheEarth); !fault.empty())
        throw RecordError(0, "max " + std::string(fault));
      return box;
    }
    case kindTriangle:
      return Triangle{vec3(&n[0]), vec3(&n[3]), vec3(&n[6])};
    default:
      break;
  }
  const Vec4 point = toPoint(layout, n);
  if (point.w == 0) throw RecordError(0, "is a direction, which is nowhere in the view; expected a point or a shape");
  const Vec3 position{point.x / point.w, point.y / point.w, point.z / point.w};
  if (isPoint(layout)) return position;
  if (!isFinite(position)) throw RecordError(0, "has a center beyond the range of doubles");
  return checked({position, n[layout.slots() - 1]});
}

}  // namespace viewproj::cmd
