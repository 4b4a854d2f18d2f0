// Streams of records: project, ray and cull on them, and the same bytes read in blocks of every size.
#include <cmath>

#include "fuzz.hpp"
#include "records/points.hpp"
#include "records/scene.hpp"
#include "stream/filter.hpp"
#include "targets.hpp"
#include "text/error.hpp"
#include "viewproj/matrices.hpp"
#include "viewproj/scene.hpp"
#include "viewproj/screen.hpp"

namespace viewproj::fuzz {
namespace {

using namespace cmd;

constexpr double kWidth = 1280, kHeight = 720;

constexpr ResultRow kScreen{"screen", ResultKind::vector, 2}, kDepth{"depth"}, kClip{"clip", ResultKind::vector, 4},
    kVisible{"visible", ResultKind::flag}, kDirection{"direction", ResultKind::vector, 3},
    kPoint{"point", ResultKind::vector, 3};

Camera someCamera(bool orthographicLens) {
  const Projection lens =
      orthographicLens ? orthographic(-8, 8, -4.5, 4.5, -1, 100) : perspectiveWindow(-1, 1, -0.5625, 0.5625, 0.1, 1000);
  Viewport viewport;
  viewport.width = kWidth;
  viewport.height = kHeight;
  return makeCamera(lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right), lens, viewport);
}

struct Setting {
  Camera camera = someCamera(false);
  Frustum frustum = viewFrustum(camera);
  bool onEarth = false;  ///< places are points, and three numbers without names are none
};

const Setting& setting(bool orthographicLens) {
  static const Setting perspective{.onEarth = true}, flat{someCamera(true)};
  return orthographicLens ? flat : perspective;
}

/// Numbers of a record as the plan found them, until their results are asked for.
class Work : public RecordProcessor {
 public:
  explicit Work(const Setting& in) : in_(in) {}
  void clear() override { rows_.clear(); }

 protected:
  const Setting& in_;
  std::vector<std::pair<NumberPlan, Numbers>> rows_;
};

class Points final : public Work {
 public:
  using Work::Work;
  NumberPlan locate(const RecordView& record) const override {
    return findPoint(record, {.columns = {}, .worldIsEcef = in_.onEarth, .segments = true});
  }
  ResultRows rows(const NumberPlan&) const override { return {&kScreen, &kDepth, &kClip, &kVisible}; }
  void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera&) override {
    if (!isSegment(plan)) (void)toPoint(plan, numbers);
    rows_.emplace_back(plan, numbers);
  }
  void results(std::size_t i, ResultValues& values) override {
    const auto& [plan, n] = rows_[i];
    if (!isSegment(plan)) return addPoint(toPoint(plan, n), values);
    const VisibleSegment segment = clipSegment(in_.frustum, {n[0], n[1], n[2]}, {n[3], n[4], n[5]});
    if (segment.visible && !(segment.start.t >= 0 && segment.start.t <= segment.end.t && segment.end.t <= 1))
      found("the visible part of a segment is none");
    addPoint({n[0], n[1], n[2], 1}, values);
  }

 private:
  void addPoint(const Vec4& point, ResultValues& values) const {
    const ScreenPoint p = worldToScreen(in_.camera, point);
    if (p.visible() && !(p.x >= 0 && p.x <= kWidth && p.y >= 0 && p.y <= kHeight))
      found("a visible point lies outside of the picture");
    values.add(Vec2{p.x, p.y});
    values.add(p.depth);
    values.add(worldTo(in_.camera, Space::clip, point, in_.camera.convention()));
    values.add(p.visible());
  }
};

class Pixels final : public Work {
 public:
  using Work::Work;
  NumberPlan locate(const RecordView& record) const override { return findPixel(record, {}); }
  ResultRows rows(const NumberPlan&) const override { return {&kDirection, &kPoint}; }
  void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera&) override {
    rows_.emplace_back(plan, numbers);
  }
  void results(std::size_t i, ResultValues& values) override {
    const Pixel pixel = toPixel(rows_[i].first, rows_[i].second);
    const Vec2 screen = pixel.screen.value_or(Vec2{NAN, NAN});
    const Ray ray = screenToRay(in_.camera, screen);
    const double length = std::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
    if (std::isfinite(length) && !(std::fabs(length - 1) < 1e-12)) found("a ray's direction is not of unit length");
    values.add(ray.direction);
    values.add((pixel.viewDistance ? screenToWorldAtDistance(in_.camera, screen, *pixel.viewDistance)
                                   : screenToWorld(in_.camera, screen, pixel.depth.value_or(NAN)))
                   .position);
  }
};

