// Descriptors are those of the C runtime, in binary mode. The executable's manifest makes names UTF-8.
#include <windows.h>
//
#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <thread>

#include "text/system.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kMost = 1 << 30;  // bytes per call

HANDLE handleOf(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

/// The console's code page before the run, which writes UTF-8.
UINT codePage = 0;

void restoreCodePage() { ::SetConsoleOutputCP(codePage); }

/// Sets errno as on other systems.
int opened(int descriptor, const std::string& name) {
  const int error = errno;
  std::error_code ignored;
  if (descriptor < 0)
    errno = std::filesystem::is_directory(pathOf(name), ignored) ? EISDIR : error == EINVAL ? ENOENT : error;
  return descriptor;
}

}  // namespace

void prepareSystem() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) ::_setmode(descriptor, _O_BINARY);
  if (!isTerminal(kStandardOutput) && !isTerminal(kStandardError)) return;
  codePage = ::GetConsoleOutputCP();
  ::SetConsoleOutputCP(CP_UTF8);
  std::atexit(restoreCodePage);
}

bool isTerminal(int descriptor) {
  DWORD mode = 0;
  return ::GetConsoleMode(handleOf(descriptor), &mode) != 0;
}

bool obeysEscapes(int descriptor) {
  constexpr DWORD kObeys = 0x0004;  // ENABLE_VIRTUAL_TERMINAL_PROCESSING
  DWORD mode = 0;
  return ::GetConsoleMode(handleOf(descriptor), &mode) != 0 && ::SetConsoleMode(handleOf(descriptor), mode | kObeys);
}

std::size_t terminalColumns() {
  CONSOLE_SCREEN_BUFFER_INFO info = {};
  if (!::GetConsoleScreenBufferInfo(handleOf(kStandardOutput), &info)) return 0;
  return static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1);
}

const char* const kEndOfKeyboard = "Ctrl-Z and Enter end the input, Ctrl-C the run";

int openToRead(const std::string& name) { return opened(::_open(name.c_str(), _O_RDONLY | _O_BINARY), name); }

int openToWrite(const std::string& name) { return opened(::_open(name.c_str(), _O_WRONLY | _O_BINARY), name); }

int createFile(const std::string& name, int) {
  // Unlike _open, this lets an open file be renamed and removed.
  const HANDLE file = ::CreateFileA(name.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                    nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (file != INVALID_HANDLE_VALUE) return ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), _O_BINARY);
  const DWORD error = ::GetLastError();
  errno = error == ERROR_FILE_EXISTS ? EEXIST : error == ERROR_ACCESS_DENIED ? EACCES : ENOENT;
  return -1;
}

void closeDescriptor(int descriptor) { ::_close(descriptor); }

int becomeStandardOutput(int descriptor) { return ::_dup2(descriptor, kStandardOutput); }

std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most) {
  constexpr DWORD kMilliseconds = 1000;
  constexpr char kCtrlZ = 0x1a;
  ::SetLastError(ERROR_SUCCESS);
  const int got = ::_read(descriptor, to, static_cast<unsigned>(std::min(most, kMost)));
  // Ctrl-C ends a read, and then another thread ends the process. That is not the end of the input.
  if (got == 0 && ::GetLastError() == ERROR_OPERATION_ABORTED) ::Sleep(kMilliseconds);
  if (got > 0 && *to == kCtrlZ && isTerminal(descriptor)) return 0;
  return got < 0 && errno == EPIPE ? 0 : got;  // the writer has closed: the end
}

bool isReady(int descriptor, int /*milliseconds*/) {
  DWORD bytes = 0;
  if (::GetFileType(handleOf(descriptor)) == FILE_TYPE_PIPE)
    return ::PeekNamedPipe(handleOf(descriptor), nullptr, 0, nullptr, &bytes, nullptr) && bytes > 0;
  return !isTerminal(descriptor);
}

std::optional<std::size_t> bytesLeft(int descriptor) {
  if (::GetFileType(handleOf(descriptor)) != FILE_TYPE_DISK) return std::nullopt;
  const long long size = ::_filelengthi64(descriptor), at = ::_telli64(descriptor);
  if (at < 0 || at > size) return std::nullopt;
  return static_cast<std::size_t>(size - at);
}

std::ptrdiff_t writeSome(int descriptor, std::string_view text) {
  const int written = ::_write(descriptor, text.data(), static_cast<unsigned>(std::min(text.size(), kMost)));
  // A pipe fails in several ways, some without a code. All of them mean that the reader has closed.
  if (written < 0 && ::GetFileType(handleOf(descriptor)) == FILE_TYPE_PIPE) errno = EPIPE;
  return written;
}

unsigned countProcessors() { return std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace viewproj::cmd
