// An option's value, read as it was typed: before any file is opened, what is none has ended with a message.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace viewproj::cmd {

/// Of an option's value, after its name.
inline constexpr const char* kEmptyValue = " has an empty value; is a variable of a script not set?";

/// The options of a command, of which some wait until one of them is typed, or all are asked for: they are many, and
/// most command lines have none.
class CommandLine : public CLI::App {
 public:
  using CLI::App::App;

  /// knows: whether a name is of one of them.
  void later(bool (*knows)(std::string_view), std::function<void()> add) {
    waiting_.push_back({knows, std::move(add)});
  }
  /// Adds those that are waiting, if one of them is typed.
  void addTyped(std::span<const std::string_view> typed);
  void addAll();

 private:
  struct Waiting {
    bool (*knows)(std::string_view);
    std::function<void()> add;
  };
  std::vector<Waiting> waiting_;
};

/// While it lives, options that are added stand under this heading in the help. The same heading has the same options
/// in every command.
class Heading {
 public:
  Heading(CLI::App& app, const std::string& name);
  ~Heading();  // NOLINT(bugprone-exception-escape)
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;

 private:
  CLI::App& app_;
};

/// Takes the values of an option, one or more, none of them empty. Throws UsageError. option: its name.
using TakeValues = std::function<void(const std::string& option, const std::vector<std::string>& values)>;

enum class Times {
  once,   ///< given twice is an error
  often,  ///< one value an occurrence; never takes the argument after that value
};

/// form: the word for the value in the help. An empty value is an error.
CLI::Option* addOption(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
                       Times times, TakeValues take);

/// What machines are told of an option: the words that it takes, the one that holds without it, whether it may be given
/// again.
struct OptionFacts {
  std::vector<std::string_view> choices = {};
  std::string otherwise = {};
  bool severalChoices = false, repeatable = false;
  bool operator==(const OptionFacts&) const = default;
};

/// While it lives, the facts of options are kept as they are added.
class FactKeeper {
 public:
  FactKeeper() { current_ = this; }
  ~FactKeeper() { current_ = nullptr; }
  FactKeeper(const FactKeeper&) = delete;
  FactKeeper& operator=(const FactKeeper&) = delete;

  /// Of an option that was added while one lived, or none.
  static OptionFacts factsOf(const CLI::Option* option);
  /// The option, of which the facts that make() gives are kept if somebody keeps some.
  template <class Make>
  static CLI::Option* keep(CLI::Option* option, Make make) {
    if (current_) current_->facts_[option] = make();
    return option;
  }

 private:
  static FactKeeper* current_;
  std::unordered_map<const CLI::Option*, OptionFacts> facts_;
};

/// One value, which read(option, text) makes of the text. value: where it goes; an optional is empty where the option
/// is not given.
template <class T, class Read>
CLI::Option* addValue(CLI::App& app, const std::string& name, const std::string& form, T& value, Read read,
                      const std::string& help) {
  return addOption(app, name, form, help, Times::once,
                   [&value, read](const std::string& option, const std::vector<std::string>& given) {
                     value = read(option, given.front());
                   });
}

/// As many as the option is given times.
template <class T, class Read>
CLI::Option* addValues(CLI::App& app, const std::string& name, const std::string& form, std::vector<T>& values,
                       Read read, const std::string& help) {
  CLI::Option* const added =
      addOption(app, name, form, help + "; repeatable", Times::often,
                [&values, read](const std::string& option, const std::vector<std::string>& given) {
                  for (const std::string& text : given) values.push_back(read(option, text));
                });
  return FactKeeper::keep(added, [] { return OptionFacts{.repeatable = true}; });
}

/// The text itself.
std::string readText(const std::string& option, const std::string& text);

/// A file's name, perhaps with #PICK after it; the system's names of standard input are "-" too.
std::string readFileName(const std::string& option, const std::string& text);

// Choices

/// Names that are known, and what they stand for.
template <class T>
using Names = std::vector<std::pair<std::string_view, T>>;

