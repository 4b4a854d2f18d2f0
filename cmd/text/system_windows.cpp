// Descriptors are those of the C runtime, in binary mode.
#include <windows.h>
//
#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <shellapi.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <system_error>
#include <vector>

#include "text/system.hpp"

namespace viewproj::cmd {
namespace {

constexpr int kNew = _O_WRONLY | _O_BINARY | _O_NOINHERIT;

std::wstring wide(const std::string& text) {
  std::wstring out(text.size(), 0);  // no text has more units in UTF-16 than bytes in UTF-8
  out.resize(static_cast<std::size_t>(::MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()),
                                                            out.data(), static_cast<int>(out.size()))));
  return out;
}

std::string narrow(std::wstring_view text) {
  std::string out(3 * text.size(), 0);
  out.resize(
      static_cast<std::size_t>(::WideCharToMultiByte(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), out.data(),
                                                     static_cast<int>(out.size()), nullptr, nullptr)));
  return out;
}

HANDLE handleOf(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

DWORD kindOf(int descriptor) { return ::GetFileType(handleOf(descriptor)); }

int errorOf(DWORD code) {
  switch (code) {
    case ERROR_SUCCESS:
      return 0;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
      return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
      return EACCES;
    case ERROR_BROKEN_PIPE:
    case ERROR_NO_DATA:
    case ERROR_PIPE_NOT_CONNECTED:
      return EPIPE;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      return ENOSPC;
    case ERROR_FILENAME_EXCED_RANGE:
      return ENAMETOOLONG;
    case ERROR_TOO_MANY_OPEN_FILES:
      return EMFILE;
    case ERROR_INVALID_HANDLE:
      return EBADF;
    default:
      return EIO;
  }
}

bool isFolder(const std::wstring& name) {
  const DWORD attributes = ::GetFileAttributesW(name.c_str());
  return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

/// Of the console, while the run writes UTF-8 to it.
UINT codePage = 0;

void restoreCodePage() { ::SetConsoleOutputCP(codePage); }

}  // namespace

void prepareSystem(int& argc, char**& argv) {
  for (int descriptor = 0; descriptor <= 2; ++descriptor) {
    if (::_get_osfhandle(descriptor) < 0 || kindOf(descriptor) == FILE_TYPE_UNKNOWN) {
      const int nothing = ::_open("NUL", _O_RDONLY);
      if (nothing >= 0 && nothing != descriptor) {
        (void)::_dup2(nothing, descriptor);
        ::_close(nothing);
      }
    }
    ::_setmode(descriptor, _O_BINARY);
  }
  if (isTerminal(kStandardOutput) || isTerminal(kStandardError)) {
    codePage = ::GetConsoleOutputCP();
    ::SetConsoleOutputCP(CP_UTF8);
    std::atexit(restoreCodePage);
  }
  static std::vector<std::string> texts;
  static std::vector<char*> pointers;
  int count = 0;
  wchar_t** const given = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  if (!given) return;
  for (int i = 0; i < count; ++i) texts.push_back(narrow(given[i]));
  ::LocalFree(given);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  argc = count;
  argv = pointers.data();
}

std::filesystem::path pathOf(const std::string& name) { return wide(name); }
std::string nameOf(const std::filesystem::path& path) { return narrow(path.generic_wstring()); }

bool isTerminal(int descriptor) {
  DWORD mode = 0;
  return ::GetConsoleMode(handleOf(descriptor), &mode) != 0;
}

bool obeysEscapes(int descriptor) {
  constexpr DWORD kObeys = 0x0004;  // ENABLE_VIRTUAL_TERMINAL_PROCESSING, since Windows 10
  DWORD mode = 0;
  return ::GetConsoleMode(handleOf(descriptor), &mode) != 0 && ::SetConsoleMode(handleOf(descriptor), mode | kObeys);
}

std::size_t terminalColumns() {
  CONSOLE_SCREEN_BUFFER_INFO info = {};
  if (!::GetConsoleScreenBufferInfo(handleOf(kStandardOutput), &info)) return 0;
  return static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1);
}

const char* const kEndOfKeyboard = "Ctrl-Z and Enter end the input, Ctrl-C the run";

int openToRead(const std::string& name) {
  const std::wstring path = wide(name);
  const int descriptor = ::_wopen(path.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT);
  if (descriptor < 0 && isFolder(path)) errno = EISDIR;
  if (descriptor < 0 && errno == EINVAL) errno = ENOENT;  // no file has such a name
  return descriptor;
}

