// COLMAP's cameras.txt and images.txt as JSON. Source: COLMAP documentation, "Output Format".
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "camera/importers/importer.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The first words of a line as numbers and texts, then the rest as one text. Nothing for a comment.
std::vector<Json> wordsOf(std::string_view line, std::size_t most) {
  std::vector<Json> words;
  if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  line.remove_suffix(line.size() - (line.find_last_not_of(" \t\r") + 1));
  while (!line.empty()) {
    line.remove_prefix(line.find_first_not_of(" \t"));
    if (words.empty() && line.starts_with('#')) break;
    const std::string_view word = words.size() < most ? line.substr(0, line.find_first_of(" \t")) : line;
    const auto number = words.size() < most ? parseNumber(word) : std::nullopt;
    words.push_back(number ? Json(*number) : Json(word));
    line.remove_prefix(word.size());
  }
  return words;
}

bool areNumbers(std::span<const Json> words) {
  return std::all_of(words.begin(), words.end(), [](const Json& word) { return word.is_number(); });
}

/// CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]
bool isCamera(const std::vector<Json>& words) {
  return words.size() > 3 && words[0].is_number() && words[1].is_string() && areNumbers(std::span(words).subspan(2));
}

/// IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME
bool isImage(const std::vector<Json>& words) { return words.size() > 9 && areNumbers(std::span(words).first(9)); }

std::string idOf(const Json& word) { return formatNumber(word.get<double>()); }

/// Whether a line lists points: X Y POINT3D_ID repeated, or nothing. It is the next image if it names a camera of the
/// file and begins with a unit quaternion.
bool isPointsLine(std::string_view line, const Json& cameras) {
  std::vector<Json> words = wordsOf(line, 60);  // the first words of a long line are enough
  words.resize(std::min<std::size_t>(words.size(), 60));
  if (!areNumbers(words) || words.size() % 3 != 0) return false;
  double square = 0;
  for (std::size_t i = 1; i < std::min<std::size_t>(words.size(), 5); ++i)
    square += std::pow(words[i].get<double>(), 2);
  return !(isImage(words) && cameras.contains(idOf(words[8])) && std::fabs(square - 1) < 0.01);
}

/// Reads a file line by line. read returns what is wrong with a line.
void readLines(const std::string& name, const std::function<std::string(const std::string& line)>& read) {
  std::ifstream file(pathOf(name), std::ios::binary);
  if (!file) throw InputError(visible(name) + ": " + std::generic_category().message(errno));
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number)
    if (const std::string fault = read(line); !fault.empty())
      throw InputError(visible(name) + ":" + std::to_string(number) + ": " + fault);
}

Json readCameras(const std::string& name) {
  Json cameras = Json::object();
  readLines(name, [&](const std::string& line) {
    const std::vector<Json> w = wordsOf(line, line.size());
    if (w.empty()) return "";
    if (!isCamera(w)) return "expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]";
    const Json params(std::vector(w.begin() + 4, w.end()));
    const Json camera{{"model", w[1]}, {"width", w[2]}, {"height", w[3]}, {"params", params}};
    return cameras.emplace(idOf(w[0]), camera).second ? "" : "a second camera of this CAMERA_ID";
  });
  return cameras;
}

Json readImages(const std::string& name, const Json& cameras) {
  Json images = Json::array();
  bool isPoints = false;
  readLines(name, [&](const std::string& line) {
    if (std::exchange(isPoints, false))
      return isPointsLine(line, cameras) ? "" : "expected the image's points, X Y POINT3D_ID each, or an empty line";
    const std::vector<Json> w = wordsOf(line, 9);
    if (w.empty()) return "";
    if (!isImage(w)) return "expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME";
    if (!cameras.contains(idOf(w[8]))) return "has a CAMERA_ID that is not in cameras.txt";
    images.push_back({{"id", idOf(w[0])},
                      {"camera_id", idOf(w[8])},
                      {"name", w[9]},
                      {"qvec", {w[1], w[2], w[3], w[4]}},
                      {"tvec", {w[5], w[6], w[7]}}});
    isPoints = true;
    return "";
  });
  return images;
}

/// The words of the first line that is not blank or a comment.
std::vector<Json> firstWords(const std::filesystem::path& name) {
  std::ifstream file(name, std::ios::binary);
  std::vector<Json> words;
  for (std::string line; words.empty() && std::getline(file, line);) words = wordsOf(line, line.size());
  return words;
}

}  // namespace

bool isColmap(const std::string& name) {
  std::error_code ignored;
  if (std::filesystem::is_directory(pathOf(name), ignored))
    return std::filesystem::exists(pathOf(name) / "cameras.txt", ignored);
  if (!name.ends_with(".txt") || !std::filesystem::is_regular_file(pathOf(name), ignored)) return false;
  const std::vector<Json> words = firstWords(pathOf(name));
  return isCamera(words) || (isImage(words) && words[9].is_string());  // a table of numbers names no picture
}

Json readColmap(const std::string& folderOrFile) {
  std::error_code ignored;
  const std::filesystem::path source = pathOf(folderOrFile);
  const bool isFolder = std::filesystem::is_directory(source, ignored);
  const auto beside = [&](const char* name) {
    const std::u8string path = ((isFolder ? source : source.parent_path()) / name).generic_u8string();
    return std::string(path.begin(), path.end());
  };
  const bool isCameras = !isFolder && isCamera(firstWords(source));
  Json root{{"cameras", readCameras(isCameras ? folderOrFile : beside("cameras.txt"))}};
  const std::string images = isFolder ? beside("images.txt") : folderOrFile;
  if (!isCameras && std::filesystem::exists(pathOf(images), ignored))
    root["images"] = readImages(images, root["cameras"]);
  return root;
}

}  // namespace viewproj::cmd
