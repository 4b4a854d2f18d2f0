// -o FILE, and the form of the output, which its name tells where --to does not.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/values.hpp"
#include "output/output_file.hpp"
#include "text/form.hpp"

namespace viewproj::cmd {

inline constexpr std::string_view kOutputOption = "-o,--output", kFormOption = "--to";

class OutputOption {
 public:
  /// -o FILE, which every command has.
  void add(CommandLine& line);
  /// From here on, what the command writes goes there. Throws InputError.
  void open();
  /// The command has written all that it was to write.
  void keep();

 private:
  std::optional<std::string> file_;
  std::unique_ptr<NamedOutput> output_;
};

/// The names of forms, as addChoice() takes them.
template <class T>
Names<T> namesOf(std::span<const FormRow<T>> rows) {
  Names<T> names;
  for (const FormRow<T>& row : rows) names.emplace_back(row.name, row.form);
  return names;
}

/// Which of the forms with these endings the file's name tells; nothing where it tells none. Throws UsageError for an
/// ending of another command's forms, or of a picture.
std::optional<std::size_t> formOfOutputName(const std::string& file,
                                            const std::vector<std::pair<std::string_view, std::string_view>>& forms);

/// --to FORM. chosen: a form, or an optional of one, which keeps what it is where neither --to nor -o tells one.
template <class T, class Chosen>
void addForm(CommandLine& line, Chosen& chosen, std::span<const FormRow<T>> rows, const std::string& help,
             std::string_view otherwise = {}) {
  if (!line.wants(kFormOption) && !line.wants(kOutputOption)) return;
  const Names<T> names = namesOf(rows);
  std::vector<std::pair<std::string_view, std::string_view>> endings;
  for (const FormRow<T>& row : rows) endings.emplace_back(row.name, row.endings);
  if constexpr (std::is_same_v<Chosen, std::optional<T>>)
    addChoice(line, kFormOption, "FORM", chosen, names, help, otherwise);
  else
    addChoice(line, kFormOption, "FORM", chosen, names, help);
  line.afterwards([&line, &chosen, names, endings] {
    const auto file = line.valueOf(kOutputOption);
    if (!file || line.has(kFormOption)) return;
    if (const auto told = formOfOutputName(*file, endings)) chosen = names[*told].second;
  });
}

/// The one form that a command writes.
void addOnlyForm(CommandLine& line, std::string_view name, std::string_view endings);

}  // namespace viewproj::cmd
