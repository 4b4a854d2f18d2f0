// What the systems differ in, POSIX and Windows: descriptors and terminals. Text is UTF-8 on both, names of files and
// arguments too. What fails returns -1 and sets errno.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

/// The first call of main: bytes are read and written unchanged, a write that nobody reads fails without a signal, and
/// a standard descriptor that is closed is not taken by the next file that is opened.
void prepareSystem();

/// A file's name for std::filesystem, which would take plain text for another encoding on Windows.
inline std::filesystem::path pathOf(const std::string& name) { return std::u8string(name.begin(), name.end()); }

bool isTerminal(int descriptor);

/// Whether that is a terminal, and one that obeys escape sequences.
bool obeysEscapes(int descriptor);

/// Of the terminal that standard output is; 0: it is none.
std::size_t terminalColumns();

/// How to end the input, and the run, on a keyboard.
extern const char* const kEndOfKeyboard;

int openToRead(const std::string& name);
/// Opens what is there.
int openToWrite(const std::string& name);
/// Creates a file, EEXIST where there is one. permissions: as POSIX counts them, before the umask.
int createFile(const std::string& name, int permissions);
void closeDescriptor(int descriptor);
/// Makes standard output another name of the descriptor.
int becomeStandardOutput(int descriptor);

/// Waits for bytes, and reads up to `most`; 0 at the end.
std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most);

/// Whether there is something to read now; false where that cannot be told.
bool isReady(int descriptor);

/// Bytes of a regular file from here to its end.
std::optional<std::size_t> bytesLeft(int descriptor);

/// Writes once: returns how many bytes, 0 where it was interrupted or waited for room. EPIPE: nobody reads any more.
std::ptrdiff_t writeSome(int descriptor, std::string_view text);

/// That this process may use.
unsigned countProcessors();

}  // namespace viewproj::cmd
