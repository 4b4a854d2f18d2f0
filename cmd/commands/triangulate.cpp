// viewproj triangulate: where the rays of pixels of several cameras meet.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "camera/sea_level.hpp"
#include "commands/command.hpp"
#include "commands/plain_camera.hpp"
#include "commands/record_camera_options.hpp"
#include "commands/stream_options.hpp"
#include "output/output_file.hpp"
#include "output/results.hpp"
#include "text/error.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

using detail::crossOf;
using detail::dot;
namespace {

struct Eye {
  const RecordCamera* from;
  PlainCamera camera;
};

/// A pixel of a point. There may be many millions.
struct Sighting {
  const Eye* eye;
  Vec2 pixel;
  std::size_t line;
  std::uint32_t point;
};

struct SightRay {
  const Sighting* seen;
  Ray ray;
};
using Rays = std::vector<SightRay>;

/// How far a point lies from a pixel, and how its own pixel moves with x, y and z.
struct Look {
  Vec2 miss;
  std::array<Vec2, 3> slope;
};

Look lookAt(const SightRay& ray, const Vec3& point) {
  constexpr double kStep = 0x1p-24;
  const PlainCamera& camera = ray.seen->eye->camera;
  const auto pixelAt = [&](const Vec3& way) {
    const Vec3 p = camera.isOrthographic ? sum(camera.eye, 1, way) : way;
    return pixelOf(camera, {p.x, p.y, p.z, camera.isOrthographic ? 1.0 : 0.0});
  };
  const Vec3 way = sum(point, -1, camera.eye);
  const Vec2 at = pixelAt(way);
  const double step = kStep * length(way);
  Look look{{ray.seen->pixel.x - at.x, ray.seen->pixel.y - at.y}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 beside = way;
    beside[i] += step;
    const Vec2 moved = pixelAt(beside);
    look.slope[i] = {(moved.x - at.x) / step, (moved.y - at.y) / step};
  }
  return look;
}

/// Of a symmetric matrix that is positive definite; nothing of another.
std::optional<Rows> inverseOf(const Rows& a) {
  const Rows sides{crossOf(a[1], a[2]), crossOf(a[2], a[0]), crossOf(a[0], a[1])};
  const double size = dot(a[0], sides[0]);
  if (!(size > 0 && std::isfinite(size))) return std::nullopt;
  return Rows{scaled(sides[0], 1 / size), scaled(sides[1], 1 / size), scaled(sides[2], 1 / size)};
}

/// A point, its looks at the rays, the sum of their squares, and half its curvature and slope.
struct Meeting {
  Vec3 point;
  std::vector<Look> looks;
  double cost = 0;
  Rows normal{};
  Vec3 slope{};

  Meeting(const Rays& rays, const Vec3& at) : point(at) {
    looks.reserve(rays.size());
    for (const SightRay& ray : rays) {
      const Look look = looks.emplace_back(lookAt(ray, at));
      cost += look.miss.x * look.miss.x + look.miss.y * look.miss.y;
      for (std::size_t i = 0; i < 3; ++i) {
        slope[i] += look.slope[i].x * look.miss.x + look.slope[i].y * look.miss.y;
        for (std::size_t j = 0; j < 3; ++j)
          normal[i][j] += look.slope[i].x * look.slope[j].x + look.slope[i].y * look.slope[j].y;
      }
    }
  }
};

double nearestEye(const Rays& rays, const Vec3& point) {
  double nearest = HUGE_VAL;
  for (const SightRay& ray : rays) nearest = std::min(nearest, apart(ray.seen->eye->camera.eye, point));
  return nearest;
}

/// The point nearest to the rays; nothing where they are parallel.
std::optional<Vec3> nearestPoint(const Rays& rays) {
  Rows a{};
  Vec3 b{};
  const Vec3 first = rays.front().ray.origin;
  for (const auto& [seen, ray] : rays) {
    const Vec3 d = ray.direction, from = sum(ray.origin, -1, first);
    b = sum(sum(b, 1, from), -dot(d, from), d);
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = sum(a[i], -d[i], d);
      a[i][i] += 1;
    }
  }
  const auto inverse = inverseOf(a);
  return inverse ? std::optional(sum(first, 1, *inverse * b)) : std::nullopt;
}

