// Records of a stream at random, good and bad, in every form and arrangement.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "random.hpp"

namespace viewproj::tests {

class RandomText : public Random {
 public:
  using Random::Random;

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
};

}  // namespace viewproj::tests
