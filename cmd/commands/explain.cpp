// viewproj explain: every stage of one point or pixel.
//
// Each step's value is the double nearest the true one, and its formula names what it is made of: numbers of steps
// above it, and entries of the matrices beside them, as the convention writes them on paper. The result is what
// `project` and `ray` give.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "camera/plain_vectors.hpp"
#include "camera/read_camera.hpp"
#include "camera/sea_level.hpp"
#include "commands/camera_options.hpp"
#include "commands/command.hpp"
#include "output/results.hpp"
#include "records/arguments.hpp"
#include "records/model.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "viewproj/lens.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::cmd {
namespace {

/// Names of numbers to be multiplied, perhaps after "-".
using Term = std::vector<std::string>;
using Notes = std::array<std::string, 3>;

const std::string kAxes[] = {".x", ".y", ".z"};

std::vector<std::string> components(const std::string& name) { return {name + ".x", name + ".y", name + ".z"}; }

/// The steps as they grow, and the numbers by name.
class Steps {
 public:
  explicit Steps(const Convention& convention) : rows_(convention.vectors == Vectors::row), convention_(convention) {}

  void stage(const std::string& name) { stage_ = name; }

  /// column: for column vectors. Its entries are "NAME[row][column]", counted from 0.
  void matrix(const std::string& name, const Mat4& column) {
    const Mat4 paper = laidOut(column, convention_);
    matrices_[name] = asJson(paper);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) values_[entry(name, i, j)] = paper[i][j];
  }

  void given(const std::string& name, double value, const std::string& note = "") { step(name, "", value, note); }

  void vector(const std::string& name, const Vec3& value, const std::string& note = "") {
    for (std::size_t i = 0; i < 3; ++i) given(name + kAxes[i], value[i], i == 0 ? note : "");
  }

  void sum(const std::string& name, const std::vector<Term>& terms, double value, std::string note = "") {
    std::string formula;
    double sizes = 0;
    for (const Term& term : terms) {
      const bool minus = term[0] == "-";
      double size = 1;
      std::string product;
      for (std::size_t i = minus ? 1 : 0; i < term.size(); ++i) {
        size *= std::fabs(values_.at(term[i]));
        product += (product.empty() ? "" : "*") + term[i];
      }
      sizes += size;
      formula += (formula.empty() ? (minus ? "-" : "") : minus ? " - " : " + ") + product;
    }
    // A sum of numbers ten times its size has lost a digit of theirs.
    const double lost = std::floor(std::log10(sizes / std::fabs(value)));
    if (terms.size() > 1 && sizes > 0 && lost >= 1)
      note += (note.empty() ? "" : "; ") + (value == 0  ? std::string("cancels to 0")
                                            : lost == 1 ? std::string("1 digit cancels")
                                                        : formatNumber(lost) + " digits cancel");
    step(name, formula, value, note);
  }

  /// The components of a vector. terms(i): of component i, whose name ends in kAxes[i].
  template <class Terms>
  void sums(const std::string& name, const Vec3& value, const Terms& terms, const Notes& notes = {}) {
    for (std::size_t i = 0; i < 3; ++i) sum(name + kAxes[i], terms(i), value[i], notes[i]);
  }

  void step(const std::string& name, const std::string& formula, double value, const std::string& note = "") {
    const auto orNull = [](const std::string& text) { return text.empty() ? OrderedJson() : OrderedJson(text); };
    values_[name] = value;
    steps_.push_back({{"stage", stage_},
                      {"name", name},
                      {"formula", orNull(formula)},
                      {"value", value + 0.0},
                      {"note", orNull(note)}});
  }

  /// The terms of a row of a matrix for column vectors times the numbers of these names: without entries that are 0 and
  /// empty names; "1" is itself.
  std::vector<Term> product(const std::string& matrix, std::size_t row, const std::vector<std::string>& vector) const {
    std::vector<Term> terms;
    for (std::size_t j = 0; j < vector.size(); ++j) {
      const std::string name = rows_ ? entry(matrix, j, row) : entry(matrix, row, j);
      if (vector[j].empty() || values_.at(name) == 0) continue;
      terms.push_back(vector[j] == "1" ? Term{name} : rows_ ? Term{vector[j], name} : Term{name, vector[j]});
    }
    return terms;
  }

