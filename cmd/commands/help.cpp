// viewproj help: the tool, a command, or a topic.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/fields.hpp"
#include "commands/check/words.hpp"
#include "commands/cli.hpp"
#include "commands/command.hpp"
#include "formats/open.hpp"
#include "formats/writer.hpp"
#include "output/matrix_text.hpp"
#include "output/output_file.hpp"
#include "output/report.hpp"
#include "output/table.hpp"
#include "text/error.hpp"
#include "text/form.hpp"
#include "text/layout.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// A page of data/help, whose first line is its summary. A line that begins with @ is a list that is printed from a
/// table, an indented one is printed as it is.
struct Topic {
  std::string_view name, text;

  std::string_view summary() const { return text.substr(0, text.find('\n')); }
};
constexpr Topic kTopics[] = {
#include <help_topics.inc>
};

std::string row(const std::string& left, std::string_view text, std::size_t column) {
  return entry("  " + left, std::min(column, terminalWidth() * 3 / 8), text, terminalWidth());
}

/// Fields with their options. Neighbours of the same help share a row; a long list of words is left to the page.
template <class IsListed>
std::string fieldRows(const IsListed& isListed) {
  constexpr std::size_t kColumn = 28, kMostWords = 40, kMostNames = 76;
  std::string out, names, options;
  const Field* previous = nullptr;
  const auto flush = [&] {
    if (!previous) return;
    std::string text(previous->help);
    const std::string words = previous->words ? joined(previous->words()) : "";
    if (words.find(' ') != std::string::npos && words.size() <= kMostWords) text += " One of " + words + ".";
    if (!previous->alias.empty()) text += " [" + std::string(previous->alias) + "]";
    std::string left = names + options;
    for (std::size_t end; left.size() > kMostNames; left.erase(0, end + 2)) {
      end = left.rfind(", ", kMostNames);
      out += "  " + left.substr(0, end + 1) + "\n";
    }
    out += row(left, text, kColumn);
    names = options = "";
  };
  for (const Field& field : kFields) {
    // What may only be 0 says nothing, and text nothing of the picture.
    if (!isListed(field) || field.kind == Kind::zero || field.kind == Kind::text) continue;
    if (!previous || previous->help != field.help) flush();
    previous = &field;
    names += (names.empty() ? "" : ", ") + std::string(field.path.substr(field.path.find('.') + 1));
    if (!field.option.empty()) options += ", " + std::string(field.option);
  }
  flush();
  return out;
}

bool isFieldOption(const CLI::Option* option) {
  return std::any_of(std::begin(kFields), std::end(kFields), [&](const Field& field) {
    return !field.option.empty() && option->check_name(std::string(field.option));
  });
}

/// Options that commands list by name alone, as `project` has them, but those of fields.
std::string sharedOptions(const std::string& topic) {
  CLI::App app;
  prepare(app);
  const Action action = declareProject(app);
  std::string out;
  for (const CLI::Option* option : app.get_options())
    if (option->get_group().find("(viewproj help " + topic + ")") != std::string::npos && !isFieldOption(option))
      out += optionHelp(option);
  return out;
}

std::string presetTable() {
  TextRows rows(1, {""});
  for (const ConventionPreset& preset : conventionPresets()) {
    OrderedJson axes = asJson(preset.convention);
    axes["reverseZ"] = preset.convention.reverseZ ? "yes" : "no";
    axes["storage"] = nameOf(kStorageNames, preset.convention.storage).substr(0, 3);
    axes["up"] = preset.up.z != 0 ? "z" : preset.up.y < 0 ? "-y" : "y";
    axes["cameraAxes"] = nameOf(kCameraAxesNames, preset.cameraAxes);
    rows.push_back({std::string(preset.name)});
    for (const auto& [axis, word] : axes.items()) {
      if (rows.size() == 2) rows[0].push_back(axis);
      rows.back().push_back(word.get<std::string>());
    }
  }
  return aligned(rows, [](std::size_t column) { return column > 0; });
}

template <class Rows>
std::string formRows(const Rows& forms) {
  std::string out;
  for (const auto& form : forms)
    out += row(std::string(form.name),
               std::string(form.help) + (form.endings.empty() ? "" : " (" + std::string(form.endings) + ")"), 12);
  return out;
}

