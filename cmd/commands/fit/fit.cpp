// viewproj fit: the camera that shows all of something.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "commands/command.hpp"
#include "commands/fit/hull.hpp"
#include "commands/notes.hpp"
#include "commands/options.hpp"
#include "commands/stream_options.hpp"
#include "input/adjusted.hpp"
#include "numbers/ulp.hpp"
#include "output/camera_text.hpp"
#include "output/output_file.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "records/shapes.hpp"
#include "stream/filter.hpp"
#include "text/error.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// What the things are to fit by.
enum class Means { place, lens };

/// Where they are in the picture of a perspective, however near or far.
class Extent {
 public:
  explicit Extent(const Frustum& frustum) : frustum_(frustum) {}

  template <class Shape>
  void add(const Shape& shape) {
    const auto box = screenBox(frustum_, shape);
    if (!box) return;
    left_ = std::min(left_, box->left);
    right_ = std::max(right_, box->right);
    first_ = std::min({first_, box->top, box->bottom});
    last_ = std::max({last_, box->top, box->bottom});
  }
  void add(const Vec3& point) { add(Sphere{point, 0}); }

  double left() const { return left_; }
  double right() const { return right_; }
  /// The smaller and the larger screen y.
  double first() const { return first_; }
  double last() const { return last_; }

 private:
  const Frustum& frustum_;
  double left_ = INFINITY, right_ = -INFINITY, first_ = INFINITY, last_ = -INFINITY;
};

struct Fitting {
  Hull hull;
  Extent extent;

  template <class Shape>
  void add(const Shape& shape) {
    hull.add(shape);
    extent.add(shape);
  }
};

class FitWork final : public RecordWork {
 public:
  FitWork(Fitting& fitting, const PointReading& reading) : fitting_(fitting), reading_(reading) {}

  Layout find(const RecordParts& record) const override { return findPoint(record, reading_); }
  Results results(const Layout&, OutputForm) const override { return {}; }

  void add(const Layout& layout, const Numbers& n) override {
    if (isSegment(layout))
      for (const std::size_t end : {0u, 3u}) fitting_.add(Vec3{n[end], n[end + 1], n[end + 2]});
    else
      std::visit([&](const auto& shape) { fitting_.add(shape); }, toShape(layout, n));
  }

  void write(std::size_t, ResultSink&) override {}  // records are read alone
  void clear() override {}

 private:
  Fitting& fitting_;
  const PointReading& reading_;
};

void addScene(Fitting& fitting, const std::vector<SceneObject>& scene) {
  for (const SceneObject& object : scene)
    std::visit(
        [&](const auto& shape) {
          if constexpr (requires { fitting.hull.add(shape); })
            fitting.add(shape);
          else
            throw InputError("--scene: object " + object.id +
                             " is no sphere, box or triangle, and has no place to fit");
        },
        object.shape);
}

/// The part of the picture that is to be filled.
struct Wanted {
  Room room;
  std::optional<double> pixels;  ///< the larger side of what is fitted, in the middle of the picture
};

[[noreturn]] void failToHold(const Wanted& wanted, const Viewport& v) {
  throw InputError("--pixels " + formatNumber(*wanted.pixels) + ": so large, some of it leaves the picture of " +
                   formatNumber(v.width) + " x " + formatNumber(v.height));
}

/// How many times the window opens so that all of it lies in the room.
double openingFor(const Viewport& v, const ScreenMap& screen, const Extent& e, const Room& room) {
  const double cx = screen.centerX.hi, cy = screen.centerY.hi;
  const auto [x, y] = pictureCorners(v).first;
  const bool down = v.origin == Origin::topLeft;
  const double first = down ? 1 - room.top : room.bottom, last = down ? 1 - room.bottom : room.top;
  // What is off the axis counts to the next double: a screen box is rounded.
  const auto factor = [](double end, double side, double middle) {
    const double share = (end - middle) / (side - middle);
    return share > 0 ? (std::nextafter(end, side < middle ? -INFINITY : INFINITY) - middle) / (side - middle) : share;
  };
  const double sides[] = {x + room.left * v.width, x + room.right * v.width, y + first * v.height, y + last * v.height};
  if (!(sides[0] < cx && cx < sides[1] && sides[2] < cy && cy < sides[3]))
    throw InputError("the viewing axis lies outside the part of the picture to fill; --by fov opens the lens about it");
  return std::max({factor(e.left(), sides[0], cx), factor(e.right(), sides[1], cx), factor(e.first(), sides[2], cy),
                   factor(e.last(), sides[3], cy)});
}