  OrderedJson report(const char* name, OrderedJson given, OrderedJson result) && {
    return {{name, std::move(given)},
            {"steps", std::move(steps_)},
            {"matrices", std::move(matrices_)},
            {"result", std::move(result)}};
  }

 private:
  static std::string entry(const std::string& matrix, std::size_t row, std::size_t column) {
    return matrix + "[" + std::to_string(row) + "][" + std::to_string(column) + "]";
  }

  bool rows_;
  Convention convention_;
  std::string stage_;
  OrderedJson steps_ = OrderedJson::array(), matrices_ = OrderedJson::object();
  std::map<std::string, double> values_;
};

Vec3 xyz(const Vec4& v) { return {v.x, v.y, v.z}; }

bool isBack(const Convention& c) { return c.view == ViewAxes::RUB; }
bool isDown(const Convention& c) { return c.view == ViewAxes::RDF; }

/// World to view, or back, without the eye, which is subtracted before.
Mat4 rotationOf(const Camera& camera, const Convention& convention, Space to, Space from) {
  return matrix(cameraIn(convention, movedTo(camera.pose(), Vec3{})), to, from);
}

/// In world coordinates, after the model and the division by the weight.
Vec3 placePoint(Steps& steps, const Vec4& point, const std::optional<Mat4>& model) {
  const bool isWeighted = point.w != 0 && point.w != 1;
  Vec3 world = xyz(point);
  steps.stage("world");
  if (!model && !isWeighted) {
    steps.vector("world", world, point.w == 0 ? "a direction" : "the point");
    return world;
  }
  steps.vector("point", world, "the point");
  steps.given("point.w", point.w, point.w == 0 ? "a direction" : "");
  std::string name = "point";
  if (model) {
    world = xyz(toWorld(*model, point));
    name = isWeighted ? "placed" : "world";
    steps.matrix("model", *model);
    steps.sums(name, world, [&](std::size_t i) {
      return steps.product("model", i, {"point.x", "point.y", "point.z", "point.w"});
    });
  }
  for (std::size_t i = 0; isWeighted && i < 3; ++i) {
    world[i] /= point.w;
    steps.step("world" + kAxes[i], name + kAxes[i] + " / point.w", world[i]);
  }
  return world;
}

void explainView(Steps& steps, const Camera& camera, const Convention& c, const Vec3& world, const Vec4& point,
                 double viewDistance) {
  const bool isDirection = point.w == 0;
  const Vec3 eye = isDirection ? Vec3{} : camera.pose().eye();
  steps.stage("relative");
  if (!isDirection) steps.vector("eye", eye);
  steps.sums("relative", {world.x - eye.x, world.y - eye.y, world.z - eye.z},
             [&](std::size_t i) {
               std::vector<Term> terms{{"world" + kAxes[i]}};
               if (!isDirection) terms.push_back({"-", "eye" + kAxes[i]});
               return terms;
             },
             {isDirection ? "a direction has no place" : ""});
  steps.stage("view");
  steps.matrix("V", rotationOf(camera, c, Space::view, Space::world));
  steps.sums("view", xyz(worldTo(camera, Space::view, point, c)),
             [&](std::size_t i) { return steps.product("V", i, components("relative")); },
             {"right", isDown(c) ? "down" : "up", isBack(c) ? "back" : "forward"});
  steps.given("view.w", isDirection ? 0 : 1, isDirection ? "a direction" : "a point");
  if (!isDirection)
    steps.sum("viewDistance", {isBack(c) ? Term{"-", "view.z"} : Term{"view.z"}}, viewDistance,
              "along the viewing axis");
}

