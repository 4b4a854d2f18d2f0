#include "commands/help/pages.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "camera/fields.hpp"
#include "camera/importers/importer.hpp"
#include "commands/options.hpp"
#include "output/matrix_text.hpp"
#include "output/table.hpp"
#include "records/coordinates.hpp"
#include "text/form.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd::pages {
namespace {

/// A name, what its value is, and what it is for.
struct Entry {
  std::string name, form, text;
};

/// In three columns; what is too long for its own has its line.
std::string listed(const std::vector<Entry>& entries, std::size_t width) {
  constexpr std::size_t kMostName = 16, kMostForm = 18;
  std::size_t nameWidth = 0, formWidth = 0;
  for (const Entry& e : entries) {
    if (columnsOf(e.name) <= kMostName) nameWidth = std::max(nameWidth, columnsOf(e.name));
    if (columnsOf(e.form) <= kMostForm) formWidth = std::max(formWidth, columnsOf(e.form));
  }
  const std::size_t formAt = 2 + nameWidth + 2, textAt = formAt + (formWidth > 0 ? formWidth + 2 : 0);
  std::string out;
  for (const Entry& e : entries) {
    std::string line = "  " + e.name;
    if (!e.form.empty()) {
      line = paddedRight(line + (columnsOf(e.name) > nameWidth ? " " : ""), formAt);
      line += wrapped(e.form, width, columnsOf(line));
      line.pop_back();  // what ends the line
    }
    out += entry(line, textAt, e.text, width);
  }
  return out;
}

/// "position, eye, from".
std::string spellings(std::string_view name, std::span<const std::string_view> aliases) {
  std::string text(name);
  for (const std::string_view alias : aliases) text += ", " + std::string(alias);
  return text;
}

/// What a value is, in a few words.
std::string formOf(const Field& field) {
  return field.words ? alternatives(field.words()) : std::string(wordsOfKind(field.kind).form);
}

/// The fields of an object of the camera file; "" for those that stand at its top.
std::vector<Entry> fieldsUnder(std::string_view object) {
  std::vector<Entry> entries;
  for (const Field& field : kFields) {
    const bool isWithin =
        object.empty() ? field.path.find('.') == std::string_view::npos : field.path.starts_with(object);
    if (!isWithin) continue;
    std::string name(field.path.substr(object.size()));
    for (const char c : field.others.empty() ? std::string() : " " + std::string(field.others))
      name += c == ' ' ? ", " : std::string(1, c);
    entries.push_back({name, formOf(field), std::string(field.help)});
  }
  return entries;
}

std::string paragraph(const std::string& text, std::size_t width) { return "\n" + wrapped(text, width); }

std::vector<Entry> entriesOf(std::span<const Coordinate* const> rows) {
  std::vector<Entry> entries;
  for (const Coordinate* row : rows) {
    if (row->form == CoordinateForm::word) continue;
    const bool isArray = row->form == CoordinateForm::array;
    std::string form = isArray ? (row->most > 2 ? "[x, y, z]" : "[x, y]") : "a number each";
    if (row->form == CoordinateForm::object || row->form == CoordinateForm::points) form = exampleOf(*row);
    if (row->form == CoordinateForm::numbers && row->parts.size() == 1) form = "a number";
    std::string text(row->help);
    for (const CoordinatePart& part : row->parts)
      if (!part.aliases.empty()) text += "; " + spellings(part.name, part.aliases);
    entries.push_back({spellings(row->name, row->aliases), form, text});
  }
  return entries;
}

template <class T>
std::vector<Entry> entriesOf(std::span<const FormRow<T>> rows) {
  std::vector<Entry> entries;
  for (const FormRow<T>& row : rows)
    entries.push_back({std::string(row.name), std::string(row.endings), std::string(row.help)});
  return entries;
}

}  // namespace

std::string camera(std::size_t width) {
  return wrapped(
             "A camera file is a JSON object: a pose, a projection, a viewport, and the convention their numbers are "
             "in. Fields are options too, as --fov-y for fovY: without a file they are the camera, over a file they "
             "change it. viewproj help projection and help viewport tell the fields of these two.",
             width) +
         "\n" + listed(fieldsUnder(""), width);
}

std::string projection(std::size_t width) {
  constexpr std::pair<const char*, const char*> kTypes[] = {
      {"perspective",
       "one of fovY, fovX, fovDiagonal, nearWidth with nearHeight, focalLength with a sensor's side; aspect"},
      {"frustum", "left, right, bottom, top on the near plane"},
      {"intrinsics", "fx, fy, cx, cy in pixels of the viewport, or of pixels"},
      {"orthographic", "left, right, bottom, top; or width and height, or one of them with aspect; near and far"},
      {"ps2", "screen x = cx + ax scrz X/Z, y = cy + ay scrz Y/Z; depth is zMax at near, zMin at far"},
      {"matrix", "a projection matrix, beside a stated convention"}};
  std::vector<Entry> types;
  for (const auto& [name, text] : kTypes) types.push_back({name, "", text});
  return wrapped("projection says what the camera sees: its type, the fields of that type, near, far and shift.",
                 width) +
         "\n" + listed(types, width) + "\n" + listed(fieldsUnder("projection."), width);
}

std::string viewport(std::size_t width) {
  return wrapped("viewport is the picture. The centre of pixel (i, j) is at (i + pixelCenter, j + pixelCenter).",
                 width) +
         "\n" + listed(fieldsUnder("viewport."), width);
}

