// What is obeyed but probably not meant, a line each on standard error; the status stays 0.
#pragma once

#include <set>
#include <string>

namespace viewproj::cmd {

class CommandLine;

class Notes {
 public:
  /// --quiet.
  void add(CommandLine& line);

  /// `viewproj: note: ...`, once a run each.
  void say(const std::string& note) const;

 private:
  bool quiet_ = false;
  mutable std::set<std::string> said_;
};

}  // namespace viewproj::cmd
