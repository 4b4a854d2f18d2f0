// CLI11 as this tool uses it: the look of help, which command lines are refused, options that read their own values,
// and the options that several commands share beside those of the camera and of streams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "output/report.hpp"
#include "text/form.hpp"
#include "viewproj/screen.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace viewproj::cmd {

/// Groups of options that commands share. Help lists them by name alone; the topic in the heading describes them.
inline constexpr const char *kCameraGroup = "Camera (viewproj help camera)",
                            *kConventionGroup = "Convention (viewproj help conventions)",
                            *kStreamGroup = "Records (viewproj help points)";

/// Sets what every command has: the look of its help, and --help, -o and --quiet.
void prepare(CLI::App& app);

/// What help says first, and last: the examples.
void describe(CLI::App& app, const std::string& what, const std::string& examples);

/// A row of help.
std::string optionHelp(const CLI::Option* option);

/// Parses. Throws UsageError. adviceOn: what to add to the message about an argument that was not expected.
void parse(CLI::App& app, std::span<const std::string> arguments,
           const std::function<std::string(const std::string& argument)>& adviceOn);

// ---- Standard input: which command lines read it is decided here alone, by the options that are given

/// The FILE of a command: as typed; or "-", standard input, where it is absent and no option stands in for it; else
/// nothing. A terminal counts as any other input.
std::optional<std::string> inputFile(const CLI::App& app);

/// Whether the FILE of a command is its camera.
bool fileIsCamera(const CLI::App& app);

/// Throws UsageError where two inputs come from standard input.
void requireOneStandardInput(const CLI::App& app);

// ---- What a command has, and after parse() what is given

bool hasOption(const CLI::App& app, const std::string& option);
bool isGiven(const CLI::App& app, const std::string& option);
/// The file after -o; "-" without one.
std::string outputFile(const CLI::App& app);

// ---- Options. A reader makes a value of a text; it gets the option's name for its message, and throws UsageError.

/// names: "-c,--camera", or of an operand "FILE". form: what help calls the value.
CLI::Option* addOption(CLI::App& app, const std::string& names, const std::string& form,
                       std::function<void(const std::string& option, const std::string& text)> take,
                       const std::string& help, bool isRepeatable = false);

/// One value, which read(option, text) makes of the text.
template <class T, class Read>
CLI::Option* addValue(CLI::App& app, const std::string& names, const std::string& form, T& value, Read read,
                      const std::string& help) {
  return addOption(
      app, names, form,
      [&value, read](const std::string& option, const std::string& text) { value = read(option, text); }, help);
}

/// One value each time that the option is given.
template <class T, class Read>
CLI::Option* addValues(CLI::App& app, const std::string& names, const std::string& form, std::vector<T>& values,
                       Read read, const std::string& help) {
  return addOption(
      app, names, form,
      [&values, read](const std::string& option, const std::string& text) { values.push_back(read(option, text)); },
      help, true);
}

CLI::Option* addFlag(CLI::App& app, const std::string& names, bool& flag, const std::string& help);

CLI::Option* findOption(CLI::App& app, const std::string& name);
void removeOption(CLI::App& app, const std::string& name);
/// A command line has one of the two at most.
void exclude(CLI::Option* one, CLI::Option* other);
/// A command line with `one` has the other too.
void require(CLI::Option* one, CLI::Option* other);
/// Refuses a value of the option with this advice.
void refuse(CLI::Option* option, const std::string& value, const std::string& advice);

/// While it lives, options that are added belong to this group of help.
class OptionGroup {
 public:
  OptionGroup(CLI::App& app, const char* group);
  OptionGroup(const OptionGroup&) = delete;
  ~OptionGroup();  // NOLINT(bugprone-exception-escape)

 private:
  CLI::App& app_;
};

/// The text itself.
inline std::string readText(const std::string&, const std::string& text) { return text; }

/// A file's name, perhaps with #PICK after it; the system's names of standard input are "-" too.
std::string readFileName(const std::string& option, const std::string& text);

/// Reads a whole number from least to most.
std::function<std::size_t(const std::string&, const std::string&)> wholeNumber(std::size_t least, std::size_t most);

/// Reads a number for which isGood holds. expected: for the message about any other.
std::function<double(const std::string&, const std::string&)> numberThat(bool (*isGood)(double),
                                                                         const std::string& expected);

/// Width and height, "1920x1080".
struct Size {
  double width = 0, height = 0;
};
Size readSize(const std::string& option, const std::string& text);

/// Distances or depths, one or more: "1,10,100". form: for the message about anything else.
std::function<std::vector<double>(const std::string&, const std::string&)> numberList(const char* form);

