#include "text/npy_header.hpp"

#include <algorithm>

#include "text/error.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

std::size_t npyHeaderSize(const std::string& name, std::string_view bytes) {
  constexpr std::size_t kMost = 1 << 20;
  const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(bytes[at])}; };
  const std::size_t known = std::min(bytes.size(), kNpyMagic.size());
  if (bytes.substr(0, known) != kNpyMagic.substr(0, known)) throw InputError(name + ": is no .npy file of NumPy");
  if (bytes.size() < 8) return 0;
  if (byte(6) < 1 || byte(6) > 3)
    throw InputError(name + ": is an .npy file of version " + std::to_string(byte(6)) + "; expected 1, 2 or 3");
  const std::size_t width = byte(6) == 1 ? 2 : 4;
  if (bytes.size() < 8 + width) return 0;
  std::size_t length = 0;
  for (std::size_t i = width; i-- > 0;) length = length << 8 | byte(8 + i);
  if (length > kMost) throw InputError(name + ": has an .npy header longer than 1 MiB");
  return 8 + width + length;
}

NpyHeader readNpyHeader(const std::string& name, std::string_view bytes) {
  NpyHeader header;
  header.size = npyHeaderSize(name, bytes);
  const std::size_t begin = bytes[6] == 1 ? 10 : 12;
  const std::string_view text = bytes.substr(begin, header.size - begin);
  // It is a dictionary of Python: {'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }.
  const auto valueOf = [&](const std::string& key) {
    const std::size_t at = text.find("'" + key + "':");
    if (at == std::string_view::npos) throw InputError(name + ": has an .npy header without " + key);
    return trimmed(text.substr(at + key.size() + 3));
  };
  const std::string_view type = valueOf("descr");
  header.type = type.starts_with('\'') ? type.substr(1, type.find('\'', 1) - 1) : type.substr(0, type.find(", 'f"));
  header.isFortranOrder = valueOf("fortran_order").starts_with("True");
  const std::string_view shape = valueOf("shape");
  constexpr std::size_t kLargest = std::size_t{1} << 48;
  bool isInNumber = false;
  for (const char c : shape.substr(0, shape.find(')'))) {
    if (!isDigit(c)) {
      isInNumber = false;
      continue;
    }
    if (!isInNumber) header.shape.push_back(0);
    isInNumber = true;
    header.shape.back() = std::min(10 * header.shape.back() + static_cast<std::size_t>(c - '0'), kLargest);
  }
  return header;
}

}  // namespace viewproj::cmd
