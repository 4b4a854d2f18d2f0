#include "commands/cli.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "camera/fields.hpp"
#include "output/output_file.hpp"
#include "text/error.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// CLI11's own neither wraps a line nor leaves out what the descriptions say already.
class Help final : public CLI::Formatter {
 public:
  Help() {
    label("OPTIONS", "options");
    label("Positionals", "Arguments");
  }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    std::string out = wrapped(app->get_description(), terminalWidth()) + "\n";
    out += make_usage(app, name) + make_positionals(app);
    for (const bool isShared : {false, true})
      for (const std::string& group : app->get_groups())
        if (namesTopic(group) == isShared)
          out += make_group(group, false, app->get_options([&group](const CLI::Option* option) {
            return option->get_group() == group && option->nonpositional();
          }));
    return out + "\n" + make_footer(app);
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

std::string unexpected(const std::string& argument,
                       const std::function<std::string(const std::string& argument)>& adviceOn) {
  return "'" + argument + "' was not expected" + adviceOn(argument);
}

/// The file of an option or operand; nothing where it is not given.
std::optional<std::string> fileOf(const CLI::App& app, std::string_view name) {
  const CLI::Option* const option = app.get_option_no_throw(std::string(name));
  if (!option || option->count() == 0) return std::nullopt;
  return readFileName("", option->results().front());
}

std::vector<double> readNumbers(const std::string& option, const std::string& text, std::size_t fewest,
                                std::size_t most, const std::string& form) {
  auto numbers = parseNumberList(text);
  if (!numbers || numbers->size() < fewest || numbers->size() > most)
    throw UsageError(option + " " + text + ": expected " + form);
  return std::move(*numbers);
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

void describe(CLI::App& app, const std::string& what, const std::string& examples) {
  app.description(what);
  app.footer(examples);
}

std::string optionHelp(const CLI::Option* option) { return Help().make_option(option, false); }

void parse(CLI::App& app, std::span<const std::string> arguments,
           const std::function<std::string(const std::string& argument)>& adviceOn) {
  requireValues(app, arguments);
  std::string message;
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    // Of a command that takes any number of files, all but the first remain.
    const std::vector<std::string> rest = app.remaining();
    const auto option = std::find_if(rest.begin(), rest.end(), [](const std::string& argument) {
      return argument.starts_with('-') && argument != "-" && argument != "--";
    });
    if (option == rest.end()) return;
    message = unexpected(*option, adviceOn);
  } catch (const CLI::ExtrasError&) {
    message = unexpected(app.remaining().front(), adviceOn);
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

bool hasOption(const CLI::App& app, const std::string& option) { return app.get_option_no_throw(option) != nullptr; }
bool isGiven(const CLI::App& app, const std::string& option) { return app.count(option) > 0; }

std::string outputFile(const CLI::App& app) {
  const CLI::Option* const file = app.get_option("--output");
  return file->empty() ? "-" : file->results().front();
}

bool fileIsCamera(const CLI::App& app) {
  const CLI::Option* const file = app.get_option_no_throw("FILE");
  return file && file->get_group() == kCameraGroup;
}

std::optional<std::string> inputFile(const CLI::App& app) {
  if (auto file = fileOf(app, "FILE")) return file;
  if (!app.get_option_no_throw("FILE")) return std::nullopt;
  const auto isGiven = [&](std::string_view name) { return !name.empty() && fileOf(app, name).has_value(); };
  bool hasInput = false;
  if (fileIsCamera(app)) {
    for (const char* const name : {"--camera", "--orthographic", "--world-from-camera", "--camera-from-world"})
      hasInput = hasInput || isGiven(name);
    for (const Field& field : kFields) hasInput = hasInput || isGiven(field.option);
  } else {
    for (const char* const name : {"--point", "--pixel", "--sphere", "--box"}) hasInput = hasInput || isGiven(name);
    // A ray hits the scene; draw and fit work on it.
    hasInput = hasInput || (isGiven("--scene") && !app.get_option_no_throw("--all-hits"));
  }
  return hasInput ? std::nullopt : std::optional<std::string>("-");
}

void requireOneStandardInput(const CLI::App& app) {
  std::string first;
  const auto add = [&](const std::optional<std::string>& file, const std::string& what) {
    if (!file || (*file != "-" && !file->starts_with("-#"))) return;
    if (!first.empty()) throw UsageError(first + " and " + what + " cannot both come from standard input");
    first = what;
  };
  const std::pair<const char*, const char*> kSeveral[] = {
      {"--camera", "the camera"}, {"--world-from-camera", "a pose"}, {"--camera-from-world", "a pose"}};
  for (const auto& [option, what] : kSeveral)
    if (const CLI::Option* const files = app.get_option_no_throw(option))
      for (const std::string& text : files->results()) add(readFileName("", text), what);
  if (fileIsCamera(app)) add(inputFile(app), "the camera");
  add(fileOf(app, "--model"), "the model");
  add(fileOf(app, "--scene"), "the scene");
  if (!fileIsCamera(app)) add(inputFile(app), "the records");
}

CLI::Option* addOption(CLI::App& app, const std::string& names, const std::string& form,
                       std::function<void(const std::string& option, const std::string& text)> take,
                       const std::string& help, bool isRepeatable) {
  const std::string longName = names.substr(names.rfind(',') + 1);
  const CLI::callback_t takeAll = [longName, take = std::move(take)](const CLI::results_t& texts) {
    for (const std::string& text : texts) take(longName, text);
    return true;
  };
  CLI::Option* const option = app.add_option(names, takeAll, help + (isRepeatable ? "; repeatable" : ""));
  if (isRepeatable) option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return option->option_text(form);
}

CLI::Option* addFlag(CLI::App& app, const std::string& names, bool& flag, const std::string& help) {
  return app.add_flag(names, flag, help);
}

CLI::Option* findOption(CLI::App& app, const std::string& name) { return app.get_option(name); }
void removeOption(CLI::App& app, const std::string& name) { app.remove_option(app.get_option(name)); }
void exclude(CLI::Option* one, CLI::Option* other) { one->excludes(other); }
void require(CLI::Option* one, CLI::Option* other) { one->needs(other); }

void refuse(CLI::Option* option, const std::string& value, const std::string& advice) {
  option->check([=](const std::string& text) -> std::string {
    if (text == value) throw UsageError(option->get_name() + " " + value + ": " + advice);
    return "";
  });
}

OptionGroup::OptionGroup(CLI::App& app, const char* group) : app_(app) { app.option_defaults()->group(group); }
// NOLINTNEXTLINE(bugprone-exception-escape): so short a name needs no memory
OptionGroup::~OptionGroup() { app_.option_defaults()->group("Options"); }

void takeEnding(CLI::App& app, std::vector<FormRow<std::size_t>> rows, std::function<void(std::size_t form)> take) {
  app.get_option("--output")->each([&app, rows = std::move(rows), take = std::move(take)](const std::string& file) {
    const CLI::Option* const to = app.get_option_no_throw("--to");
    if (to && to->count() > 0) return;
    const std::string_view ending = endingOf(file);
    const std::string_view last = file.ends_with('/') ? "/" : std::string_view(file).substr(file.rfind('/') + 1);
    std::vector<std::string_view> names;
    for (const FormRow<std::size_t>& row : rows) {
      if (isEnding(ending, row.endings) || isEnding(last, row.endings)) return take(row.form);
      names.push_back(row.name);
    }
    if (isEnding(ending, kKnownEndings))
      throw UsageError("-o " + file + ": this command does not write " + std::string(ending) +
                       (to ? "; --to chooses one of " : "; it writes ") + joined(names));
  });
}

void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings) {
  takeEnding(app, {{name, 0, endings}}, [](std::size_t) {});
}

std::string readFileName(const std::string&, const std::string& text) {
  for (const std::string_view name : {"/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"})
    if (text.starts_with(name) && (text.size() == name.size() || text[name.size()] == '#'))
      return "-" + text.substr(name.size());
  return text;
}

void failUnknown(const std::string& option, std::string_view name, std::span<const std::string_view> known) {
  throw UsageError(option + ": '" + std::string(name) + "' is not known" + suggestion(name, known));
}

std::string withNames(std::string_view help, std::span<const std::string_view> names, std::string_view otherwise) {
  const std::size_t end = std::min(help.find(';'), help.size());
  std::string text = std::string(help.substr(0, end)) + ": " + joined(names);
  if (!otherwise.empty()) text += " (default: " + std::string(otherwise) + ")";
  return text + std::string(help.substr(end));
}

std::vector<std::string> splitNames(const std::string& option, const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ",");
  std::vector<std::string> names(parts.begin(), parts.end());
  std::unordered_set<std::string_view> seen;
  for (const std::string& name : names)
    if (!seen.insert(name).second) throw UsageError(option + ": " + name + " is named twice");
  return names;
}

std::function<std::size_t(const std::string&, const std::string&)> wholeNumber(std::size_t least, std::size_t most) {
  return [least, most](const std::string& option, const std::string& text) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (end != text.data() + text.size() || error != std::errc() || number < least || number > most)
      throw UsageError(option + " " + text + ": expected a whole number from " + std::to_string(least) + " to " +
                       std::to_string(most));
    return number;
  };
}

