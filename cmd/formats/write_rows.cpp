// Writers of formats that rows read: OpenCV's FileStorage, ROS's camera_info, KITTI, 3D Gaussian splatting, Open3D.
// Sources: OpenCV's persistence.hpp, ROS's camera_calibration_parsers, KITTI's development kit, gaussian-splatting's
// camera_utils, Open3D's PinholeCameraParameters and, of several, PinholeCameraTrajectory.
#include <algorithm>
#include <tuple>

#include "camera/read_lens.hpp"
#include "formats/writer.hpp"
#include "numbers/vectors.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

using namespace detail;

namespace {

std::array<double, 9> matrixOf(const Intrinsics& k) { return {k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1}; }

bool isFisheye(const WrittenCamera& camera) {
  return camera.file.lens && camera.file.lens->model() == LensModel::fisheye;
}

/// Centres of pixels at whole numbers, as OpenCV, ROS and Open3D count.
Intrinsics atCentres(const WrittenCamera& camera) { return camera.intrinsics(0); }

// ---- OpenCV

/// A number, or a matrix of rows.
struct Stored {
  std::string name;
  std::size_t rows, columns;  ///< 0: a number
  std::vector<double> numbers;
};

/// FileStorage in one of its three forms.
std::string storage(const std::vector<Stored>& entries, std::string_view ending) {
  JsonObject json;
  std::string yaml = "%YAML:1.0\n---\n", xml = "<?xml version=\"1.0\"?>\n<opencv_storage>\n";
  for (const auto& [name, rows, columns, numbers] : entries) {
    if (rows == 0) {
      const std::string text = formatNumber(numbers.front());
      json.addText(name, text, ",\n  ");
      yaml += name + ": " + text + "\n";
      xml += "<" + name + ">" + text + "</" + name + ">\n";
      continue;
    }
    const std::string height = std::to_string(rows), width = std::to_string(columns);
    std::string words;
    for (const double number : numbers) words += (words.empty() ? "" : " ") + yamlNumber(number);
    json.addText(name,
                 R"({"type_id": "opencv-matrix", "rows": )" + height + ", \"cols\": " + width +
                     R"(, "dt": "d", "data": )" + yamlList(numbers) + "}",
                 ",\n  ");
    yaml += name + ": !!opencv-matrix\n   rows: " + height + "\n   cols: " + width +
            "\n   dt: d\n   data: " + yamlList(numbers) + "\n";
    xml += "<" + name + " type_id=\"opencv-matrix\">\n  <rows>" + height + "</rows>\n  <cols>" + width +
           "</cols>\n  <dt>d</dt>\n  <data>" + words + "</data></" + name + ">\n";
  }
  return ending == ".json" ? "{\n  " + json.members() + "\n}\n" : ending == ".xml" ? xml + "</opencv_storage>\n" : yaml;
}

/// The pose of a camera as R and T, as stereoCalibrate gives them for the second of two.
void addPose(const WrittenCamera& camera, std::vector<Stored>& entries) {
  const auto m = cameraFromWorld(camera);
  entries.push_back({"R", 3, 3, {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}});
  entries.push_back({"T", 3, 1, {m[3], m[7], m[11]}});
}

/// Two cameras, as stereo_calib stores them: the world is the first one's.
std::vector<WrittenFile> writeStereo(const WrittenCamera& first, const WrittenCamera& second, std::string_view ending) {
  const auto fail = [&](const std::string& what) {
    throw InputError(first.file.name + ": opencv's file of two cameras has no place for " + what);
  };
  if (!first.isAtOrigin())
    fail("the pose of the first, from which R and T lead to the second; pick one with FILE#NAME");
  if (first.width() != second.width() || first.height() != second.height()) fail("two sizes of pictures");
  std::vector<Stored> entries{{"image_width", 0, 0, {first.width()}}, {"image_height", 0, 0, {first.height()}}};
  for (const WrittenCamera* camera : {&first, &second}) {
    const std::string number = camera == &first ? "1" : "2";
    const std::optional<Lens>& lens = camera->file.lens;
    if (lens && lens->model() != LensModel::brown)
      fail("the lens " + std::string(nameOf(lens->model())) + "; --ignore-distortion leaves out the whole distortion");
    const auto k = matrixOf(atCentres(*camera));
    const std::vector<double> c = lens ? coefficientsOf(*lens) : std::vector<double>(5);
    entries.push_back({"M" + number, 3, 3, {k.begin(), k.end()}});
    entries.push_back({"D" + number, 1, c.size(), c});
  }
  addPose(second, entries);
  return {{"", storage(entries, ending)}};
}

}  // namespace

std::vector<WrittenFile> writeOpenCv(std::span<const WrittenCamera> cameras, std::string_view ending) {
  const WrittenCamera& camera = cameras.front();
  if (cameras.size() == 2) return writeStereo(camera, cameras.back(), ending);
  const auto k = matrixOf(atCentres(camera));
  std::vector<Stored> entries{{"image_width", 0, 0, {camera.width()}},
                              {"image_height", 0, 0, {camera.height()}},
                              {"camera_matrix", 3, 3, {k.begin(), k.end()}}};
  if (camera.file.lens) {
    std::vector<double> c = coefficientsOf(*camera.file.lens);
    const bool isOmni = camera.file.lens->model() == LensModel::omni;
    const double xi = c.front();
    if (isOmni) c.erase(c.begin());
    entries.push_back({"distortion_coefficients", 1, c.size(), c});
    if (isOmni) entries.push_back({"xi", 0, 0, {xi}});
    if (isFisheye(camera)) entries.push_back({"fisheye_model", 0, 0, {1}});
  }
  if (!camera.isAtOrigin()) addPose(camera, entries);
  return {{"", storage(entries, ending)}};
}

