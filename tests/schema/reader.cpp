// What the readers say of documents: one JSON string a line holds a document's text, and for each comes a line
// "accepted", "foreign" (a camera file of another program) or "rejected: " and the message.
//   schema_reader camera|scene SCRATCH_FILE < DOCUMENTS
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "input/camera_source.hpp"
#include "input/document.hpp"
#include "input/scene.hpp"
#include "text/error.hpp"

namespace {

using namespace viewproj::cmd;

std::string judgeCamera(const std::string& source) {
  const Document document(source, "camera");
  if (isForeign(document)) return "foreign";
  const CameraFile file = readAnyCamera(document, std::nullopt, {});
  if (file.pose && file.projection && file.viewport) (void)makeCamera(file);
  return "accepted";
}

std::string judgeScene(const std::string& source) {
  (void)readScene(source, true);
  return "accepted";
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const bool cameras = std::string(argv[1]) == "camera";
  const std::string file = argv[2];
  for (std::string line; std::getline(std::cin, line);) {
    std::string source = nlohmann::json::parse(line).get<std::string>();
    // What does not begin as an object would count as a file's name.
    const std::size_t first = source.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || source[first] != '{') {
      std::ofstream(file, std::ios::binary) << source;
      source = file;
    }
    std::string verdict;
    try {
      verdict = cameras ? judgeCamera(source) : judgeScene(source);
    } catch (const InputError& e) {
      verdict = std::string("rejected: ") + e.what();
    }
    std::replace(verdict.begin(), verdict.end(), '\n', ' ');
    std::puts(verdict.c_str());
  }
  return 0;
}
