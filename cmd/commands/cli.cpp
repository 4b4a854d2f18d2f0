#include "commands/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// CLI11's own neither wraps a line nor leaves out what the descriptions say already.
class Help final : public CLI::Formatter {
 public:
  Help() {
    label("OPTIONS", "options");
    label("Positionals", "Arguments");
  }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string out = wrapped(app->get_description(), terminalWidth()) + "\n";
    out += app->get_subcommands({}).empty() ? make_usage(app, name) : "Usage: " + name + " COMMAND [options] [FILE]\n";
    out += make_positionals(app);
    for (const bool isShared : {false, true})
      for (const std::string& group : app->get_groups())
        if (namesTopic(group) == isShared)
          out += make_group(group, false, app->get_options([&group](const CLI::Option* option) {
            return option->get_group() == group && option->nonpositional();
          }));
    return out + make_subcommands(app, mode) + "\n" + make_footer(app);
  }

  std::string make_group(std::string group, bool isPositional, std::vector<const CLI::Option*> options) const override {
    if (options.empty()) return "";
    std::string out = "\n" + group + ":\n", names;
    for (const CLI::Option* option : options)
      if (namesTopic(group))
        names += option->get_name(false, true) + " ";
      else
        out += make_option(option, isPositional);
    return names.empty() ? out : out + "  " + wrapped(names, terminalWidth(), 2);
  }

  std::string make_option(const CLI::Option* option, bool isPositional) const override {
    constexpr std::size_t kColumn = 28;
    const std::string& form = option->get_option_text();
    const std::string name = "  " + make_option_name(option, isPositional) + (form.empty() ? "" : " " + form);
    return entry(name, std::min(kColumn, terminalWidth() * 3 / 8), option->get_description(), terminalWidth());
  }

  std::string make_subcommand(const CLI::App* command) const override {
    constexpr std::size_t kNames = 15;
    return entry("  " + command->get_name(), kNames, command->get_description(), terminalWidth());
  }

 private:
  static bool namesTopic(const std::string& group) { return group.find("(viewproj help ") != std::string::npos; }
};

/// Endings of the tool's own forms, and of a few others: a file that is called so is expected to be so.
constexpr std::string_view kKnownEndings =
    ".json .ndjson .jsonl .csv .tsv .txt .xyz .f64 .svg .c .h .glsl .hlsl .wgsl .css .py .png .jpg .jpeg .pdf "
    ".bin .npy .npz .parquet .xlsx .gz .bz2 .xz .zst .zip";

/// CLI11 would take the argument after "--prefix=" for its value, and an option for that of one without a value.
void requireValues(const CLI::App& app, std::span<const std::string> arguments) {
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& argument = arguments[i];
    const bool isLast = i + 1 == arguments.size();
    if (argument.empty() || (argument.starts_with("--") && argument.find('=') == argument.size() - 1))
      throw UsageError((!argument.empty() ? "the value of " + argument.substr(0, argument.size() - 1)
                        : i == 0          ? "the first argument"
                                          : "the argument after " + arguments[i - 1]) +
                       " is empty; is a variable of a script not set?");
    const CLI::Option* const option = argument.starts_with('-') ? app.get_option_no_throw(argument) : nullptr;
    if (!option || option->get_items_expected_max() == 0) continue;
    const std::string next = isLast ? "" : arguments[i + 1];
    if (isLast || next == "--" || (next.starts_with('-') && app.get_option_no_throw(next.substr(0, next.find('=')))))
      throw UsageError(argument + " needs a value: " + option->get_option_text() + (isLast ? "" : ", not " + next));
  }
}

}  // namespace

void prepare(CLI::App& app) {
  app.formatter(std::make_shared<Help>());
  app.allow_windows_style_options(false);  // a name of a file may begin with a slash
  app.option_defaults()->disable_flag_override();
  app.set_help_flag("-h,--help", "Print this help");
  app.add_option("-o,--output", "Write to FILE, which is replaced only on success; its extension picks the format")
      ->option_text("FILE");
  app.add_flag_callback("--quiet", silenceNotes, "Do not write notes on standard error");
}

std::string commandName(const CLI::App& app) { return app.get_name().substr(app.get_name().rfind(' ') + 1); }

std::string optionHelp(const CLI::Option* option) { return Help().make_option(option, false); }

void parse(CLI::App& app, std::span<const std::string> arguments,
           const std::function<std::string(const std::string& argument)>& adviceOn) {
  requireValues(app, arguments);
  std::string message;
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    return;
  } catch (const CLI::ExtrasError&) {
    const std::string argument = app.remaining().front();
    message = "'" + argument + "' was not expected" + adviceOn(argument);
  } catch (const CLI::ArgumentMismatch& e) {  // with values there can only be too many, or one of a flag
    message = e.what();
    const std::size_t colon = message.find(':');
    message = colon == std::string::npos ? "--" + message.substr(0, message.find(' ')) + " takes no value"
                                         : message.substr(0, colon) + " is given twice";
  } catch (const CLI::ParseError& e) {
    message = CLI::detail::find_and_replace(e.what(), " excludes ", " cannot be used with ");
    message = CLI::detail::find_and_replace(message, " requires ", " needs ");
  }
  throw UsageError(message);
}

CLI::Option* addOption(CLI::App& app, const std::string& names, const std::string& form, TakeText take,
                       const std::string& help) {
  const std::string longName = names.substr(names.rfind(',') + 1);
  const CLI::callback_t takeAll = [longName, take = std::move(take)](const CLI::results_t& texts) {
    for (const std::string& text : texts) take(longName, text);
    return true;
  };
  return app.add_option(names, takeAll, help)->option_text(form);
}

CLI::Option* addRepeatable(CLI::App& app, const std::string& names, const std::string& form, TakeText take,
                           const std::string& help) {
  return addOption(app, names, form, std::move(take), help + "; repeatable")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void takeEnding(CLI::App& app, std::span<const FormRow<std::size_t>> rows, std::function<void(std::size_t)> take) {
  const std::vector<FormRow<std::size_t>> forms(rows.begin(), rows.end());
  app.get_option("--output")->each([&app, forms, take = std::move(take)](const std::string& file) {
    const CLI::Option* const to = app.get_option_no_throw("--to");
    if (to && to->count() > 0) return;
    const std::string_view ending = endingOf(file);
    std::vector<std::string_view> names;
    for (const FormRow<std::size_t>& row : forms) {
      if (isEnding(ending, row.endings)) return take(row.form);
      names.push_back(row.name);
    }
    if (isEnding(ending, kKnownEndings))
      throw UsageError("-o " + file + ": this command does not write " + std::string(ending) +
                       (to ? "; --to chooses one of " : "; it writes ") + joined(names));
  });
}

void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings) {
  const FormRow<std::size_t> row{name, 0, endings};
  takeEnding(app, {&row, 1}, [](std::size_t) {});
}

}  // namespace viewproj::cmd
