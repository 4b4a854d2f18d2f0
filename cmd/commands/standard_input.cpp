#include "commands/standard_input.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "camera/fields.hpp"
#include "commands/cli.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// What stands in for the FILE of a command. Of a camera also the options of its fields.
struct Reader {
  std::string_view command;
  std::initializer_list<std::string_view> instead;
  bool isCamera = false;
};

const Reader kReaders[] = {
    {"project", {"--point"}},
    {"measure", {"--point"}},
    {"ray", {"--pixel"}},
    {"cull", {"--point", "--sphere", "--box"}},
    {"check", {"--point"}},
    {"draw", {"--point", "--pixel", "--scene"}},
    {"fit", {"--point", "--scene"}},
    {"matrix", {"--camera", "--orthographic"}, true},
    {"info", {"--camera", "--orthographic"}, true},
    {"depth", {"--camera", "--orthographic"}, true},
    {"inspect", {}},
};

const Reader* readerOf(const CLI::App& app) {
  const auto reader = std::find_if(std::begin(kReaders), std::end(kReaders),
                                   [&](const Reader& one) { return one.command == commandName(app); });
  return reader == std::end(kReaders) ? nullptr : reader;
}

/// Nothing where the option is not given.
std::optional<std::string> fileOf(const CLI::App& app, const std::string& name) {
  const CLI::Option* const option = app.get_option_no_throw(name);
  if (!option || option->count() == 0) return std::nullopt;
  return readFileName(name, option->results().front());
}

}  // namespace

std::optional<std::string> inputFile(const CLI::App& app) {
  if (auto file = fileOf(app, "FILE")) return file;
  const Reader* const reader = readerOf(app);
  if (!reader) return std::nullopt;
  const auto isGiven = [&](std::string_view name) { return fileOf(app, std::string(name)).has_value(); };
  const auto isGivenField = [&](const Field& field) { return !field.option.empty() && isGiven(field.option); };
  if (std::any_of(reader->instead.begin(), reader->instead.end(), isGiven) ||
      (reader->isCamera && std::any_of(std::begin(kFields), std::end(kFields), isGivenField)))
    return std::nullopt;
  return "-";
}

void requireOneStandardInput(const CLI::App& app) {
  const Reader* const reader = readerOf(app);
  std::string first;
  const auto add = [&](const std::optional<std::string>& file, const std::string& what) {
    if (!file || (*file != "-" && !file->starts_with("-#"))) return;
    if (!first.empty()) throw UsageError(first + " and " + what + " cannot both come from standard input");
    first = what;
  };
  add(fileOf(app, "--camera"), "the camera");
  if (reader && reader->isCamera) add(inputFile(app), "the camera");
  add(fileOf(app, "--model"), "the model");
  add(fileOf(app, "--scene"), "the scene");
  if (reader && !reader->isCamera) add(inputFile(app), "the records");
}

}  // namespace viewproj::cmd
