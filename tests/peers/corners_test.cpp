// Conventions by where the eight corners of the frustum land.
//
// A corner's place in the world is written down from the window's edges; where it has to land is the table below, taken
// from each API's documentation. Matrices are read back out of the sixteen numbers in memory, as that API would.
#include "catch.hpp"
#include "internals.hpp"
#include "measure.hpp"
#include "parts.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::detail;
using namespace peers;

namespace {

/// What each API says of its spaces. With reverseZ turned round, near and far trade places.
struct Documented {
  std::string_view name;
  double ndcNear, ndcFar;      // NDC z
  double ndcTop;               // NDC y of the picture's upper edge
  double viewUp, viewForward;  // view y of a metre up, view z of a metre ahead
  bool rowVectors, rowMajor;
};

// clang-format off
constexpr Documented kDocumented[] = {
    //            near far  top  up  fwd  row vectors, row-major
    {"opengl",    -1,  1,   1,   1,  -1,  false, false},
    {"opengl-lh", -1,  1,   1,   1,   1,  false, false},
    {"d3d",        0,  1,   1,   1,   1,  true,  true},
    {"d3d-rh",     0,  1,   1,   1,  -1,  true,  true},
    {"vulkan",     0,  1,  -1,   1,  -1,  false, false},
    {"metal",      0,  1,   1,   1,  -1,  false, false},
    {"webgpu",     0,  1,   1,   1,  -1,  false, false},
    {"unity",     -1,  1,   1,   1,  -1,  false, false},
    {"unreal",     1,  0,   1,   1,   1,  true,  true},
    {"opencv",     0,  1,   1,  -1,   1,  false, true},
    {"ps2",        1,  0,  -1,  -1,   1,  true,  true},
};
// clang-format on

/// The camera stands at an eye of whole numbers and looks along (3, 4, 0)/5 with Z up. In a right-handed world its
/// right hand points along (4, -3, 0)/5, in a left-handed one along (-4, 3, 0)/5.
constexpr Vec3 kEye{100, -50, 7};
constexpr Vec3 kAhead{0.6, 0.8, 0};

Vec3 rightOf(Handedness world) { return world == Handedness::right ? Vec3{0.8, -0.6, 0} : Vec3{-0.8, 0.6, 0}; }

enum class Window { symmetric, offCentre, orthographic };

struct Frame {
  Window lens;
  double left, right, bottom, top;  // at distance 1 in perspective
  double near, far;
};

constexpr Frame kFrames[] = {
    {Window::symmetric, -2, 2, -1, 1, 0.5, 80},
    {Window::symmetric, -2, 2, -1, 1, 0.5, kInfiniteFar},
    {Window::offCentre, -0.25, 1.5, 0.125, 0.75, 0.5, 80},
    {Window::offCentre, -0.25, 1.5, 0.125, 0.75, 0.5, kInfiniteFar},
    {Window::orthographic, -8, 8, -5, 5, 0.5, 80},
    {Window::orthographic, 3, 12, -9, -4, -20, 80},
};

Projection projectionOf(const Frame& f) {
  return f.lens == Window::orthographic
             ? orthographic(f.left, f.right, f.bottom, f.top, f.near, f.far)
             : frustum(f.left * f.near, f.right * f.near, f.bottom * f.near, f.top * f.near, f.near, f.far);
}

struct Corner {
  bool right, top, far;
};

constexpr Corner kCorners[] = {
    {false, false, false}, {true, false, false}, {false, true, false}, {true, true, false},
    {false, false, true},  {true, false, true},  {false, true, true},  {true, true, true},
};

/// The corner in the world. A corner of an infinite far plane is a direction: w = 0.
Vec4 worldOf(const Corner& c, const Frame& f, Handedness world) {
  const double across = c.right ? f.right : f.left, rise = c.top ? f.top : f.bottom;
  const double distance = c.far ? f.far : f.near;
  const Vec3 right = rightOf(world);
  const bool atInfinity = std::isinf(distance);
  const double ahead = atInfinity ? 1 : distance;
  const double spread = f.lens == Window::orthographic ? 1 : ahead;
  const double w = atInfinity ? 0 : 1;
  return {w * kEye.x + ahead * kAhead.x + spread * across * right.x,
          w * kEye.y + ahead * kAhead.y + spread * across * right.y, w * kEye.z + spread * rise, w};
}

/// Sixteen numbers in memory applied to a point: on paper first, then as columns or rows.
Vec4 applied(const std::array<double, 16>& memory, const Documented& d, const Vec4& v) {
  Mat4 paper;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) paper[i][j] = d.rowMajor ? memory[4 * i + j] : memory[4 * j + i];
  return times(d.rowVectors ? transposed(paper) : paper, v);
}

