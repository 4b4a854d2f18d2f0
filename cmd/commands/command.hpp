// The commands of the tool. To add one: a file beside this one, and a row in main.cpp.
#pragma once

#include <string_view>

namespace viewproj::cmd {

struct Command {
  std::string_view name;
  std::string_view summary;
  /// argv[0] is the command's name. Returns the exit status; throws what input/error.hpp lists.
  int (*run)(int argc, char** argv);
};

int runProject(int argc, char** argv);
int runRay(int argc, char** argv);
int runMatrix(int argc, char** argv);
int runCull(int argc, char** argv);
int runInspect(int argc, char** argv);
int runExplain(int argc, char** argv);
int runDepth(int argc, char** argv);
int runMeasure(int argc, char** argv);
int runDraw(int argc, char** argv);
int runSchema(int argc, char** argv);

}  // namespace viewproj::cmd
