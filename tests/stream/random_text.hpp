// Records of a stream at random, good and bad, in every form and arrangement.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace viewproj::tests {

class RandomText {
 public:
  explicit RandomText(std::uint64_t seed) : engine_(seed) {}

  /// From 0 to below.
  std::size_t below(std::size_t end) { return engine_() % end; }
  bool oneIn(std::size_t n) { return below(n) == 0; }
  template <class T, std::size_t N>
  const T& oneOf(const T (&all)[N]) {
    return all[below(N)];
  }

  std::string number();
  /// A JSON value, none of a point's numbers.
  std::string value(int depth = 0);
  /// A good JSON record. pretty: may have line breaks in it.
  std::string record(bool pretty);
  /// JSON that is no record: of the wrong shape, or with a number or a name that is wrong.
  std::string badRecord();
  /// Bytes flipped, left out, put in, said twice; numbers, escapes and UTF-8 made odd. Returns which kind it was.
  std::string_view mutate(std::string& text);

  /// Whole inputs. bad: one record in so many is bad, none for 0.
  std::string json(std::size_t records, std::size_t bad);
  std::string csv(std::size_t records, std::size_t bad);
  std::string text(std::size_t records, std::size_t bad);
  std::string f64(std::size_t records, std::size_t bad);

 private:
  std::mt19937_64 engine_;
};

}  // namespace viewproj::tests