void explainClip(Steps& steps, const Camera& camera, const Convention& c, const Vec4& clip) {
  const std::vector<std::string> view = {"view.x", "view.y", "view.z", "view.w"};
  steps.stage("clip");
  steps.matrix("P", matrix(cameraIn(c, {}, camera.projection()), Space::clip, Space::view));
  steps.sums("clip", xyz(clip), [&](std::size_t i) { return steps.product("P", i, view); });
  const std::string line = c.vectors == Vectors::row ? "the fourth column" : "the fourth row";
  steps.sum("clip.w", steps.product("P", 3, view), clip.w,
            line + (camera.projection().isOrthographic() ? " of P is 0 0 0 1: w stays what it is"
                                                         : " of P makes w the distance along the view"));
  steps.stage("inequalities");
  const auto margin = [&](const char* side, char axis, double value, bool atLow) {
    const std::string coordinate = std::string("clip.") + axis;
    const bool isFromZero = axis == 'z' && atLow && c.ndcZ == NdcZ::zeroToOne;
    const double room = isFromZero ? value : atLow ? clip.w + value : clip.w - value;
    const std::string bound = isFromZero ? " >= 0" : atLow ? " >= -w" : " <= w";
    steps.sum(std::string("margin.") + side,
              isFromZero ? std::vector<Term>{{coordinate}}
                         : std::vector<Term>{{"clip.w"}, atLow ? Term{coordinate} : Term{"-", coordinate}},
              room, axis + bound + (room >= 0 ? ": inside" : ": outside"));
  };
  margin("left", 'x', clip.x, true);
  margin("right", 'x', clip.x, false);
  margin("bottom", 'y', clip.y, c.ndcY == NdcY::up);
  margin("top", 'y', clip.y, c.ndcY == NdcY::down);
  margin("near", 'z', clip.z, !c.reverseZ);
  if (std::isfinite(camera.projection().zFar())) margin("far", 'z', clip.z, c.reverseZ);
}

void explainScreen(Steps& steps, const Camera& camera, const Convention& c, const Vec4& point, const ScreenPoint& p) {
  const Vec4 ndc = worldTo(camera, Space::ndc, point, c);
  steps.stage("ndc");
  if (std::isnan(ndc.x))
    return steps.given("ndc.x", ndc.x,
                       p.status == PointStatus::behind
                           ? "w is not above 0: on or behind the plane through the eye, and nothing is divided"
                           : "w is 0: a direction has no pixel in orthographic");
  for (std::size_t i = 0; i < 3; ++i) steps.step("ndc" + kAxes[i], "clip" + kAxes[i] + " / clip.w", xyz(ndc)[i]);
  const std::vector<std::string> vector = {"ndc.x", "ndc.y", "ndc.z", "1"};
  steps.stage("screen");
  // Window depth is the camera's own, whatever is written: NDC z the other way round meets the range's other end.
  Viewport viewport = camera.viewport();
  const bool isExchanged = c.reverseZ != camera.convention().reverseZ;
  if (isExchanged) std::swap(viewport.depthFirst, viewport.depthSecond);
  steps.matrix("S", matrix(cameraIn(c, {}, {}, viewport), Space::screen, Space::ndc));
  steps.sum("screen.x", steps.product("S", 0, vector), p.x);
  steps.sum("screen.y", steps.product("S", 1, vector), p.y);
  steps.sum("depth", steps.product("S", 2, vector), p.depth,
            isExchanged ? "window depth; S exchanges its range, as the camera's reverseZ is not the one written"
                        : "window depth");
}

/// Focal lengths and principal point of a window whose y counts downwards.
Intrinsics explainIntrinsics(Steps& steps, const Camera& camera) {
  Intrinsics k = camera.intrinsics();
  const bool isUpwards = camera.viewport().origin != Origin::topLeft;
  if (isUpwards) k.fy = -k.fy;
  steps.given("cx", k.cx, "where the viewing axis meets the screen");
  steps.given("cy", k.cy);
  steps.given("fx", k.fx,
              camera.projection().isOrthographic() ? "pixels for a unit of length" : "pixels for a tangent of 1");
  steps.given("fy", k.fy, isUpwards ? "screen y runs upwards" : "");
  return k;
}

