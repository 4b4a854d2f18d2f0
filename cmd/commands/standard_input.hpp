// Which command lines read standard input: the one place that knows.
#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace viewproj::cmd {

/// Whether a command reads standard input as its FILE: where FILE is -, and without FILE unless an option is given that
/// stands in for it. A terminal counts as any other input. isGiven: of an option by its long name.
bool readsStandardInput(std::string_view command, const std::optional<std::string>& file,
                        const std::function<bool(std::string_view option)>& isGiven);

/// Whether a file is standard input, which is then read for it.
inline bool isStandardInput(const std::optional<std::string>& file) { return file == "-"; }

/// Something that is read, and whether from standard input.
struct NamedInput {
  const char* what = "";
  bool isStandard = false;
};

/// Throws UsageError where two of these come from standard input.
void requireOneStandardInput(std::initializer_list<NamedInput> inputs);

}  // namespace viewproj::cmd
