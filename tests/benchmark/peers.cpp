// Compiled once with -O2 and once with -O3; VIEWPROJ_PEERS is the table's name.
#include "peers.hpp"

#include <Eigen/Dense>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace benchmark {

using viewproj::Mat4;
using viewproj::Vec2;
using viewproj::Vec3;

namespace {

template <class T>
glm::mat<4, 4, T> toGlm(const Mat4& m) {
  glm::mat<4, 4, T> g;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      g[column][row] = static_cast<T>(m[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]);
  return g;
}

template <class T, class In>
void glmProject(const PeerCamera& c, std::span<const In> points, std::span<In> screen) {
  const auto view = toGlm<T>(c.view), projection = toGlm<T>(c.projection);
  const glm::vec<4, T> viewport(0, 0, c.width, c.height);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec<3, T> p =
        glm::projectNO(glm::vec<3, T>(points[i].x, points[i].y, points[i].z), view, projection, viewport);
    screen[i] = {p.x, p.y, p.z};
  }
}

void glmProjectDouble(const PeerCamera& c, std::span<const Vec3> points, std::span<Vec3> screen) {
  glmProject<double>(c, points, screen);
}

void glmProjectFloat(const PeerCamera& c, std::span<const Vec3f> points, std::span<Vec3f> screen) {
  glmProject<float>(c, points, screen);
}

void eigenCachedDouble(const PeerCamera& c, std::span<const Vec3> points, std::span<Vec3> screen) {
  Eigen::Matrix4d view, projection;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      view(i, j) = c.view[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      projection(i, j) = c.projection[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  const Eigen::Matrix4d m = projection * view;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector4d p = m * Eigen::Vector4d(points[i].x, points[i].y, points[i].z, 1);
    const double perW = 1 / p.w();
    screen[i] = {(p.x() * perW * 0.5 + 0.5) * c.width, (p.y() * perW * 0.5 + 0.5) * c.height, p.z() * perW * 0.5 + 0.5};
  }
}

void glmUnProjectTwice(const PeerCamera& c, std::span<const Vec2> pixels, std::span<Vec3> directions) {
  const auto view = toGlm<double>(c.view), projection = toGlm<double>(c.projection);
  const glm::dvec4 viewport(0, 0, c.width, c.height);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::dvec3 near = glm::unProjectNO(glm::dvec3(pixels[i].x, pixels[i].y, 0), view, projection, viewport);
    const glm::dvec3 far = glm::unProjectNO(glm::dvec3(pixels[i].x, pixels[i].y, 1), view, projection, viewport);
    const glm::dvec3 d = glm::normalize(far - near);
    directions[i] = {d.x, d.y, d.z};
  }
}

}  // namespace

const Peers VIEWPROJ_PEERS = {glmProjectDouble, glmProjectFloat, eigenCachedDouble, glmUnProjectTwice};

}  // namespace benchmark
