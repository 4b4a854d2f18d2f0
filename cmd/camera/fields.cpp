#include "camera/fields.hpp"

#include <algorithm>

#include "text/names.hpp"

namespace viewproj::cmd {

namespace {

constexpr bool kindsAreInOrder() {
  for (std::size_t i = 0; i < std::size(kKinds); ++i)
    if (kKinds[i].kind != static_cast<Kind>(i)) return false;
  return true;
}
static_assert(kindsAreInOrder());

}  // namespace

std::string_view shortName(const Field& field) {
  return field.types != 0 ? field.path.substr(field.path.find('.') + 1) : field.path;
}

std::string_view topName(const Field& field) { return field.path.substr(0, field.path.find('.')); }

std::vector<std::string_view> namesUnder(std::string_view prefix) {
  std::vector<std::string_view> names;
  for (const Field& field : kFields) {
    std::string_view rest = field.path;
    if (!prefix.empty() && !(rest.starts_with(prefix) && rest.substr(prefix.size()).starts_with('.'))) continue;
    if (!prefix.empty()) rest.remove_prefix(prefix.size() + 1);
    const std::string_view name = rest.substr(0, rest.find('.'));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return names;
}

std::vector<std::string_view> wordsIn(std::string_view text) { return partsOf(text, " "); }

bool contradict(const Field& a, const Field& b) {
  return &a != &b && a.group == b.group && a.group != Group::none && (a.sets & b.sets) == 0;
}

std::string contradictionMessage(std::string_view first, std::string_view second, Group group) {
  return std::string(first) + " and " + std::string(second) +
         (group == Group::pose ? " both orient the camera; keep one" : " both say what the camera sees; keep one");
}

}  // namespace viewproj::cmd
