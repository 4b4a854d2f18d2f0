#include "output/named_output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/visible.hpp"

namespace viewproj::cmd {
namespace {

constexpr const char* kBesides = ".viewproj-XXXXXX";  // after the file's own name, for mkstemp

constexpr const char* kDescriptors = "/proc/self/fd";

/// The descriptor that is open already under such a name: /dev/stdout, /dev/fd/3; -1: it is no such name.
int descriptorOf(std::string_view name) {
  if (name == "/dev/stdout") return STDOUT_FILENO;
  if (name == "/dev/stderr") return STDERR_FILENO;
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

NamedOutput::NamedOutput(const std::string& name) : name_(name) {
  if (name == "-") return;
  constexpr int kApart = 100;  // from the descriptors that a shell opens by number
  before_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, kApart);
  if (const int open = descriptorOf(name); open >= 0) {  // it goes on where that stands
    if (::dup2(open, STDOUT_FILENO) < 0) fail(errno);
    nameOutput(visible(name));
    return;
  }
  struct stat state = {};
  const bool exists = ::stat(name.c_str(), &state) == 0;
  int descriptor = -1;
  if (exists && !S_ISREG(state.st_mode)) {
    descriptor = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    if (exists && ::access(name.c_str(), W_OK) != 0) fail(errno);
    std::error_code error;
    const std::filesystem::path target = followed(name, error);
    if (error) fail(error.value());
    target_ = target.string();
    const mode_t mode = exists ? state.st_mode & 0777 : usualMode();
#ifdef O_TMPFILE
    // Without a name nothing is left of it, however the run ends.
    const std::string folder = target.has_parent_path() ? target.parent_path().string() : ".";
    if (::access(kDescriptors, X_OK) == 0) descriptor = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
#endif
    if (descriptor < 0) {
      written_ = target_ + kBesides;
      descriptor = ::mkstemp(written_.data());
      if (descriptor < 0) written_.clear();
    }
    if (descriptor >= 0 && exists) (void)!::fchown(descriptor, state.st_uid, state.st_gid);  // where that is allowed
    if (descriptor >= 0) (void)::fchmod(descriptor, mode);
  }
  if (descriptor < 0 || ::dup2(descriptor, STDOUT_FILENO) < 0) fail(errno);
  ::close(descriptor);
  nameOutput(visible(name));
}

NamedOutput::~NamedOutput() {
  if (before_ >= 0) {
    (void)::dup2(before_, STDOUT_FILENO);
    ::close(before_);
  }
  if (!written_.empty()) ::unlink(written_.c_str());
}

void NamedOutput::keep() {
  if (target_.empty()) return;
  if (written_.empty()) {
    // A name that nobody has: of a file that goes at once.
    std::string name = target_ + kBesides;
    const int other = ::mkstemp(name.data());
    if (other < 0) fail(errno);
    ::close(other);
    ::unlink(name.c_str());
    const std::string open = std::string(kDescriptors) + "/" + std::to_string(STDOUT_FILENO);
    if (::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) fail(errno);
    written_ = name;
  }
  if (::rename(written_.c_str(), target_.c_str()) != 0) fail(errno);
  written_.clear();
  target_.clear();
}

void NamedOutput::fail(int error) const {
  throw InputError(visible(name_) + ": " + std::generic_category().message(error));
}

}  // namespace viewproj::cmd
