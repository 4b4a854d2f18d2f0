// Text of an input as a message can hold it.
#pragma once

#include <string>

namespace viewproj::cmd {

/// With a word for each NUL, at which what() of an exception would end.
inline std::string withoutNul(const std::string& text) {
  if (text.find('\0') == std::string::npos) return text;
  std::string shown;
  for (const char c : text) shown += c == '\0' ? std::string("<U+0000>") : std::string(1, c);
  return shown;
}

}  // namespace viewproj::cmd
