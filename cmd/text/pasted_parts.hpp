// The steps from a paste to its matrices: plain text, tokens, runs of numbers that no word parts, blocks of 9, 12, 16.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "text/number.hpp"
#include "text/pasted_matrices.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd::pasted {

inline constexpr std::size_t kNone = std::string_view::npos;

inline bool isAmong(char c, std::string_view set) { return set.find(c) != kNone; }
/// Every character beyond ASCII counts as a letter.
inline bool isNameStart(char c) { return isLetter(c) || c == '_' || static_cast<unsigned char>(c) >= 0x80; }
inline bool isNamePart(char c) { return isNameStart(c) || isDigit(c); }
inline bool isSpace(char c) { return isAmong(c, " \t\n\v\f"); }

std::string lower(std::string_view text);
bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words);

// ---- Plain text

/// Lines stay lines, and end with \n.
struct PlainText {
  std::string all;
  std::string live, comments;  ///< the text without its comments, and the comments alone; all else is blanks
};

/// One character for those that look alike, points for decimal commas, blanks for marks around numbers and for what a
/// log puts in front of each line.
PlainText plainText(std::string_view given);

/// The end of the number at `at`, which may have a sign and an exponent; kNone if there is none.
std::size_t numberEnd(std::string_view text, std::size_t at);

// ---- Tokens

enum class Kind : std::uint8_t {
  number,
  open,
  close,
  row,        ///< ; or \\ at the end of a row
  index,      ///< m00, [3], x: in front of an entry or a row
  callee,     ///< what touches a bracket: mat4(
  alias,      ///< r, s: a second name of the entry before, as in glm's unions
  repeat,     ///< <repeats 4 times>
  factor,     ///< 1.0e+03 *
  tableRule,  ///< |---|---|
  elided,     ///< ... where a row or an entry is left out
  key,        ///< any other name of what follows
  word        ///< anything else: it ends a run
};

struct Token {
  Kind kind;
  std::size_t line;
  std::string_view text = {}, label = {};  ///< label: ViewProj of ViewProj.row1
  double value = 0;
};

inline constexpr std::string_view kColumnsApart = "\n";  ///< the key of "Columns 1 through 3"

std::vector<Token> tokensOf(std::string_view text);

// ---- Runs

struct Bracket {
  std::size_t parent = 0;
  std::string_view callee = {}, key = {};
  bool isArguments = false;  ///< of a call that makes a matrix of other things
  bool lacks = false;        ///< an index in it has no number
  bool isClosed = false;
};

struct Number {
  double value;
  std::string_view text;
  std::size_t line, bracket, rowEnds;  ///< rowEnds: how many stand in front of it
  std::string_view label, key;
  std::size_t keyLine, indexDigits = 0, index = 0;
};

struct Run {
  std::vector<Number> numbers = {};
  double factor = 1;
  std::string_view refusal = {};  ///< why it is no matrix, if that is known
  bool isUnopened = false;        ///< it ends with a bracket that nothing opened
};

struct Runs {
  std::vector<Run> runs;
  std::vector<Bracket> brackets{Bracket{}};  ///< the first is none
};

Runs runsOf(const std::vector<Token>& tokens);

/// Whether a key tells nothing of what it names: data, values.
bool isGeneric(std::string_view key);

// ---- Blocks

struct Block {
  std::vector<const Number*> numbers;
  std::size_t rows, columns;
  bool isInMemoryOrder;
  std::size_t number = 0, beside = 1;  ///< which it is of so many side by side
};

struct Blocks {
  std::vector<Block> blocks;
  std::vector<PassedOver> passedOver;
};

/// The matrices of one run. emptyLines: how many there are in front of each line.
Blocks blocksOf(const Run& run, const std::vector<Bracket>& brackets, const std::vector<std::size_t>& emptyLines);

}  // namespace viewproj::cmd::pasted
