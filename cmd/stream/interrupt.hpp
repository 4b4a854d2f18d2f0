// Ctrl-C and its kin: a stream ends after a whole record.
#pragma once

namespace viewproj::cmd {

/// Thrown after the last whole record; whoever catches it dies of the signal.
struct Interrupted {
  int signal;
};

/// While it lives, SIGINT, SIGTERM and SIGHUP are noted instead of ending the process; a second one does end it.
class InterruptGuard {
 public:
  /// Throws InputError where there are no descriptors left.
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Has something to read once a signal came, or wake() was called.
  int descriptor() const;
  void wake();

  /// The signal that came, or 0.
  static int signal();
};

/// While it lives, a signal that comes interrupts what this thread is writing.
class WritingHere {
 public:
  WritingHere();
  ~WritingHere();
  WritingHere(const WritingHere&) = delete;
  WritingHere& operator=(const WritingHere&) = delete;
};

/// Ends the process as the signal would have.
[[noreturn]] void dieOf(const Interrupted& interrupted);

}  // namespace viewproj::cmd
