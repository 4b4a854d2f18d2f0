// Recognises JSON records that differ only in their numbers and unread fields, without splitting them into fields.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "records/layout.hpp"

namespace viewproj::cmd {

/// What similar records have in common: all bytes except the numbers, strings and flags of the fields that a layout
/// uses, the values of other fields, which may be any JSON, and the white space around these. So such records have the
/// same shape and layout, and are records wherever they are.
class RecordPattern {
 public:
  /// Matches no records.
  RecordPattern() = default;
  /// Matches records like this one, with this layout and the numbers and texts of readNumbers. Matches none if the
  /// numbers need more than reading (as those of a place), if the text is a record only in some places, or if the
  /// pattern would be too large.
  RecordPattern(const RecordParts& record, const Layout& layout, const Numbers& numbers, const NumberTexts& texts);

  /// If text begins with a matching record, reads its numbers as readNumbers does and returns its size. Otherwise, or
  /// if it nests deeply, returns 0.
  std::size_t read(std::string_view text, Numbers& numbers) const;

  /// Whether it matches no records.
  bool isEmpty() const { return common_.empty(); }

 private:
  enum class Kind : char { number, string, flag, any };
  static constexpr std::size_t kNoSlot = kMostNumbers;

  /// Some common bytes, and the kind of value after them.
  struct Piece {
    std::size_t size;
    Kind kind;
    std::size_t slot;  ///< slot of a number
  };

  std::string common_;  ///< the bytes of all pieces, and those after the last piece
  std::vector<Piece> pieces_;
  std::array<double, kMostNumbers> absent_{};  ///< NaN in the slots of values that the records do not have
};

}  // namespace viewproj::cmd