/// How many times wider a window of that half tangent is made, lest the rounding of its angle, or of what it holds,
/// leave some out.
double wider(double tangent, double turn) {
  return 1 + 0x1p-52 * 4 + (0x1p-52 * std::atan(tangent) + turn) * (tangent + 1 / tangent);
}

/// The window times a factor, about the viewing axis.
Projection opened(const Projection& projection, const Viewport& v, const ScreenMap& screen, const Extent& e,
                  const Wanted& wanted, double turn) {
  double k = 0;
  if (wanted.pixels) {
    k = std::max(e.right() - e.left(), e.last() - e.first()) / *wanted.pixels;
    if (k > 0 && !(openingFor(v, screen, e, Room()) <= k * (1 + 1e-12))) failToHold(wanted, v);
  } else {
    k = openingFor(v, screen, e, wanted.room);
  }
  if (!(k > 0 && std::isfinite(k)))
    throw InputError("all of it lies on the viewing axis, or is one point: any lens shows it");
  ProjectionParts p = parts(projection);
  if (!wanted.pixels)
    k *= wider(k * std::max({std::fabs(p.left.hi), std::fabs(p.right.hi), std::fabs(p.bottom.hi), std::fabs(p.top.hi)}),
               turn);
  for (DoubleDouble* edge : {&p.left, &p.right, &p.bottom, &p.top, &p.width, &p.height})
    *edge = *edge * DoubleDouble(k);
  p.reachX *= k;
  p.reachY *= k;
  return made(p);
}

/// An orthographic window about all, of the picture's shape.
Projection around(const Projection& projection, const Viewport& v, const Hull::Reach& reach, const Wanted& wanted) {
  const Room& room = wanted.room;
  ProjectionParts p = parts(projection);
  const DoubleDouble half(0.5), width = reach.right - reach.left, height = reach.top - reach.bottom;
  const DoubleDouble byWidth = width / (windowWidth(p) * DoubleDouble(room.right - room.left));
  const DoubleDouble byHeight = height / (windowHeight(p) * DoubleDouble(room.top - room.bottom));
  const DoubleDouble share = byWidth.hi > byHeight.hi ? byWidth : byHeight;
  if (!(share.hi > 0)) throw InputError("all of it is one point of the picture: it fits at any scale");
  if (wanted.pixels && *wanted.pixels > (byWidth.hi > byHeight.hi ? v.width : v.height)) failToHold(wanted, v);
  const DoubleDouble x = (reach.left + reach.right) * half, y = (reach.bottom + reach.top) * half;
  const DoubleDouble toSide = windowWidth(p) * share * half, toTop = windowHeight(p) * share * half;
  ProjectionParts fitted;
  fitted.orthographic = true;
  fitted.left = lowerDouble(x - toSide);
  fitted.right = upperDouble(x + toSide);
  fitted.bottom = lowerDouble(y - toTop);
  fitted.top = upperDouble(y + toTop);
  fitted.near = p.near;
  fitted.far = p.far;
  return made(fitted);
}

struct Options {
  CameraOptions camera;
  StreamOptions stream;
  std::optional<std::string> scene;
  std::optional<Means> by;
  std::optional<double> margin, pixels;
};

Wanted wantedBy(const Options& o, const Viewport& v) {
  constexpr double kMargin = 0.05;
  const double margin = o.margin.value_or(kMargin);
  if (!o.pixels) return {{margin, 1 - margin, margin, 1 - margin}, {}};
  const double across = std::min(*o.pixels / v.width, 1.0) / 2, up = std::min(*o.pixels / v.height, 1.0) / 2;
  return {{0.5 - across, 0.5 + across, 0.5 - up, 0.5 + up}, o.pixels};
}

