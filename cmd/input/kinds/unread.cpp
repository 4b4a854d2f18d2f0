#include "input/kinds/unread.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

using nlohmann::json;

/// So far into a file its words are looked for.
constexpr std::size_t kFirstLines = 4096;

const json& rows() {
  static const json kRows = json::parse(unreadText());
  return kRows;
}

template <class Fits>
bool any(const json& row, const char* word, Fits fits) {
  const auto texts = row.find(word);
  return texts != row.end() && std::any_of(texts->begin(), texts->end(),
                                           [&](const json& text) { return fits(text.get_ref<const std::string&>()); });
}

template <class Fits>
bool all(const json& row, const char* word, Fits fits) {
  const auto texts = row.find(word);
  return texts != row.end() && std::all_of(texts->begin(), texts->end(),
                                           [&](const json& text) { return fits(text.get_ref<const std::string&>()); });
}

[[noreturn]] void refuse(const std::string& name, const json& row) {
  throw InputError(name + ": is " + row["form"].get<std::string>() +
                   ", which is not read (viewproj help formats lists what is); what to copy from it: " +
                   row["copy"].get<std::string>());
}

}  // namespace

void refuseUnread(const std::string& name, std::string_view text) {
  const std::string_view file = std::string_view(name).substr(name.rfind('/') + 1);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with('{') || text.starts_with('[')) {
    const bool isGodot = text.starts_with("[gd_");
    if (!isGodot) return;  // JSON
  }
  // Windows' line ends count as one.
  std::string start(text.substr(0, kFirstLines));
  std::erase(start, '\r');
  for (const json& row : rows())
    if (any(row, "begins", [&](const std::string& word) { return start.starts_with(word); }) ||
        all(row, "holds", [&](const std::string& word) { return start.find(word) != std::string::npos; }) ||
        any(row, "named", [&](const std::string& word) { return file == word; }))
      refuse(name, row);
}

void refuseUnreadKeys(const std::string& name, const json& root) {
  for (const json& row : rows())
    if (all(row, "keys", [&](const std::string& key) { return root.contains(key); })) refuse(name, row);
}

std::vector<std::string> unreadForms() {
  std::vector<std::string> forms;
  for (const json& row : rows())
    if (const std::string form = row["form"]; std::find(forms.begin(), forms.end(), form) == forms.end())
      forms.push_back(form);
  return forms;
}

}  // namespace viewproj::cmd