/// The least squares of the misses in pixels; nothing where that is behind a camera. Levenberg's damping.
std::optional<Meeting> meetingOf(const Rays& rays, const Vec3& start) {
  constexpr int kSteps = 50;
  Meeting at(rays, start);
  if (!std::isfinite(at.cost)) return std::nullopt;
  double damping = 0;
  for (int step = 0; step < kSteps; ++step) {
    Rows damped = at.normal;
    for (std::size_t i = 0; i < 3; ++i) damped[i][i] *= 1 + damping;
    const auto inverse = inverseOf(damped);
    if (!inverse) break;
    const Vec3 way = *inverse * at.slope;
    if (length(way) <= 1e-12 * nearestEye(rays, at.point) + 0x1p-52 * length(at.point)) break;
    Meeting next(rays, sum(at.point, 1, way));
    const bool isBetter = next.cost <= at.cost;
    damping = isBetter ? damping / 100 : std::max(100 * damping, 1e-4);
    if (isBetter) at = std::move(next);
  }
  return at;
}

/// Of the rays' directions, up to 90 degrees.
double largestAngle(const Rays& rays) {
  double largest = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 &a = rays[i].ray.direction, &b = rays[j].ray.direction;
      largest = std::max(largest, std::atan2(length(crossOf(a, b)), std::fabs(dot(a, b))));
    }
  return largest * 180 / std::numbers::pi;
}

/// The least squares from the point that is nearest to the rays.
std::optional<Meeting> meetingOf(const Rays& rays) {
  const auto start = rays.size() > 1 ? nearestPoint(rays) : std::nullopt;
  return start ? meetingOf(rays, *start) : std::nullopt;
}

/// A miss in units of what a pixel of noise makes it: its own noise, and what the noise of the others makes of the
/// point that they meet in. Where the point is of all rays, this ray's too, it is what it would be without it, nearly.
double weighed(const Look& look, const Meeting& met, bool isOfAll) {
  const auto variance = inverseOf(met.normal);
  if (!variance) return std::isfinite(look.miss.x) ? 0 : HUGE_VAL;
  const auto along = [&](double Vec2::*a, double Vec2::*b) {
    const Vec3 across{look.slope[0].*b, look.slope[1].*b, look.slope[2].*b};
    const double of = dot(Vec3{look.slope[0].*a, look.slope[1].*a, look.slope[2].*a}, *variance * across);
    return (a == b ? 1 : 0) + (isOfAll ? -of : of);
  };
  const double xx = along(&Vec2::x, &Vec2::x), xy = along(&Vec2::x, &Vec2::y), yy = along(&Vec2::y, &Vec2::y);
  const auto [x, y] = look.miss;
  const double square = (yy * x * x - 2 * xy * x * y + xx * y * y) / (xx * yy - xy * xy);
  return square >= 0 ? std::sqrt(square) : HUGE_VAL;
}

/// The ray whose weighed miss is beyond five times the rms of the others, and of half a pixel of noise, where it is
/// left out; of several, the one whose others agree best. met: of all rays.
std::optional<std::size_t> wrongRay(const Rays& rays, const std::optional<Meeting>& met, double noise) {
  constexpr double kTimes = 5;
  const double least = noise / 2;
  std::optional<std::size_t> wrong;
  double best = HUGE_VAL;
  for (std::size_t i = 0; rays.size() > 2 && i < rays.size(); ++i) {
    if (met && weighed(met->looks[i], *met, true) < kTimes * least / 2) continue;  // far from it
    Rays rest = rays;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    const auto without = meetingOf(rest);
    if (!without) continue;
    const double rms = std::sqrt(without->cost / static_cast<double>(rest.size()));
    if (rms >= best || weighed(lookAt(rays[i], without->point), *without, false) <= kTimes * std::max(rms, least))
      continue;
    best = rms;
    wrong = i;
  }
  return wrong;
}

struct TriangulateOptions {
  CameraOptions camera;
  RecordCameraOptions cameras;
  StreamOptions stream;
  std::optional<std::string> by;
  bool isSorted = false, isRobust = false, hasMisses = false;
  double noise = 1;
};

