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
#include "formats/writer.hpp"
#include "text/error.hpp"
#include "text/number.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

using Words = std::vector<std::string_view>;

/// The first words of a line, then the rest as one. Nothing for a comment.
Words fieldsOf(std::string_view line, std::size_t most = SIZE_MAX) {
  Words words;
  line.remove_suffix(line.size() - (line.find_last_not_of(" \t\r") + 1));
  while (!line.empty()) {
    line.remove_prefix(line.find_first_not_of(" \t"));
    if (words.empty() && line.starts_with('#')) break;
    words.push_back(words.size() < most ? line.substr(0, line.find_first_of(" \t")) : line);
    line.remove_prefix(words.back().size());
  }
  return words;
}

bool areNumbers(std::span<const std::string_view> words) {
  return std::all_of(words.begin(), words.end(), [](std::string_view word) { return parseNumber(word).has_value(); });
}

constexpr const char *kCameraForm = "CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]",
                     *kImageForm = "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME",
                     *kPointForm = "POINT3D_ID X Y Z R G B ERROR TRACK[]";

bool isCamera(const Words& words) {
  return words.size() > 3 && areNumbers({&words[0], 1}) && !areNumbers({&words[1], 1}) &&
         areNumbers(std::span(words).subspan(2));
}

/// A line that may be of images.txt: numbers with a unit quaternion after the first.
bool mayBeImage(const Words& words) {
  if (words.size() < 10 || !areNumbers(std::span(words).first(9))) return false;
  double square = 0;
  for (std::size_t i = 1; i < 5; ++i) square += std::pow(*parseNumber(words[i]), 2);
  return std::fabs(square - 1) < 0.01;
}

/// A file of a model: entries of the same fields, as lines of words or as bytes, the lowest first.
class ModelFile {
 public:
  explicit ModelFile(const std::string& name)
      : name_(name), isBinary_(name.ends_with(".bin")), file_(pathOf(name), std::ios::binary) {
    if (!file_) throw InputError(visible(name) + ": " + std::generic_category().message(errno));
    if (!isBinary_) return;
    file_.seekg(0, std::ios::end);
    left_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    file_.seekg(0);
    entries_ = integer(8);
  }

  bool isBinary() const { return isBinary_; }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(visible(name_) + (isBinary_ ? "" : ":" + std::to_string(lineNumber_)) + ": " + message);
  }

  /// The next entry. form: of a line, whose words after the first ones are one.
  bool next(const char* form, std::size_t words = SIZE_MAX) {
    form_ = form;
    if (isBinary_) {
      if (entries_-- > 0) return true;
      if (left_ != 0) fail("goes on after its last entry");
      return false;
    }
    do {
      if (!readLine()) return false;
      words_ = fieldsOf(line_, words);
    } while (words_.empty());
    word_ = 0;
    return true;
  }
  /// The words of the next line, which may have none. Of those after `most` the first ones are enough.
  const Words& nextLine(std::size_t most) {
    if (!readLine()) line_.clear();
    words_ = fieldsOf(line_, most);
    words_.resize(std::min(words_.size(), most));
    word_ = 0;
    return words_;
  }

  std::string text() {
    if (!isBinary_) return std::string(nextWord());
    std::string text;
    while (const char c = static_cast<char>(integer(1))) text += c;
    return text;
  }
  double real() { return isBinary_ ? std::bit_cast<double>(integer(8)) : number(); }
  /// An integer of so many bytes.
  double whole(std::size_t bytes) { return isBinary_ ? static_cast<double>(integer(bytes)) : number(); }
  std::int64_t signedWhole() {
    return isBinary_ ? static_cast<std::int64_t>(integer(8)) : static_cast<std::int64_t>(number());
  }
  std::string id() { return formatNumber(whole(4)); }
  /// All that are left of a line, or so many.
  Json reals(std::size_t count) {
    Json list = Json::array();
    for (std::size_t i = 0; isBinary_ ? i < count : word_ < words_.size(); ++i) list.push_back(real());
    return list;
  }
  /// Passes over bytes; a line has words that nobody reads.
  void skip(std::uint64_t count, std::uint64_t size) {
    if (!isBinary_) return;
    if (count > left_ / size) fail("ends inside a list");
    left_ -= count * size;
    file_.seekg(static_cast<std::streamoff>(count * size), std::ios::cur);
  }

 private:
  bool readLine() {
    if (!std::getline(file_, line_)) return false;
    if (++lineNumber_ == 1) line_.erase(0, line_.size() - withoutByteOrderMark(line_).size());
    return true;
  }
  std::string_view nextWord() {
    if (word_ == words_.size()) fail(std::string("expected ") + form_);
    return words_[word_++];
  }
  double number() {
    const auto number = parseNumber(nextWord());
    if (!number) fail(std::string("expected ") + form_);
    return *number;
  }
  std::uint64_t integer(std::size_t bytes) {
    if (bytes > left_) fail("ends inside an entry");
    left_ -= bytes;
    char raw[8] = {};
    if (!file_.read(raw, static_cast<std::streamsize>(bytes))) fail("cannot be read");
    std::uint64_t number = 0;
    for (std::size_t i = bytes; i-- > 0;) number = number << 8 | static_cast<unsigned char>(raw[i]);
    return number;
  }

  std::string name_;
  bool isBinary_;
  std::ifstream file_;
  std::uint64_t left_ = 0, entries_ = 0;  ///< of a binary file
  const char* form_ = "";
  std::string line_;
  std::size_t lineNumber_ = 0, word_ = 0;
  Words words_;
};

