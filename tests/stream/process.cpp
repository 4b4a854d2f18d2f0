#include "stream/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace viewproj::tests {
namespace {

constexpr const char* kCamera =
    R"({"position":[3,2,5],"target":[0,0,0],"projection":{"type":"perspective","fovY":60,"near":0.1,"far":1000},)"
    R"("viewport":{"width":1280,"height":720}})";
constexpr int kPatience = 10000;  // ms

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void Descriptor::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

Pipe::Pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  read = Descriptor(ends[0]);
  write = Descriptor(ends[1]);
}

Terminal::Terminal() : read(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (read < 0 || ::grantpt(read) != 0 || ::unlockpt(read) != 0) throw std::runtime_error("no terminal");
  end = Descriptor(::open(::ptsname(read), O_RDWR | O_NOCTTY | O_CLOEXEC));
  if (end < 0) throw std::runtime_error("no end of the terminal");
}

bool writeAll(int to, std::string_view text) {
  std::signal(SIGPIPE, SIG_IGN);
  while (!text.empty()) {
    const ssize_t written = ::write(to, text.data(), text.size());
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

namespace {

std::string readUntil(int from, const std::function<std::size_t(const std::string&)>& missing) {
  std::string text;
  for (std::size_t most; (most = missing(text)) > 0;) {
    pollfd state{from, POLLIN, 0};
    if (::poll(&state, 1, kPatience) <= 0) break;
    char buffer[65536];
    const ssize_t got = ::read(from, buffer, std::min(most, sizeof buffer));
    if (got <= 0) break;
    text.append(buffer, static_cast<std::size_t>(got));
  }
  return text;
}

}  // namespace

std::string readUpTo(int from, std::size_t most) {
  return readUntil(from, [&](const std::string& text) { return most - text.size(); });
}

std::string readLines(int from, std::size_t count) {
  std::size_t lines = 0, seen = 0;
  return readUntil(from, [&](const std::string& text) {
    lines += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(seen), text.end(), '\n'));
    seen = text.size();
    return lines < count ? std::size_t{65536} : 0;
  });
}

Feeder::Feeder(Descriptor to, std::string before, std::string again)
    : thread_([to = std::move(to), before = std::move(before), again = std::move(again)] {
        for (bool open = writeAll(to, before); open;) open = writeAll(to, again);
      }) {}

Tool::Tool(std::vector<std::string> arguments, const Setup& setup) {
  arguments.insert(arguments.begin(), {VIEWPROJ_TOOL, "project", "-c", kCamera});
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ > 0) return;
  const int given[] = {setup.in, setup.out, setup.err};
  for (int i = 0; i < 3; ++i) ::dup2(given[i] >= 0 ? given[i] : ::open("/dev/null", O_RDWR | O_CLOEXEC), i);
  for (const int signal : {SIGPIPE, SIGHUP, SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);  // nohup ignores one
  if (setup.fileSize > 0) {
    const rlimit limit{setup.fileSize, setup.fileSize};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ::alarm(60);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

Tool::~Tool() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    (void)wait();
  }
}

int Tool::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

void Tool::signal(int number) const { ::kill(process_, number); }

std::size_t Tool::peakMemory() const { return status("VmHWM:") << 10; }

std::size_t Tool::threads() const { return status("Threads:"); }

std::size_t Tool::status(const std::string& name) const {
  std::ifstream status("/proc/" + std::to_string(process_) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name)) return std::strtoull(line.c_str() + name.size(), nullptr, 10);
  return 0;
}

}  // namespace viewproj::tests
