// bundle.out of Bundler: f k1 k2, the rows of R, and t of each camera, which looks along -z with y up; pixels count
// from the picture's middle. Source: Bundler's manual, "Output format".
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"

namespace viewproj::cmd {
namespace bundler {

constexpr std::size_t kFirst = 2, kNumbers = 15;  // N and M; the numbers of a camera

bool recognises(const Node& root) {
  const auto numbers = root.json().is_object() && root.json().size() == 1 ? root.find("#1") : std::nullopt;
  if (!numbers || !numbers->json().is_array() || numbers->json().size() < kFirst + kNumbers) return false;
  const Json& list = numbers->json();
  for (std::size_t i = 0; i < kFirst + kNumbers; ++i)
    if (!list[i].is_number()) return false;
  const double count = list[0].get<double>(), points = list[1].get<double>();
  if (!(count >= 1 && count == std::floor(count) && points >= 0 && points == std::floor(points))) return false;
  if (!(count * kNumbers + kFirst <= static_cast<double>(list.size()))) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::vector<double> r;
    for (std::size_t j = 0; j < 9; ++j) {
      const Json& entry = list[kFirst + i * kNumbers + 3 + j];
      if (!entry.is_number()) return false;
      r.push_back(entry.get<double>());
    }
    if (list[kFirst + i * kNumbers] != 0 && !isRotation(r)) return false;
  }
  return true;
}

Import open(const Node& root) {
  const Node all = root.require("#1");
  const std::vector<double> numbers = numbersOf(all);
  Import result;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < static_cast<std::size_t>(numbers[0]); ++i) {
    if (numbers[kFirst + i * kNumbers] == 0) continue;  // was not reconstructed
    result.cameras.push_back({std::to_string(i), ""});
    places.push_back(kFirst + i * kNumbers);
  }
  result.document = [all, numbers, places](std::size_t which) {
    const std::vector<double> c(numbers.begin() + static_cast<std::ptrdiff_t>(places[which]),
                                numbers.begin() + static_cast<std::ptrdiff_t>(places[which] + kNumbers));
    Json camera{{"convention", "opengl"},
                {"cameraFromWorld",
                 {{"rotation", {{c[3], c[4], c[5]}, {c[6], c[7], c[8]}, {c[9], c[10], c[11]}}},
                  {"translation", {c[12], c[13], c[14]}}}},
                {"projection", {{"type", "intrinsics"}, {"fx", c[0]}, {"fy", c[0]}}}};
    if (Json lens = lensOf(all, "radial", std::vector{c[1], c[2]}); !lens.is_null())
      camera["distortion"] = std::move(lens);
    return camera;
  };
  return result;
}  // namespace bundler

}  // namespace bundler

extern const Format kBundler{"bundler", "a bundle.out of Bundler", "", bundler::open, "*", bundler::recognises};

}  // namespace viewproj::cmd