/// X,Y.
Vec2 readPixelPosition(const std::string& option, const std::string& text);

/// X,Y[,DEPTH].
std::vector<double> readPixelNumbers(const std::string& option, const std::string& text);

// ---- Names that a value can be one of

/// Known names, and what they stand for.
template <class T>
using Names = std::vector<std::pair<std::string_view, T>>;

template <class T, std::size_t N>
Names<T> rowsOf(const std::pair<std::string_view, T> (&table)[N]) {
  return {std::begin(table), std::end(table)};
}
template <class T>
Names<T> namesOf(std::span<const FormRow<T>> rows) {
  Names<T> names;
  for (const FormRow<T>& row : rows) names.emplace_back(row.name, row.form);
  return names;
}
template <class T>
std::vector<std::string_view> known(const Names<T>& names) {
  std::vector<std::string_view> result;
  for (const auto& [name, value] : names) result.push_back(name);
  return result;
}

/// Throws UsageError with the nearest of the known names.
[[noreturn]] void failUnknown(const std::string& option, std::string_view name,
                              std::span<const std::string_view> known);

template <class T>
T choose(const std::string& option, std::string_view name, const Names<T>& names) {
  for (const auto& [row, value] : names)
    if (row == name) return value;
  failUnknown(option, name, known(names));
}

/// "a,b,c" to its parts. Throws UsageError for one that is named twice.
std::vector<std::string> splitNames(const std::string& option, const std::string& text);

/// The values that "a,b,c" names, or all where "all" is among them.
template <class T>
struct Several {
  bool all = false;
  std::vector<T> named;
};
template <class T>
Several<T> chooseSeveral(const std::string& option, const std::string& text, const Names<T>& names) {
  Several<T> several;
  for (const std::string& name : splitNames(option, text)) {
    if (name == "all") return {.all = true, .named = {}};
    several.named.push_back(choose(option, name, names));
  }
  return several;
}

/// "HELP: a, b, c (default: OTHERWISE)"; what help says after a semicolon comes last.
std::string withNames(std::string_view help, std::span<const std::string_view> names, std::string_view otherwise);

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

/// Calls take with the name of the row whose ending the file after -o has, where --to is not given.
void takeEnding(CLI::App& app, std::vector<FormRow<std::size_t>> rows, std::function<void(std::size_t form)> take);

/// --to FORM; without it the ending of the file after -o picks the form. chosen: as addChoice's value.
template <class T, class Chosen>
CLI::Option* addForm(CLI::App& app, Chosen& chosen, std::span<const FormRow<T>> rows, const std::string& help,
                     std::string_view otherwise = {}) {
  const Names<T> names = namesOf(rows);
  std::vector<FormRow<std::size_t>> endings;
  for (std::size_t i = 0; i < rows.size(); ++i) endings.push_back({rows[i].name, i, rows[i].endings});
  takeEnding(app, std::move(endings), [&chosen, names](std::size_t row) { chosen = names[row].second; });
  return addChoice(app, "--to", "FORM", chosen, names, help, otherwise);
}

/// The one form that a command writes: a file after -o with the ending of another is refused.
void addOnlyForm(CLI::App& app, std::string_view name, std::string_view endings);

// ---- Options that commands share

/// --model FILE, which readModel() reads; several in turn are a chain, base first.
CLI::Option* addModel(CLI::App& app, std::vector<std::string>& models, const std::string& help);
/// --scene FILE, which readScene() reads. help: what its shapes are for.
CLI::Option* addScene(CLI::App& app, std::optional<std::string>& scene, const std::string& help);
/// --digits N. otherwise: what holds where it is not given.
void addDigits(CLI::App& app, std::optional<std::size_t>& digits, const std::string& otherwise);
/// --precision MODE.
void addPrecision(CLI::App& app, Precision& precision);

/// The forms of a report.
enum class ReportForm : std::uint8_t { table, json, csv };

/// --to table, json or csv, and --digits.
class ReportOptions {
 public:
  /// tableDigits: significant ones for people; programs get all.
  void add(CLI::App& app, int tableDigits);
  ReportForm form() const { return form_; }
  int digits() const {
    return static_cast<int>(digits_.value_or(form_ == ReportForm::table ? static_cast<std::size_t>(tableDigits_) : 0));
  }
  /// rows: the member that CSV is of; empty: all of the report is one row.
  void write(const OrderedJson& report, const char* rows = "") const;

 private:
  ReportForm form_ = ReportForm::table;
  std::optional<std::size_t> digits_;
  int tableDigits_ = 0;
};

}  // namespace viewproj::cmd
