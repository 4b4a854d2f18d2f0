#include "commands/output_option.hpp"

#include <algorithm>

#include "commands/command.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// Endings that say what a file is, whether or not a command writes it.
constexpr std::string_view kTelling =
    ".json .geojson .ndjson .jsonl .csv .tsv .txt .xyz .f64 .bin .svg .c .h .cpp .hpp .glsl .vert .frag .hlsl .wgsl "
    ".css .py .js .ts .java .cs .rs .lua .png .jpg .jpeg .gif .pdf .html .md .yaml .yml .toml .xml .xlsx .ods .xls "
    ".gltf .glb .obj .ply .stl .pcd .e57 .las .laz .fbx "
    ".usd .usda .shp .kml .gpkg .parquet .arrow .feather .npy .npz .mat .h5 .hdf5 .db .sqlite .gz .bz2 .xz .zst .zip "
    ".tif .tiff .bmp "
    ".webp .exr";

}  // namespace

void OutputOption::add(CommandLine& line) {
  const Heading heading(line, kEverywhere);
  addValue(line, kOutputOption, "FILE", file_, readText,
           "Write to this file, whole or, after an error, not at all; its name tells the form (default: standard "
           "output)");
}

void OutputOption::open() {
  if (file_) output_ = std::make_unique<NamedOutput>(*file_);
}

void OutputOption::keep() {
  if (output_) output_->keep();
}

std::optional<std::size_t> formOfOutputName(const std::string& file,
                                            const std::vector<std::pair<std::string_view, std::string_view>>& forms) {
  const std::string_view ending = endingOf(file);
  if (ending.empty()) return std::nullopt;
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (isEnding(ending, forms[i].second)) return i;
  if (!isEnding(ending, kTelling)) return std::nullopt;
  std::vector<std::string_view> names;
  for (const auto& [name, endings] : forms) names.push_back(name);
  throw UsageError("-o " + file + ": nothing that this command writes is called " + std::string(ending) +
                   (names.size() > 1 ? "; --to tells the form: " : "; it writes ") + joined(names));
}

void addOnlyForm(CommandLine& line, std::string_view name, std::string_view endings) {
  line.afterwards([&line, name, endings] {
    if (const auto file = line.valueOf(kOutputOption)) (void)formOfOutputName(*file, {{name, endings}});
  });
}

}  // namespace viewproj::cmd
