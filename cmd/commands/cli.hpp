// CLI11 as this tool uses it: the look of help, what of a command line is refused, and options with a reader of their
// own. Flags, --needs and whatever else CLI11 has, commands take from it directly.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/values.hpp"
#include "text/form.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace viewproj::cmd {

/// Groups of options that commands share. Help lists them by name alone, and the topic in the heading tells them.
inline constexpr const char *kCameraGroup = "Camera (viewproj help camera)",
                            *kConventionGroup = "Convention (viewproj help conventions)",
                            *kStreamGroup = "Records (viewproj help points)";

/// Every command's: how its help looks, and --help, -o and --quiet.
void prepare(CLI::App& app);

/// A row of help.
std::string optionHelp(const CLI::Option* option);

/// Whether --help or -h is among the arguments; it goes before whatever is wrong with the others.
bool asksForHelp(std::span<const std::string> arguments);

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

/// One of the names. otherwise: what holds where the option is not given, for the help.
template <class T, class Value>
CLI::Option* addChoice(CLI::App& app, const std::string& names, const std::string& form, Value& value,
                       const Names<T>& table, const std::string& help, std::string_view otherwise) {
  return addValue(
      app, names, form, value,
      [table](const std::string& option, const std::string& text) { return choose(option, text, table); },
      withNames(help, known(table), otherwise));
}

/// What value is before is the default that help tells.
template <class T>
CLI::Option* addChoice(CLI::App& app, const std::string& names, const std::string& form, T& value,
                       const Names<T>& table, const std::string& help) {
  std::string_view otherwise;
  for (const auto& [name, each] : table)
    if (each == value) otherwise = name;
  return addChoice(app, names, form, value, table, help, otherwise);
}

/// Several of the names, "a,b,c".
template <class T>
CLI::Option* addChoices(CLI::App& app, const std::string& names, std::optional<std::vector<T>>& values,
                        const Names<T>& table, const std::string& help, std::string_view otherwise) {
  return addValue(
      app, names, "NAMES", values,
      [table](const std::string& option, const std::string& text) {
        std::vector<T> chosen;
        for (const std::string& part : splitNames(option, text)) chosen.push_back(choose(option, part, table));
        return chosen;
      },
      withNames(help, known(table), otherwise));
}

/// Calls take with the ending of the file after -o, where --to (of these names) is not given.
void takeEnding(CLI::App& app, const std::vector<std::pair<std::string_view, std::string_view>>& endings,
                std::function<void(std::size_t which)> take);

/// --to FORM; without it the ending of the file after -o tells the form. chosen: a form, or an optional of one.
template <class T, class Chosen>
CLI::Option* addForm(CLI::App& app, Chosen& chosen, std::span<const FormRow<T>> rows, const std::string& help,
                     std::string_view otherwise = {}) {
  Names<T> names;
  std::vector<std::pair<std::string_view, std::string_view>> endings;
  for (const FormRow<T>& row : rows) {
    names.emplace_back(row.name, row.form);
    endings.emplace_back(row.name, row.endings);
  }
  takeEnding(app, endings, [&chosen, names](std::size_t which) { chosen = names[which].second; });
  if constexpr (std::is_same_v<Chosen, T>)
    return addChoice(app, "--to", "FORM", chosen, names, help);
  else
    return addChoice(app, "--to", "FORM", chosen, names, help, otherwise);
}

/// The one form that a command writes: a file after -o that is called otherwise is refused.
void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings);

}  // namespace viewproj::cmd
