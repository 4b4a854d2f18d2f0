#include "commands/notes.hpp"

#include <set>

#include "commands/command_line.hpp"
#include "output/output_file.hpp"

namespace viewproj::cmd {
namespace {

bool isSilent = false;

}  // namespace

void note(const std::string& text) {
  static std::set<std::string> written;
  if (!isSilent && written.insert(text).second) complain("note: " + text);
}

void silenceNotes() { isSilent = true; }

void Notes::add(CommandLine& line) {
  const Heading heading(line, kEverywhere);
  line.addFlag(
      "--quiet", [](std::int64_t) { silenceNotes(); }, "Do not write notes on standard error");
}

}  // namespace viewproj::cmd