/// Makes points of sightings, and writes them.
class Triangulator {
 public:
  Triangulator(const TriangulateOptions& o, const StreamSetup& setup, bool isOnEarth)
      : options_(o), setup_(setup), isOnEarth_(isOnEarth) {}

  const Eye* eyeOf(const RecordCamera& camera) {
    if (!lastEye_ || lastEye_->from != &camera)
      lastEye_ = &eyes_.try_emplace(&camera, Eye{&camera, plainOf(camera.camera)}).first->second;
    return lastEye_;
  }

  void write(const RecordView& record, std::span<const Sighting> sightings);
  void finish() {
    static const Schema kNone;
    if (!output_) output_.emplace(setup_, kNone, rows());
    output_->finish();
  }
  bool lacksPoints() const { return lacksPoints_; }

 private:
  ResultRows rows() const {
    ResultRows rows{&results::position};
    if (isOnEarth_) rows = {&results::lat, &results::lon, &results::height};
    if (isOnEarth_ && hasGeoid()) rows.push_back(&results::altitude);
    rows.insert(rows.end(), std::begin(results::kMeeting), std::end(results::kMeeting));
    if (options_.hasMisses) rows.push_back(&results::misses);
    return rows;
  }
  /// Why there is no point.
  std::string_view reasonAgainst(const Rays& rays, const std::optional<Meeting>& met, const Vec3& sigma) const {
    if (rays.size() < 2) return "fewer than two rays";
    if (largestAngle(rays) < 0.01) return "parallel";
    if (!met) return "behind";
    return std::max({sigma.x, sigma.y, sigma.z}) <= nearestEye(rays, met->point) ? "" : "parallel";
  }
  /// Standard deviations along x, y, z, or east, north, up; infinite where they are not known.
  Vec3 sigmaOf(const Meeting& met) const {
    const auto variance = inverseOf(met.normal);
    const LocalAxes axes = isOnEarth_ ? localAxes(ecefToGeodetic(met.point)) : LocalAxes{};
    const auto along = [&](const Vec3& axis) {
      return variance ? options_.noise * std::sqrt(dot(axis, *variance * axis)) : HUGE_VAL;
    };
    return {along(axes.east), along(axes.north), along(axes.up)};
  }

  const TriangulateOptions& options_;
  const StreamSetup& setup_;
  bool isOnEarth_, lacksPoints_ = false;
  std::unordered_map<const RecordCamera*, Eye> eyes_;
  const Eye* lastEye_ = nullptr;
  std::optional<RecordOutput> output_;
  Rays rays_;
  ResultValues values_;
};

void Triangulator::write(const RecordView& record, std::span<const Sighting> sightings) {
  constexpr Vec3 kNone{NAN, NAN, NAN};
  rays_.clear();
  for (const Sighting& seen : sightings) {
    const Ray ray = screenToRay(seen.eye->from->camera, seen.pixel);
    if (std::isfinite(ray.direction.x)) rays_.push_back({&seen, ray});
  }
  auto met = meetingOf(rays_);
  const auto wrong = wrongRay(rays_, met, options_.noise);
  const double wrongLine = wrong ? static_cast<double>(rays_[*wrong].seen->line) : NAN;
  if (wrong && options_.isRobust) {
    rays_.erase(rays_.begin() + static_cast<std::ptrdiff_t>(*wrong));
    met = meetingOf(rays_);
  }
  const Vec3 sigma = met ? sigmaOf(*met) : kNone;
  const std::string_view reason = reasonAgainst(rays_, met, sigma);
  const bool isThere = reason.empty();
  lacksPoints_ |= !isThere;

  const auto missOf = [&](std::size_t i) { return isThere ? met->looks[i].miss : Vec2{NAN, NAN}; };
  std::size_t worst = 0;
  for (std::size_t i = 0; i < rays_.size(); ++i)
    if (length(missOf(i)) > length(missOf(worst))) worst = i;
  const auto count = static_cast<double>(rays_.size());
  values_.clear();
  const Geodetic place = isThere && isOnEarth_ ? ecefToGeodetic(met->point) : Geodetic{NAN, NAN, NAN};
  values_.add(!isThere ? kNone : isOnEarth_ ? Vec3{place.lat, place.lon, place.height} : met->point);
  if (isOnEarth_ && hasGeoid()) values_.add(place.height - seaLevelAt(place.lat, place.lon));
  values_.addWord(reason);
  values_.add(count);
  values_.add(isThere ? std::sqrt(met->cost / count) : NAN);
  values_.add(isThere ? length(missOf(worst)) : NAN);
  values_.add(isThere ? static_cast<double>(rays_[worst].seen->line) : NAN);
  values_.add(wrongLine);
  values_.add(rays_.size() > 1 ? largestAngle(rays_) : NAN);
  values_.add(isThere ? sigma : kNone);
  if (options_.hasMisses) values_.addCount(rays_.size());
  for (std::size_t i = 0; options_.hasMisses && i < rays_.size(); ++i) {
    values_.add(static_cast<double>(rays_[i].seen->line));
    values_.addWord(rays_[i].seen->eye->from->name);
    values_.add(missOf(i));
  }
  if (!output_) output_.emplace(setup_, *record.schema, rows());
  output_->write(record, values_);
}

