// Standard output, written whole or with an error, -o FILE, and messages.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace viewproj::cmd {

/// While it lives, standard output is a temporary file beside the one that is named; keep() gives it the name. What is
/// no regular file (a pipe, a device) is written as it is.
class NamedOutput {
 public:
  /// "-": standard output itself. Throws InputError where there cannot be such a file.
  explicit NamedOutput(const std::string& name);
  /// Removes what was not kept.
  ~NamedOutput();
  NamedOutput(const NamedOutput&) = delete;
  NamedOutput& operator=(const NamedOutput&) = delete;

  /// Whether nothing is in the temporary file.
  bool isEmpty() const;
  /// All is written. Throws InputError where the file cannot have its name.
  void keep();

 private:
  std::string target_;  ///< empty where nothing is to be renamed
};

/// Writes files, {name, text} each, into a folder that is not there yet or is empty: all of them, or none. Throws
/// InputError.
void writeFolder(const std::string& name, std::span<const std::pair<std::string, std::string>> files);

/// As messages name it.
std::string_view nameOfOutput();

/// Writes all of text. Throws ClosedPipe where nobody reads any more, InputError where it cannot be written.
void writeOutput(std::string_view text);

/// Writes `viewproj: MESSAGE` to standard error. Where that cannot be written, nobody is told.
void complain(const std::string& message);

/// Writes `viewproj: note: TEXT`, each note once: of what is obeyed but probably not meant. The exit status stays 0.
void note(const std::string& text);

/// --quiet: from here on no note is written.
void silenceNotes();

/// The exit status of whatever goes wrong from here on; 1 at first.
void setFailureStatus(int status);

/// In a catch block: complains of the exception. Returns the exit status.
int reportException();

/// The same, and ends the process, whatever other threads wait for.
[[noreturn]] void endWithException();

/// What operator new does in place of throwing: parts of libraries end or go on with less (streams, the
/// destructor of nlohmann's JSON). Waits for what another thread is writing, so that it is whole.
[[noreturn]] void endWithoutMemory();

}  // namespace viewproj::cmd
