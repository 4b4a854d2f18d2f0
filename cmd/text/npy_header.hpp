// The header of a NumPy array file, .npy (numpy.lib.format).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

inline constexpr std::string_view kNpyMagic = "\x93NUMPY";

struct NpyHeader {
  std::string type;                ///< "<f8"
  bool isFortranOrder = false;     ///< the first index moves fastest
  std::vector<std::size_t> shape;  ///< of more than 2^48 in a dimension: 2^48
  std::size_t size = 0;            ///< bytes before the numbers
};

/// How many bytes the header of a file has that begins so: 0 where more are needed to tell. Throws InputError, whose
/// message begins with name, if it begins as no .npy of version 1 to 3 does.
std::size_t npyHeaderSize(const std::string& name, std::string_view bytes);

/// bytes: at least the header. Throws InputError.
NpyHeader readNpyHeader(const std::string& name, std::string_view bytes);

}  // namespace viewproj::cmd
