#include "input/euler.hpp"

#include "camera/camera.hpp"
#include "camera/turned_axes.hpp"
#include "input/camera_fields.hpp"

namespace viewproj::cmd {

using namespace detail;

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
  // The camera's axes in the world; about one of them the two after it turn, the first towards the second.
  TurnedAxes t({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  for (std::size_t i = 0; i < 3; ++i) t.turn(((*order)[i] + 2) % 3, ((*order)[i] + 1) % 3, (*degrees)[i]);
  switch (axes) {
    case CameraAxes::RUB:
      return poseFromAxes(position, t.axis(0), t.axis(1), t.axis(2, true));
    case CameraAxes::RUF:
      return poseFromAxes(position, t.axis(0), t.axis(1), t.axis(2));
    case CameraAxes::RDF:
      return poseFromAxes(position, t.axis(0), t.axis(1, true), t.axis(2));
    case CameraAxes::FRU:
      break;
  }
  return poseFromAxes(position, t.axis(1), t.axis(2), t.axis(0));
}

}  // namespace viewproj::cmd
