#include "commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "text/error.hpp"

namespace viewproj::cmd {

namespace {

/// Whether it is true of one of the names in "-c,--camera", asked one after the other.
template <class IsIt>
bool isAnyName(std::string_view names, const IsIt& isIt) {
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(','), names.size());
    const std::size_t begin = names[0] == '!' ? 1 : 0;
    if (isIt(names.substr(begin, end - begin))) return true;
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  return false;
}

}  // namespace

std::vector<std::string> Option::spelled() const {
  std::vector<std::string> all;
  isAnyName(names, [&](std::string_view one) { return all.emplace_back(one).empty(); });
  return all;
}

CommandLine::CommandLine(std::string name) : name_(std::move(name)) {
  addFlag("-h,--help", {}, "Print this help message and exit");
}

CommandLine::CommandLine(std::string name, std::span<const std::string_view> typed) : CommandLine(std::move(name)) {
  isWhole_ = false;  // help is there all the same
  for (const std::string_view argument : typed) {
    if (argument.starts_with("--"))
      typed_.push_back(argument.substr(0, argument.find('=')));
    else if (argument.starts_with('-'))
      letters_ += argument.substr(1);
  }
}

bool CommandLine::wants(std::string_view names) const {
  if (isWhole_ || !names.starts_with('-')) return true;
  return isAnyName(names, [&](std::string_view one) {
    return one.starts_with("--") ? std::find(typed_.begin(), typed_.end(), one) != typed_.end()
                                 : letters_.find(one[1]) != std::string::npos;
  });
}

void CommandLine::add(Option option, TakeValues take) {
  if (!wants(option.names)) return;
  option.heading = heading_;
  options_.push_back(std::move(option));
  takers_.push_back({std::move(take), {}});
}

void CommandLine::addFlag(std::string_view names, std::function<void(std::int64_t)> take, std::string_view help) {
  if (!wants(names)) return;
  options_.push_back({std::string(names), {}, std::string(help), Times::never, heading_});
  takers_.push_back({{}, std::move(take)});
}

const Option* CommandLine::find(std::string_view name) const {
  for (const Option& option : options_)
    if (option.names == name || isAnyName(option.names, [&](std::string_view one) { return one == name; }))
      return &option;
  return nullptr;
}

bool CommandLine::has(std::string_view name) const {
  const Option* const option = find(name);
  return option && option->isGiven;
}

std::optional<std::string> CommandLine::valueOf(std::string_view name) const {
  const Option* const option = find(name);
  if (!option || option->given.empty()) return std::nullopt;
  return option->given.front();
}

/// As they are typed: CLI11 would take the argument after "--prefix=" for its value, and "=cam.json" for that of
/// "-c=cam.json".
void CommandLine::requireValuesAfterEquals(std::span<const std::string_view> all) const {
  for (const std::string_view help : {"--help", "-h"})  // which goes first
    if (std::find(all.begin(), all.end(), help) != all.end()) return;
  for (const std::string_view argument : all) {
    if (argument == "--") return;
    const std::size_t equals = argument.find('=');
    if (!argument.starts_with('-') || equals == std::string_view::npos) continue;
    const std::string name(argument.substr(0, equals));
    const Option* const option = find(name);
    if (!option) continue;
    if (option->times == Times::never) throw UsageError(name + " takes no value");
    if (!name.starts_with("--"))
      throw UsageError(std::string(argument) + ": the value of " + name + " follows after a blank, without =");
    if (equals + 1 == argument.size()) throw UsageError(name + kEmptyValue);
  }
}

/// CLI11 would take an option after one for its value. Help goes first, unless it is what stands there.
void CommandLine::requireValues(std::span<const std::string_view> all) const {
  std::string fault;
  for (std::size_t i = 0; i < all.size() && all[i] != "--"; ++i) {
    const Option* const option = all[i].starts_with('-') ? find(all[i]) : nullptr;
    if (option == &options_.front()) return;  // help
    if (!option || option->times == Times::never) continue;
    if (fault.empty() && i + 1 == all.size()) fault = option->name() + " has no value; expected " + option->form;
    ++i;
    if (fault.empty() && i < all.size() && all[i].starts_with('-') && (find(all[i]) || all[i] == "--"))
      fault = option->name() + " has no value: after it comes " + std::string(all[i]);
  }
  if (!fault.empty()) throw UsageError(fault);
}

void CommandLine::parse(int argc, const char* const* argv) {
  const std::vector<std::string_view> all(argv + 1, argv + argc);
  requireValuesAfterEquals(all);
  requireValues(all);
  CLI::App app;
  app.allow_windows_style_options(false);  // a name of a file may begin with a slash
  for (std::size_t i = 0; i < options_.size(); ++i) {
    Option& option = options_[i];
    const Taker& taker = takers_[i];
    const auto takeValues = [&option, &taker](const CLI::results_t& values) {
      const std::string name = option.name();
      if (std::find(values.begin(), values.end(), "") != values.end()) throw UsageError(name + kEmptyValue);
      if (option.times == Times::once && values.size() > 1)
        throw UsageError(name + " is given twice: " + values[0] + " and " + values[1]);
      option.given = values;
      option.isGiven = true;
      taker.values(name, values);
      return true;
    };
    const auto takeFlag = [&option, &taker](std::int64_t sum) {
      option.isGiven = true;
      taker.flag(sum);
    };
    if (taker.flag) app.add_flag_function(option.names, takeFlag)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (taker.values)
      app.add_option(option.names, CLI::callback_t(takeValues))
          ->type_name(option.form)
          ->expected(1)
          ->allow_extra_args(false)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  try {
    app.parse(argc, argv);
    for (const std::function<void()>& check : checks_) check();
  } catch (const UsageError&) {  // of an option's value; help goes first
    if (app.get_help_ptr()->count() > 0) throw HelpAsked();
    throw;
  } catch (const CLI::CallForHelp&) {
    throw HelpAsked();
  } catch (const CLI::ExtrasError&) {
    throw NotExpected{app.remaining().front()};
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
}

}  // namespace viewproj::cmd
