#include "text/file.hpp"

#include <cerrno>
#include <system_error>

#include "text/error.hpp"
#include "text/system.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// Tells the user that the program waits for typed input.
void announceKeyboardInput() {
  if (isTerminal(kStandardInput) && isTerminal(kStandardError))
    (void)writeSome(kStandardError, std::string("viewproj: reading from the keyboard; ") + kEndOfKeyboard + "\n");
}

}  // namespace

std::string shownName(const std::string& name) { return name == "-" ? "<stdin>" : visible(name); }

InputFile::InputFile(const std::string& name)
    : name_(shownName(name)), descriptor_(name == "-" ? kStandardInput : openToRead(name)) {
  if (descriptor_ < 0) throw InputError(name_ + ": " + std::generic_category().message(errno));
  if (descriptor_ == kStandardInput) announceKeyboardInput();
}

InputFile::~InputFile() {
  if (descriptor_ != kStandardInput) closeDescriptor(descriptor_);
}

std::size_t InputFile::read(char* to, std::size_t most) {
  const std::ptrdiff_t got = readSome(descriptor_, to, most);
  if (got < 0) throw InputError(name_ + ": " + std::generic_category().message(errno));
  return static_cast<std::size_t>(got);
}

bool InputFile::isReady(int milliseconds) const { return cmd::isReady(descriptor_, milliseconds); }

std::optional<std::size_t> InputFile::remaining() const { return bytesLeft(descriptor_); }

std::string readWholeFile(const std::string& name, std::size_t most) {
  constexpr std::size_t kBlock = 64 << 10;
  InputFile file(name);
  std::string text;
  for (std::size_t got = 1; got > 0;) {
    const std::size_t had = text.size();
    text.resize(had + kBlock);
    got = file.read(text.data() + had, kBlock);
    text.resize(had + got);
    if (text.size() > most)
      throw InputError(file.name() + ": longer than " + std::to_string(most >> 20) + " MiB, the most that is read");
  }
  return text;
}

}  // namespace viewproj::cmd
