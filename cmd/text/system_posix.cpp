#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <system_error>

#include "text/system.hpp"

namespace viewproj::cmd {

void prepareSystem(int&, char**&) {
  // Where it cannot be written further, write() says so.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // Input is empty where it came closed, and output fails.
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) < 0) (void)::open("/dev/null", O_RDONLY);
}

std::filesystem::path pathOf(const std::string& name) { return name; }
std::string nameOf(const std::filesystem::path& path) { return path.string(); }

bool isTerminal(int descriptor) { return ::isatty(descriptor) != 0; }

bool obeysEscapes(int descriptor) { return isTerminal(descriptor); }

std::size_t terminalColumns() {
  winsize size = {};
  return ::ioctl(kStandardOutput, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

const char* const kEndOfKeyboard = "Ctrl-D ends the input, Ctrl-C the run";

int openToRead(const std::string& name) { return ::open(name.c_str(), O_RDONLY | O_CLOEXEC); }

void closeDescriptor(int descriptor) { ::close(descriptor); }

std::ptrdiff_t readSome(int descriptor, char* to, std::size_t most) {
  ssize_t got = 0;
  while ((got = ::read(descriptor, to, most)) < 0) {
    if (errno == EAGAIN) {  // whoever opened it set it not to block
      pollfd state{descriptor, POLLIN, 0};
      (void)::poll(&state, 1, -1);
    } else if (errno != EINTR) {
      break;
    }
  }
  return got;
}

bool isReady(int descriptor) {
  pollfd state{descriptor, POLLIN, 0};
  return ::poll(&state, 1, 0) > 0;
}

bool waitUnless(int descriptor, int other) {
  pollfd states[] = {{descriptor, POLLIN, 0}, {other, POLLIN, 0}};
  int ready = 0;
  do ready = ::poll(states, 2, -1);
  while (ready < 0 && errno == EINTR);
  return states[1].revents == 0;
}

std::optional<std::size_t> bytesLeft(int descriptor) {
  struct stat state;
  if (::fstat(descriptor, &state) != 0 || !S_ISREG(state.st_mode)) return std::nullopt;
  const off_t at = ::lseek(descriptor, 0, SEEK_CUR);
  if (at < 0 || at > state.st_size) return std::nullopt;
  return static_cast<std::size_t>(state.st_size - at);
}

Written writeSome(int descriptor, std::string_view text) {
  const ssize_t written = ::write(descriptor, text.data(), text.size());
  if (written >= 0) return {static_cast<std::size_t>(written), 0};
  if (errno == EAGAIN) {  // whoever opened it set it not to block
    pollfd state{descriptor, POLLOUT, 0};
    (void)::poll(&state, 1, -1);
  } else if (errno != EINTR) {
    return {0, errno};
  }
  return {};
}

void writeAtOnce(int descriptor, std::string_view text) {
  pollfd state{descriptor, POLLOUT, 0};
  if (::poll(&state, 1, 0) > 0) (void)!::write(descriptor, text.data(), text.size());
}

void cutOff(int descriptor, std::size_t bytes) noexcept {
  struct stat state;
  const off_t at = ::lseek(descriptor, 0, SEEK_CUR);
  const auto back = static_cast<off_t>(bytes);
  if (bytes == 0 || at < back || ::fstat(descriptor, &state) != 0) return;
  if (!S_ISREG(state.st_mode) || state.st_size != at) return;
  if (::ftruncate(descriptor, at - back) == 0) (void)::lseek(descriptor, at - back, SEEK_SET);
}

std::FILE* openTemporary() { return std::tmpfile(); }

namespace {

constexpr const char* kBesides = ".viewproj-XXXXXX";  // after the file's own name, for mkstemp

constexpr const char* kDescriptors = "/proc/self/fd";

/// The descriptor that is open already under such a name: /dev/stdout, /dev/fd/3; -1: it is no such name.
int descriptorOf(std::string_view name) {
  if (name == "/dev/stdout") return kStandardOutput;
  if (name == "/dev/stderr") return kStandardError;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    int number = -1;
    if (name.starts_with(folder) &&
        std::from_chars(name.data() + folder.size(), name.data() + name.size(), number).ptr ==
            name.data() + name.size())
      return number;
  }
  return -1;
}

/// Where a name leads that may be a link to a file that is not there yet.
std::filesystem::path followed(std::filesystem::path path, std::error_code& error) {
  constexpr int kMostLinks = 40;
  int links = 0;
  for (std::error_code none; std::filesystem::is_symlink(path, none); ++links) {
    if (links == kMostLinks) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    if (error) return path;
    const std::filesystem::path next = std::filesystem::read_symlink(path, error);
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

/// That a new file would have.
mode_t usualMode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

}  // namespace

int beginReplacement(const std::string& name, Replacement& replacement) {
  constexpr int kApart = 100;  // from the descriptors that a shell opens by number
  replacement.before = ::fcntl(kStandardOutput, F_DUPFD_CLOEXEC, kApart);
  if (const int open = descriptorOf(name); open >= 0)  // it goes on where that stands
    return ::dup2(open, kStandardOutput) < 0 ? errno : 0;
  struct stat state = {};
  const bool exists = ::stat(name.c_str(), &state) == 0;
  int descriptor = -1;
  if (exists && !S_ISREG(state.st_mode)) {
    descriptor = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    if (exists && ::access(name.c_str(), W_OK) != 0) return errno;
    std::error_code error;
    const std::filesystem::path target = followed(name, error);
    if (error) return error.value();
    replacement.target = target.string();
    const mode_t mode = exists ? state.st_mode & 0777 : usualMode();
#ifdef O_TMPFILE
    // Without a name nothing is left of it, however the run ends.
    const std::string folder = target.has_parent_path() ? target.parent_path().string() : ".";
    if (::access(kDescriptors, X_OK) == 0) descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
#endif
    if (descriptor < 0) {
      replacement.written = replacement.target + kBesides;
      descriptor = ::mkstemp(replacement.written.data());
      if (descriptor < 0) replacement.written.clear();
    }
    if (descriptor >= 0 && exists) (void)!::fchown(descriptor, state.st_uid, state.st_gid);  // where that is allowed
    if (descriptor >= 0) (void)::fchmod(descriptor, mode);
  }
  if (descriptor < 0 || ::dup2(descriptor, kStandardOutput) < 0) return errno;
  ::close(descriptor);
  return 0;
}

int keepReplacement(Replacement& replacement) {
  if (replacement.target.empty()) return 0;
  if (replacement.written.empty()) {
    // A name that nobody has: of a file that goes at once.
    std::string name = replacement.target + kBesides;
    const int other = ::mkstemp(name.data());
    if (other < 0) return errno;
    ::close(other);
    ::unlink(name.c_str());
    const std::string open = std::string(kDescriptors) + "/" + std::to_string(kStandardOutput);
    if (::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) return errno;
    replacement.written = name;
  }
  if (::rename(replacement.written.c_str(), replacement.target.c_str()) != 0) return errno;
  replacement.written.clear();
  replacement.target.clear();
  return 0;
}

void endReplacement(const Replacement& replacement) {
  if (replacement.before >= 0) {
    (void)::dup2(replacement.before, kStandardOutput);
    ::close(replacement.before);
  }
  if (!replacement.written.empty()) ::unlink(replacement.written.c_str());
}

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
/// Says nothing but "look up from your write".
constexpr int kNudge = SIGURG;

// What a signal handler may touch.
std::atomic<int> came{0};
std::atomic<bool> writing{false};
std::atomic<pthread_t> writer{};
int wakeEnds[2] = {-1, -1};

struct sigaction before[std::size(kSignals)], beforeNudge;

void nudged(int) {}

void note(int signal) {
  const int error = errno;
  came = signal;
  wake();
  if (writing && !pthread_equal(writer, pthread_self())) pthread_kill(writer, kNudge);
  errno = error;
}

}  // namespace

int beginNoting() {
  came = 0;
  // uncounted: faults_call has it fail, but not beside sanitizers
  if (::pipe2(wakeEnds, O_CLOEXEC | O_NONBLOCK) != 0) return errno;

  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    ::sigaction(kSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
  action.sa_handler = nudged;
  action.sa_flags = 0;
  ::sigaction(kNudge, &action, &beforeNudge);
  return 0;
}

void endNoting() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
  ::sigaction(kNudge, &beforeNudge, nullptr);
  for (int& end : wakeEnds) {
    ::close(end);
    end = -1;
  }
}

int notedSignal() { return came; }

int wakeDescriptor() { return wakeEnds[0]; }

void wake() { (void)!::write(wakeEnds[1], "", 1); }

void beginWriting() {
  writer = pthread_self();
  writing = true;
}

void endWriting() { writing = false; }

void dieOfSignal(int signal) {
  std::signal(signal, SIG_DFL);
  ::raise(signal);
  std::_Exit(128 + signal);
}

}  // namespace viewproj::cmd