/// The worst distance of a landing from its place, in units of what rounding world coordinates, entries and products
/// may move it by: the terms of w are at most the coordinates' sizes, times a dozen roundings.
class Landings {
 public:
  void land(const Vec4& clip, const Vec4& size, const Vec3& place) {
    const auto see = [&](double value, double terms, double expected) {
      worst_.see(0, value / clip.w - expected,
                 12 * kRounding * (terms + std::fabs(expected) * size.w) / std::fabs(clip.w));
    };
    see(clip.x, size.x, place.x);
    see(clip.y, size.y, place.y);
    see(clip.z, size.z, place.z);
  }

  const Worst& worst() const { return worst_; }

 private:
  Worst worst_;
};

/// Calls check(documented, convention, frame, pose, world) for all presets, both depth directions, frames and worlds.
template <class Check>
void forEveryCase(Check check) {
  for (const Documented& preset : kDocumented)
    for (bool turned : {false, true})
      for (const Frame& frame : kFrames)
        for (Handedness world : {Handedness::right, Handedness::left}) {
          Documented d = preset;
          Convention c = peers::preset(d.name);
          if (turned) {
            std::swap(d.ndcNear, d.ndcFar);
            c.reverseZ = !c.reverseZ;
          }
          c.world = world;
          INFO(d.name << (c.reverseZ ? ", reversed" : ", forward") << ", near " << frame.near << ", far " << frame.far
                      << (world == Handedness::left ? ", left-handed" : ", right-handed"));
          check(d, c, frame, lookAlong(kEye, kAhead, {0, 0, 1}, world), world);
        }
}

}  // namespace

TEST_CASE("The written clipFromWorld takes the eight corners to the corners of clip space") {
  forEveryCase([](const Documented& d, const Convention& c, const Frame& f, const Pose& pose, Handedness world) {
    const Mat4 matrix = clipFromWorld(pose, projectionOf(f), c);
    const auto memory = inStorageOrder(matrix, c);
    Landings landings;
    for (const Corner& corner : kCorners) {
      const Vec4 at = worldOf(corner, f, world);
      const Vec3 place{corner.right ? 1.0 : -1.0, corner.top ? d.ndcTop : -d.ndcTop, corner.far ? d.ndcFar : d.ndcNear};
      landings.land(applied(memory, d, at), sizes(matrix, at), place);
    }
    CHECK(landings.worst().ratio() <= 1);
  });
}

TEST_CASE("View space has its axes where the convention says") {
  forEveryCase([](const Documented& d, const Convention& c, const Frame& f, const Pose& pose, Handedness world) {
    const Mat4 view = viewFromWorld(pose, c);
    Worst worst;
    for (const Corner& corner : kCorners) {
      const Vec4 at = worldOf(corner, f, world);
      const double distance = !corner.far ? f.near : std::isinf(f.far) ? 1 : f.far;
      const double spread = f.lens == Window::orthographic ? 1 : distance;
      const Vec4 inView = applied(inStorageOrder(view, c), d, at), size = sizes(view, at);
      worst.see(0, inView.x - spread * (corner.right ? f.right : f.left), 12 * kRounding * size.x);
      worst.see(0, inView.y - d.viewUp * spread * (corner.top ? f.top : f.bottom), 12 * kRounding * size.y);
      worst.see(0, inView.z - d.viewForward * distance, 12 * kRounding * size.z);
    }
    CHECK(worst.ratio() <= 1);
  });
}

TEST_CASE("Through screenFromNdc and through worldToScreen the corners land in the corners of the picture") {
  forEveryCase([](const Documented&, const Convention& c, const Frame& f, const Pose& pose, Handedness world) {
    const Projection p = projectionOf(f);
    for (Origin origin : {Origin::topLeft, Origin::bottomLeft}) {
      const Viewport v{640, 480, 30, 70, 0.25, 0.75, origin};
      const Camera camera = makeCamera(pose, p, v, c);
      const Mat4 clipMatrix = clipFromWorld(pose, p, c), viewportMatrix = screenFromNdc(v, c);
      Landings byMatrix;
      Worst byPoint;
      for (const Corner& corner : kCorners) {
        const Vec4 at = worldOf(corner, f, world);
        const bool nearStart = (origin == Origin::topLeft) == corner.top;
        const Vec3 place{corner.right ? 670.0 : 30.0, nearStart ? 70.0 : 550.0, corner.far != c.reverseZ ? 0.75 : 0.25};

        const Vec4 clip = times(clipMatrix, at);
        byMatrix.land(times(viewportMatrix, clip), sizes(viewportMatrix, sizes(clipMatrix, at)), place);

        // A world coordinate is rounded, and the pixel moves by that share of the viewport (2 windows and more
        // off-centre).
        const ScreenPoint s = worldToScreen(camera, at);
        const double share = 12 * kRounding * sizes(viewFromWorld(pose, c), at).z / std::fabs(clip.w);
        REQUIRE(s.status == PointStatus::inFront);
        byPoint.see(0, s.x - place.x, share * 2 * 640);
        byPoint.see(0, s.y - place.y, share * 2 * 480);
        byPoint.see(0, s.depth - place.z, share * 4);
      }
      CHECK(byMatrix.worst().ratio() <= 1);
      CHECK(byPoint.ratio() <= 1);
    }
  });
}
