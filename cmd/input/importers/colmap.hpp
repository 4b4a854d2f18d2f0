// COLMAP's reconstructions as text, as a document that a row of kinds.json reads: {"cameras": {"1": {...}}, "images":
// {"a.jpg": {...}}}.
// Source: COLMAP documentation, "Output Format" and "Camera Models".
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

namespace viewproj::cmd {

struct ColmapText {
  ColmapText();
  ~ColmapText();
  ColmapText(ColmapText&&) noexcept;

  std::unique_ptr<nlohmann::json> root;
  /// Where a camera or an image stands, "FOLDER/images.txt:5:1", by its keys with a line break between them.
  std::unordered_map<std::string, std::string> places;
};

/// Whether it is a folder, or a text file that begins as cameras.txt or images.txt do.
bool isColmapFile(const std::string& name);

/// Of a folder, or of one of its files: cameras.txt and, where it is there or is asked for, images.txt. Throws
/// InputError.
ColmapText readColmap(const std::string& folderOrFile);

}  // namespace viewproj::cmd
