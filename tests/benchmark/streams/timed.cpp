// Runs a shell command with its output thrown away and prints what it took: timed COMMAND
//   0.183215 0.179000 5120
// seconds by the clock, seconds of the processors, and the peak memory in kB of the largest process in it.
// Small, because a process starts with the peak of the one that made it.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("usage: timed COMMAND\n", stderr), 2;
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
    ::execl("/bin/sh", "sh", "-c", argv[1], nullptr);
    ::_exit(127);
  }
  int status = 0;
  rusage used = {};
  if (child < 0 || ::wait4(child, &status, 0, &used) != child) return std::perror("timed"), 1;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (status != 0) return std::fprintf(stderr, "timed: failed: %s\n", argv[1]), 1;
  const auto inSeconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  std::printf("%.6f %.6f %ld\n", seconds.count(), inSeconds(used.ru_utime) + inSeconds(used.ru_stime), used.ru_maxrss);
}
