#include "stream/interrupt.hpp"

#include <string>
#include <system_error>

#include "text/error.hpp"
#include "text/system.hpp"

namespace viewproj::cmd {

InterruptGuard::InterruptGuard() {
  // uncounted: faults_call has it fail, but not beside sanitizers
  if (const int error = beginNoting())
    throw InputError(std::string("a pipe for signals: ") + std::generic_category().message(error));
}

InterruptGuard::~InterruptGuard() { endNoting(); }

int InterruptGuard::descriptor() const { return wakeDescriptor(); }

void InterruptGuard::wake() { cmd::wake(); }

int InterruptGuard::signal() { return notedSignal(); }

WritingHere::WritingHere() { beginWriting(); }

WritingHere::~WritingHere() { endWriting(); }

void dieOf(const Interrupted& interrupted) { dieOfSignal(interrupted.signal); }

}  // namespace viewproj::cmd