int run(const Options& o) {
  if (o.margin && o.pixels) throw UsageError("--margin and --pixels both say how large it is; leave out one of them");
  FilterSetup setup = o.stream.setup(kSphereColumns);
  setup.note = note;
  const bool reads = o.stream.readsBeside(o.scene, setup, o.camera);

  CameraFile file = o.camera.read();
  if (reads) o.stream.settleOnEarth(setup, file.worldIsEcef);
  const Camera camera = makeCamera(file);
  const bool orthographic = file.projection->isOrthographic();
  if (orthographic && o.by) throw UsageError("--by is for a perspective; an orthographic window is scaled and centred");
  const Means by = o.by.value_or(orthographic ? Means::lens : Means::place);
  // With all of space in front of near: it is the things that say what is behind.
  const Projection open = orthographic ? *file.projection : withRange(*file.projection, 0x1p-1000, kInfiniteFar);
  const Frustum frustum = viewFrustum(makeCamera(*file.pose, open, *file.viewport, file.convention));
  const Wanted wanted = wantedBy(o, *file.viewport);
  Fitting fitting{Hull(camera, wanted.room), Extent(frustum)};
  const PointReading reading{
      .columns = setup.columns, .worldIsEcef = file.worldIsEcef, .segments = true, .shapes = "fitted", .radius = true};
  if (o.scene) addScene(fitting, readScene(*o.scene, file.worldIsEcef));
  const int status = reads ? readRecords(setup, [&] { return std::make_unique<FitWork>(fitting, reading); }) : 0;
  if (fitting.hull.isEmpty()) throw InputError("there is nothing to fit");

  if (orthographic) {
    file.projection = around(*file.projection, *file.viewport, fitting.hull.reach(), wanted);
  } else if (by == Means::lens) {
    if (!(fitting.hull.range().nearest > 0))
      throw InputError("something of it lies on or behind the plane through the eye; no lens shows that");
    file.projection = opened(*file.projection, *file.viewport, parts(camera).screen, fitting.extent, wanted,
                             writeCamera(file, "", o.camera.allowsStretch()).turned);
  } else {
    const Pose pose = *file.pose;
    Hull::Place place = fitting.hull.place();
    file.pose = movedTo(pose, place.eye, file.convention.world);
    place = fitting.hull.place(writeCamera(file, "", o.camera.allowsStretch()).turned);
    if (place.by != Hull::Place::By::near && o.pixels &&
        *o.pixels > (place.by == Hull::Place::By::width ? file.viewport->width : file.viewport->height))
      failToHold(wanted, *file.viewport);
    file.pose = movedTo(pose, place.eye, file.convention.world);
  }
  writeOutput(writeCamera(file, "", o.camera.allowsStretch()).text);
  return status;
}

}  // namespace

Action declareFit(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  app.description("The camera that shows all of it: points and shapes of FILE, a scene, or both; as a camera file.");
  app.footer(
      "Example:\n"
      "  printf '0 0 0\\n9 1 0\\n' |\n"
      "    viewproj fit --position 3,2,5 --target 0,0,0 --fov-y 60 --viewport 640x480");
  o->stream.addInput(app, "points and shapes");
  addScene(app, o->scene, "shapes to fit");
  static constexpr std::pair<std::string_view, Means> kMeans[] = {{"place", Means::place}, {"fov", Means::lens}};
  addChoice(app, "--by", "WHAT", o->by, rowsOf(kMeans), "What changes", "place");
  addValue(app, "--margin", "SHARE", o->margin,
           numberThat([](double share) { return share >= 0 && share < 0.5; }, "a share from 0 to below 0.5"),
           "Share of the picture to leave free on each side (default: 0.05)");
  addValue(app, "--pixels", "N", o->pixels,
           numberThat([](double pixels) { return pixels > 0 && std::isfinite(pixels); }, "a number of pixels above 0"),
           "Size in pixels of the longer side, in place of a margin");
  addOnlyForm(app, "a camera file", ".json");
  o->camera.add(app);
  return [o] { return run(*o); };
}

}  // namespace viewproj::cmd
