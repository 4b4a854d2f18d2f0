#include "tool.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.hpp"

namespace rasterisers {
namespace {

std::string quoted(const std::string& argument) {
  std::string out = "'";
  for (char c : argument) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

struct ScratchFile {
  std::string name = (std::filesystem::temp_directory_path() / "viewproj-rasterisers-XXXXXX").string();

  explicit ScratchFile(const std::string& text) {
    const int descriptor = mkstemp(name.data());
    REQUIRE(descriptor >= 0);
    close(descriptor);
    std::ofstream(name) << text;
  }
  ~ScratchFile() { std::filesystem::remove(name); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
};

}  // namespace

std::string runTool(const std::vector<std::string>& arguments, const std::string& input) {
  const ScratchFile file(input);
  std::string command = quoted(VIEWPROJ_TOOL);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  INFO(command);
  FILE* pipe = popen((command + " <" + quoted(file.name)).c_str(), "r");
  REQUIRE(pipe);
  std::string text;
  char buffer[4096];
  for (std::size_t got; (got = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, got);
  REQUIRE(pclose(pipe) == 0);
  return text;
}

std::vector<nlohmann::json> filter(const std::vector<std::string>& arguments,
                                   const std::vector<nlohmann::json>& records) {
  std::string input;
  for (const nlohmann::json& record : records) input += record.dump() + "\n";
  std::istringstream lines(runTool(arguments, input));
  std::vector<nlohmann::json> results;
  for (std::string line; std::getline(lines, line);) results.push_back(nlohmann::json::parse(line));
  REQUIRE(results.size() == records.size());
  return results;
}

}  // namespace rasterisers
