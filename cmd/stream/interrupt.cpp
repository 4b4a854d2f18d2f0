#include "stream/interrupt.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <string>
#include <system_error>

#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
/// Says nothing but "look up from your write".
constexpr int kNudge = SIGURG;

// What a signal handler may touch.
std::atomic<int> came{0};
std::atomic<bool> writing{false};
std::atomic<pthread_t> writer{};
int wakeEnds[2] = {-1, -1};

struct sigaction before[std::size(kSignals)], beforeNudge;

void nudged(int) {}

void note(int signal) {
  const int error = errno;
  came = signal;
  (void)!::write(wakeEnds[1], "", 1);
  if (writing && !pthread_equal(writer, pthread_self())) pthread_kill(writer, kNudge);
  errno = error;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  came = 0;
  // uncounted: faults_call has it fail, but not beside sanitizers
  if (::pipe2(wakeEnds, O_CLOEXEC | O_NONBLOCK) != 0)
    throw InputError(std::string("a pipe for signals: ") + std::generic_category().message(errno));

  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    ::sigaction(kSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
  action.sa_handler = nudged;
  action.sa_flags = 0;
  ::sigaction(kNudge, &action, &beforeNudge);
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
  ::sigaction(kNudge, &beforeNudge, nullptr);
  for (int& end : wakeEnds) {
    ::close(end);
    end = -1;
  }
}

int InterruptGuard::descriptor() const { return wakeEnds[0]; }

void InterruptGuard::wake() { (void)!::write(wakeEnds[1], "", 1); }

int InterruptGuard::signal() { return came; }

WritingHere::WritingHere() {
  writer = pthread_self();
  writing = true;
}

WritingHere::~WritingHere() { writing = false; }

void dieOf(const Interrupted& interrupted) {
  std::signal(interrupted.signal, SIG_DFL);
  ::raise(interrupted.signal);
  std::_Exit(128 + interrupted.signal);
}

}  // namespace viewproj::cmd
