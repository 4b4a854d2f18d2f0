#include "text/names.hpp"

#include <algorithm>

#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c; }

/// The number of edits (insert, delete, replace, swap neighbours) from a to b, ignoring case.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string_view withoutDashes(std::string_view name) {
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

std::string enumerated(std::span<const std::string_view> names, const char* last) {
  if (names.size() < 2) return joined(names);
  return joined(names.first(names.size() - 1)) + last + std::string(names.back());
}

}  // namespace

bool sameButForCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string lettersOf(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (isLetter(c) || isDigit(c)) letters += lower(c);
  return letters;
}

std::string_view nearestName(std::string_view name, std::span<const std::string_view> candidates) {
  constexpr std::size_t kLongest = 100;
  const std::string_view word = withoutDashes(name);
  std::string_view best;
  if (word.size() > kLongest) return best;
  // A name with a suffix, like d3d-lh or d3d11, means the candidate without it.
  for (const std::string_view candidate : candidates)
    if (candidate.size() > std::max<std::size_t>(best.size(), 2) && name.size() > candidate.size() &&
        sameButForCase(name.substr(0, candidate.size()), candidate) &&
        (name[candidate.size()] == '-' || isDigit(name[candidate.size()])))
      best = candidate;
  if (!best.empty() && std::find(candidates.begin(), candidates.end(), name) == candidates.end()) return best;
  std::size_t fewest = word.size() / 3 + 1;
  for (const std::string_view candidate : candidates) {
    const std::string_view other = withoutDashes(candidate);
    // A difference in length needs at least as many edits.
    if (other.size() >= word.size() + fewest || word.size() >= other.size() + fewest) continue;
    if (const std::size_t edits = editDistance(word, other); edits < fewest) {
      fewest = edits;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> candidates, std::string_view page) {
  constexpr std::size_t kMost = 8;
  std::string_view nearest = nearestName(name, candidates);
  std::vector<std::string_view> completions;  // preferred to nearest for a single letter, which is near any other
  for (const std::string_view candidate : candidates)
    if (sameButForCase(candidate.substr(0, name.size()), name)) completions.push_back(candidate);
  if (name.size() == 1 ? completions.size() == 1 : nearest.empty() && name.size() > 2 && !completions.empty())
    nearest = completions[0];
  if (!nearest.empty()) return "; did you mean '" + visible(nearest) + "'?";
  if (!page.empty() && candidates.size() > kMost) return "; viewproj " + std::string(page) + " lists them";
  return (candidates.size() == 1 ? "; known is " : "; known are ") + visible(joined(candidates));
}

std::string columnName(std::string_view name) {
  std::string column;
  for (const char c : name) {
    if (c != lower(c)) column += '_';
    column += lower(c);
  }
  return column;
}

std::string alternatives(const std::vector<std::string_view>& names) { return enumerated(names, " or "); }

std::string together(const std::vector<std::string_view>& names) { return enumerated(names, " and "); }

std::string joined(std::span<const std::string_view> names, std::string_view separator) {
  std::string text;
  for (std::string_view name : names) {
    if (!text.empty()) text += separator;
    text += name;
  }
  return text;
}

std::string joined(const std::vector<std::string>& names, std::string_view separator) {
  return joined(std::vector<std::string_view>(names.begin(), names.end()), separator);
}

std::vector<std::string_view> partsOf(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end;
  }
  return parts;
}

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

bool isAmong(std::string_view word, std::string_view words) {
  for (std::size_t at = words.find(word); at != std::string_view::npos && !word.empty();
       at = words.find(word, at + 1)) {
    const bool begins = at == 0 || words[at - 1] == ' ',
               ends = at + word.size() == words.size() || words[at + word.size()] == ' ';
    if (begins && ends) return true;
  }
  return false;
}

std::string inShell(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,:/=+";
  return word.find_first_not_of(kPlain) == std::string::npos ? word : "'" + word + "'";
}

std::string someOf(const std::vector<std::string>& names, std::size_t most) {
  if (names.size() <= most) return joined(names);
  return joined({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(most)}) + " and " +
         std::to_string(names.size() - most) + " more";
}

}  // namespace viewproj::cmd
