#include "output/output_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>

#include "text/error.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {

namespace {

namespace fs = std::filesystem;

/// Held while something is written.
std::mutex writing;

std::string outputName = "standard output";  // for messages

int failureStatus = 1;

/// Returns errno, or 0.
int writeUnlocked(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const std::ptrdiff_t written = writeSome(descriptor, text);
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int writeAll(int descriptor, std::string_view text) {
  const std::lock_guard lock(writing);
  return writeUnlocked(descriptor, text);
}

std::set<std::string> notes;
bool isSilent = false;

[[noreturn]] void fail(int error) { throw InputError(outputName + ": " + std::generic_category().message(error)); }

std::string temporaryName;
/// What a signal handler may touch: that name while there is such a file, else null.
std::atomic<const char*> temporary{nullptr};

void removeTemporary() {
  if (const char* const name = temporary.exchange(nullptr)) ::unlink(name);
}

void removeAndDie(int signal) {
  removeTemporary();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void catchSignals() {
  for (const int signal : {
           SIGINT,
           SIGTERM,
#ifdef SIGHUP
           SIGHUP,
           SIGQUIT,
           SIGALRM,
           SIGXCPU,
#endif
       })
    if (std::signal(signal, removeAndDie) == SIG_IGN) std::signal(signal, SIG_IGN);
}

/// The descriptor that has such a name (/dev/stdout, /dev/fd/3): opened by it, a file would begin anew. Else -1.
int descriptorOf(std::string_view name) {
  if (name == "/dev/stdout") return kStandardOutput;
  if (name == "/dev/stderr") return kStandardError;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    int number = -1;
    const char* const end = name.data() + name.size();
    if (name.starts_with(folder) && std::from_chars(name.data() + folder.size(), end, number).ptr == end) return number;
  }
  return -1;
}

/// Where a name leads that may be a link to a file that is not there yet.
fs::path followed(fs::path path) {
  std::error_code error;
  while (fs::is_symlink(path, error)) path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

/// Creates the temporary file beside the target, with its permissions or those of a new file. Returns a descriptor.
int createTemporary(const std::string& target, bool exists) {
  std::error_code error;
  const fs::perms permissions =
      exists ? fs::status(pathOf(target), error).permissions() & fs::perms::all : fs::perms(0666);
  int descriptor = -1, number = static_cast<int>(::getpid());
  do {
    temporaryName = target + ".viewproj-" + std::to_string(number++);
    descriptor = createFile(temporaryName, static_cast<int>(permissions));
  } while (descriptor < 0 && errno == EEXIST);
  if (descriptor < 0) fail(errno);
  temporary = temporaryName.c_str();
  if (exists) fs::permissions(pathOf(temporaryName), permissions, error);  // the umask took some of them
  return descriptor;
}

}  // namespace

NamedOutput::NamedOutput(const std::string& name) {
  if (name == "-") return;
  outputName = visible(name);
  const int given = descriptorOf(name);
  int descriptor = given >= 0 ? given : openToWrite(name);
  const bool exists = descriptor >= 0;
  if (!exists && errno != ENOENT) fail(errno);
  if (!exists || (given < 0 && bytesLeft(descriptor))) {
    if (exists) closeDescriptor(descriptor);
    catchSignals();
    target_ = followed(pathOf(name)).string();
    descriptor = createTemporary(target_, exists);
  }
  if (becomeStandardOutput(descriptor) < 0) fail(errno);
}

NamedOutput::~NamedOutput() { removeTemporary(); }

bool NamedOutput::isEmpty() const {
  std::error_code error;
  return !target_.empty() && fs::file_size(pathOf(temporaryName), error) == 0 && !error;
}

void NamedOutput::keep() {
  if (target_.empty()) return;
  std::error_code error;
  fs::rename(pathOf(temporaryName), pathOf(target_), error);
  if (error) fail(error.value());
  temporary = nullptr;
}

void writeFolder(const std::string& name, std::span<const std::pair<std::string, std::string>> files) {
  outputName = visible(name);
  const fs::path target = pathOf(name.substr(0, name.find_last_not_of('/') + 1));
  std::error_code error;
  if (fs::exists(target, error) && !(fs::is_directory(target, error) && fs::is_empty(target, error)))
    throw InputError(outputName + ": is there already; expected a new folder, or an empty one");
  const fs::path whole = target.string() + ".viewproj-" + std::to_string(::getpid());
  if (!fs::create_directory(whole, error)) fail(error.value());
  for (const auto& [file, text] : files) {
    std::ofstream out(whole / pathOf(file), std::ios::binary);
    if (!(out << text << std::flush)) error = std::error_code(errno, std::generic_category());
  }
  if (!error) fs::remove(target, error);  // an empty one
  if (!error) fs::rename(whole, target, error);
  if (!error) return;
  std::error_code ignored;
  fs::remove_all(whole, ignored);
  fail(error.value());
}

std::string_view nameOfOutput() { return outputName; }

void writeOutput(std::string_view text) {
  const int error = writeAll(kStandardOutput, text);
  if (error == EPIPE) throw ClosedPipe{};
  if (error != 0) fail(error);
}

void complain(const std::string& message) {
  // Whatever a message quotes, it commands no terminal.
  writeAll(kStandardError, "viewproj: " + visible(message, "\n") + "\n");
}

void note(const std::string& text) {
  if (!isSilent && notes.insert(text).second) complain("note: " + text);
}

void silenceNotes() { isSilent = true; }

void setFailureStatus(int status) { failureStatus = status; }

int reportException() {
  try {
    throw;
  } catch (const ClosedPipe&) {
    return 0;
  } catch (const UsageError& e) {
    complain(visible(e.what()));
    return 2;
  } catch (const std::exception& e) {
    complain(e.what());
    return failureStatus;
  }
}

void endWithException() {
  const int status = reportException();
  removeTemporary();
  std::_Exit(status);
}

void endWithoutMemory() {
  writing.lock();
  writeUnlocked(kStandardError, "viewproj: out of memory\n");
  removeTemporary();
  std::_Exit(failureStatus);
}

}  // namespace viewproj::cmd