void closeDescriptor(int descriptor) { ::_close(descriptor); }

std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most) {
  constexpr std::size_t kMost = 1 << 30;
  ::SetLastError(ERROR_SUCCESS);
  const int got = ::_read(descriptor, to, static_cast<unsigned>(std::min(most, kMost)));
  // Ctrl-C ends a line, and only then is who asked for it told.
  constexpr int kMilliseconds = 1000;
  const bool isConsole = isTerminal(descriptor);
  if (got == 0 && isConsole && ::GetLastError() == ERROR_OPERATION_ABORTED)
    for (int i = 0; i < kMilliseconds && notedSignal() == 0; ++i) ::Sleep(1);
  constexpr char kCtrlZ = 0x1a;
  if (got > 0 && isConsole && *to == kCtrlZ) return 0;
  return got < 0 && errno == EPIPE ? 0 : got;  // the writer has gone: the end
}

namespace {

/// Whether a pipe has bytes, or its end; nothing where it cannot be asked.
std::optional<bool> pipeIsReady(int descriptor) {
  DWORD bytes = 0;
  if (::PeekNamedPipe(handleOf(descriptor), nullptr, 0, nullptr, &bytes, nullptr)) return bytes > 0;
  if (errorOf(::GetLastError()) == EPIPE) return true;
  return std::nullopt;
}

/// Whether a key was pressed at a console; what else it tells (keys that go up, the mouse) is taken away.
bool keyWaits(HANDLE console) {
  INPUT_RECORD event = {};
  DWORD count = 0;
  while (::PeekConsoleInputW(console, &event, 1, &count) && count > 0) {
    if (event.EventType == KEY_EVENT && event.Event.KeyEvent.bKeyDown) return true;
    ::ReadConsoleInputW(console, &event, 1, &count);
  }
  return false;
}

}  // namespace

bool isReady(int descriptor) {
  if (kindOf(descriptor) == FILE_TYPE_PIPE) return pipeIsReady(descriptor).value_or(false);
  if (isTerminal(descriptor)) return false;  // the next line may not be whole, and who reads it waits for that
  return ::WaitForSingleObject(handleOf(descriptor), 0) != WAIT_TIMEOUT;
}

bool waitUnless(int descriptor, int other) {
  // Nothing waits for a pipe and for something else at once.
  constexpr DWORD kMilliseconds = 1;
  const bool isPipe = kindOf(descriptor) == FILE_TYPE_PIPE, isConsole = isTerminal(descriptor);
  while (!isReady(other)) {
    if (isPipe && pipeIsReady(descriptor).value_or(true)) return true;
    if (isConsole ? keyWaits(handleOf(descriptor)) : !isPipe && isReady(descriptor)) return true;
    if (isPipe)
      ::Sleep(kMilliseconds);
    else
      ::WaitForSingleObject(handleOf(descriptor), kMilliseconds);
  }
  return false;
}

std::optional<std::size_t> bytesLeft(int descriptor) {
  if (kindOf(descriptor) != FILE_TYPE_DISK) return std::nullopt;
  const long long size = ::_filelengthi64(descriptor), at = ::_telli64(descriptor);
  if (at < 0 || at > size) return std::nullopt;
  return static_cast<std::size_t>(size - at);
}

Written writeSome(int descriptor, std::string_view text) {
  // A console takes no more at a time.
  const std::size_t most = isTerminal(descriptor) ? 8 << 10 : 1 << 20;
  DWORD written = 0;
  const auto size = static_cast<DWORD>(std::min(text.size(), most));
  if (::WriteFile(handleOf(descriptor), text.data(), size, &written, nullptr)) {
    // A full disk may take a part without a word, and then nothing.
    return {written, written == 0 && size > 0 ? ENOSPC : 0};
  }
  const DWORD code = ::GetLastError();
  if (code == ERROR_OPERATION_ABORTED) return {written, 0};
  return {written, errorOf(code)};
}

void writeAtOnce(int descriptor, std::string_view text) { (void)writeSome(descriptor, text); }

void cutOff(int descriptor, std::size_t bytes) noexcept {
  const auto back = static_cast<long long>(bytes);
  if (bytes == 0 || kindOf(descriptor) != FILE_TYPE_DISK) return;
  const long long at = ::_telli64(descriptor);
  if (at < back || ::_filelengthi64(descriptor) != at) return;
  if (::_chsize_s(descriptor, at - back) == 0) (void)::_lseeki64(descriptor, at - back, SEEK_SET);
}