std::vector<WrittenFile> writeRos(std::span<const WrittenCamera> cameras, std::string_view) {
  std::vector<WrittenFile> files;
  // P is of one lens for all, as pictures of a rectified pair have it.
  const Intrinsics straight = atCentres(cameras.front());
  for (const WrittenCamera& camera : cameras) {
    const std::string name = camera.name.empty() ? "camera" + (cameras.size() > 1 ? camera.number : "") : camera.name;
    const auto m = worldFromCamera(camera, CameraAxes::RDF);
    const double z = std::fabs(m[11]) <= kRounding * std::hypot(m[3], m[7]) ? 0 : m[11];
    std::vector<double> c(5);
    if (camera.file.lens) c = coefficientsOf(*camera.file.lens);
    std::string text = "image_width: " + formatNumber(camera.width()) +
                       "\nimage_height: " + formatNumber(camera.height()) + "\ncamera_name: " + jsonOf(name) + "\n";
    const auto add = [&](std::string_view member, std::size_t rows, std::span<const double> numbers) {
      text += std::string(member) + ":\n  rows: " + std::to_string(rows) +
              "\n  cols: " + std::to_string(numbers.size() / rows) + "\n  data: " + yamlList(numbers) + "\n";
    };
    add("camera_matrix", 3, matrixOf(atCentres(camera)));
    text += std::string("distortion_model: ") +
            (isFisheye(camera) ? "equidistant"
             : c.size() > 5    ? "rational_polynomial"
                               : "plumb_bob") +
            "\n";
    add("distortion_coefficients", 1, c);
    add("rectification_matrix", 3, std::array{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]});
    add("projection_matrix", 3,
        std::array{straight.fx, 0.0, straight.cx, 0.0 - straight.fx * m[3] - straight.cx * z, 0.0, straight.fy,
                   straight.cy, 0.0 - straight.fy * m[7] - straight.cy * z, 0.0, 0.0, 1.0, 0.0 - z});
    std::string file = name + ".yaml";
    std::replace(file.begin(), file.end(), '/', '_');
    if (std::any_of(files.begin(), files.end(), [&](const WrittenFile& other) { return other.name == file; }))
      camera.file.fail(camera.file.name + ": another camera is written as " + inQuotes(file));
    files.push_back({cameras.size() > 1 ? file : "", text});
  }
  return files;
}

std::vector<WrittenFile> writeKitti(std::span<const WrittenCamera> cameras, std::string_view) {
  std::string text;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Intrinsics k = atCentres(cameras[i]);
    const auto m = cameraFromWorld(cameras[i]);
    text += "P" + std::to_string(i) + ":";
    for (const auto& [f, c, row] : {std::tuple(k.fx, k.cx, std::size_t{0}), {k.fy, k.cy, 4}, {0.0, 1.0, 8}})
      for (std::size_t j = 0; j < 4; ++j)
        text += " " + formatNumber(rounded(twoProd(f, m[row + j]) + twoProd(c, m[8 + j])));
    text += "\n";
  }
  return {{"", text}};
}

std::vector<WrittenFile> writeSplats(std::span<const WrittenCamera> cameras, std::string_view) {
  std::vector<std::string> list;
  for (const WrittenCamera& camera : cameras) {
    const auto m = worldFromCamera(camera, CameraAxes::RDF);
    const Intrinsics k = camera.intrinsics(0.5);
    JsonObject out;
    out.addText("id", camera.number).add("img_name", camera.label());
    out.add("width", camera.width()).add("height", camera.height());
    out.addText("position", jsonListOf(std::array{m[3], m[7], m[11]}));
    out.addText("rotation", jsonRows(std::array{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, 3));
    list.push_back(out.add("fy", k.fy).add("fx", k.fx).text());
  }
  return {{"", "[\n  " + joined(list, ",\n  ") + "\n]\n"}};
}

std::vector<WrittenFile> writeOpen3d(std::span<const WrittenCamera> cameras, std::string_view) {
  const auto begin = [](const char* name) {
    JsonObject out;
    out.add("class_name", name).addText("version_major", "1").addText("version_minor", "0");
    return out;
  };
  std::vector<std::string> list;
  for (const WrittenCamera& camera : cameras) {
    const Intrinsics k = atCentres(camera);
    JsonObject intrinsic, out = begin("PinholeCameraParameters");
    intrinsic.add("width", camera.width()).add("height", camera.height());
    intrinsic.addText("intrinsic_matrix", jsonListOf(std::array<double, 9>{k.fx, 0, 0, 0, k.fy, 0, k.cx, k.cy, 1}));
    out.addText("extrinsic", jsonListOf(columnsOf(cameraFromWorld(camera)))).addText("intrinsic", intrinsic.text());
    list.push_back(out.text());
  }
  if (list.size() == 1) return {{"", list.front() + "\n"}};
  JsonObject out = begin("PinholeCameraTrajectory");
  return {{"", out.addText("parameters", jsonList(list, ",\n    ")).text() + "\n"}};
}

}  // namespace viewproj::cmd
