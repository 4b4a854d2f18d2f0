#include "commands/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "commands/notes.hpp"
#include "text/error.hpp"
#include "text/form.hpp"
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
    std::string out = "\n" + group + ":\n";
    if (namesTopic(group)) {
      std::string names;
      for (const CLI::Option* option : options) names += option->get_name(false, true) + " ";
      return out + "  " + wrapped(names, terminalWidth(), 2);
    }
    for (const CLI::Option* option : options) out += make_option(option, isPositional);
    return out;
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

std::string longName(const std::string& names) { return names.substr(names.rfind(',') + 1); }

/// Endings of the tool's own forms, and of a few others: a file that is called so is expected to be so.
constexpr std::string_view kTelling =
    ".json .ndjson .jsonl .csv .tsv .txt .xyz .f64 .svg .c .h .glsl .hlsl .wgsl .css .py .png .jpg .jpeg .pdf "
    ".bin .npy .npz .parquet .xlsx .gz .bz2 .xz .zst .zip";

/// CLI11 would take the argument after "--prefix=" for its value, and an option for that of one without a value.
void requireValues(const CLI::App& app, std::span<const std::string> arguments) {
  constexpr const char* kEmpty = " is empty; is a variable of a script not set?";
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& argument = arguments[i];
    if (argument.empty())
      throw UsageError(i == 0 ? "the argument" + std::string(kEmpty)
                              : "the argument after " + arguments[i - 1] + kEmpty);
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    const CLI::Option* const option = name.starts_with('-') ? app.get_option_no_throw(name) : nullptr;
    if (!option) continue;
    if (option->get_items_expected_max() == 0) {
      if (equals != std::string::npos) throw UsageError(name + " takes no value");
      continue;
    }
    if (equals != std::string::npos) {
      if (equals + 1 == argument.size()) throw UsageError("the value of " + name + kEmpty);
      if (!name.starts_with("--")) throw UsageError(argument + ": after " + name + " the value follows without =");
      continue;
    }
    if (++i == arguments.size()) throw UsageError(name + " needs a value: " + option->get_option_text());
    const std::string& value = arguments[i];
    if (value.empty()) throw UsageError("the value of " + name + kEmpty);
    if (value == "--" || (value.starts_with('-') && app.get_option_no_throw(value.substr(0, value.find('=')))))
      throw UsageError(name + " needs a value: " + option->get_option_text() + ", not " + value);
  }
}

/// Which of the forms with these endings the file's name tells; nothing where it tells none. Throws UsageError where it
/// tells one that is not among them.
std::optional<std::size_t> formOfOutputName(const std::string& file,
                                            const std::vector<std::pair<std::string_view, std::string_view>>& forms) {
  const std::string_view ending = endingOf(file);
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (isEnding(ending, forms[i].second)) return i;
  if (!isEnding(ending, kTelling)) return std::nullopt;
  std::vector<std::string_view> names;
  for (const auto& [name, endings] : forms) names.push_back(name);
  throw UsageError("-o " + file + ": this command does not write " + std::string(ending) +
                   (names.size() > 1 ? "; --to chooses one of " : "; it writes ") + joined(names));
}

}  // namespace

void prepare(CLI::App& app) {
  app.formatter(std::make_shared<Help>());
  app.allow_windows_style_options(false);  // a name of a file may begin with a slash
  app.set_help_flag("-h,--help", "Print this help");
  app.add_option("-o,--output", "Write to FILE, only if all goes well; its extension picks the format")
      ->option_text("FILE");
  app.add_flag_callback("--quiet", silenceNotes, "Do not write notes on standard error");
}

std::string optionHelp(const CLI::Option* option) { return Help().make_option(option, false); }

bool asksForHelp(std::span<const std::string> arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return std::any_of(arguments.begin(), end,
                     [](const std::string& argument) { return argument == "--help" || argument == "-h"; });
}

void parse(CLI::App& app, std::span<const std::string> arguments,
           const std::function<std::string(const std::string& argument)>& adviceOn) {
  requireValues(app, arguments);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ExtrasError&) {
    const std::string argument = app.remaining().front();
    throw UsageError("'" + argument + "' was not expected" + adviceOn(argument));
  } catch (const CLI::ArgumentMismatch& e) {  // with values there can only be too many
    throw UsageError(std::string(e.what()).substr(0, std::string(e.what()).find(':')) + " is given twice");
  } catch (const CLI::ExcludesError& e) {
    std::string message = e.what();
    throw UsageError(CLI::detail::find_and_replace(message, " excludes ", " cannot be used with "));
  } catch (const CLI::RequiresError& e) {
    std::string message = e.what();
    throw UsageError(CLI::detail::find_and_replace(message, " requires ", " needs "));
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
}

CLI::Option* addOption(CLI::App& app, const std::string& names, const std::string& form, TakeText take,
                       const std::string& help) {
  return app
      .add_option(names,
                  CLI::callback_t([option = longName(names), take = std::move(take)](const CLI::results_t& texts) {
                    for (const std::string& text : texts) take(option, text);
                    return true;
                  }),
                  help)
      ->option_text(form);
}

CLI::Option* addRepeatable(CLI::App& app, const std::string& names, const std::string& form, TakeText take,
                           const std::string& help) {
  return addOption(app, names, form, std::move(take), help + "; repeatable")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void takeEnding(CLI::App& app, const std::vector<std::pair<std::string_view, std::string_view>>& endings,
                std::function<void(std::size_t)> take) {
  app.get_option("--output")->each([&app, endings, take = std::move(take)](const std::string& file) {
    const CLI::Option* const to = app.get_option_no_throw("--to");
    if (to && to->count() > 0) return;
    if (const auto which = formOfOutputName(file, endings)) take(*which);
  });
}

void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings) {
  takeEnding(app, {{name, endings}}, [](std::size_t) {});
}

}  // namespace viewproj::cmd
