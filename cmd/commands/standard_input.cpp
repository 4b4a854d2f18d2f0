#include "commands/standard_input.hpp"

#include <algorithm>

#include "camera/fields.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

/// A command with a FILE, and what stands in for it. Of a camera also the options of its fields.
struct Reader {
  std::string_view command;
  std::initializer_list<std::string_view> instead;
  bool ofCamera = false;
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

}  // namespace

bool readsStandardInput(std::string_view command, const std::optional<std::string>& file,
                        const std::function<bool(std::string_view option)>& isGiven) {
  if (file) return isStandardInput(file);
  const auto reader =
      std::find_if(std::begin(kReaders), std::end(kReaders), [&](const Reader& one) { return one.command == command; });
  if (reader == std::end(kReaders)) return false;
  return std::none_of(reader->instead.begin(), reader->instead.end(), isGiven) &&
         !(reader->ofCamera && std::any_of(std::begin(kFields), std::end(kFields), [&](const Field& field) {
             return !field.option.empty() && isGiven(field.option);
           }));
}

void requireOneStandardInput(std::initializer_list<NamedInput> inputs) {
  const NamedInput* first = nullptr;
  for (const NamedInput& input : inputs) {
    if (!input.isStandard) continue;
    if (first)
      throw UsageError(std::string(first->what) + " and " + input.what + " cannot both come from standard input");
    first = &input;
  }
}

}  // namespace viewproj::cmd