/// From view space straight to the pixel: a lens comes between, or there is no near and so no clip space.
void explainStraight(Steps& steps, const Camera& camera, const Vec3& view, const Convention& c, const ScreenPoint& p) {
  const auto lens = lensOf(camera);
  const double along = isBack(c) ? -view.z : view.z, down = isDown(c) ? view.y : -view.y;
  if (std::isnan(p.x) && (!lens || p.status == PointStatus::behind)) {
    steps.stage("screen");
    return steps.given("screen.x", p.x,
                       lens ? "on or behind the plane through the eye, and the lens does not see it"
                            : "on or behind the plane through the eye: no pixel");
  }
  const std::string distance = std::isnan(p.viewDistance) ? (isBack(c) ? "-view.z" : "view.z") : "viewDistance";
  if (along > 0) {
    steps.stage("tangent");
    steps.step("tangent.x", "view.x / " + distance, view.x / along, "right");
    steps.step("tangent.y", (isDown(c) ? "view.y / " : "-view.y / ") + distance, down / along, "down");
  }
  if (lens) {
    steps.stage("lens");
    if (std::isnan(p.x))
      return steps.given(
          "lens.x", p.x,
          "beyond the limit of the lens, at " + formatDigits(lens->limitDegrees(), 6) + " degrees: no pixel");
    const Vec2 bent = distorted(*lens, Vec3{view.x, down, along});
    steps.given("lens.x", bent.x, "where the lens puts the direction");
    steps.given("lens.y", bent.y);
  }
  const std::string from = lens ? "lens" : "tangent";
  steps.stage("screen");
  (void)explainIntrinsics(steps, camera);
  steps.sum("screen.x", {{"cx"}, {"fx", from + ".x"}}, p.x,
            hasDepth(camera.projection()) ? "" : "clip, NDC and depth need near, which this camera has not");
  steps.sum("screen.y", {{"cy"}, {"fy", from + ".y"}}, p.y);
  if (hasDepth(camera.projection()))
    steps.given("depth", p.depth,
                along > 0 ? "window depth, as without the lens" : "not in front of the eye: no window depth");
}

OrderedJson resultOf(const ScreenPoint& p) {
  const Sides sides(p);
  return {{"screen", std::isnan(p.x) ? OrderedJson() : asJson(Vec2{p.x, p.y})},
          {"depth", p.depth},
          {"viewDistance", p.viewDistance},
          {"visible", p.visible()},
          {"outside", std::vector(sides.names().begin(), sides.names().end())}};
}

/// window: where the pixel's ray meets the plane at distance 1, or in orthographic any, y downwards.
void explainWindow(Steps& steps, const Camera& camera, const Vec2& pixel, const Vec2& window) {
  steps.stage("window");
  steps.given("pixel.x", pixel.x);
  steps.given("pixel.y", pixel.y);
  const Intrinsics k = explainIntrinsics(steps, camera);
  const bool hasLens = lensOf(camera).has_value();
  const Vec2 seen = hasLens ? Vec2{(pixel.x - k.cx) / k.fx, (pixel.y - k.cy) / k.fy} : window;
  steps.step(hasLens ? "lens.x" : "window.x", "(pixel.x - cx) / fx", seen.x, "right");
  steps.step(hasLens ? "lens.y" : "window.y", "(pixel.y - cy) / fy", seen.y, "down");
  if (!hasLens) return;
  steps.given(
      "window.x", window.x,
      std::isnan(window.x) ? "the lens shows nothing at this pixel" : "right; the lens puts it at lens.x, lens.y");
  steps.given("window.y", window.y, "down");
}

/// From a window depth along the ray to its point.
OrderedJson explainDepth(Steps& steps, const Camera& camera, const Vec2& pixel, double depth) {
  const Projection projection = camera.projection();
  const WindowDepths ends = camera.depths();
  if (!hasDepth(projection)) throw UsageError("--pixel: a window depth needs a camera with near; --near gives it");
  // The distance is the depth's alone, also of a pixel that the lens does not reach.
  const WorldPoint straight = screenToWorld(withoutLens(camera), pixel, depth);
  if (straight.status == DepthStatus::beyond)
    throw UsageError("--pixel: no point has the window depth " + formatNumber(depth) + ": that of infinity is " +
                     formatNumber(ends.atInfinity));
  const bool orthographic = projection.isOrthographic(), isInfinite = std::isinf(projection.zFar());
  const double share = (depth - ends.atNear) / (ends.atFar - ends.atNear);
  steps.stage("distance");
  steps.given("depth", depth);
  steps.given("atNear", ends.atNear, "window depth of near");
  steps.given("atFar", ends.atFar, "window depth of far");
  steps.given("near", projection.zNear());
  if (!isInfinite) steps.given("far", projection.zFar());
  steps.step("share", "(depth - atNear) / (atFar - atNear)", share);
  if (orthographic) {
    steps.step("distance", "(1 - share)*near + share*far", straight.viewDistance);
  } else {
    const bool isPoint = straight.status == DepthStatus::point;
    steps.step("reciprocal", isInfinite ? "(1 - share) / near" : "(1 - share) / near + share / far",
               isPoint ? 1 / straight.viewDistance : 0, "linear in depth, as 1/z is on the screen");
    steps.step("distance", "1 / reciprocal", straight.viewDistance,
               isPoint ? "along the viewing axis" : "the window depth of infinity: a direction, no point");
  }
  const WorldPoint at = screenToWorld(camera, pixel, depth);
  if (at.status != DepthStatus::point) return nullptr;
  steps.stage("point");
  steps.sums("point", at.position, [](std::size_t i) {
    return std::vector<Term>{{"origin" + kAxes[i]}, {"distance", "toward" + kAxes[i]}};
  });
  return asJson(at.position);
}

