// Text that grows at its end. Unlike std::string's, its appending is inlined: a stream consists of short pieces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

namespace viewproj::cmd {

class TextBuffer {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::string_view view() const { return {data_.get(), size_}; }
  char back() const { return data_[size_ - 1]; }

  void clear() { size_ = 0; }
  /// Removes everything after the first `size` bytes.
  void truncate(std::size_t size) { size_ = size; }

  TextBuffer& operator+=(char c) {
    *room(1) = c;
    ++size_;
    return *this;
  }
  TextBuffer& operator+=(std::string_view text) {
    if (text.empty()) return *this;  // its data may be null
    copy(room(text.size()), text.data(), text.size());
    size_ += text.size();
    return *this;
  }

  /// Returns room for up to `most` bytes. Call written() with the end of the bytes that were written.
  char* room(std::size_t most) {
    if (capacity_ - size_ < most) grow(most);
    return data_.get() + size_;
  }
  void written(const char* end) { size_ = static_cast<std::size_t>(end - data_.get()); }

 private:
  /// Like memcpy, but inlined for short texts: copies the first and the last bytes.
  static void copy(char* to, const char* from, std::size_t size) {
    if (size >= 8 && size <= 16) {
      copyEnds<std::uint64_t>(to, from, size);
    } else if (size >= 4 && size < 8) {
      copyEnds<std::uint32_t>(to, from, size);
    } else {
      std::memcpy(to, from, size);
    }
  }
  template <class Part>
  static void copyEnds(char* to, const char* from, std::size_t size) {
    Part first, last;
    std::memcpy(&first, from, sizeof(Part));
    std::memcpy(&last, from + size - sizeof(Part), sizeof(Part));
    std::memcpy(to, &first, sizeof(Part));
    std::memcpy(to + size - sizeof(Part), &last, sizeof(Part));
  }

  void grow(std::size_t more) {
    const std::size_t capacity = 2 * capacity_ + more + 1024;
    std::unique_ptr<char[]> data(new char[capacity]);  // not initialised
    if (size_ > 0) std::memcpy(data.get(), data_.get(), size_);
    data_ = std::move(data);
    capacity_ = capacity;
  }

  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace viewproj::cmd
