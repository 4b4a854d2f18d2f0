#include "input/importers/colmap.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "text/error.hpp"
#include "text/file.hpp"
#include "text/json_text.hpp"
#include "text/parse_number.hpp"
#include "text/system.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

/// A model of cameras.txt and its parameters; f stands for both focal lengths.
struct Model {
  std::string_view name;
  std::vector<std::string_view> parameters;
};

const std::vector<Model>& models() {
  static const std::vector<Model> kModels{
      {"SIMPLE_PINHOLE", {"f", "cx", "cy"}},
      {"PINHOLE", {"fx", "fy", "cx", "cy"}},
      {"SIMPLE_RADIAL", {"f", "cx", "cy", "k1"}},
      {"RADIAL", {"f", "cx", "cy", "k1", "k2"}},
      {"OPENCV", {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"}},
      {"OPENCV_FISHEYE", {"fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"}},
      {"FULL_OPENCV", {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
      {"FOV", {"fx", "fy", "cx", "cy", "omega"}},
      {"SIMPLE_RADIAL_FISHEYE", {"f", "cx", "cy", "k1"}},
      {"RADIAL_FISHEYE", {"f", "cx", "cy", "k1", "k2"}},
      {"THIN_PRISM_FISHEYE", {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"}},
  };
  return kModels;
}

const Model* modelNamed(std::string_view name) {
  for (const Model& model : models())
    if (model.name == name) return &model;
  return nullptr;
}

/// The lines of a file one by one, of which only what is asked for is kept.
class Lines {
 public:
  explicit Lines(const std::string& name) : file_(name) {}

  /// False at the end. kept: how many bytes of the line; the rest is passed over.
  bool next(std::string& line, std::size_t kept) {
    line.clear();
    ++number_;
    bool any = false;
    while (true) {
      if (at_ == end_) {
        end_ = file_.read(block_, sizeof block_);
        at_ = 0;
        if (end_ == 0) return any;
      }
      any = true;
      const std::string_view rest(block_ + at_, end_ - at_);
      const std::size_t size = std::min(rest.find('\n'), rest.size());
      line += rest.substr(0, std::min(size, kept - std::min(kept, line.size())));
      at_ += std::min(size + 1, rest.size());
      if (size < rest.size()) break;
    }
    if (line.ends_with('\r')) line.pop_back();
    return true;
  }

  std::string place(std::size_t column = 1) const { return cmd::place(file_.name(), {number_, column}); }
  [[noreturn]] void fail(const std::string& message) const { throw InputError(place() + ": " + message); }

 private:
  InputFile file_;
  char block_[64 << 10] = {};
  std::size_t at_ = 0, end_ = 0, number_ = 0;
};

constexpr std::size_t kLongestLine = 1 << 16;

/// Takes the next word off the line; empty at its end.
std::string_view word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::size_t size = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view first = line.substr(0, size);
  line.remove_prefix(size);
  return first;
}

bool isWhole(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool isPassedOver(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string_view::npos || line[first] == '#';
}

double numberAt(const Lines& lines, std::string_view text, const char* what) {
  const auto number = parseNumber(text);
  if (!number) lines.fail(inQuotes(text) + " is no number: expected " + what);
  return *number;
}

void put(ColmapText& colmap, const Lines& lines, const char* list, const std::string& key, json value) {
  json& all = (*colmap.root)[list];
  if (all.contains(key)) lines.fail(inQuotes(key) + " is given twice");
  all[key] = std::move(value);
  colmap.places[std::string(list) + "\n" + key] = lines.place();
}

/// CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]
void readCameras(ColmapText& colmap, const std::string& file) {
  Lines lines(file);
  (*colmap.root)["cameras"] = json::object();
  for (std::string line; lines.next(line, kLongestLine);) {
    if (isPassedOver(line)) continue;
    std::string_view rest = line;
    const std::string id(word(rest)), name(word(rest));
    if (!isWhole(id)) lines.fail("expected CAMERA_ID MODEL WIDTH HEIGHT and the model's parameters");
    const Model* const model = modelNamed(name);
    if (!model) lines.fail(inQuotes(name) + " is no camera model of COLMAP that is known");
    json camera{{"camera_model", name},
                {"width", numberAt(lines, word(rest), "the width")},
                {"height", numberAt(lines, word(rest), "the height")}};
    for (const std::string_view parameter : model->parameters) {
      const double number = numberAt(lines, word(rest), std::string(parameter).c_str());
      camera[parameter == "f" ? "fx" : std::string(parameter)] = number;
    }
    if (!word(rest).empty())
      lines.fail(name + " has " + std::to_string(model->parameters.size()) + " parameters, and here are more");
    put(colmap, lines, "cameras", id, std::move(camera));
  }
}

/// How a line of cameras.txt or images.txt begins.
bool looksLikeCamera(std::string_view line) {
  return isWhole(word(line)) && modelNamed(word(line)) && isWhole(word(line)) && isWhole(word(line));
}
bool looksLikeImage(std::string_view line) {
  if (!isWhole(word(line))) return false;
  for (int i = 0; i < 7; ++i)
    if (!parseNumber(word(line))) return false;
  return isWhole(word(line)) && !word(line).empty();
}

/// X Y POINT3D_ID again and again. Of a long line the first part tells.
bool isOfPoints(std::string_view line) {
  constexpr std::size_t kTelling = 4096;
  const bool isCut = line.size() > kTelling;
  line = line.substr(0, kTelling);
  std::size_t words = 0;
  for (std::string_view next = word(line); !next.empty(); next = word(line), ++words)
    if (!parseNumber(next) && !(isCut && line.empty())) return false;
  return isCut || words % 3 == 0;
}

/// IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, and a line of points, which may be empty. Editors and scripts lose the
/// empty ones, so the next image may stand in the place of points.
void readImages(ColmapText& colmap, const std::string& file) {
  Lines lines(file);
  (*colmap.root)["images"] = json::object();
  bool isPoints = false;
  for (std::string line; lines.next(line, kLongestLine);) {
    if (std::exchange(isPoints, false)) {
      if (isOfPoints(line)) continue;
      if (!looksLikeImage(line) && !isPassedOver(line))
        lines.fail("expected the points of the image before it, X Y POINT3D_ID each, or the next image");
    }
    if (isPassedOver(line)) continue;
    std::string_view rest = line;
    const std::string id(word(rest));
    if (!isWhole(id)) lines.fail("expected IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    json q = json::array(), t = json::array();
    for (const char* const what : {"QW", "QX", "QY", "QZ"}) q.push_back(numberAt(lines, word(rest), what));
    for (const char* const what : {"TX", "TY", "TZ"}) t.push_back(numberAt(lines, word(rest), what));
    const std::string camera(word(rest));
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    if (!isWhole(camera) || rest.empty()) lines.fail("needs CAMERA_ID and NAME at its end");
    if (!(*colmap.root)["cameras"].contains(camera))
      lines.fail("is of camera " + camera + ", which cameras.txt has not");
    put(colmap, lines, "images", std::string(rest),
        json{{"image_id", id}, {"camera_id", camera}, {"qvec", std::move(q)}, {"tvec", std::move(t)}});
    isPoints = true;
  }
}

std::string startOf(const std::string& file) {
  std::string start(4096, '\0');
  start.resize(InputFile(file).read(start.data(), start.size()));
  return start;
}

/// The first line that is no comment.
std::string firstLine(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (std::string_view line = text.substr(0, end); !isPassedOver(line)) {
      if (line.ends_with('\r')) line.remove_suffix(1);
      return std::string(line);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return {};
}

}  // namespace

ColmapText::ColmapText() : root(std::make_unique<json>(json::object())) {}
ColmapText::~ColmapText() = default;
ColmapText::ColmapText(ColmapText&&) noexcept = default;

bool isColmapFile(const std::string& name) {
  std::error_code ignored;
  if (std::filesystem::is_directory(pathOf(name), ignored)) return true;
  if (!name.ends_with(".txt") || !std::filesystem::is_regular_file(pathOf(name), ignored)) return false;
  const std::string start = startOf(name);
  return looksLikeCamera(firstLine(start)) || looksLikeImage(firstLine(start));
}

ColmapText readColmap(const std::string& folderOrFile) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  ColmapText colmap;
  const bool isFolder = fs::is_directory(pathOf(folderOrFile), ignored);
  const fs::path folder = isFolder ? pathOf(folderOrFile) : pathOf(folderOrFile).parent_path();
  std::string cameras = (folder / "cameras.txt").generic_string(), images = (folder / "images.txt").generic_string();
  bool hasImages = isFolder && fs::exists(pathOf(images), ignored);
  if (!isFolder) {
    (looksLikeCamera(firstLine(startOf(folderOrFile))) ? cameras : images) = folderOrFile;
    hasImages = images == folderOrFile;
  }
  if (isFolder && !fs::exists(pathOf(cameras), ignored))
    throw InputError(visible(folderOrFile) + ": is a folder without cameras.txt and images.txt, as COLMAP writes them");
  readCameras(colmap, cameras);
  if (hasImages) readImages(colmap, images);
  const char* const list = hasImages ? "images" : "cameras";
  if ((*colmap.root)[list].empty()) throw InputError(visible(hasImages ? images : cameras) + ": has no " + list);
  return colmap;
}

}  // namespace viewproj::cmd
