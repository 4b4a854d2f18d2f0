// What the systems differ in, POSIX and Windows: descriptors, terminals, signals, files that are replaced whole. Text
// is UTF-8 on both, names of files and arguments too. What fails says so by errno, as a result.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

/// The first that main does: bytes come and go as they are, a write that nobody reads says so and no signal does, a
/// descriptor that came closed is not to be taken by the next file that is opened, and arguments are UTF-8.
void prepareSystem(int& argc, char**& argv);

/// A file's name for std::filesystem, and back.
std::filesystem::path pathOf(const std::string& name);
std::string nameOf(const std::filesystem::path& path);

bool isTerminal(int descriptor);

/// Whether that is a terminal, and one that obeys escape sequences.
bool obeysEscapes(int descriptor);

/// Of the terminal that standard output is; 0: it is none.
std::size_t terminalColumns();

/// How the input ends, and the run, on a keyboard.
extern const char* const kEndOfKeyboard;

/// A descriptor, or -1.
int openToRead(const std::string& name);
void closeDescriptor(int descriptor);

/// Waits for bytes, and reads up to `most`; 0 at the end, -1 where that fails.
std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most);

/// Whether reading would return at once.
bool isReady(int descriptor);

/// Waits until reading would return at once, or another descriptor has something to read. Returns false for that.
bool waitUnless(int descriptor, int other);

/// Bytes of a regular file from here to its end.
std::optional<std::size_t> bytesLeft(int descriptor);

struct Written {
  std::size_t bytes = 0;
  int error = 0;  ///< errno, or 0
};

/// Writes once: some bytes, or none where it was interrupted or waited for room. EPIPE: nobody reads any more.
Written writeSome(int descriptor, std::string_view text);

/// Writes where that does not wait.
void writeAtOnce(int descriptor, std::string_view text);

/// Removes the last bytes written, where that is a file that ends with them.
void cutOff(int descriptor, std::size_t bytes) noexcept;

/// A file that is gone when it is closed, or null.
std::FILE* openTemporary();

/// While there is one, standard output goes to a file beside the one that is named, or as it is to what is no regular
/// file (a pipe, a device).
struct Replacement {
  std::string target;   ///< with links followed; empty where nothing is to be renamed
  std::string written;  ///< the file's name until it is kept; empty while it has none
  int before = -1;      ///< what standard output was
};

/// They return errno, or 0. keep gives the file its name; end removes what was not kept, and standard output is again
/// what it was.
int beginReplacement(const std::string& name, Replacement& replacement);
int keepReplacement(Replacement& replacement);
void endReplacement(const Replacement& replacement);

/// From here on SIGINT, SIGTERM and SIGHUP (Ctrl-C, Ctrl-Break and a window that is closed) are noted instead of ending
/// the process; a second one does end it. Returns errno, or 0.
int beginNoting();
void endNoting();

/// The signal that came, or 0.
int notedSignal();

/// Has something to read once a signal came, or wake() was called.
int wakeDescriptor();
void wake();

/// A signal that comes interrupts what this thread is writing, until the end.
void beginWriting();
void endWriting();

/// Ends the process as the signal would have.
[[noreturn]] void dieOfSignal(int signal);

}  // namespace viewproj::cmd