Json readCameras(const std::string& name) {
  ModelFile file(name);
  Json cameras = Json::object();
  while (file.next(kCameraForm)) {
    const std::string id = file.id();
    const double number = file.isBinary() ? file.whole(4) : 0;
    if (!(number < std::size(kColmapModels)))
      file.fail("camera " + id + " has a model of the number " + formatNumber(number) + ", which is not known");
    const ColmapModel& model = kColmapModels[static_cast<std::size_t>(number)];
    Json camera{{"model", file.isBinary() ? std::string(model.name) : file.text()}};
    if (parseNumber(camera["model"].get_ref<const std::string&>())) file.fail(std::string("expected ") + kCameraForm);
    for (const char* side : {"width", "height"}) camera[side] = file.whole(8);
    camera["params"] = file.reals(model.focalLengths + 2 + model.coefficients);
    if (!cameras.emplace(id, camera).second) file.fail("has a second camera " + id);
  }
  return cameras;
}

/// Of each pixel of an image: the image's number, the pixel, and the number of its point, or below 0.
using TakePixel = std::function<void(std::size_t image, const Vec2& pixel, std::int64_t point)>;

/// The pixels of an image: X Y POINT3D_ID each, on a line of their own.
void readPixels(ModelFile& file, const Json& cameras, std::size_t image, const TakePixel& take) {
  std::uint64_t count = 0;
  if (file.isBinary()) {
    count = static_cast<std::uint64_t>(file.whole(8));
    if (!take) file.skip(count, 24);
  } else {
    const Words& words = file.nextLine(take ? SIZE_MAX : 60);
    // It is the next image if it names a camera of the file.
    const bool isImage = mayBeImage(words) && cameras.contains(formatNumber(*parseNumber(words[8])));
    if (isImage || !areNumbers(words) || words.size() % 3 != 0)
      file.fail("expected the image's points, X Y POINT3D_ID each, or an empty line");
    count = words.size() / 3;
  }
  for (std::uint64_t i = 0; take && i < count; ++i) {
    const double x = file.real(), y = file.real();
    take(image, {x, y}, file.signedWhole());
  }
}

Json readImages(const std::string& name, const Json& cameras, const TakePixel& take) {
  ModelFile file(name);
  Json images = Json::array();
  while (file.next(kImageForm, 9)) {
    Json image{{"id", file.id()}};
    for (const auto& [key, count] : {std::pair{"qvec", 4}, {"tvec", 3}})
      for (int i = 0; i < count; ++i) image[key].push_back(file.real());
    const std::string camera = file.id();
    image["camera_id"] = camera;
    image["name"] = file.text();
    if (!cameras.contains(camera)) file.fail("an image is of camera " + camera + ", and the model has no such camera");
    readPixels(file, cameras, images.size(), take);
    images.push_back(std::move(image));
  }
  return images;
}