/// Sightings by their points, in the order of these.
class Points {
 public:
  /// field: of the point's name; without it all sightings are of one point, one of a camera.
  Points(Triangulator& triangulator, const std::optional<std::string>& field, bool isSorted)
      : triangulator_(triangulator), field_(field), isSorted_(isSorted) {}

  void add(const RecordView& record, const std::optional<Sighting>& seen) {
    const std::size_t field = field_ ? cameraFieldOf(*field_, record, "--by") : 0;
    const bool isBinary = cmd::isBinary(record.schema->form), isJson = record.schema->form == Form::json;
    std::string name = !field_    ? (isJson ? "null" : "")
                       : isBinary ? cameraNameAt(record, field)
                                  : std::string(record.values[field]);
    if (schema_.size == 0) {
      const bool hasName = field_ && !record.schema->isArray && record.schema->hasHeader;
      schema_ = {
          isBinary ? Form::text : record.schema->form, false, 1, {hasName ? record.schema->names[field] : "point"}};
      schema_.separator = record.schema->separator;
    }
    if (!field_ && seen)
      if (const auto [other, isFirst] = lineOf_.try_emplace(seen->eye, seen->line); !isFirst)
        throw RecordError(0, "is the second pixel of its camera, after line " + std::to_string(other->second) +
                                 "; --by FIELD names the point of each");
    if (isSorted_ && !names_.empty() && *names_.front() != name) flush();
    const auto [found, isNew] = index_.try_emplace(std::move(name), names_.size());
    if (isNew) names_.push_back(&found->first);
    if (!seen) return;
    sightings_.push_back(*seen);
    sightings_.back().point = found->second;
  }

  void flush() {
    std::stable_sort(sightings_.begin(), sightings_.end(),
                     [](const Sighting& a, const Sighting& b) { return a.point < b.point; });
    auto from = sightings_.begin();
    for (std::uint32_t i = 0; i < names_.size(); ++i) {
      const auto to = std::find_if(from, sightings_.end(), [&](const Sighting& seen) { return seen.point != i; });
      const std::string_view value = *names_[i];
      const std::string text = schema_.form == Form::json
                                   ? "{" + jsonOf(schema_.names[0]) + ":" + std::string(value) + "}"
                                   : std::string(value);
      triangulator_.write({text, &schema_, {&value, 1}}, {from, to});
      from = to;
    }
    sightings_.clear();
    names_.clear();
    index_.clear();
  }

 private:
  Triangulator& triangulator_;
  const std::optional<std::string>& field_;
  bool isSorted_;
  Schema schema_;
  std::unordered_map<const Eye*, std::size_t> lineOf_;  ///< where all are of one point
  std::unordered_map<std::string, std::uint32_t> index_;
  std::vector<const std::string*> names_;
  std::vector<Sighting> sightings_;
};