/// A table of such rows.
template <class T, std::size_t N>
Names<T> rowsOf(const std::pair<std::string_view, T> (&table)[N]) {
  return {std::begin(table), std::end(table)};
}

/// Names that stand for themselves.
Names<std::string> namesAlone(std::span<const std::string_view> names);

/// Throws UsageError for a name that is not known, with the nearest that is.
[[noreturn]] void failUnknown(const std::string& option, std::string_view name,
                              std::span<const std::string_view> known);

template <class T>
std::vector<std::string_view> known(const Names<T>& names) {
  std::vector<std::string_view> result;
  for (const auto& [name, value] : names) result.push_back(name);
  return result;
}

template <class T>
T choose(const std::string& option, std::string_view name, const Names<T>& names) {
  for (const auto& [row, value] : names)
    if (row == name) return value;
  failUnknown(option, name, known(names));
}

/// "HELP: a, b, c (default: OTHERWISE)"; what help says after a semicolon comes last.
std::string withNames(const std::string& help, std::span<const std::string_view> names, std::string_view otherwise);

/// One of the names; what value is before is the default that the help tells.
template <class T>
CLI::Option* addChoice(CLI::App& app, const std::string& name, const std::string& form, T& value, const Names<T>& names,
                       const std::string& help) {
  std::string_view otherwise;
  for (const auto& [row, each] : names)
    if (each == value) otherwise = row;
  CLI::Option* const added = addValue(
      app, name, form, value,
      [names](const std::string& option, const std::string& text) { return choose(option, text, names); },
      withNames(help, known(names), otherwise));
  return FactKeeper::keep(added, [&] { return OptionFacts{known(names), std::string(otherwise)}; });
}

/// otherwise: what holds where the option is not given, for the help.
template <class T>
CLI::Option* addChoice(CLI::App& app, const std::string& name, const std::string& form, std::optional<T>& value,
                       const Names<T>& names, const std::string& help, std::string_view otherwise) {
  CLI::Option* const added = addValue(
      app, name, form, value,
      [names](const std::string& option, const std::string& text) { return choose(option, text, names); },
      withNames(help, known(names), otherwise));
  return FactKeeper::keep(added, [&] { return OptionFacts{known(names), std::string(otherwise)}; });
}

/// "a,b,c" to its parts. Throws UsageError for one that is named twice.
std::vector<std::string> splitNames(const std::string& option, const std::string& text);

/// Several of the names, "a,b,c".
template <class T>
CLI::Option* addChoices(CLI::App& app, const std::string& name, std::optional<std::vector<T>>& values,
                        const Names<T>& names, const std::string& help, std::string_view otherwise) {
  CLI::Option* const added = addValue(
      app, name, "NAMES", values,
      [names](const std::string& option, const std::string& text) {
        std::vector<T> chosen;
        for (const std::string& part : splitNames(option, text)) chosen.push_back(choose(option, part, names));
        return chosen;
      },
      withNames(help, known(names), otherwise));
  return FactKeeper::keep(added, [&] { return OptionFacts{known(names), std::string(otherwise), true}; });
}

// Numbers

/// Reads a whole number from least to most.
std::function<std::size_t(const std::string&, const std::string&)> wholeNumber(std::size_t least, std::size_t most);

/// Reads a number for which isGood holds. expected: what is told of any other.
std::function<double(const std::string&, const std::string&)> numberThat(bool (*isGood)(double),
                                                                         const std::string& expected);

/// Width and height, "1920x1080".
struct Size {
  double width = 0, height = 0;
};
Size readSize(const std::string& option, const std::string& text);

/// "1,2,3", from fewest to most numbers. form: what was expected, "X,Y or X,Y,DEPTH".
std::vector<double> readNumbers(const std::string& option, const std::string& text, std::size_t fewest,
                                std::size_t most, const std::string& form);

/// X,Y[,DEPTH].
std::vector<double> readPixelNumbers(const std::string& option, const std::string& text);

}  // namespace viewproj::cmd
