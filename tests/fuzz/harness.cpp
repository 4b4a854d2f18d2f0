#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "fuzz.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"

namespace viewproj::fuzz {
namespace {

int reports = STDERR_FILENO;  ///< standard error as it was: a run may have it closed for what commands write

void becomeMemory(int descriptor) {
  const int memory = ::memfd_create("viewproj", MFD_CLOEXEC);
  if (memory < 0 || ::dup2(memory, descriptor) < 0) std::abort();
  ::close(memory);
}

}  // namespace

void found(const std::string& what) {
  ::dprintf(reports, "FOUND: %s\n", what.c_str());
  std::abort();
}

void takeOverStandardStreams() {
  reports = ::dup(STDERR_FILENO);
  becomeMemory(STDIN_FILENO);
  becomeMemory(STDOUT_FILENO);
}

// Neither file is emptied: its pages stay.
void giveInput(std::string_view bytes) {
  if (::pwrite(STDIN_FILENO, bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()) ||
      ::ftruncate(STDIN_FILENO, static_cast<off_t>(bytes.size())) != 0 || ::lseek(STDIN_FILENO, 0, SEEK_SET) != 0)
    std::abort();
}

std::string takeOutput() {
  const off_t size = ::lseek(STDOUT_FILENO, 0, SEEK_CUR);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (::pread(STDOUT_FILENO, text.data(), text.size(), 0) != size || ::lseek(STDOUT_FILENO, 0, SEEK_SET) != 0)
    std::abort();
  return text;
}

void requireJson(std::string_view text, std::string_view what) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::size_t at = text.find_first_not_of(kSpace);
  while (at != std::string_view::npos) {
    const std::size_t end = cmd::endOfValue(text, at);
    const std::string_view value = text.substr(at, end - at);
    // To nlohmann-json a NUL is the end of the text.
    if (!nlohmann::json::accept(value.begin(), value.end()) || value.find('\0') != std::string_view::npos)
      found(std::string(what) + " writes what is no JSON: " + std::string(value));
    at = text.find_first_not_of(kSpace, end);
  }
}

unsigned takeChoice(std::string_view& input, unsigned count) {
  if (input.empty()) return 0;
  const unsigned byte = static_cast<unsigned char>(input.back());
  input.remove_suffix(1);
  return byte % count;
}

bool succeeds(void (*work)(std::string_view), std::string_view input) {
  try {
    work(input);
    return true;
  } catch (const cmd::InputError&) {
  } catch (const cmd::UsageError&) {
  } catch (const std::exception& e) {
    found(std::string("an exception without a place: ") + e.what());
  }
  return false;
}

}  // namespace viewproj::fuzz
