#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <thread>

#include "text/system.hpp"

namespace viewproj::cmd {
namespace {

/// Whether to try again: the call was interrupted, or the descriptor does not block and was not ready.
bool shouldRetry(int descriptor, short event) {
  if (errno != EAGAIN) return errno == EINTR;
  pollfd state{descriptor, event, 0};
  (void)::poll(&state, 1, -1);
  return true;
}

}  // namespace

void prepareSystem() {
  // write() then reports that it cannot write any more.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // A standard descriptor that came closed becomes empty as input and fails as output.
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", O_RDONLY);
}

bool isTerminal(int descriptor) { return ::isatty(descriptor) != 0; }

bool obeysEscapes(int descriptor) { return isTerminal(descriptor); }

std::size_t terminalColumns() {
  winsize size = {};
  return ::ioctl(kStandardOutput, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

const char* const kEndOfKeyboard = "Ctrl-D ends the input, Ctrl-C the run";

int openToRead(const std::string& name) { return ::open(name.c_str(), O_RDONLY | O_CLOEXEC); }
int openToWrite(const std::string& name) { return ::open(name.c_str(), O_WRONLY | O_CLOEXEC); }

int createFile(const std::string& name, int permissions) {
  return ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
}

void closeDescriptor(int descriptor) { ::close(descriptor); }

int becomeStandardOutput(int descriptor) { return ::dup2(descriptor, kStandardOutput); }

std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most) {
  ssize_t got = 0;
  do got = ::read(descriptor, to, most);
  while (got < 0 && shouldRetry(descriptor, POLLIN));
  return got;
}

bool isReady(int descriptor, int milliseconds) {
  pollfd state{descriptor, POLLIN, 0};
  return ::poll(&state, 1, milliseconds) > 0;
}

std::optional<std::size_t> bytesLeft(int descriptor) {
  struct stat state;
  if (::fstat(descriptor, &state) != 0 || !S_ISREG(state.st_mode)) return std::nullopt;
  const off_t at = ::lseek(descriptor, 0, SEEK_CUR);
  if (at < 0 || at > state.st_size) return std::nullopt;
  return static_cast<std::size_t>(state.st_size - at);
}

std::ptrdiff_t writeSome(int descriptor, std::string_view text) {
  const ssize_t written = ::write(descriptor, text.data(), text.size());
  return written < 0 && shouldRetry(descriptor, POLLOUT) ? 0 : written;
}

unsigned countProcessors() {
#ifdef __linux__
  cpu_set_t processors;
  if (::sched_getaffinity(0, sizeof processors, &processors) == 0)
    return static_cast<unsigned>(std::max(1, CPU_COUNT(&processors)));
#endif
  return std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace viewproj::cmd