std::string mistakeRows() {
  constexpr std::size_t kColumn = 27;
  std::string out;
  for (const auto& [name, meaning] : mistakes::allMistakes()) {
    std::string text(meaning.substr(0, meaning.rfind(": {}")));
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{'))
      text.replace(open, text.find('}') - open + 1, "N");
    out += row(std::string(name), text, kColumn);
  }
  return out;
}

/// A list: "options camera".
std::string listOf(const std::string& list) {
  const std::string kind = list.substr(0, list.find(' ')), of = list.substr(std::min(kind.size() + 1, list.size()));
  const auto isUnder = [&](const Field& field) {
    return of.empty() ? field.path.find('.') == std::string_view::npos : field.path.starts_with(of);
  };
  if (kind == "fields") return fieldRows(isUnder);
  if (kind == "options") return sharedOptions(of);
  if (kind == "presets") return presetTable();
  if (kind == "input") return formRows(inputForms());
  if (kind == "output") return formRows(outputForms());
  if (kind == "matrices") return formRows(matrixForms());
  if (kind == "mistakes") return mistakeRows();
  if (kind == "importers") {
    std::string out;
    for (const FormatName& format : formatNames()) out += (out.empty() ? "" : ", ") + std::string(format.form);
    return wrapped(out + ".", terminalWidth());
  }
  if (kind == "writers") {
    std::string out = "viewproj convert writes (--to): camera";
    for (const Writer& writer : writers())
      out += ", " + std::string(writer.name) + (writer.endings.empty() ? "" : " (" + std::string(writer.endings) + ")");
    return wrapped(out + "; observations of a calibration.", terminalWidth());
  }
  // Fields of a type of projection, or of several whose first it is.
  const std::uint8_t type = of == "all" ? 0 : valueOf(kTypeNames, of);
  return fieldRows([type](const Field& field) {
    if (field.types == kAllTypes) return type == 0;
    return type != 0 && (field.types & -field.types) == type;
  });
}

std::string pageOf(const Topic& topic) {
  std::string out, paragraph;
  const auto flush = [&] {
    if (!paragraph.empty()) out += wrapped(paragraph, terminalWidth());
    paragraph = "";
  };
  std::string_view rest = topic.text;
  for (bool isFirst = true; !rest.empty(); isFirst = false) {
    const std::string line(rest.substr(0, rest.find('\n')));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (isFirst) {
      out += std::string(topic.name) + ": " + line + "\n\n";
    } else if (line.empty() || line[0] == ' ' || line[0] == '@') {
      flush();
      out += line.starts_with('@') ? listOf(line.substr(1)) : line + "\n";
    } else {
      paragraph += (paragraph.empty() ? "" : " ") + line;
    }
  }
  flush();
  return out;
}

}  // namespace

std::string overview() {
  constexpr std::size_t kColumn = 15;
  std::string out =
      "World points to screen coordinates, pixels to picking rays, cameras to matrices.\n\n"
      "Usage: viewproj COMMAND [options] [FILE]\n";
  std::string_view task;
  for (const Command& command : allCommands()) {
    if (command.task != task) out += "\n" + std::string(task = command.task) + ":\n";
    out += row(std::string(command.name), command.summary, kColumn);
  }
  out += "\nTopics (viewproj help TOPIC):\n";
  for (const Topic& topic : kTopics) out += row(std::string(topic.name), topic.summary(), kColumn);
  return out +
         "\nviewproj COMMAND --help lists the options of a command; viewproj --version\nprints the version.\n\n"
         "Exit status: 0 success; 1 an input was wrong, or an output could not be\n"
         "written; 2 the command line was wrong.\n";
}

namespace {

std::string helpOn(const std::string& name) {
  std::vector<std::string_view> known;
  for (const Command& command : allCommands()) {
    if (command.name == name) return helpOf(command);
    known.push_back(command.name);
  }
  for (const Topic& topic : kTopics) {
    if (topic.name == name) return pageOf(topic);
    known.push_back(topic.name);
  }
  throw UsageError("'" + name + "' is no command and no topic" + suggestion(name, known, "help"));
}

}  // namespace

Action declareHelp(CLI::App& app) {
  std::vector<std::string_view> names;
  for (const Topic& topic : kTopics) names.push_back(topic.name);
  app.description("Help on a command, with its options, or on a topic: " + joined(names) + ".");
  app.footer("Examples:\n  viewproj help camera\n  viewproj help project");
  const auto name = std::make_shared<std::optional<std::string>>();
  app.add_option("NAME", *name, "A command or a topic (default: list them)");
  addOnlyForm(app, "text", ".txt .md");
  return [name] {
    writeOutput(*name ? helpOn(**name) : overview());
    return 0;
  };
}

}  // namespace viewproj::cmd
