// JSON records that are alike but for their numbers, strings and flags: read without taking them apart.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "input/layout.hpp"

namespace viewproj::cmd {

/// What such records have in common: every byte outside of numbers, of strings that are no names, and of true and
/// false. So they have one shape and one layout, and are valid JSON where these parts are.
class RecordPattern {
 public:
  /// Of no records.
  RecordPattern() = default;
  /// Of those like this one, which has this layout; of none where its numbers are more than read, as a place's are, or
  /// where it is longer than a few pages.
  RecordPattern(const RecordParts& record, const Layout& layout);

  /// Where a record of the pattern ends that text begins with, and its numbers as readNumbers reads them; 0 where it
  /// begins with none, or with one whose strings have escapes as \u0041.
  std::size_t read(std::string_view text, Numbers& numbers) const;

 private:
  enum class Kind : char { number, string, flag };
  static constexpr std::size_t kNoSlot = kMostNumbers;

  /// Some bytes that are the same in all, and what differs after them.
  struct Piece {
    std::size_t size;
    Kind kind;
    std::size_t slot;  ///< of a number
  };

  std::string common_;  ///< the bytes of all pieces, and those after the last one
  std::vector<Piece> pieces_;
  std::array<double, kMostNumbers> absent_{};  ///< NaN in the slots of values that such records do not have
};

}  // namespace viewproj::cmd