std::function<double(const std::string&, const std::string&)> numberThat(bool (*isGood)(double),
                                                                         const std::string& expected) {
  return [isGood, expected](const std::string& option, const std::string& text) {
    const auto number = parseNumber(text);
    if (!number || !isGood(*number)) throw UsageError(option + " " + text + ": expected " + expected);
    return *number;
  };
}

Size readSize(const std::string& option, const std::string& text) {
  const std::size_t x = std::min(text.find_first_of("xX"), text.size() - 1);
  const auto width = parseNumber(text.substr(0, x)), height = parseNumber(text.substr(x + 1));
  if (!width || !height || !(*width > 0 && *height > 0))
    throw UsageError(option + " " + text +
                     ": expected WIDTHxHEIGHT, as in 1920x1080, or a part of a file's, as in 50%");
  return {*width, *height};
}

std::function<std::vector<double>(const std::string&, const std::string&)> numberList(const char* form) {
  return [form](const std::string& option, const std::string& text) {
    return readNumbers(option, text, 1, SIZE_MAX, form);
  };
}

Vec2 readPixelPosition(const std::string& option, const std::string& text) {
  const std::vector<double> n = readNumbers(option, text, 2, 2, "X,Y");
  return {n[0], n[1]};
}

std::vector<double> readPixelNumbers(const std::string& option, const std::string& text) {
  return readNumbers(option, text, 2, 3, "X,Y or X,Y,DEPTH");
}

