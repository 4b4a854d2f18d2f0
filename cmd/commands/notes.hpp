// Notes: what is obeyed but probably not meant, a line each on standard error; the exit status stays 0.
#pragma once

#include <string>

namespace viewproj::cmd {

/// Writes `viewproj: note: ...`, each note once.
void note(const std::string& text);

/// --quiet: from here on no note is written.
void silenceNotes();

}  // namespace viewproj::cmd
