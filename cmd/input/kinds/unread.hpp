// Files that are known and not read: rows of unread.json say what they begin with, and what to copy from them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::cmd {

/// Throws InputError for a file that is one of them, with what to do. text: all of it or its first part.
void refuseUnread(const std::string& name, std::string_view text);
/// The same of a JSON document, by its keys.
void refuseUnreadKeys(const std::string& name, const nlohmann::json& root);

/// "a Unity scene", each once.
std::vector<std::string> unreadForms();

/// The rows' text.
std::string unreadText();

}  // namespace viewproj::cmd
