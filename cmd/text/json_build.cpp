#include "text/json_build.hpp"

#include <nlohmann/json.hpp>

#include "text/format_number.hpp"

namespace viewproj::cmd {
std::string jsonOf(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string jsonOf(double number) { return formatNumber(number); }

std::string jsonOf(bool flag) { return flag ? "true" : "false"; }

std::string jsonList(const std::vector<std::string>& items, std::string_view between) {
  std::string text = "[";
  for (const std::string& item : items) {
    text += text.size() > 1 ? between : between.substr(std::min(between.find('\n'), between.size()));
    text += item;
  }
  return text + "]";
}

JsonObject& JsonObject::addText(std::string_view name, std::string_view json, std::string_view between) {
  return addMembers(jsonOf(name) + ": " + std::string(json), between);
}

JsonObject& JsonObject::addMembers(std::string_view members, std::string_view between) {
  if (!members.empty() && !members_.empty()) members_ += between;
  members_ += members;
  return *this;
}

}  // namespace viewproj::cmd
