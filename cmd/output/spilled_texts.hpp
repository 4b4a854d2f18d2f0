// Texts that wait to be written, in memory while they are few, in a temporary file when they are many.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <string>

namespace viewproj::cmd {

class SpilledTexts {
 public:
  bool empty() const { return recent_.empty() && !file_; }
  /// Throws InputError where the file cannot be written.
  void add(const std::string& text);
  /// Each in turn; none is left.
  void replay(const std::function<void(const std::string&)>& take);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string recent_;  ///< each after its length
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace viewproj::cmd
