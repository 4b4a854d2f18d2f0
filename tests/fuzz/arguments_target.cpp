// Whole commands as a shell starts them, all that main.cpp registers but one that takes its time.
#define main viewprojMain
#include "../../cmd/main.cpp"
#undef main

#include "fuzz.hpp"
#include "targets.hpp"

namespace viewproj::fuzz {
namespace {

bool isJson(const std::vector<std::string>& arguments) {
  bool json = false;
  for (std::size_t i = 1; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--to") json = arguments[i + 1] == "json" || arguments[i + 1] == "ndjson";
  return json;
}

/// None is written, and none read but those in the folder that the fuzzer runs in, and none of a form whose numbers are
/// not.
void runArguments(std::string_view input) {
  std::vector<std::string> arguments{"viewproj"};
  std::size_t end = 0;
  while ((end = input.find('\0')) != std::string_view::npos) {
    arguments.emplace_back(input.substr(0, end));
    input.remove_prefix(end + 1);
    const bool isText = arguments.back().find_first_of("{[") != std::string::npos;
    if (!isText && arguments.back().find('/') != std::string::npos) return;
    if (arguments.back().starts_with("-o") || arguments.back().starts_with("--o")) return;  // it would leave files
  }
  if (arguments.size() > 1 && arguments[1] == "measure") return;
  // A worker among several that fails ends the process.
  if (arguments.size() > 1 && (arguments[1] == "project" || arguments[1] == "ray" || arguments[1] == "cull")) {
    for (const std::string& argument : arguments)
      if (argument.starts_with("--j")) return;
    arguments.insert(arguments.begin() + 2, "--jobs=1");
  }
  giveInput(input);
  (void)::run({arguments.begin() + 1, arguments.end()});
  if (isJson(arguments)) requireJson(takeOutput(), arguments[1]);
}

}  // namespace

void fuzzArguments(std::string_view input) {
  succeeds(runArguments, input);
  (void)takeOutput();
}

}  // namespace viewproj::fuzz