CLI::Option* addModel(CLI::App& app, std::vector<std::string>& models, const std::string& help) {
  return addValues(app, "--model", "FILE", models, readFileName, help + "; a file, JSON or a pose, or a chain");
}

CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help) {
  return addValue(app, "--scene", "FILE", scene, readFileName, help + ": a scene file, or its JSON");
}

void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise) {
  addValue(app, "--digits", "N", digits, wholeNumber(1, kMostDigits),
           "Significant digits, 1 to " + std::to_string(kMostDigits) + " (default: " + otherwise + ")");
}

void addPrecision(CLI::App& app, Precision& precision) {
  static constexpr std::pair<std::string_view, Precision> kNames[] = {{"exact", Precision::exact},
                                                                      {"standard", Precision::standard}};
  addChoice(app, "--precision", "MODE", precision, rowsOf(kNames), "Arithmetic");
}

void ReportOptions::add(CLI::App& app, int tableDigits) {
  static constexpr FormRow<ReportForm> kForms[] = {
      {"table", ReportForm::table, ".txt"}, {"json", ReportForm::json, ".json"}, {"csv", ReportForm::csv, ".csv"}};
  addForm(app, form_, std::span<const FormRow<ReportForm>>(kForms), "Output format");
  addDigits(app, digits_, "all in JSON and CSV, " + std::to_string(tableDigits) + " in a table");
  tableDigits_ = tableDigits;
}

void ReportOptions::write(const OrderedJson& report, const char* rows) const {
  if (form_ == ReportForm::table)
    writeOutput(tableText(report, digits()));
  else if (form_ == ReportForm::json)
    writeOutput(jsonText(report, digits()) + "\n");
  else
    writeOutput(csvText(*rows ? report.at(rows) : report, digits()));
}

}  // namespace viewproj::cmd
