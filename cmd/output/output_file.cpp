#include "output/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "input/error.hpp"

namespace viewproj::cmd {

void writeOutput(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EPIPE) {
      throw ClosedPipe{};
    } else if (errno != EINTR) {
      throw InputError(std::string("standard output: ") + std::strerror(errno));
    }
  }
}

}  // namespace viewproj::cmd