int runTriangulate(const TriangulateOptions& o) {
  const bool areNamed = o.cameras.areNamed();
  StreamSetup setup = o.stream.setup(areNamed ? kPixelAloneColumns : kTwoPixelsColumns);
  o.stream.reads(setup);
  const RecordCameras cameras = o.cameras.read(o.camera, setup, [](const CameraFile&) {});
  setup.namesCameras = false;
  setup.areWords = true;
  setup.arrayName = "pixels";
  CamerasOfBatch finder(cameras);
  Triangulator triangulator(o, setup, cameras.worldIsEcef());
  Points points(triangulator, o.by, o.isSorted);
  const auto locate = [&](const RecordView& record) {
    return areNamed ? findPixel(record, setup.columns) : findTwoPixels(record, setup.columns);
  };
  const auto use = [&](const NumberPlan& plan, const Numbers& n, const RecordView& record, std::size_t line) {
    const auto eyes = finder.find(record, cameras.locate(record, plan));
    if (areNamed) {
      const auto pixel = toPixel(plan, n).screen;
      points.add(record, pixel ? std::optional(Sighting{triangulator.eyeOf(*eyes[0]), *pixel, line, 0}) : std::nullopt);
      return;
    }
    if (eyes.size() < 2) throw InputError("two pixels in a record need two cameras, and -c has one");
    const Sighting two[] = {{triangulator.eyeOf(*eyes[0]), {n[0], n[1]}, line, 0},
                            {triangulator.eyeOf(*eyes[1]), {n[2], n[3]}, line, 0}};
    triangulator.write(record, two);
  };
  int status = 0;
  try {
    status = readRecords(setup, {locate, use});
  } catch (...) {
    triangulator.finish();
    throw;
  }
  points.flush();
  triangulator.finish();
  return std::max(status, triangulator.lacksPoints() ? 1 : 0);
}

}  // namespace

Action declareTriangulate(CLI::App& app) {
  const auto o = std::make_shared<TriangulateOptions>();
  describe(
      app,
      "Where the rays of a point's pixels meet, by least squares of their misses. A record is a pixel with the names "
      "of its camera and its point; or u1, v1, u2, v2, its pixels in the first two cameras of -c. sigma: how far x, y "
      "and z may be off; angle: the largest between two rays; wrong: the line of a pixel that the others contradict. "
      "Status 1 where a position is null.",
      "Examples:\n"
      "  rig='{\"cameras\": [{}, {\"position\": [1, 0, 0]}], \"position\": [0, 0, 0],\n"
      "    \"direction\": [0, 0, -1], \"projection\": {\"type\": \"perspective\", \"fovY\": 60},\n"
      "    \"viewport\": {\"width\": 640, \"height\": 480}}'\n"
      "  printf 'u1,v1,u2,v2\\n400,200,330,200\\n' | viewproj triangulate -c \"$rig\"\n"
      "  printf 'point,camera,u,v\\na,0,400,200\\na,1,330,200\\n' |\n"
      "    viewproj triangulate -c \"$rig\" --camera-by camera --by point --to table");
  CLI::Option* const by = o->cameras.addNamed(app);
  CLI::Option* const point =
      addValue(app, "--by", "FIELD", o->by, readText, "The field that names a point (default: one point)");
  require(point, by);
  require(addFlag(app, "--sorted", o->isSorted, "Records of a point stand together: memory stays flat"), point);
  addFlag(app, "--robust", o->isRobust, "Leave out the pixel that the others contradict");
  addValue(app, "--noise", "PIXELS", o->noise,
           numberThat([](double noise) { return noise > 0 && std::isfinite(noise); }, "a number of pixels above 0"),
           "Noise of a pixel, for sigma (default: 1)");
  addOption(
      app, "--fields", "misses",
      [o](const std::string& option, const std::string& text) {
        o->hasMisses = choose(option, text, Names<bool>{{"misses", true}});
      },
      "Add the misses, given minus computed (--to json)");
  o->stream.add(app, "pixels");
  removeOption(app, "--jobs");
  o->camera.takeAnySize();
  o->camera.add(app);
  return [o] { return runTriangulate(*o); };
}

}  // namespace viewproj::cmd
