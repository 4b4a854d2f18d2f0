// Sources: COLMAP documentation, "Output Format"; OpenCV's calibration sample, which writes image_points and
// grid_points.
#include "formats/observations.hpp"

#include <nlohmann/json.hpp>

#include "formats/colmap.hpp"
#include "formats/format.hpp"
#include "formats/tree.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

std::vector<Vec3> pointsOf(const Node& list) {
  const std::vector<double> numbers = numbersOf(list);
  if (numbers.size() % 3 != 0) list.fail("expected points of 3 numbers");
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < numbers.size(); i += 3) points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return points;
}

/// The corners of a board: rows of width points, a square apart.
std::vector<Vec3> boardOf(const Node& width, const Node& height, double square) {
  std::vector<Vec3> points;
  for (double y = 0; y < numberOf(height); ++y)
    for (double x = 0; x < numberOf(width); ++x) points.push_back({x * square, y * square, 0});
  return points;
}

}  // namespace

std::string eachObservation(const std::string& source, const std::function<void(const Observation&)>& take) {
  if (const auto model = colmapModel(source)) {
    eachColmapPixel(*model, [&](std::size_t image, std::int64_t number, const Vec3& point, const Vec2& pixel) {
      take({image, number, point, pixel});
    });
    return "";
  }
  const Document file = readTree(source, "FILE");
  const Node root(file);
  const auto find = [&](std::initializer_list<std::string_view> names) {
    return root.json().is_object() ? root.findAny(names) : std::nullopt;
  };
  const auto pixels = find({"image_points", "imgpoints", "img_points"});
  const auto views = find({"extrinsic_parameters", "rvecs", "rVector", "rotation_vecs"});
  if (!pixels || !views)
    throw InputError(file.name +
                     ": holds no observations; those of COLMAP's models and of OpenCV's image_points are read");
  const auto grid = find({"grid_points", "objpoints", "obj_points"});
  const auto width = root.find("board_width"), height = root.find("board_height"), square = root.find("square_size");
  std::string note;
  std::vector<Vec3> points;
  if (grid) {
    points = pointsOf(*grid);
  } else if (width && height && square) {
    points = boardOf(*width, *height, numberOf(*square));
    note = file.name + ": has no grid_points; the board is taken for a plain grid of " + std::to_string(points.size()) +
           " points, " + formatNumber(numberOf(*square)) + " apart";
  } else {
    root.fail("needs grid_points: where the board's points are");
  }
  const std::vector<double> numbers = numbersOf(*pixels);
  const std::size_t count = views->size();
  const std::size_t each = count == 0 ? 0 : numbers.size() / 2 / count;
  if (each == 0 || each * count * 2 != numbers.size() || (points.size() != each && points.size() != each * count))
    pixels->fail("expected a pixel of each of " + std::to_string(points.size()) + " points in " +
                 std::to_string(count) + " views, got " + std::to_string(numbers.size()) + " numbers");
  for (std::size_t i = 0; i < each * count; ++i)
    take({i / each,
          static_cast<std::int64_t>(i % each),
          points[points.size() == each ? i % each : i],
          {numbers[2 * i], numbers[2 * i + 1]}});
  return note;
}

}  // namespace viewproj::cmd
