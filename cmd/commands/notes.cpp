#include "commands/notes.hpp"

#include <set>

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

}  // namespace viewproj::cmd
