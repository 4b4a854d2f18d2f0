// Files and standard input as bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace viewproj::cmd {

/// A file as messages have it: "<stdin>" for "-".
std::string shownName(const std::string& name);

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

  /// Reads up to `most` bytes, as many as there are at once; 0 at the end of the file. Throws InputError.
  std::size_t read(char* to, std::size_t most);

  /// Whether there is something to read now.
  bool isReady() const;

  /// Bytes of a regular file from here to its end.
  std::optional<std::size_t> remaining() const;

  /// As messages have it.
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  int descriptor_;
};

}  // namespace viewproj::cmd
