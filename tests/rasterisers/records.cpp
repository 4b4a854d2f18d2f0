#include "records.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tool.hpp"

namespace rasterisers {
namespace {

struct ScratchFile {
  std::string name = (std::filesystem::temp_directory_path() / "viewproj-rasterisers-XXXXXX").string();

  ScratchFile() {
    const int descriptor = mkstemp(name.data());
    REQUIRE(descriptor >= 0);
    close(descriptor);
  }
  ~ScratchFile() { std::filesystem::remove(name); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
};

}  // namespace

std::vector<nlohmann::json> filter(const std::vector<std::string>& arguments,
                                   const std::vector<nlohmann::json>& records) {
  const ScratchFile file;
  std::ofstream input(file.name);
  for (const nlohmann::json& record : records) input << record << "\n";
  input.close();
  std::string line;
  for (const std::string& argument : arguments) line += tool::quoted(argument) + " ";
  std::istringstream output(tool::printed(line + "<" + tool::quoted(file.name)));
  std::vector<nlohmann::json> results;
  while (std::getline(output, line)) results.push_back(nlohmann::json::parse(line));
  REQUIRE(results.size() == records.size());
  return results;
}

}  // namespace rasterisers