class Shapes final : public Work {
 public:
  using Work::Work;
  NumberPlan locate(const RecordView& record) const override {
    return findPoint(record, {.columns = {}, .worldIsEcef = in_.onEarth, .shapes = true, .radius = true});
  }
  ResultRows rows(const NumberPlan&) const override { return {&kVisible}; }
  void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera&) override {
    (void)toShape(plan, numbers);
    rows_.emplace_back(plan, numbers);
  }
  void results(std::size_t i, ResultValues& values) override {
    const CullShape shape = toShape(rows_[i].first, rows_[i].second);
    const Cull result = std::visit([&](const auto& one) { return cull(in_.frustum, one); }, shape);
    if (result.verdict == CullVerdict::inside && result.side != 0) found("what is inside lies beyond a plane");
    values.add(result.verdict != CullVerdict::outside);
  }
};

struct Run {
  bool finished = false;
  int status = 0;
  std::string out, error;
  bool operator==(const Run&) const = default;
};

struct How {
  std::optional<Form> from;
  std::optional<OutputForm> to;
  bool keepGoing = false, orthographic = false;
  unsigned work = 0;
  std::size_t block = 4096;  ///< more than any input has
};

Run run(std::string_view input, const How& how) {
  const Setting& in = setting(how.orthographic);
  const MakeProcessor makeProcessor = [&](OutputForm) -> std::unique_ptr<RecordProcessor> {
    if (how.work == 0) return std::make_unique<Points>(in);
    if (how.work == 1) return std::make_unique<Pixels>(in);
    return std::make_unique<Shapes>(in);
  };
  StreamSetup setup;
  setup.from = how.from;
  setup.to = how.to;
  setup.keepGoing = how.keepGoing;
  setup.jobs = 1;
  setup.blockSize = how.block;
  setup.csvDefaults = {"x", "y", "z"};
  setup.arrayName = how.work == 1 ? "screen" : "position";
  giveInput(input);
  Run result;
  try {
    result.status = runFilter(setup, RecordCameras(in.camera), makeProcessor);
    result.finished = true;
  } catch (const InputError& e) {
    result.error = e.what();
  } catch (const UsageError& e) {
    result.error = e.what();
  } catch (const std::exception& e) {
    found(std::string("an exception without a place: ") + e.what());
  }
  result.out = takeOutput();
  return result;
}

/// The first choice tells what is done, the second in how large blocks it is read again.
void fuzzRecords(std::string_view input, Form form) {
  constexpr std::optional<OutputForm> kTo[] = {std::nullopt,     OutputForm::lines, OutputForm::array, OutputForm::csv,
                                               OutputForm::text, OutputForm::f64,   OutputForm::table};
  const unsigned choice = takeChoice(input, 256);
  const std::size_t block = 1 + takeChoice(input, 256);
  How how{.from = choice % 11 == 10 ? std::nullopt : std::optional(form),
          .to = choice % 3 == 0 ? kTo[choice / 3 % std::size(kTo)] : std::nullopt,
          .keepGoing = choice % 2 == 1,
          .orthographic = choice % 5 == 4,
          .work = choice / 64 % 3};
  const Run whole = run(input, how);
  const OutputForm to = how.to.value_or(sameForm(form));
  if (how.from && (to == OutputForm::lines || to == OutputForm::array)) requireJson(whole.out, "a stream");
  how.block = block;
  const Run again = run(input, how);
  if (!(again == whole))
    found("in blocks of " + std::to_string(block) + " the answer is another:\n" + again.out + again.error + "\n--\n" +
          whole.out + whole.error);
}

}  // namespace

void fuzzJsonRecords(std::string_view input) { fuzzRecords(input, Form::json); }
void fuzzCsvRecords(std::string_view input) { fuzzRecords(input, Form::csv); }
void fuzzTextRecords(std::string_view input) { fuzzRecords(input, Form::text); }
void fuzzF64Records(std::string_view input) { fuzzRecords(input, Form::f64); }

}  // namespace viewproj::fuzz
