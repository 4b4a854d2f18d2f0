#include "output/spilled_texts.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include "text/error.hpp"
#include "text/system.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kInMemory = 1 << 20;

[[noreturn]] void fail() { throw InputError("a temporary file: " + std::generic_category().message(errno)); }

}  // namespace

void SpilledTexts::add(const std::string& text) {
  const std::size_t size = text.size();
  recent_.append(reinterpret_cast<const char*>(&size), sizeof size);
  recent_ += text;
  if (recent_.size() < kInMemory) return;
  if (!file_) file_.reset(openTemporary());
  if (!file_ || std::fwrite(recent_.data(), 1, recent_.size(), file_.get()) != recent_.size()) fail();
  recent_.clear();
}

void SpilledTexts::replay(const std::function<void(const std::string&)>& take) {
  std::size_t size = 0;
  if (file_) {
    std::string text;
    std::rewind(file_.get());
    while (std::fread(&size, sizeof size, 1, file_.get()) == 1) {
      text.resize(size);
      if (std::fread(text.data(), 1, size, file_.get()) != size) fail();
      take(text);
    }
    if (std::ferror(file_.get())) fail();
    file_.reset();
  }
  for (std::size_t at = 0; at < recent_.size(); at += sizeof size + size) {
    std::memcpy(&size, recent_.data() + at, sizeof size);
    take(recent_.substr(at + sizeof size, size));
  }
  recent_.clear();
}

}  // namespace viewproj::cmd