/// point: before the model matrix, if there is one. Throws InputError where that takes it out of the range of doubles.
OrderedJson explainPoint(const Camera& camera, const Convention& convention, const Vec4& point,
                         const std::optional<Mat4>& model) {
  const Vec4 placed = model ? toWorld(*model, point) : point;
  const ScreenPoint p = worldToScreen(camera, placed);
  if (p.status == PointStatus::outOfRange)
    throw UsageError(!model         ? "the point lies farther than 1e46 from the eye"
                     : point.w == 0 ? "--model takes the direction to 0"
                                    : "--model takes the point out of the range of numbers");
  Steps steps(convention);
  const Vec3 world = placePoint(steps, point, model);
  explainView(steps, camera, convention, world, placed, p.viewDistance);
  if (lensOf(camera) || !hasDepth(camera.projection())) {
    explainStraight(steps, camera, xyz(worldTo(camera, Space::view, placed, convention)), convention, p);
  } else {
    explainClip(steps, camera, convention, worldTo(camera, Space::clip, placed, convention));
    explainScreen(steps, camera, convention, placed, p);
  }
  return std::move(steps).report("point", point.w == 1 ? asJson(Vec3{point.x, point.y, point.z}) : asJson(point),
                                 resultOf(p));
}

/// Throws InputError for a depth that no point in front of the eye has.
OrderedJson explainPixel(const Camera& camera, const Convention& convention, const Vec2& pixel,
                         std::optional<double> depth) {
  const bool orthographic = camera.projection().isOrthographic();
  const Ray ray = screenToRay(camera, pixel);
  // The same camera at the origin has the ray's offsets from the eye, with all their digits.
  const auto lens = lensOf(camera);
  Camera centred =
      makeCamera(movedTo(camera.pose(), Vec3{}), camera.projection(), camera.viewport(), camera.convention());
  if (lens) centred = withLens(centred, *lens);
  // A ray through a lens may point backwards: then to the plane behind the eye.
  WorldPoint ahead = screenToWorldAtDistance(centred, pixel, 1);
  const bool isBackward = ahead.status == DepthStatus::beyond;
  if (isBackward) ahead = screenToWorldAtDistance(centred, pixel, -1);
  const Vec3 at = ahead.position;
  const Mat4 back = matrix(cameraIn({}, movedTo(camera.pose(), Vec3{})), Space::world, Space::view);
  const Vec3 toward = orthographic ? Vec3{-back[0][2], -back[1][2], -back[2][2]} : at;
  const Vec3 view = xyz(worldTo(centred, Space::view, {at.x, at.y, at.z, 1}, convention));
  const double down = isDown(convention) ? 1 : -1;

  Steps steps(convention);
  explainWindow(steps, camera, pixel, {view.x, down * view.y});
  steps.stage("view");
  steps.sum("view.x", {{"window.x"}}, view.x);
  steps.sum("view.y", {down < 0 ? Term{"-", "window.y"} : Term{"window.y"}}, view.y);
  steps.given("view.z", isBack(convention) != isBackward ? -1 : 1,
              std::string(isBack(convention) ? "z points back" : "z points forward") +
                  (isBackward ? "; the ray points backwards" : ""));
  steps.stage("toward");
  steps.matrix("W", rotationOf(camera, convention, Space::world, Space::view));
  const std::string x = orthographic ? "" : "view.x", y = orthographic ? "" : "view.y";
  steps.sums("toward", toward, [&](std::size_t i) { return steps.product("W", i, {x, y, "view.z"}); });
  steps.stage("ray");
  steps.vector("eye", camera.pose().eye());
  steps.sums("origin", ray.origin, [&](std::size_t i) {
    std::vector<Term> terms;
    if (orthographic) terms = steps.product("W", i, {"view.x", "view.y", ""});
    terms.insert(terms.begin(), Term{"eye" + kAxes[i]});
    return terms;
  });
  steps.step("length", "sqrt(toward.x*toward.x + toward.y*toward.y + toward.z*toward.z)", length(toward));
  for (std::size_t i = 0; i < 3; ++i)
    steps.step("direction" + kAxes[i], "toward" + kAxes[i] + " / length", ray.direction[i]);
  OrderedJson result{{"origin", asJson(ray.origin)},
                     {"direction", std::isnan(ray.direction.x) ? OrderedJson() : asJson(ray.direction)}};
  if (depth) result["point"] = explainDepth(steps, camera, pixel, *depth);
  OrderedJson given = asJson(pixel);
  if (depth) given.push_back(*depth);
  return std::move(steps).report("pixel", std::move(given), std::move(result));
}

