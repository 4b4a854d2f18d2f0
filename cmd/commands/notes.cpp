#include "commands/notes.hpp"

#include "commands/command_line.hpp"
#include "output/output_file.hpp"

namespace viewproj::cmd {

void Notes::add(CommandLine& line) {
  const Heading heading(line, kEverywhere);
  line.addFlag("--quiet", quiet_, "Leave out the notes on standard error about what was probably not meant");
}

void Notes::say(const std::string& note) const {
  if (!quiet_ && said_.insert(note).second) complain("note: " + note);
}

}  // namespace viewproj::cmd
