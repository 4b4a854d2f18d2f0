// The command-line tool, run from a test. VIEWPROJ_TOOL names it.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "catch.hpp"

namespace tool {

/// What it prints; it must succeed. arguments: as a shell takes them.
inline std::string printed(const std::string& arguments) {
  const std::string command = "exec " VIEWPROJ_TOOL " " + arguments;
  INFO(command);
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  char buffer[4096];
  for (std::size_t got; (got = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, got);
  REQUIRE(pclose(pipe) == 0);
  return text;
}

inline std::string quoted(const std::string& argument) {
  std::string out = "'";
  for (char c : argument) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

/// The same, of arguments as they are.
inline std::string printed(const std::vector<std::string>& arguments) {
  std::string line;
  for (const std::string& argument : arguments) line += (line.empty() ? "" : " ") + quoted(argument);
  return printed(line);
}

}  // namespace tool
