// -o FILE: a file that is whole, or as it was.
#pragma once

#include <string>

#include "text/system.hpp"

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
  /// Throws InputError for an errno.
  void requireNone(int error) const;

  std::string name_;
  Replacement replacement_;
};

}  // namespace viewproj::cmd