std::FILE* openTemporary() {
  wchar_t folder[MAX_PATH + 1], name[MAX_PATH + 1];
  if (::GetTempPathW(MAX_PATH, folder) == 0 || ::GetTempFileNameW(folder, L"vpj", 0, name) == 0) return nullptr;
  return ::_wfopen(name, L"w+bTD");
}

int beginReplacement(const std::string& name, Replacement& replacement) {
  replacement.before = ::_dup(kStandardOutput);
  const std::wstring path = wide(name);
  const HANDLE there = ::CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr,
                                     OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  const DWORD code = there == INVALID_HANDLE_VALUE ? ::GetLastError() : ERROR_SUCCESS;
  if (isFolder(path)) return EISDIR;
  if (code != ERROR_SUCCESS && code != ERROR_FILE_NOT_FOUND) return errorOf(code);
  int descriptor = -1;
  if (code == ERROR_SUCCESS && ::GetFileType(there) != FILE_TYPE_DISK) {  // NUL, CON, a pipe
    descriptor = ::_open_osfhandle(reinterpret_cast<intptr_t>(there), kNew);
  } else {
    if (code == ERROR_SUCCESS) ::CloseHandle(there);
    std::error_code ignored;
    const std::filesystem::path followed = std::filesystem::weakly_canonical(path, ignored);
    replacement.target = ignored ? name : nameOf(followed);
    constexpr int kTries = 100;
    for (int i = 0; descriptor < 0 && i < kTries; ++i) {
      replacement.written =
          replacement.target + ".viewproj-" + std::to_string(::GetCurrentProcessId()) + "-" + std::to_string(i);
      descriptor = ::_wopen(wide(replacement.written).c_str(), kNew | _O_CREAT | _O_EXCL, _S_IREAD | _S_IWRITE);
      if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) replacement.written.clear();
  }
  if (descriptor < 0 || ::_dup2(descriptor, kStandardOutput) < 0) return errno;
  ::_close(descriptor);
  return 0;
}

int keepReplacement(Replacement& replacement) {
  if (replacement.target.empty()) return 0;
  // An open file keeps its name.
  if (replacement.before < 0 || ::_dup2(replacement.before, kStandardOutput) < 0) return errno;
  if (!::MoveFileExW(wide(replacement.written).c_str(), wide(replacement.target).c_str(), MOVEFILE_REPLACE_EXISTING))
    return errorOf(::GetLastError());
  replacement.written.clear();
  replacement.target.clear();
  return 0;
}

void endReplacement(const Replacement& replacement) {
  if (replacement.before >= 0) {
    (void)::_dup2(replacement.before, kStandardOutput);
    ::_close(replacement.before);
  }
  if (!replacement.written.empty()) ::_wunlink(wide(replacement.written).c_str());
}

namespace {

// What the thread that is told of Ctrl-C may touch.
std::atomic<int> came{0};
std::atomic<bool> writing{false};
std::atomic<DWORD> writer{0};
int wakeEnds[2] = {-1, -1};

BOOL WINAPI note(DWORD event) {
  if (came != 0) return FALSE;  // the second one ends the process
  came = event == CTRL_C_EVENT ? SIGINT : SIGTERM;
  wake();
  if (writing) {
    const HANDLE thread = ::OpenThread(THREAD_TERMINATE, FALSE, writer);
    if (thread) {
      ::CancelSynchronousIo(thread);
      ::CloseHandle(thread);
    }
  }
  return TRUE;
}

}  // namespace

int beginNoting() {
  constexpr unsigned kBytes = 4096;
  came = 0;
  if (::_pipe(wakeEnds, kBytes, _O_BINARY | _O_NOINHERIT) != 0) return errno;
  ::SetConsoleCtrlHandler(note, TRUE);
  return 0;
}

void endNoting() {
  ::SetConsoleCtrlHandler(note, FALSE);
  for (int& end : wakeEnds) {
    ::_close(end);
    end = -1;
  }
}

int notedSignal() { return came; }

int wakeDescriptor() { return wakeEnds[0]; }

void wake() { (void)::_write(wakeEnds[1], "", 1); }

void beginWriting() {
  writer = ::GetCurrentThreadId();
  writing = true;
}

void endWriting() { writing = false; }

void dieOfSignal(int) {
  constexpr UINT kEndedByCtrlC = 0xC000013A;
  if (codePage != 0) restoreCodePage();
  ::ExitProcess(kEndedByCtrlC);
}

}  // namespace viewproj::cmd
