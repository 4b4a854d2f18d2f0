#include "man/roff.hpp"

#include <sstream>

namespace viewproj::cmd::roff {
namespace {

constexpr std::size_t kWidth = 78;

/// A dot or a quote at the start of a line would be a request.
std::string line(std::string_view text) {
  const bool isRequest = text.starts_with('.') || text.starts_with('\'');
  return (isRequest ? "\\&" : "") + escaped(text);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (char c : text) switch (c) {
      case '\\':
        out += "\\e";
        break;
      case '-':
        out += "\\-";
        break;
      case '\'':
        out += "\\(aq";
        break;
      case '`':
        out += "\\(ga";
        break;
      case '^':
        out += "\\(ha";
        break;
      case '~':
        out += "\\(ti";
        break;
      default:
        out += c;
    }
  return out;
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string filled(const std::string& text) {
  std::string out, current, word;
  const auto flush = [&] {
    if (!current.empty()) out += line(current) + "\n";
    current.clear();
  };
  for (std::istringstream words(text); words >> word;) {
    if (escaped(current + " " + word).size() > kWidth) flush();
    current += (current.empty() ? "" : " ") + word;
  }
  flush();
  return out;
}

std::string verbatim(const std::string& text) {
  std::string out = ".PP\n.nf\n.RS 4\n", each;
  for (std::istringstream lines(text); std::getline(lines, each);) out += line(each) + "\n";
  return out + ".RE\n.fi\n";
}

}  // namespace viewproj::cmd::roff
