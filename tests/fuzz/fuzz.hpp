// What all fuzz targets share: each is a function of the input's bytes that returns, or reports a finding and aborts.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace viewproj::fuzz {

struct Target {
  std::string_view name;
  void (*run)(std::string_view input);
};

/// One a reader. To add one: a function and a row in targets.cpp.
std::span<const Target> targets();
const Target* findTarget(std::string_view name);

/// Says what was found and aborts.
[[noreturn]] void found(const std::string& what);

/// Standard input and output become files in memory. Call once.
void takeOverStandardStreams();
/// Standard input, from its beginning.
void giveInput(std::string_view bytes);
/// What was written to standard output since the last call.
std::string takeOutput();

/// A finding unless text is values of JSON with white space in between: NaN and infinity are none, nor is 1e999.
void requireJson(std::string_view text, std::string_view what);

/// Takes a number from the input's last byte, where fuzzers expect choices.
unsigned takeChoice(std::string_view& input, unsigned count);

/// What a work does; words of the tool for what is wrong are its right, all else is a finding.
bool succeeds(void (*work)(std::string_view), std::string_view input);

}  // namespace viewproj::fuzz
