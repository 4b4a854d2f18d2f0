// Files and standard input as bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace viewproj::cmd {

/// The name of a file in messages: "<stdin>" for "-".
std::string shownName(const std::string& name);

/// Reads a file, or standard input for "-". Throws InputError, also if the file is longer than most.
std::string readWholeFile(const std::string& name, std::size_t most);

/// A file descriptor that closes itself.
class InputFile {
 public:
  /// Opens a file, or standard input for "-". Throws InputError.
  explicit InputFile(const std::string& name);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Reads up to `most` bytes, as many as are available at once; 0 at the end of the file. Throws InputError.
  std::size_t read(char* to, std::size_t most);

  /// Whether there are bytes to read, now or within some milliseconds.
  bool isReady(int milliseconds = 0) const;

  /// Bytes from here to the end, for a regular file.
  std::optional<std::size_t> remaining() const;

  /// The name in messages.
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  int descriptor_;
};

}  // namespace viewproj::cmd
