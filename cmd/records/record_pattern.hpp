// JSON records that are alike but for their numbers and the fields that are not read, without taking them apart.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "records/layout.hpp"

namespace viewproj::cmd {

/// What such records have in common: every byte outside of the numbers, strings and flags of the fields that a layout
/// is about, of the other fields, which may be any JSON, and of the white space around all these. So they have one
/// shape and one layout, and are records wherever they stand.
class RecordPattern {
 public:
  /// Of no records.
  RecordPattern() = default;
  /// Of records like this one, which has this layout, and these numbers where readNumbers found them; of none where
  /// its numbers are more than read, as a place's are, where it is a record in some places only, or where too much
  /// would have to be remembered.
  RecordPattern(const RecordParts& record, const Layout& layout, const Numbers& numbers, const NumberTexts& texts);

  /// The size of the record of the pattern that text begins with, and its numbers as readNumbers reads them; 0 where
  /// text begins with none, or with one that nests deeply.
  std::size_t read(std::string_view text, Numbers& numbers) const;

  /// No record is read.
  bool isEmpty() const { return common_.empty(); }

 private:
  enum class Kind : char { number, string, flag, any };
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
