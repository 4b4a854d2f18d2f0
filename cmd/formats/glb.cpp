// Reads a file of JSON, or the JSON at the beginning of a binary glTF file.
// Source: glTF 2.0 specification, "GLB File Format Specification".
#include <algorithm>

#include "formats/tree.hpp"
#include "text/error.hpp"
#include "text/file.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kBlock = 64 << 10;
constexpr std::size_t kHeader = 20;  // magic, version, length; length and type of the JSON chunk

std::size_t littleEndian(const std::string& text, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(text[at + i]);
  return number;
}

/// Reads until the text has this many bytes, or to the end.
void readUpTo(InputFile& file, std::string& text, std::size_t size) {
  while (text.size() < size) {
    const std::size_t had = text.size();
    text.resize(had + std::min(kBlock, size - had));
    const std::size_t got = file.read(text.data() + had, text.size() - had);
    text.resize(had + got);
    if (got == 0) return;
  }
}

}  // namespace

std::string readWithoutGlb(const std::string& name, std::size_t most) {
  InputFile file(name);
  const auto requireSize = [&](std::size_t size) {
    if (size > most)
      throw InputError(file.name() + ": longer than " + std::to_string(most >> 20) + " MiB, the most that is read");
  };
  std::string text;
  readUpTo(file, text, kHeader);
  if (!text.starts_with("glTF")) {
    readUpTo(file, text, most + 1);
    requireSize(text.size());
    return text;
  }
  if (text.size() < kHeader) throw InputError(file.name() + ": ends inside the header of a .glb file");
  if (const std::size_t version = littleEndian(text, 4); version != 2)
    throw InputError(file.name() + ": is version " + std::to_string(version) + " of .glb; 2 is read");
  if (text.compare(16, 4, "JSON") != 0) throw InputError(file.name() + ": has no JSON in its first chunk");
  const std::size_t length = littleEndian(text, 12);
  requireSize(length);
  text.clear();
  readUpTo(file, text, length);
  if (text.size() < length) throw InputError(file.name() + ": ends inside its JSON chunk");
  text.erase(text.find_last_not_of('\0') + 1);  // some exporters pad with NULs instead of blanks
  return text;
}

}  // namespace viewproj::cmd