std::string points(std::size_t width) {
  std::string out = wrapped(
                        "A record is [x, y, z], or an object or a row of CSV with one of these, in this order; all "
                        "its other fields come out as they are.",
                        width) +
                    "\n" + listed(entriesOf(coordinates::kPoints), width);
  out += paragraph("Shapes, for project, fit, draw and cull, which takes no segment.", width);
  std::vector<const Coordinate*> shapes(std::begin(coordinates::kShapes), std::end(coordinates::kShapes));
  shapes.insert(shapes.begin(), &coordinates::segment);
  shapes.push_back(&coordinates::radius);
  out += listed(entriesOf(shapes), width);
  out += paragraph("Forms of files; --from names one where neither name nor first bytes tell.", width);
  return out + listed(entriesOf(inputForms()), width);
}

std::string pixels(std::size_t width) {
  std::string out = wrapped(
      "A pixel is [x, y] or [x, y, depth], or an object or a row of CSV with one of these, of which the first counts. "
      "x runs to the right and y "
      "down from the picture's upper left corner; 0 is its edge and 0.5 the centre of the first pixel. In the camera "
      "file viewport.origin bottom-left has y run up, and viewport.pixelCenter 0 (the convention opencv) has 0 be the "
      "first pixel's centre.",
      width);
  return out + "\n" + listed(entriesOf(coordinates::kPixels), width) +
         paragraph("And, for the point behind it:", width) + listed(entriesOf(coordinates::kDistances), width);
}

std::string scene(std::size_t width) {
  return wrapped("A scene is {\"objects\": [...]}: shapes in the world's coordinates, each {\"id\": ID, SHAPE}.",
                 width) +
         "\n" +
         listed({{"plane", "{point, normal}", "Endless; the normal of any length."},
                 {"sphere", "{center, radius}", "The radius is 0 or more."},
                 {"box", "{min, max}", "Its edges lie along the world's axes."},
                 {"triangle", "[a, b, c]", "Three corners; the normal is (b - a) x (c - a)."},
                 {"ellipsoid", "\"WGS84\"", "The Earth, for a camera on it; height is metres above it."}},
                width) +
         paragraph("A point is [x, y, z], or {lat, lon, height} for a camera on the Earth.", width);
}

std::string conventions(std::size_t width) {
  std::vector<std::vector<std::string>> rows{
      {"name", "world", "view", "pose", "ndcZ", "reversed", "ndcY", "vectors", "storage"}};
  for (const ConventionPreset& preset : conventionPresets()) {
    const Convention& c = preset.convention;
    rows.push_back({std::string(preset.name)});
    for (const std::string_view cell :
         {nameOf(kWorldNames, c.world), nameOf(kViewNames, c.view), nameOf(kCameraAxesNames, preset.cameraAxes),
          nameOf(kNdcZNames, c.ndcZ), std::string_view(c.reverseZ ? "yes" : "no"), nameOf(kNdcYNames, c.ndcY),
          nameOf(kVectorsNames, c.vectors), nameOf(kStorageNames, c.storage)})
      rows.back().emplace_back(cell);
  }
  std::string out = wrapped(
                        "\"convention\" in a camera file says how its numbers are read, --convention how matrices, "
                        "NDC and clip coordinates are written; the world, and every pixel, stays the file's.",
                        width) +
                    "\n" + alignedTable(rows);
  for (const ConventionPreset& preset : conventionPresets()) {
    if (preset.up != conventionPresets().front().up)
      out += paragraph(std::string(preset.name) + " has up " + formatNumber(preset.up.x) + " " +
                           formatNumber(preset.up.y) + " " + formatNumber(preset.up.z) + " where a file names none.",
                       width);
    if (preset.pixelCenter != conventionPresets().front().pixelCenter)
      out += paragraph(std::string(preset.name) + " counts pixels from the centre of the first: pixelCenter " +
                           formatNumber(preset.pixelCenter) + ".",
                       width);
  }
  out += paragraph("Axis by axis, as a camera file says it: {\"preset\": \"opengl\", \"ndcZ\": \"0..1\"}.", width);
  return out + listed(fieldsUnder("convention."), width);
}

std::string formats(std::size_t width) {
  std::string out = wrapped("Cameras: a camera file (viewproj help camera), and, known by what stands in them:", width);
  std::vector<Entry> files;
  for (const Importer* importer : importers())
    files.push_back({std::string(importer->name), "", std::string(importer->form)});
  out += listed(files, width);
  out += paragraph(
      "FILE#NAME or FILE#INDEX picks one of several, FILE##INDEX where a number is a name too; info FILE tells what "
      "picks each.",
      width);
  out += paragraph("Points and pixels, in:", width) + listed(entriesOf(inputForms()), width);
  out +=
      paragraph("Their results, as --to or the name after -o tells:", width) + listed(entriesOf(outputForms()), width);
  const auto matrices = matrixForms();
  return out + paragraph("Matrices:", width) + listed(entriesOf(std::span(matrices)), width);
}

std::string precision(std::size_t width) {
  std::string out = wrapped(
                        "--precision says in which arithmetic points are projected, and so how near the true value "
                        "screen x, y and depth are. measure shows both on your own points.",
                        width) +
                    "\n";
  std::vector<Entry> modes;
  for (const PrecisionRow& row : precisions())
    modes.push_back(
        {std::string(row.name), "", std::string(row.arithmetic) + ". Promised: " + std::string(row.promise) + "."});
  out += listed(modes, width);
  return out + paragraph(
                   "The bounds hold wherever the eye is. A point that standard cannot bound is projected exactly. "
                   "Rays are within 1.2e-15 radians. Input counts as the doubles nearest its text.",
                   width);
}

}  // namespace viewproj::cmd::pages
