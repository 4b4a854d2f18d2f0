// bundle.out of Bundler: f k1 k2, the rows of R, and t of each camera, which looks along -z with y up; pixels count
// from the picture's middle. Source: Bundler's manual, "Output format".
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/format.hpp"
#include "formats/value.hpp"
#include "formats/words.hpp"
#include "text/file.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace bundler {

constexpr std::size_t kFirst = 2, kNumbers = 15;  // N and M; the numbers of a camera

using Camera = std::vector<double>;

/// The cameras of a block of numbers; none if it is no file of Bundler. f is 0 of those that were not reconstructed.
std::vector<Camera> camerasIn(const Json& block) {
  const auto isWhole = [](const Json& number) {
    return number.is_number() && number >= 0 && number == std::floor(number.get<double>());
  };
  if (!block.is_array() || block.size() < kFirst || !isWhole(block[0]) || !isWhole(block[1])) return {};
  if (!(block[0].get<double>() * kNumbers + kFirst <= static_cast<double>(block.size()))) return {};
  std::vector<Camera> cameras(block[0].get<std::size_t>());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    Camera& c = cameras[i];
    for (std::size_t j = 0; j < kNumbers; ++j) {
      const Json& number = block[kFirst + i * kNumbers + j];
      if (!number.is_number()) return {};
      c.push_back(number);
    }
    if (c[0] != 0 && !isRotation({c.begin() + 3, c.begin() + 12})) return {};
  }
  return cameras;
}

bool recognises(const Node& root) {
  const auto block = root.json().is_object() && root.json().size() == 1 ? root.find("#1") : std::nullopt;
  return block && !camerasIn(block->json()).empty();
}

Json documentOf(const Node& block, const Camera& c) {
  Json camera{{"convention", "opengl"},
              {"cameraFromWorld",
               {{"rotation", rowsOf(std::span(c).subspan(3, 9), 3)}, {"translation", {c[12], c[13], c[14]}}}},
              {"projection", {{"type", "intrinsics"}, {"fx", c[0]}, {"fy", c[0]}}}};
  setLens(camera, block, "radial", {c[1], c[2]});
  return camera;
}

/// The pictures that list.txt names, beside the file or in the folder around it; numbers where it has another count.
std::vector<std::string> picturesOf(const std::string& file, std::size_t count) {
  std::vector<std::string> names;
  const std::filesystem::path folder = pathOf(file).parent_path();
  for (const char* list : {"list.txt", "../list.txt"}) {
    std::ifstream lines(file == shownName("-") ? "" : folder / list);
    names.clear();
    for (std::string line; std::getline(lines, line);)
      if (const auto words = wordsIn(trimmed(line)); !words.empty())
        names.emplace_back(words.front().substr(words.front().starts_with("./") ? 2 : 0));
    if (names.size() == count) return names;
  }
  for (names.clear(); names.size() < count;) names.push_back(std::to_string(names.size()));
  return names;
}

Import open(const Node& root) {
  const Node block = root.require("#1");
  const std::vector<Camera> cameras = camerasIn(block.json());
  const std::vector<std::string> names = picturesOf(root.document().name, cameras.size());
  Import result;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (cameras[i][0] != 0)
      result.add(names[i], std::to_string(i), [block, camera = cameras[i]] { return documentOf(block, camera); });
    else
      result.withoutPose.push_back(names[i]);
  return result;
}

}  // namespace bundler

extern const Format kBundler{"bundler", "a bundle.out of Bundler", "", bundler::open, "*", bundler::recognises};

}  // namespace viewproj::cmd
