#pragma once

#include <string_view>

namespace viewproj::fuzz {

/// A camera file of any form, .glb too. Behind it, each after a NUL byte: #PICK, or a --set assignment.
void fuzzCamera(std::string_view input);
void fuzzScene(std::string_view input);
/// The model matrix of project and explain.
void fuzzModel(std::string_view input);
/// Text with matrices.
void fuzzMatrices(std::string_view input);

/// A stream of records in one form; its last two bytes choose what is done with it, and how.
void fuzzJsonRecords(std::string_view input);
void fuzzCsvRecords(std::string_view input);
void fuzzTextRecords(std::string_view input);
void fuzzF64Records(std::string_view input);

/// A command's name, its arguments and its standard input, a NUL byte between them.
void fuzzArguments(std::string_view input);

}  // namespace viewproj::fuzz