std::unordered_map<std::int64_t, Vec3> readPoints(const std::string& name) {
  ModelFile file(name);
  std::unordered_map<std::int64_t, Vec3> points;
  while (file.next(kPointForm, 8)) {
    Vec3& point = points[file.signedWhole()];
    for (std::size_t i = 0; i < 3; ++i) point[i] = file.real();
    file.skip(11, 1);  // its colour and its error
    if (file.isBinary()) file.skip(static_cast<std::uint64_t>(file.whole(8)), 8);
  }
  return points;
}

/// What the first line of a text that is not blank or a comment is of.
enum class TextKind { none, cameras, images };
TextKind kindOfText(const std::string& name) {
  std::ifstream file(pathOf(name), std::ios::binary);
  Words words;
  for (std::string line; words.empty() && std::getline(file, line);) {
    words = fieldsOf(withoutByteOrderMark(line));
    if (isCamera(words)) return TextKind::cameras;
    if (mayBeImage(words) && !areNumbers({&words[9], 1})) return TextKind::images;
  }
  return TextKind::none;
}

/// Whether a binary file is cameras.bin: its count and its cameras end where it ends.
bool isBinaryCameras(const std::string& name) {
  try {
    return !readCameras(name).empty();
  } catch (const InputError&) {
    return false;
  }
}

/// The files of a model.
struct Model {
  std::string cameras, images, points;  ///< images: empty if there are none
};

Model filesOf(const std::string& model) {
  const std::filesystem::path source = pathOf(model);
  const bool isFolder = !isFile(source);
  const auto beside = [&](const char* name) {
    const std::u8string path = ((isFolder ? source : source.parent_path()) / name).generic_u8string();
    return std::string(path.begin(), path.end());
  };
  const bool isBinary = isFolder ? isFile(pathOf(beside("cameras.bin"))) : model.ends_with(".bin");
  const bool isCameras =
      !isFolder && (isBinary ? !model.ends_with("images.bin") : kindOfText(model) == TextKind::cameras);
  const std::string images = isFolder ? beside(isBinary ? "images.bin" : "images.txt") : model;
  return {isCameras ? model : beside(isBinary ? "cameras.bin" : "cameras.txt"),
          !isCameras && isFile(pathOf(images)) ? images : "", beside(isBinary ? "points3D.bin" : "points3D.txt")};
}

Json readModel(const Model& model, const TakePixel& take) {
  Json root{{"cameras", readCameras(model.cameras)}};
  if (!model.images.empty()) root["images"] = readImages(model.images, root["cameras"], take);
  return root;
}

}  // namespace

std::optional<std::string> colmapModel(const std::string& source) {
  for (const char* inside : {"", "/sparse/0", "/0", "/sparse"})
    for (const char* file : {"/cameras.bin", "/cameras.txt"})
      if (isFile(pathOf(source + inside + file))) return source + inside;
  const bool isOne = isFile(pathOf(source)) &&
                     (source.ends_with("images.bin") || (source.ends_with(".bin") && isBinaryCameras(source)) ||
                      (source.ends_with(".txt") && kindOfText(source) != TextKind::none));
  return isOne ? std::optional(source) : std::nullopt;
}

std::string leftOutOfColmap(const std::string& source) {
  const auto model = colmapModel(source);
  const std::string points = model ? filesOf(*model).points : "";
  std::ifstream file(pathOf(points), std::ios::binary);
  std::string line;
  bool hasPoints = false;
  if (points.ends_with(".bin"))
    hasPoints = file.read(line.assign(8, 0).data(), 8) && line.find_first_not_of('\0') != line.npos;
  else
    while (!hasPoints && std::getline(file, line)) hasPoints = !isBlank(line) && line[0] != '#';
  return hasPoints ? "colmap is written with its cameras alone: points3D and the points of images are left out" : "";
}

Json readColmap(const std::string& model) { return readModel(filesOf(model), nullptr); }

void eachColmapPixel(
    const std::string& source,
    const std::function<void(std::size_t image, std::int64_t number, const Vec3& point, const Vec2& pixel)>& take) {
  const Model model = filesOf(source);
  if (model.images.empty()) throw InputError(visible(source) + ": has no images");
  const auto points = readPoints(model.points);
  (void)readModel(model, [&](std::size_t image, const Vec2& pixel, std::int64_t number) {
    if (number < 0) return;
    const auto point = points.find(number);
    if (point == points.end())
      throw InputError(visible(model.points) + ": has no point " + std::to_string(number) + ", which an image has");
    take(image, number, point->second, pixel);
  });
}

}  // namespace viewproj::cmd
