// How long a filter takes to answer a record typed by hand: answer COUNT LINE COMMAND...
// Writes LINE into the command's standard input COUNT times, each time after the answer to the one before and a pause,
// and prints the median and the longest wait in microseconds. The first is left out: it waits for the start.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  if (argc < 4) return std::fputs("usage: answer COUNT LINE COMMAND...\n", stderr), 2;
  const long count = std::strtol(argv[1], nullptr, 10);
  const std::string line = std::string(argv[2]) + "\n";
  int to[2], from[2];
  if (::pipe(to) != 0 || ::pipe(from) != 0) return std::perror("answer"), 1;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(to[0], STDIN_FILENO);
    ::dup2(from[1], STDOUT_FILENO);
    for (int end : {to[0], to[1], from[0], from[1]}) ::close(end);
    ::execvp(argv[3], argv + 3);
    ::_exit(127);
  }
  ::close(to[0]);
  ::close(from[1]);
  ::alarm(60);  // a filter that holds its answer back ends the measurement
  std::vector<double> waits;
  for (long i = 0; i <= count; ++i) {
    ::usleep(2000);
    const auto start = std::chrono::steady_clock::now();
    if (::write(to[1], line.data(), line.size()) != static_cast<ssize_t>(line.size())) return std::perror("answer"), 1;
    char answer[4096];
    for (ssize_t got = 0; got == 0 || answer[got - 1] != '\n';)
      if ((got = ::read(from[0], answer, sizeof answer)) <= 0) return std::fputs("answer: none came\n", stderr), 1;
    const std::chrono::duration<double, std::micro> wait = std::chrono::steady_clock::now() - start;
    if (i > 0) waits.push_back(wait.count());
  }
  ::close(to[1]);
  ::waitpid(child, nullptr, 0);
  std::sort(waits.begin(), waits.end());
  std::printf("%.0f %.0f\n", waits[waits.size() / 2], waits.back());
}
