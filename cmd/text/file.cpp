#include "text/file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "text/error.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

/// Who waits on a person says so.
void tellOfKeyboard() {
  constexpr std::string_view kLine = "viewproj: reading from the keyboard; Ctrl-D ends the input, Ctrl-C the run\n";
  if (::isatty(STDIN_FILENO) && ::isatty(STDERR_FILENO)) (void)!::write(STDERR_FILENO, kLine.data(), kLine.size());
}

}  // namespace

InputFile::InputFile(const std::string& name)
    : name_(name == "-" ? kStandardInputName : visible(name)),
      descriptor_(name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw InputError(name_ + ": " + std::generic_category().message(errno));
  if (descriptor_ == STDIN_FILENO) tellOfKeyboard();
}

InputFile::~InputFile() {
  if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
}

std::size_t InputFile::read(char* to, std::size_t most) {
  ssize_t got = 0;
  while ((got = ::read(descriptor_, to, most)) < 0) {
    if (errno == EAGAIN) {  // whoever opened it set it not to block
      pollfd state{descriptor_, POLLIN, 0};
      (void)::poll(&state, 1, -1);
    } else if (errno != EINTR) {
      break;
    }
  }
  if (got < 0) throw InputError(name_ + ": " + std::generic_category().message(errno));
  return static_cast<std::size_t>(got);
}

bool InputFile::isReady() const {
  pollfd state{descriptor_, POLLIN, 0};
  return ::poll(&state, 1, 0) > 0;
}

bool InputFile::waitUnless(int other) const {
  pollfd states[] = {{descriptor_, POLLIN, 0}, {other, POLLIN, 0}};
  int ready = 0;
  do ready = ::poll(states, 2, -1);
  while (ready < 0 && errno == EINTR);
  return states[1].revents == 0;
}

std::optional<std::size_t> InputFile::remaining() const {
  struct stat state;
  if (::fstat(descriptor_, &state) != 0 || !S_ISREG(state.st_mode)) return std::nullopt;
  const off_t at = ::lseek(descriptor_, 0, SEEK_CUR);
  if (at < 0 || at > state.st_size) return std::nullopt;
  return static_cast<std::size_t>(state.st_size - at);
}

bool isTerminal() { return ::isatty(STDIN_FILENO) != 0; }

std::string readWholeFile(const std::string& name, std::size_t most) {
  constexpr std::size_t kBlock = 64 << 10;
  InputFile file(name);
  std::string text;
  for (std::size_t got = 1; got > 0;) {
    const std::size_t had = text.size();
    text.resize(had + kBlock);
    got = file.read(text.data() + had, kBlock);
    text.resize(had + got);
    if (text.size() > most)
      throw InputError(file.name() + ": longer than " + std::to_string(most >> 20) + " MiB, the most that is read");
  }
  return text;
}

}  // namespace viewproj::cmd
