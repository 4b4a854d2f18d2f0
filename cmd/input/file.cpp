#include "input/file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "input/error.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kBlock = 256 << 10;

}  // namespace

InputFile::InputFile(const std::string& name)
    : name_(name == "-" ? kStandardInputName : name),
      descriptor_(name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw InputError(name_ + ": " + std::strerror(errno));
}

InputFile::~InputFile() {
  if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
}

bool InputFile::readInto(std::string& buffer) {
  const std::size_t had = buffer.size();
  buffer.resize(had + kBlock);
  ssize_t got = 0;
  do got = ::read(descriptor_, buffer.data() + had, kBlock);
  while (got < 0 && errno == EINTR);
  buffer.resize(had + (got > 0 ? static_cast<std::size_t>(got) : 0));
  if (got < 0) throw InputError(name_ + ": " + std::strerror(errno));
  return got > 0;
}

bool InputFile::isReady() const {
  pollfd state{descriptor_, POLLIN, 0};
  return ::poll(&state, 1, 0) > 0;
}

std::string readWholeFile(const std::string& name, std::size_t most) {
  InputFile file(name);
  std::string text;
  while (file.readInto(text))
    if (text.size() > most)
      throw InputError(file.name() + ": longer than " + std::to_string(most >> 20) + " MiB, the most that is read");
  return text;
}

}  // namespace viewproj::cmd
