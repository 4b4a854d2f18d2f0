// Files and standard input as bytes.
#pragma once

#include <cstddef>
#include <string>

namespace viewproj::cmd {

inline constexpr const char* kStandardInputName = "<stdin>";

/// name "-" is standard input. Throws InputError, also if the file is longer than most.
std::string readWholeFile(const std::string& name, std::size_t most);

/// A file descriptor that closes itself.
class InputFile {
 public:
  /// name "-" is standard input. Throws InputError.
  explicit InputFile(const std::string& name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Appends up to a block to buffer; false at the end of the file. Throws InputError.
  bool readInto(std::string& buffer);

  /// Whether reading would return at once.
  bool isReady() const;

  const std::string& name() const { return name_; }

 private:
  std::string name_;
  int descriptor_;
};

}  // namespace viewproj::cmd
