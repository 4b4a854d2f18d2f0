// -o FILE: a file that is whole, or as it was.
#pragma once

#include <string>

namespace viewproj::cmd {

/// While it lives, what goes to standard output goes to a file of no name beside the one that is named; keep() gives it
/// the name. What is no regular file (a pipe, a device) is written as it is.
class NamedOutput {
 public:
  /// "-": standard output itself. Throws InputError where there cannot be such a file.
  explicit NamedOutput(const std::string& name);
  ~NamedOutput();
  NamedOutput(const NamedOutput&) = delete;
  NamedOutput& operator=(const NamedOutput&) = delete;

  /// All is written. Throws InputError where the file cannot have its name.
  void keep();

 private:
  [[noreturn]] void fail(int error) const;

  std::string name_;
  std::string target_;   ///< with links followed; empty where nothing is to be renamed
  int before_ = -1;      ///< what standard output was
  std::string written_;  ///< the file's name until it is kept; empty while it has none
};

}  // namespace viewproj::cmd
