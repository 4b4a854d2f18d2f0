#include "text/csv.hpp"

#include "text/error.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t npos = std::string_view::npos;

/// "a comma", "'|'".
std::string nameOf(char separator) {
  for (const SeparatorName& one : kSeparators)
    if (one.separator == separator) return "a " + std::string(one.name);
  return inQuotes(std::string_view(&separator, 1));
}

}  // namespace

std::string quotedIfNeeded(std::string_view cell, char separator) {
  const auto needs = [&](char c) { return c == '"' || c == '\r' || c == '\n' || c == separator; };
  if (std::none_of(cell.begin(), cell.end(), needs)) return std::string(cell);
  std::string quoted = "\"";
  for (const char c : cell) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csvValue(std::string_view field) {
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
  std::string value;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    if (field[i] == '"' && field[i + 1] == '"' && i + 2 < field.size()) ++i;
    value += field[i];
  }
  return value;
}

void splitCsvLine(std::string_view line, std::vector<std::string_view>& fields, char separator, std::size_t most) {
  for (std::size_t begin = 0;; ++begin) {
    std::size_t end = begin;
    if (end < line.size() && line[end] == '"') end = std::min(afterQuotes(line, end), line.size());
    while (end < line.size() && line[end] != separator) ++end;
    fields.push_back(line.substr(begin, end - begin));
    if (end == line.size() || fields.size() == most) return;
    begin = end;
  }
}

void requireWholeFields(std::string_view record, const std::vector<std::string_view>& fields, char separator) {
  for (const std::string_view field : fields) {
    const auto begin = static_cast<std::size_t>(field.data() - record.data());
    const bool isQuoted = field.starts_with('"');
    if (const std::size_t at = isQuoted ? npos : field.find('\r'); at != npos)
      throw RecordError(begin + at, kLoneReturn);
    if (const std::size_t after = isQuoted ? afterQuotes(field, 0) : npos; after < field.size())
      throw RecordError(begin + after,
                        "text after the closing quote; expected " + nameOf(separator) + " or the end of the line");
  }
}

std::size_t CsvEnds::lastEnd(std::string_view text) {
  while (at_ < text.size()) {
    const std::size_t quote = text.find('"', at_);
    if (quoted_) {
      at_ = std::min(quote, text.size());
      if (at_ + 1 >= text.size()) break;  // whether it closes, what follows tells
      quoted_ = text[quote + 1] == '"';
      at_ += quoted_ ? 2 : 1;
      continue;
    }
    const std::string_view plain = text.substr(0, quote).substr(at_);
    if (const std::size_t line = plain.rfind('\n'); line != npos) after_ = at_ + line + 1;
    at_ += plain.size();
    if (quote == npos) break;
    quoted_ = quote == after_ || text[quote - 1] == separator_;
    ++at_;
  }
  return after_;
}

}  // namespace viewproj::cmd
