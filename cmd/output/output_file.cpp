#include "output/output_file.hpp"

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
    const Written part = writeSome(descriptor, text.substr(all.bytes));
    all.bytes += part.bytes;
    all.error = part.error;
    if (all.error != 0) return all;
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
  const Written all = writeUntil(kStandardOutput, text);
  if (all.error != 0) failToWrite(all.error);
}

void complain(const std::string& message, const Stop& stop) {
  // Whatever a message quotes, it commands no terminal.
  writeUntil(kStandardError, "viewproj: " + visible(message, "\n") + "\n", stop);
}

// uncounted: faults_limit takes memory away, but not beside sanitizers
void endWithoutMemory() {
  writing.lock();
  write(kStandardError, "viewproj: out of memory\n", {});
  std::_Exit(1);
}

void takeBack(std::size_t bytes) noexcept { cutOff(kStandardOutput, bytes); }

}  // namespace viewproj::cmd
