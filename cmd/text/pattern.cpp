#include "text/pattern.hpp"

namespace viewproj::cmd {

bool fitsPattern(std::string_view name, std::string_view pattern) {
  std::size_t at = 0, i = 0, star = std::string_view::npos, afterStar = 0;
  while (at < name.size()) {
    if (i < pattern.size() && pattern[i] == '*') {
      star = i++;
      afterStar = at;
    } else if (i < pattern.size() && pattern[i] == name[at]) {
      ++i;
      ++at;
    } else if (star != std::string_view::npos) {  // the last star takes one more
      i = star + 1;
      at = ++afterStar;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', i) == std::string_view::npos;
}

}  // namespace viewproj::cmd
