// -o FILE, and the form of the output, which its name tells where --to does not.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/values.hpp"
#include "output/named_output.hpp"
#include "text/form.hpp"

namespace viewproj::cmd {

class OutputOption {
 public:
  /// -o FILE, which every command has.
  void add(CLI::App& app);
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
void addForm(CLI::App& app, Chosen& chosen, std::span<const FormRow<T>> rows, const std::string& help,
             std::string_view otherwise = {}) {
  const Names<T> names = namesOf(rows);
  std::vector<std::pair<std::string_view, std::string_view>> endings;
  for (const FormRow<T>& row : rows) endings.emplace_back(row.name, row.endings);
  const CLI::Option* to = nullptr;
  if constexpr (std::is_same_v<Chosen, std::optional<T>>)
    to = addChoice(app, "--to", "FORM", chosen, names, help, otherwise);
  else
    to = addChoice(app, "--to", "FORM", chosen, names, help);
  app.parse_complete_callback([&app, &chosen, names, endings, to] {
    const CLI::Option* const output = app.get_option_no_throw("--output");
    if (!output || output->count() == 0 || to->count() > 0) return;
    if (const auto told = formOfOutputName(output->as<std::string>(), endings)) chosen = names[*told].second;
  });
}

/// Those of matrices.
std::vector<FormRow<std::string>> matrixForms();

/// The one form that a command writes.
void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings);

}  // namespace viewproj::cmd
