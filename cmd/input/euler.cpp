#include "input/euler.hpp"

#include <cmath>

#include "camera/camera.hpp"
#include "geodesy/normal.hpp"
#include "input/camera_fields.hpp"
#include "numbers/degrees.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Column = Vector3<Dyadic>;

/// The camera's axes in the world, as columns.
struct Turned {
  std::array<Column, 3> columns{Column{1, 0, 0}, Column{0, 1, 0}, Column{0, 0, 1}};
  bool exact = true;  ///< turned by right angles only

  /// With i and j the axes after this one:
  ///   | i' |   |  cos  sin | | i |
  ///   | j' | = | -sin  cos | | j |
  void turn(std::size_t axis, double degrees) {
    const SinCos angle = sinCosDegrees(degrees);
    Column &i = columns[(axis + 1) % 3], &j = columns[(axis + 2) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Dyadic a = i[k], b = j[k];
      i[k] = sinCosProduct(a, angle.cosine) + sinCosProduct(b, angle.sine);
      j[k] = sinCosProduct(b, angle.cosine) - sinCosProduct(a, angle.sine);
    }
    exact = exact && isRightAngle(degrees);
  }

  /// A column, or what is opposite to it.
  FineVec3 along(std::size_t axis, bool opposite = false) const {
    constexpr double kNoise = 0x1p-207;  // below it is what rounding left of a sum that cancels
    FineVec3 v;
    for (std::size_t k = 0; k < 3; ++k) {
      const Expansion<8> terms = (opposite ? -columns[axis][k] : columns[axis][k]).expansion<8>();
      if (std::fabs(terms.rounded().hi) >= kNoise) v.terms[k] = terms;
    }
    v.error = exact ? 0 : kGeodesyRowBound;
    return v;
  }
};

}  // namespace

Pose readEuler(const ObjectReader& camera, const Vec3& position, CameraAxes axes, Handedness world) {
  const ObjectReader fields = *camera.object(field::euler);
  fields.allow(field::turns);
  const auto order = fields.choice(field::eulerOrder, field::kEulerOrders);
  if (!order) fields.fail("needs an order, such as YXZ");
  const auto degrees = fields.numbers(field::eulerDegrees, 3, 3);
  if (!degrees) fields.fail("needs degrees, an angle for each turn");
  try {
    (void)poseFromRotation(position, {}, axes, world);
  } catch (const CameraError& e) {
    if (e.field() == "rotation") camera.fail(field::euler, e.message());
    throw;
  }
  Turned t;
  for (std::size_t i = 0; i < 3; ++i) t.turn((*order)[i], (*degrees)[i]);
  switch (axes) {
    case CameraAxes::RUB:
      return poseFromAxes(position, t.along(0), t.along(1), t.along(2, true));
    case CameraAxes::RUF:
      return poseFromAxes(position, t.along(0), t.along(1), t.along(2));
    case CameraAxes::RDF:
      return poseFromAxes(position, t.along(0), t.along(1, true), t.along(2));
    case CameraAxes::FRU:
      break;
  }
  return poseFromAxes(position, t.along(1), t.along(2), t.along(0));
}

}  // namespace viewproj::cmd
