// Stands in for viewproj where golden cases run, and keeps what it is given as seeds: in $SEEDS a folder for each
// target.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMost = 4096;

std::string read(std::istream& in) {
  std::string text(kMost, '\0');
  in.read(text.data(), kMost);
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

// Keeps it for each target, under a name made of it.
void seed(std::string_view text, std::initializer_list<const char*> targets) {
  text = text.substr(0, kMost);
  for (const char* target : targets) {
    if (text.empty()) return;
    const fs::path folder = fs::path(std::getenv("SEEDS")) / target;
    fs::create_directories(folder);
    const fs::path mine = folder / ("new." + std::to_string(getpid()));
    std::ofstream(mine, std::ios::binary) << text;
    fs::rename(mine,
               folder / (std::to_string(std::hash<std::string_view>{}(text)) + "-" + std::to_string(text.size())));
  }
}

// What an argument stands for: JSON, or the content of a file.
std::string contentOf(const std::string& argument) {
  if (argument.starts_with('{') || argument.starts_with('[')) return argument;
  const std::string name = argument.substr(0, argument.find('#'));
  if (!fs::is_regular_file(name)) return "";
  std::ifstream file(name, std::ios::binary);
  return read(file);
}

// Options with their values, and --set assignments, each after a NUL.
std::string patchesOf(const std::vector<std::string>& arguments) {
  std::string text;
  bool open = false;
  for (const std::string& patch : arguments) {
    const bool assigns = std::islower(static_cast<unsigned char>(patch[0])) && patch.find('=') != std::string::npos;
    if (patch == "--set") continue;
    if (assigns || patch.starts_with("--")) {
      text += '\0' + patch;
    } else if (open && !patch.starts_with('-')) {
      text += ' ' + patch;
      continue;
    }
    open = patch.starts_with("--");
  }
  return text;
}

void seedAsItBegins(const std::string& text, const std::string& choice, const std::string& patches) {
  const std::string records = text.substr(0, kMost - choice.size()) + choice;
  const auto first = static_cast<unsigned char>(text.empty() ? 0 : text[0]);
  if (first == '{' || first == '[') {
    seed(records, {"json"});
    seed(text + patches, {"camera"});
    seed(text, {"camera", "scene", "model", "matrices"});
  } else if (std::isalpha(first) || first == '"' || first == '%') {
    seed(records, {"csv"});
    seed(text, {"camera", "matrices"});
  } else if (first != 0 &&
             std::string_view("-+.0123456789# ").find(static_cast<char>(first)) != std::string_view::npos) {
    seed(records, {"text", "csv"});
    seed(text, {"matrices"});
  } else {
    seed(records, {"f64"});
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  struct stat standard {};
  const bool typed = fstat(0, &standard) != 0 || S_ISCHR(standard.st_mode);
  const std::string input = typed ? "" : read(std::cin);
  const std::string command = arguments.empty() ? "" : arguments[0];
  // Two bytes behind the records choose what is done with them.
  const std::string choice = command == "ray" ? "?@" : command == "cull" ? "?\200" : "!!";
  const std::string patches = patchesOf(arguments);
  std::string all;
  seedAsItBegins(input, choice, patches);
  for (const std::string& argument : arguments) {
    std::string text = contentOf(argument);
    seedAsItBegins(text, choice, patches);
    if (text.starts_with('{')) std::erase(text, '\0');
    all += (text.starts_with('{') ? text : argument) + '\0';
  }
  seed(all + input, {"arguments"});
}
