#include "commands/values.hpp"

#include <algorithm>
#include <charconv>
#include <unordered_set>

#include "text/error.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {

std::string readFileName(const std::string&, const std::string& text) {
  for (const std::string_view name : {"/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"})
    if (text.starts_with(name) && (text.size() == name.size() || text[name.size()] == '#'))
      return "-" + text.substr(name.size());
  return text;
}

void failUnknown(const std::string& option, std::string_view name, std::span<const std::string_view> known) {
  throw UsageError(option + ": '" + std::string(name) + "' is not known" + suggestion(name, known));
}

std::string withNames(std::string_view help, std::span<const std::string_view> names, std::string_view otherwise) {
  const std::size_t end = std::min(help.find(';'), help.size());
  std::string text = std::string(help.substr(0, end)) + ": " + joined(names);
  if (!otherwise.empty()) text += " (default: " + std::string(otherwise) + ")";
  return text + std::string(help.substr(end));
}

std::vector<std::string> splitNames(const std::string& option, const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    names.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  std::unordered_set<std::string_view> seen;
  for (const std::string& name : names)
    if (!seen.insert(name).second) throw UsageError(option + ": " + name + " is named twice");
  return names;
}

std::function<std::size_t(const std::string&, const std::string&)> wholeNumber(std::size_t least, std::size_t most) {
  return [least, most](const std::string& option, const std::string& text) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (end != text.data() + text.size() || error != std::errc() || number < least || number > most)
      throw UsageError(option + " " + text + ": expected a whole number from " + std::to_string(least) + " to " +
                       std::to_string(most));
    return number;
  };
}

std::function<double(const std::string&, const std::string&)> numberThat(bool (*isGood)(double),
                                                                         const std::string& expected) {
  return [isGood, expected](const std::string& option, const std::string& text) {
    const auto number = parseNumber(text);
    if (!number || !isGood(*number)) throw UsageError(option + " " + text + ": expected " + expected);
    return *number;
  };
}

Size readSize(const std::string& option, const std::string& text) {
  const std::size_t x = std::min(text.find_first_of("xX"), text.size() - 1);
  const auto width = parseNumber(text.substr(0, x)), height = parseNumber(text.substr(x + 1));
  if (!width || !height || !(*width > 0 && *height > 0))
    throw UsageError(option + " " + text + ": expected WIDTHxHEIGHT, as in 1920x1080");
  return {*width, *height};
}

std::vector<double> readNumbers(const std::string& option, const std::string& text, std::size_t fewest,
                                std::size_t most, const std::string& form) {
  auto numbers = parseNumberList(text);
  if (!numbers || numbers->size() < fewest || numbers->size() > most)
    throw UsageError(option + " " + text + ": expected " + form);
  return std::move(*numbers);
}

Vec2 readPixelPosition(const std::string& option, const std::string& text) {
  const std::vector<double> n = readNumbers(option, text, 2, 2, "X,Y");
  return {n[0], n[1]};
}

std::vector<double> readPixelNumbers(const std::string& option, const std::string& text) {
  return readNumbers(option, text, 2, 3, "X,Y or X,Y,DEPTH");
}

}  // namespace viewproj::cmd
