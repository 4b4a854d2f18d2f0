// Runs the inputs that once were findings, and others worth keeping, through the fuzz targets, without a fuzzer:
//   fuzz_corpus DIRECTORY
// which has a directory for each target. Prints what ran last if one aborts.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fuzz_corpus DIRECTORY\n"), 2;
  const int report = ::dup(STDERR_FILENO);
  viewproj::fuzz::takeOverStandardStreams();
  if (const int nothing = ::open("/dev/null", O_WRONLY); nothing >= 0) ::dup2(nothing, STDERR_FILENO);
  bool good = true;
  for (const auto& target : viewproj::fuzz::targets()) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / target.name;
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder))
      for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      std::ifstream stream(file, std::ios::binary);
      const std::string input{std::istreambuf_iterator<char>(stream), {}};
      ::dprintf(report, "%s/%s\n", target.name.data(), file.filename().c_str());
      target.run(input);
    }
    ::dprintf(report, "%s: %zu inputs\n", target.name.data(), files.size());
    good = good && !files.empty();
  }
  if (!good) ::dprintf(report, "a target has no inputs\n");
  return good ? 0 : 1;
}
