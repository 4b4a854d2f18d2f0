#include "output/output_file.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <string>
#include <system_error>

#include "text/error.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {

namespace {

/// Held while something is written.
std::mutex writing;

std::string outputName = "standard output";  // for messages

Written write(int descriptor, std::string_view text, const Stop& stop) {
  Written all;
  while (all.bytes < text.size()) {
    const ssize_t written = ::write(descriptor, text.data() + all.bytes, text.size() - all.bytes);
    if (written >= 0) {
      all.bytes += static_cast<std::size_t>(written);
    } else if (errno == EAGAIN) {  // whoever opened it set it not to block
      pollfd state{descriptor, POLLOUT, 0};
      (void)::poll(&state, 1, -1);
    } else if (errno != EINTR) {
      all.error = errno;
      return all;
    }
    if (stop && stop()) return all;
  }
  return all;
}

}  // namespace

Written writeUntil(int descriptor, std::string_view text, const Stop& stop) {
  const std::lock_guard lock(writing);
  return write(descriptor, text, stop);
}

void nameOutput(const std::string& name) { outputName = name; }

std::string_view nameOfOutput() { return outputName; }

void failToWrite(int error) {
  if (error == EPIPE) throw ClosedPipe{};
  throw InputError(outputName + ": " + std::generic_category().message(error));
}

void writeOutput(std::string_view text) {
  const Written all = writeUntil(STDOUT_FILENO, text);
  if (all.error != 0) failToWrite(all.error);
}

void complain(const std::string& message, const Stop& stop) {
  // Whatever a message quotes, it commands no terminal.
  writeUntil(STDERR_FILENO, "viewproj: " + visible(message, "\n") + "\n", stop);
}

// uncounted: faults_limit takes memory away, but not beside sanitizers
void endWithoutMemory() {
  writing.lock();
  write(STDERR_FILENO, "viewproj: out of memory\n", {});
  std::_Exit(1);
}

void takeBack(std::size_t bytes) noexcept {
  struct stat state;
  const off_t at = ::lseek(STDOUT_FILENO, 0, SEEK_CUR);
  const auto back = static_cast<off_t>(bytes);
  if (bytes == 0 || at < back || ::fstat(STDOUT_FILENO, &state) != 0) return;
  if (!S_ISREG(state.st_mode) || state.st_size != at) return;
  if (::ftruncate(STDOUT_FILENO, at - back) == 0) (void)::lseek(STDOUT_FILENO, at - back, SEEK_SET);
}

}  // namespace viewproj::cmd
