// COLMAP's cameras and images, of text and binary files, as JSON. Source: COLMAP documentation, "Output Format".
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "formats/colmap.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// The first words of a line as numbers and texts, then the rest as one text. Nothing for a comment.
std::vector<Json> fieldsOf(std::string_view line, std::size_t most) {
  std::vector<Json> words;
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
  std::vector<Json> words = fieldsOf(line, 60);  // the first words of a long line are enough
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
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    if (number == 1) line.erase(0, line.size() - withoutByteOrderMark(line).size());
    if (const std::string fault = read(line); !fault.empty())
      throw InputError(visible(name) + ":" + std::to_string(number) + ": " + fault);
  }
}

Json readCameras(const std::string& name) {
  Json cameras = Json::object();
  readLines(name, [&](const std::string& line) {
    const std::vector<Json> w = fieldsOf(line, line.size());
    if (w.empty()) return "";
    if (!isCamera(w)) return "expected CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]";
    const Json params(std::vector(w.begin() + 4, w.end()));
    const Json camera{{"model", w[1]}, {"width", w[2]}, {"height", w[3]}, {"params", params}};
    return cameras.emplace(idOf(w[0]), camera).second ? "" : "a second camera of this CAMERA_ID";
  });
  return cameras;
}

/// Of each pixel of an image: the image's number, the pixel, and the number of its point, or below 0.
using TakePixel = std::function<void(std::size_t image, const Vec2& pixel, std::int64_t point)>;

