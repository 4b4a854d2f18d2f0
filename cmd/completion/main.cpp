// Writes what makes a shell complete command lines, from what the commands say of their options.
//   viewproj_completion bash|zsh|fish
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "commands/help/command_help.hpp"
#include "commands/help/topics.hpp"
#include "text/names.hpp"

namespace {

using namespace viewproj::cmd;

/// A command, its options, and the words that its operand can be; none: a file.
struct Completed {
  const Command* command;
  std::vector<OptionHelp> options;
  std::vector<std::string> operands;
};

std::vector<Completed> completed() {
  std::vector<Completed> all;
  for (const Command& command : allCommands()) {
    const CommandHelp help = describe(command);
    Completed& one = all.emplace_back(Completed{&command, {}, {}});
    for (const OptionGroup& group : help.groups)
      one.options.insert(one.options.end(), group.options.begin(), group.options.end());
    for (const OptionHelp& argument : help.arguments)
      for (const std::string_view word : argument.facts.choices) one.operands.emplace_back(word);
  }
  for (Completed& one : all)
    if (one.command->name == "help") {
      for (const Command& command : allCommands()) one.operands.emplace_back(command.name);
      for (const Topic& topic : topics()) one.operands.emplace_back(topic.name);
    }
  return all;
}

std::vector<std::string> words(const std::vector<std::string_view>& names) { return {names.begin(), names.end()}; }

std::vector<std::string> commandNames() {
  std::vector<std::string> names;
  for (const Command& command : allCommands()) names.emplace_back(command.name);
  return names;
}

bool takesFile(const OptionHelp& option) { return option.value.starts_with("FILE"); }

/// Within single quotes of a shell.
std::string quotedOnce(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out;
}

/// The beginning of a help text: up to the first full stop, semicolon or bracket.
std::string_view firstOf(std::string_view text) { return text.substr(0, text.find_first_of(".;(:[")); }

std::string bash() {
  std::string out =
      "# Completion of viewproj for bash.\n"
      "_viewproj() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options= operands=\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '" +
      joined(commandNames(), " ") +
      " --help --version' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${COMP_WORDS[1]} in\n";
  for (const Completed& one : completed()) {
    std::vector<std::string> names;
    std::string values;
    for (const OptionHelp& option : one.options) {
      names.insert(names.end(), option.names.begin(), option.names.end());
      if (option.value.empty()) continue;
      values += "        " + joined(option.names, "|") + ") ";
      if (!option.facts.choices.empty())
        values += "COMPREPLY=($(compgen -W '" + joined(words(option.facts.choices), " ") + "' -- \"$word\")); return";
      else
        values += takesFile(option) ? "COMPREPLY=($(compgen -f -- \"$word\")); return" : "return";
      values += " ;;\n";
    }
    out += "    " + std::string(one.command->name) + ")\n      case $before in\n" + values +
           "      esac\n      options='" + joined(names, " ") + "'\n      operands='" + joined(one.operands, " ") +
           "' ;;\n";
  }
  return out +
         "  esac\n"
         "  case $word in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *)\n"
         "      if [ -n \"$operands\" ]; then COMPREPLY=($(compgen -W \"$operands\" -- \"$word\"))\n"
         "      else COMPREPLY=($(compgen -f -- \"$word\")); fi ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _viewproj viewproj\n";
}

/// What _arguments takes for a value.
std::string zshValue(const OptionHelp& option) {
  if (option.value.empty()) return "";
  if (!option.facts.choices.empty())
    return ":value:" + std::string(option.facts.severalChoices ? "_values -s , value " : "(") +
           joined(words(option.facts.choices), " ") + (option.facts.severalChoices ? "" : ")");
  return takesFile(option) ? ":file:_files" : ":value:";
}

std::string zsh() {
  std::string out =
      "#compdef viewproj\n# Completion of viewproj for zsh.\n_viewproj() {\n  if (( CURRENT == 2 )); then\n";
  out += "    local -a commands=(";
  for (const Command& command : allCommands())
    out += "'" + std::string(command.name) + ":" + quotedOnce(command.summary) + "' ";
  out +=
      ")\n    _describe command commands\n    return\n  fi\n  local command=$words[2]\n  shift words\n  (( CURRENT-- "
      "))\n  case $command in\n";
  for (const Completed& one : completed()) {
    out += "    " + std::string(one.command->name) + ") _arguments -s";
    for (const OptionHelp& option : one.options)
      for (const std::string& name : option.names)
        out += " \\\n      '" + std::string(option.facts.repeatable ? "*" : "") + name + "[" +
               quotedOnce(firstOf(option.text)) + "]" + quotedOnce(zshValue(option)) + "'";
    out +=
        " \\\n      '*:operand:" + (one.operands.empty() ? "_files" : "(" + joined(one.operands, " ") + ")") + "' ;;\n";
  }
  return out + "  esac\n}\n_viewproj \"$@\"\n";
}

std::string fish() {
  std::string out = "# Completion of viewproj for fish.\ncomplete -c viewproj -n __fish_use_subcommand -f\n";
  for (const Completed& one : completed()) {
    const std::string name(one.command->name);
    out +=
        "complete -c viewproj -n __fish_use_subcommand -a " + name + " -d '" + quotedOnce(one.command->summary) + "'\n";
    const std::string with = "complete -c viewproj -n '__fish_seen_subcommand_from " + name + "'";
    if (!one.operands.empty()) out += with + " -f -a '" + joined(one.operands, " ") + "'\n";
    for (const OptionHelp& option : one.options) {
      out += with;
      for (const std::string& typed : option.names)
        out += typed.starts_with("--") ? " -l " + typed.substr(2) : " -s " + typed.substr(1);
      if (!option.value.empty()) out += takesFile(option) ? " -r" : " -x";
      if (!option.facts.choices.empty()) out += " -a '" + joined(words(option.facts.choices), " ") + "'";
      out += " -d '" + quotedOnce(firstOf(option.text)) + "'\n";
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view shell = argc == 2 ? argv[1] : "";
  try {
    const std::string text = shell == "bash" ? bash() : shell == "zsh" ? zsh() : shell == "fish" ? fish() : "";
    if (text.empty()) {
      std::fprintf(stderr, "usage: viewproj_completion bash|zsh|fish\n");
      return 2;
    }
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "viewproj_completion: %s\n", e.what());
    return 1;
  }
}