struct ExplainOptions {
  CameraOptions camera;
  std::optional<PointArgument> point;
  std::optional<std::vector<double>> pixel;
  std::vector<std::string> models;
  ReportOptions report;
};

int runExplain(const ExplainOptions& o) {
  if (!o.point && !o.pixel) throw UsageError("expected --point X,Y,Z or --pixel X,Y[,DEPTH]: what to follow");
  if (o.point && o.pixel)
    throw UsageError("--point and --pixel: expected one of them; viewproj check tells whether they agree");
  const CameraFile file = o.camera.read();
  if (o.point) o.point->requireFit(file.worldIsEcef);
  const Camera camera = makeCamera(file);
  const Convention convention = o.camera.writing(file.convention);
  o.camera.noteHandedness(file);
  OrderedJson report;
  if (o.point) {
    const auto model = o.models.empty() ? std::nullopt : std::optional(readModel(o.models));
    const Vec4 point = o.point->point();
    report = explainPoint(camera, convention, point, model);
    if (file.worldIsEcef && earthHides(camera.pose().eye(), model ? toWorld(*model, point) : point)) {
      report["result"]["visible"] = false;
      report["result"]["outside"].push_back("earth");
    }
  } else {
    const std::vector<double>& n = *o.pixel;
    report = explainPixel(camera, convention, {n[0], n[1]}, n.size() > 2 ? std::optional(n[2]) : std::nullopt);
  }
  if (o.report.form() == ReportForm::table) {  // for people a stage is named once
    OrderedJson& steps = report["steps"];
    for (std::size_t i = steps.size() - 1; i > 0; --i)
      if (steps[i]["stage"] == steps[i - 1]["stage"]) steps[i]["stage"] = nullptr;
  }
  o.report.write(report, "steps");
  return 0;
}

}  // namespace

Action declareExplain(CLI::App& app) {
  const auto o = std::make_shared<ExplainOptions>();
  describe(
      app,
      "Every stage of one point's way to its pixel, or of one pixel's way back: world, view, clip and where w comes "
      "from, the clip inequalities, NDC, screen, each number with its formula.",
      "Examples:\n"
      "  viewproj explain --position 3,2,5 --target 0,0,0 --fov-y 60 --near 0.1 \\\n"
      "    --viewport 1280x720 --point 1,1,1\n"
      "  viewproj explain --position 3,2,5 --target 0,0,0 --fov-y 60 --near 0.1 \\\n"
      "    --viewport 1280x720 --pixel 640,300");
  CLI::Option* const point = addValue(app, "--point", kPointForm, o->point, readPointArgument, "The point to follow");
  addValue(app, "--pixel", "X,Y[,DEPTH]", o->pixel, readPixelNumbers,
           "The pixel to follow back, with a window depth if known");
  require(addModel(app, o->models, "Where the point's model stands in the world"), point);
  o->report.add(app, 9);
  o->camera.add(app);
  o->camera.addWriting(app);
  return [o] { return runExplain(*o); };
}

}  // namespace viewproj::cmd