Json readImages(const std::string& name, const Json& cameras, const TakePixel& take) {
  Json images = Json::array();
  bool isPoints = false;
  readLines(name, [&](const std::string& line) {
    if (std::exchange(isPoints, false)) {
      if (!isPointsLine(line, cameras)) return "expected the image's points, X Y POINT3D_ID each, or an empty line";
      if (!take) return "";
      const std::vector<Json> w = fieldsOf(line, line.size());
      if (w.size() % 3 != 0 || !areNumbers(w)) return "expected the image's points, X Y POINT3D_ID each";
      for (std::size_t i = 0; i < w.size(); i += 3)
        take(images.size() - 1, {w[i], w[i + 1]}, w[i + 2].get<std::int64_t>());
      return "";
    }
    const std::vector<Json> w = fieldsOf(line, 9);
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

/// The numbers of a binary file, the lowest byte first.
class BinaryFile {
 public:
  explicit BinaryFile(const std::string& name) : name_(name), file_(pathOf(name), std::ios::binary) {
    if (!file_) throw InputError(visible(name) + ": " + std::generic_category().message(errno));
    file_.seekg(0, std::ios::end);
    left_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    file_.seekg(0);
  }

  [[noreturn]] void fail(const std::string& message) const { throw InputError(visible(name_) + ": " + message); }

  std::uint64_t integer(std::size_t bytes) {
    char raw[8] = {};
    take(bytes);
    if (!file_.read(raw, static_cast<std::streamsize>(bytes))) fail("cannot be read");
    std::uint64_t number = 0;
    for (std::size_t i = bytes; i-- > 0;) number = number << 8 | static_cast<unsigned char>(raw[i]);
    return number;
  }
  double real() { return std::bit_cast<double>(integer(8)); }
  Json reals(std::size_t count) {
    Json list = Json::array();
    for (std::size_t i = 0; i < count; ++i) list.push_back(real());
    return list;
  }
  /// A text that ends with a NUL.
  std::string text() {
    std::string text;
    while (const char c = static_cast<char>(integer(1))) text += c;
    return text;
  }
  void skip(std::uint64_t count, std::uint64_t size) {
    if (count > left_ / size) fail("ends inside a list");
    take(count * size);
    file_.seekg(static_cast<std::streamoff>(count * size), std::ios::cur);
  }
  void requireEnd() const {
    if (left_ != 0) fail("goes on after its last entry");
  }

 private:
  void take(std::uint64_t bytes) {
    if (bytes > left_) fail("ends inside an entry");
    left_ -= bytes;
  }

  std::string name_;
  std::ifstream file_;
  std::uint64_t left_ = 0;
};

/// The models by their numbers in a binary file, with the number of their parameters.
constexpr std::pair<const char*, std::size_t> kBinaryModels[] = {{"SIMPLE_PINHOLE", 3},
                                                                 {"PINHOLE", 4},
                                                                 {"SIMPLE_RADIAL", 4},
                                                                 {"RADIAL", 5},
                                                                 {"OPENCV", 8},
                                                                 {"OPENCV_FISHEYE", 8},
                                                                 {"FULL_OPENCV", 12},
                                                                 {"FOV", 5},
                                                                 {"SIMPLE_RADIAL_FISHEYE", 4},
                                                                 {"RADIAL_FISHEYE", 5},
                                                                 {"THIN_PRISM_FISHEYE", 12},
                                                                 {"RAD_TAN_THIN_PRISM_FISHEYE", 16},
                                                                 {"SIMPLE_DIVISION", 4},
                                                                 {"DIVISION", 5},
                                                                 {"SIMPLE_FISHEYE", 3},
                                                                 {"FISHEYE", 4},
                                                                 {"EUCM", 6},
                                                                 {"EQUIRECTANGULAR", 2}};

Json readBinaryCameras(const std::string& name) {
  BinaryFile file(name);
  Json cameras = Json::object();
  for (std::uint64_t left = file.integer(8); left > 0; --left) {
    const std::string id = std::to_string(file.integer(4));
    const std::uint64_t model = file.integer(4);
    if (model >= std::size(kBinaryModels))
      file.fail("camera " + id + " has a model of the number " + std::to_string(model) + ", which is not known");
    const auto width = static_cast<double>(file.integer(8)), height = static_cast<double>(file.integer(8));
    const Json camera{{"model", kBinaryModels[model].first},
                      {"width", width},
                      {"height", height},
                      {"params", file.reals(kBinaryModels[model].second)}};
    if (!cameras.emplace(id, camera).second) file.fail("has a second camera " + id);
  }
  file.requireEnd();
  return cameras;
}

Json readBinaryImages(const std::string& name, const Json& cameras, const TakePixel& take) {
  BinaryFile file(name);
  Json images = Json::array();
  for (std::uint64_t left = file.integer(8); left > 0; --left) {
    Json image{{"id", std::to_string(file.integer(4))}};
    image["qvec"] = file.reals(4);
    image["tvec"] = file.reals(3);
    const std::string camera = std::to_string(file.integer(4));
    image["camera_id"] = camera;
    image["name"] = file.text();
    std::uint64_t pixels = file.integer(8);
    if (!take) file.skip(pixels, 24);
    for (; take && pixels > 0; --pixels) {
      const double x = file.real(), y = file.real();
      take(images.size(), {x, y}, static_cast<std::int64_t>(file.integer(8)));
    }
    if (!cameras.contains(camera)) file.fail("an image is of camera " + camera + ", which is not in cameras.bin");
    images.push_back(std::move(image));
  }
  file.requireEnd();
  return images;
}

using Points = std::unordered_map<std::int64_t, Vec3>;

/// POINT3D_ID X Y Z R G B ERROR TRACK[]
Points readPoints(const std::string& name) {
  Points points;
  readLines(name, [&](const std::string& line) {
    const std::vector<Json> w = fieldsOf(line, 8);
    if (w.empty()) return "";
    if (w.size() < 4 || !areNumbers(std::span(w).first(4))) return "expected POINT3D_ID X Y Z R G B ERROR TRACK[]";
    points[w[0].get<std::int64_t>()] = {w[1], w[2], w[3]};
    return "";
  });
  return points;
}

Points readBinaryPoints(const std::string& name) {
  BinaryFile file(name);
  Points points;
  for (std::uint64_t left = file.integer(8); left > 0; --left) {
    Vec3& point = points[static_cast<std::int64_t>(file.integer(8))];
    for (std::size_t i = 0; i < 3; ++i) point[i] = file.real();
    file.skip(3, 1);  // its colour
    file.skip(1, 8);  // its error
    file.skip(file.integer(8), 8);
  }
  file.requireEnd();
  return points;
}

/// The words of the first line that is not blank or a comment.
std::vector<Json> firstWords(const std::filesystem::path& name) {
  std::ifstream file(name, std::ios::binary);
  std::vector<Json> words;
  for (std::string line; words.empty() && std::getline(file, line);) {
    const std::string_view bare = withoutByteOrderMark(line);
    words = fieldsOf(bare, bare.size());
  }
  return words;
}

/// A line of images.txt has a unit quaternion after its number, and a name that is none.
bool isSurelyImage(const std::vector<Json>& words) {
  if (!isImage(words) || words[9].is_number()) return false;
  double square = 0;
  for (std::size_t i = 1; i < 5; ++i) square += std::pow(words[i].get<double>(), 2);
  return std::fabs(square - 1) < 0.01;
}

/// Whether a binary file is cameras.bin: its count and its cameras end where it ends.
bool isBinaryCameras(const std::string& name) {
  try {
    return !readBinaryCameras(name).empty();
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<std::string> colmapModel(const std::string& source) {
  std::error_code ignored;
  const auto is = [&](const std::string& name) { return std::filesystem::is_regular_file(pathOf(name), ignored); };
  if (std::filesystem::is_directory(pathOf(source), ignored)) {
    for (const char* inside : {"", "/sparse/0", "/0", "/sparse"})
      for (const char* file : {"/cameras.bin", "/cameras.txt"})
        if (is(source + inside + file)) return source + inside;
    return std::nullopt;
  }
  if (!is(source)) return std::nullopt;
  if (source.ends_with("images.bin") || (source.ends_with(".bin") && isBinaryCameras(source))) return source;
  if (!source.ends_with(".txt")) return std::nullopt;
  const std::vector<Json> words = firstWords(pathOf(source));
  return isCamera(words) || isSurelyImage(words) ? std::optional(source) : std::nullopt;
}

namespace {

/// The files of a model.
struct Model {
  bool isBinary;
  std::string cameras, images, points;  ///< images: empty if there are none
};

Model filesOf(const std::string& model) {
  std::error_code ignored;
  const std::filesystem::path source = pathOf(model);
  const bool isFolder = std::filesystem::is_directory(source, ignored);
  const auto beside = [&](const char* name) {
    const std::u8string path = ((isFolder ? source : source.parent_path()) / name).generic_u8string();
    return std::string(path.begin(), path.end());
  };
  const auto exists = [&](const std::string& name) { return std::filesystem::exists(pathOf(name), ignored); };
  const bool isBinary = isFolder ? exists(beside("cameras.bin")) : model.ends_with(".bin");
  const bool isCameras = !isFolder && (isBinary ? !model.ends_with("images.bin") : isCamera(firstWords(source)));
  const std::string images = isFolder ? beside(isBinary ? "images.bin" : "images.txt") : model;
  return {isBinary, isCameras ? model : beside(isBinary ? "cameras.bin" : "cameras.txt"),
          !isCameras && exists(images) ? images : "", beside(isBinary ? "points3D.bin" : "points3D.txt")};
}

Json readModel(const Model& model, const TakePixel& take) {
  Json root{{"cameras", model.isBinary ? readBinaryCameras(model.cameras) : readCameras(model.cameras)}};
  if (!model.images.empty())
    root["images"] = model.isBinary ? readBinaryImages(model.images, root["cameras"], take)
                                    : readImages(model.images, root["cameras"], take);
  return root;
}

}  // namespace

Json readColmap(const std::string& model) { return readModel(filesOf(model), nullptr); }

void eachColmapPixel(
    const std::string& source,
    const std::function<void(std::size_t image, std::int64_t number, const Vec3& point, const Vec2& pixel)>& take) {
  const Model model = filesOf(source);
  if (model.images.empty()) throw InputError(visible(source) + ": has no images");
  const Points points = model.isBinary ? readBinaryPoints(model.points) : readPoints(model.points);
  (void)readModel(model, [&](std::size_t image, const Vec2& pixel, std::int64_t number) {
    if (number < 0) return;
    const auto point = points.find(number);
    if (point == points.end())
      throw InputError(visible(model.points) + ": has no point " + std::to_string(number) + ", which an image has");
    take(image, number, point->second, pixel);
  });
}

}  // namespace viewproj::cmd
