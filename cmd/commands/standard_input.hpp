// Which command lines read standard input: the one place that decides, by the options of a parsed command line.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace viewproj::cmd {

/// The FILE of a command: as typed; or "-", standard input, where it is absent and no option stands in for it; else
/// nothing. A terminal counts as any other input.
std::optional<std::string> inputFile(const CLI::App& app);

/// Throws UsageError where two inputs come from standard input.
void requireOneStandardInput(const CLI::App& app);

}  // namespace viewproj::cmd
