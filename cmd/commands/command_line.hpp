// A command as it declares itself: what it is about, its options, and the parsing of those that are typed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace viewproj::cmd {

/// Of an option's value, after its name.
inline constexpr const char* kEmptyValue = " has an empty value; is a variable of a script not set?";

/// Takes the place of all that a command does otherwise.
inline constexpr std::string_view kListOption = "--list", kCameraOption = "--camera";

/// Headings in the help: of the command's own options, of those that every command has, and the longest, which comes
/// last.
inline constexpr const char* kOwnOptions = "Options";
inline constexpr const char* kCameraHeading = "Camera";
inline constexpr const char* kEverywhere = "Output file and messages";
inline constexpr const char* kCameraFields = "The camera's fields, over a file's or without one";

enum class Times {
  never,  ///< a flag: no value
  once,   ///< given twice is an error
  often,  ///< one value an occurrence; never takes the argument after that value
};

/// Takes the values of an option, one or more, none of them empty. Throws UsageError. option: its name.
using TakeValues = std::function<void(const std::string& option, const std::vector<std::string>& values)>;

/// An option, or an operand, whose name has no dash.
struct Option {
  std::string names;  ///< "-c,--camera"; of a flag that is denied by another name "--good,!--no-good"
  std::string form;   ///< the word for the value in the help
  std::string help;
  Times times = Times::once;
  std::string heading = {};
  std::vector<std::string> given = {};  ///< the values, once parsed
  bool isGiven = false;

  bool isOperand() const { return !names.starts_with('-'); }
  /// "-c", "--camera".
  std::vector<std::string> spelled() const;
  /// By its long name, or that of an operand.
  std::string name() const { return spelled().back(); }
};

class CommandLine {
 public:
  /// name: "viewproj project".
  explicit CommandLine(std::string name);
  /// Leaves out the options that are not among what is typed: a command has many, and most command lines few of them.
  CommandLine(std::string name, std::span<const std::string_view> typed);

  void setDescription(std::string_view text) { description_ = text; }
  /// A command line that works beside samples/.
  void setExample(std::string_view text) { example_ = text; }
  const std::string& name() const { return name_; }
  const std::string& description() const { return description_; }
  const std::string& example() const { return example_; }

  /// Whether an option of these names is worth adding.
  bool wants(std::string_view names) const;
  void add(Option option, TakeValues take);
  /// sum: how often it is given, less how often it is denied.
  void addFlag(std::string_view names, std::function<void(std::int64_t sum)> take, std::string_view help);
  void addFlag(std::string_view names, bool& value, std::string_view help) {
    addFlag(
        names, [&value](std::int64_t) { value = true; }, help);
  }
  /// Called once all is parsed.
  void afterwards(std::function<void()> check) { checks_.push_back(std::move(check)); }

  const std::vector<Option>& options() const { return options_; }
  /// By one of its names or all of them, or null.
  const Option* find(std::string_view name) const;
  bool has(std::string_view name) const;
  /// The first value that it was given.
  std::optional<std::string> valueOf(std::string_view name) const;

  /// That help is asked for, which goes before all that is wrong.
  struct HelpAsked {};
  /// An argument that is none of the command's.
  struct NotExpected {
    std::string argument;
  };
  /// Throws UsageError, HelpAsked or NotExpected. argv[0] is the command's name.
  void parse(int argc, const char* const* argv);

 private:
  friend class Heading;
  void requireValuesAfterEquals(std::span<const std::string_view> all) const;
  void requireValues(std::span<const std::string_view> all) const;

  std::string name_, description_, example_, heading_ = kOwnOptions;
  bool isWhole_ = true;
  std::vector<std::string_view> typed_;  ///< long options
  std::string letters_;                  ///< of short ones
  struct Taker {
    TakeValues values;
    std::function<void(std::int64_t)> flag;
  };
  std::vector<Option> options_;
  std::vector<Taker> takers_;  ///< of each
  std::vector<std::function<void()>> checks_;
};

/// While it lives, options that are added stand under this heading in the help. The same heading has the same options
/// in every command.
class Heading {
 public:
  Heading(CommandLine& line, std::string_view name) : line_(line), outer_(std::exchange(line.heading_, name)) {}
  ~Heading() { line_.heading_ = std::move(outer_); }
  Heading(const Heading&) = delete;
  Heading& operator=(const Heading&) = delete;

 private:
  CommandLine& line_;
  std::string outer_;
};

}  // namespace viewproj::cmd
