#include "formats/rigid.hpp"

#include <nlohmann/json.hpp>

namespace viewproj::cmd {

using namespace detail;

Rigid rigidOf(std::span<const double> m) {
  Rigid rigid;
  for (std::size_t j = 0; j < 3; ++j) rigid.columns[j] = {m[j], m[4 + j], m[8 + j]};
  rigid.origin = {m[3], m[7], m[11]};
  return rigid;
}

Rigid rigidOf(std::span<const double> r, const DDVec3& translation) {
  Rigid rigid;
  for (std::size_t j = 0; j < 3; ++j) rigid.columns[j] = {r[j], r[3 + j], r[6 + j]};
  rigid.origin = translation;
  return rigid;
}

Rigid operator*(const Rigid& a, const Rigid& b) {
  const auto turned = [&](const DDVec3& v) { return a.columns[0] * v.x + a.columns[1] * v.y + a.columns[2] * v.z; };
  return {{turned(b.columns[0]), turned(b.columns[1]), turned(b.columns[2])}, turned(b.origin) + a.origin};
}

Rigid inverse(const Rigid& a) {
  Rigid inverted;
  const auto& [x, y, z] = a.columns;
  inverted.columns = {DDVec3{x.x, y.x, z.x}, DDVec3{x.y, y.y, z.y}, DDVec3{x.z, y.z, z.z}};
  inverted.origin = -DDVec3{dot(x, a.origin), dot(y, a.origin), dot(z, a.origin)};
  return inverted;
}

Json rowsOf(const Rigid& a) {
  const Vec3 x = rounded(a.columns[0]), y = rounded(a.columns[1]), z = rounded(a.columns[2]), t = rounded(a.origin);
  return {{x.x, y.x, z.x, t.x}, {x.y, y.y, z.y, t.y}, {x.z, y.z, z.z, t.z}, {0, 0, 0, 1}};
}

}  // namespace viewproj::cmd
