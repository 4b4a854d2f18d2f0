// Notes: what is obeyed but probably not meant, a line each on standard error; the exit status stays 0.
#pragma once

#include <string>

namespace viewproj::cmd {

class CommandLine;

/// Writes `viewproj: note: ...`, each note once.
void note(const std::string& text);

/// --quiet: from here on no note is written.
void silenceNotes();

class Notes {
 public:
  void add(CommandLine& line);
  void say(const std::string& text) const { note(text); }
};

}  // namespace viewproj::cmd
