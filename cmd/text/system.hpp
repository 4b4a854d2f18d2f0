// The differences between POSIX and Windows: descriptors and terminals. Text is UTF-8 on both, and so are file names
// and arguments. A function that fails returns -1 and sets errno.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

/// Call this first in main. Bytes are then read and written unchanged, a write to a closed pipe fails without a signal,
/// and the next file that is opened does not get the number of a closed standard descriptor.
void prepareSystem();

/// A file's name for std::filesystem. On Windows it would not read a std::string as UTF-8.
inline std::filesystem::path pathOf(const std::string& name) { return std::u8string(name.begin(), name.end()); }

inline bool isFile(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

bool isTerminal(int descriptor);

/// Whether it is a terminal that obeys escape sequences.
bool obeysEscapes(int descriptor);

/// The width of the terminal at standard output; 0 if it is not a terminal.
std::size_t terminalColumns();

/// How to end the input, and the run, from a keyboard.
extern const char* const kEndOfKeyboard;

int openToRead(const std::string& name);
/// Opens an existing file.
int openToWrite(const std::string& name);
/// Creates a file; EEXIST if it exists. permissions: POSIX mode bits, before the umask.
int createFile(const std::string& name, int permissions);
void closeDescriptor(int descriptor);
/// Makes standard output a duplicate of the descriptor.
int becomeStandardOutput(int descriptor);

/// Waits for bytes and reads up to `most`; 0 at the end.
std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most);

/// Whether there are bytes to read now; false if that is unknown.
bool isReady(int descriptor, int milliseconds);

/// Bytes of a regular file from here to its end.
std::optional<std::size_t> bytesLeft(int descriptor);

/// Writes once. Returns the number of bytes, 0 if it was interrupted or waited for room. EPIPE: the reader has closed.
std::ptrdiff_t writeSome(int descriptor, std::string_view text);

/// The number of processors that this process may use.
unsigned countProcessors();

}  // namespace viewproj::cmd
