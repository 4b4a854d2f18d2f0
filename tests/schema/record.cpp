// Stands for viewproj on the PATH: runs $VIEWPROJ_TOOL, and keeps what goes in and out in a folder of its own in
// $VIEWPROJ_RECORDED: its arguments and folder, input, output and status.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

std::string kept;  // the folder

[[noreturn]] void giveUp(const std::string& what) {
  std::perror(what.c_str());
  std::_Exit(125);
}

int create(const std::string& name) {
  const int file = ::open((kept + name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) giveUp(kept + name);
  return file;
}

bool writeAll(int to, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(to, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

void keep(const std::string& name, const std::string& text) {
  const int file = create(name);
  if (!writeAll(file, text.data(), text.size())) giveUp(kept + name);
  ::close(file);
}

/// Until the end, or until nobody reads any more.
void copy(int from, int to, int file) {
  char bytes[1 << 16];
  for (ssize_t got; (got = ::read(from, bytes, sizeof bytes)) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 || !writeAll(file, bytes, static_cast<std::size_t>(got)) ||
        !writeAll(to, bytes, static_cast<std::size_t>(got)))
      break;
  }
  ::close(from);
  ::close(to);
}

}  // namespace

int main(int count, char** arguments) {
  const char* tool = std::getenv("VIEWPROJ_TOOL");
  const char* recorded = std::getenv("VIEWPROJ_RECORDED");
  if (!tool || !recorded) giveUp("VIEWPROJ_TOOL, VIEWPROJ_RECORDED");
  kept = std::string(recorded) + "/XXXXXX";
  char here[4096];
  if (!::mkdtemp(kept.data()) || !::getcwd(here, sizeof here)) giveUp(kept);
  kept += '/';
  keep("cwd", here);
  std::string given;
  for (int i = 1; i < count; ++i) given.append(arguments[i]).push_back('\0');
  keep("args", given);

  struct stat input {};
  const bool reads = ::fstat(0, &input) == 0 && !S_ISCHR(input.st_mode);  // most read nothing
  int in[2], out[2];
  if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0) giveUp("pipe");
  const pid_t child = ::fork();
  if (child < 0) giveUp("fork");
  if (child == 0) {
    if (reads) ::dup2(in[0], 0);
    ::dup2(out[1], 1);
    ::execv(tool, arguments);
    giveUp(tool);
  }
  ::close(in[0]);
  ::close(out[1]);
  std::signal(SIGPIPE, SIG_IGN);
  const int inputKept = create("in");
  if (reads) std::thread([=] { copy(0, in[1], inputKept); }).detach();
  copy(out[0], 1, create("out"));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  keep("status", std::to_string(code));
  std::_Exit(code);
}
