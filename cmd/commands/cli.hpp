// CLI11 as this tool uses it: the look of help, what of a command line is refused, and options with a reader of their
// own. Flags, needs and excludes, commands take from CLI11 directly.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "commands/values.hpp"
#include "text/form.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace viewproj::cmd {

/// Groups of options that commands share. Help lists them by name alone; the topic in the heading describes them.
inline constexpr const char *kCameraGroup = "Camera (viewproj help camera)",
                            *kConventionGroup = "Convention (viewproj help conventions)",
                            *kStreamGroup = "Records (viewproj help points)";

/// Every command's: how its help looks, and --help, -o and --quiet.
void prepare(CLI::App& app);

/// "project" of the App "viewproj project".
std::string commandName(const CLI::App& app);

/// A row of help.
std::string optionHelp(const CLI::Option* option);

/// Parses. Throws UsageError. adviceOn: what to add to the message about an argument that was not expected.
void parse(CLI::App& app, std::span<const std::string> arguments,
           const std::function<std::string(const std::string& argument)>& adviceOn);

/// Reads the value of an option. Throws UsageError.
using TakeText = std::function<void(const std::string& option, const std::string& text)>;

/// names: "-c,--camera", or of an operand "FILE". form: what help calls the value.
CLI::Option* addOption(CLI::App& app, const std::string& names, const std::string& form, TakeText take,
                       const std::string& help);
/// One that may be given several times, with one value each.
CLI::Option* addRepeatable(CLI::App& app, const std::string& names, const std::string& form, TakeText take,
                           const std::string& help);

/// One value, which read(option, text) makes of the text.
template <class T, class Read>
CLI::Option* addValue(CLI::App& app, const std::string& names, const std::string& form, T& value, Read read,
                      const std::string& help) {
  return addOption(
      app, names, form,
      [&value, read](const std::string& option, const std::string& text) { value = read(option, text); }, help);
}

/// As many as the option is given times.
template <class T, class Read>
CLI::Option* addValues(CLI::App& app, const std::string& names, const std::string& form, std::vector<T>& values,
                       Read read, const std::string& help) {
  return addRepeatable(
      app, names, form,
      [&values, read](const std::string& option, const std::string& text) { values.push_back(read(option, text)); },
      help);
}

/// One of the names. value: a T, whose first value is the default that help states, or an optional of one; otherwise:
/// what holds without the option.
template <class T, class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& names, const std::string& form, Value& value,
                       const Names<T>& table, const std::string& help, std::string_view otherwise = {}) {
  if constexpr (std::is_same_v<T, Value>)
    for (const auto& [name, each] : table)
      if (each == value) otherwise = name;
  return addValue(
      app, names, form, value,
      [table](const std::string& option, const std::string& text) { return choose(option, text, table); },
      withNames(help, known(table), otherwise));
}

/// Calls take with the row whose ending the file after -o has, where --to is not given.
void takeEnding(CLI::App& app, std::span<const FormRow<std::size_t>> rows, std::function<void(std::size_t form)> take);

/// --to FORM; without it the ending of the file after -o picks the form. chosen: as addChoice's value.
template <class T, class Chosen>
CLI::Option* addForm(CLI::App& app, Chosen& chosen, std::span<const FormRow<T>> rows, const std::string& help,
                     std::string_view otherwise = {}) {
  const Names<T> names = namesOf(rows);
  std::vector<FormRow<std::size_t>> endings;
  for (std::size_t i = 0; i < rows.size(); ++i) endings.push_back({rows[i].name, i, rows[i].endings});
  takeEnding(app, endings, [&chosen, names](std::size_t row) { chosen = names[row].second; });
  return addChoice(app, "--to", "FORM", chosen, names, help, otherwise);
}

/// The one form that a command writes: a file after -o that is called otherwise is refused.
void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings);

}  // namespace viewproj::cmd
