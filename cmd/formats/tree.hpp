// The tree of a file that holds a camera: what JSON, YAML, XML, numpy's arrays, a table or text with keys say, as one
// kind of value.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "camera/document.hpp"

namespace viewproj::cmd {

/// What is taken of a file that no format reads.
struct ReadingTree {
  bool mayBeFaulty = false;   ///< of what is no JSON, YAML or XML, the text with keys
  bool mayBeRefused = false;  ///< of a known program that is not read
};

/// Reads a file, "-" for standard input, or the JSON itself if source begins with a bracket. option: the name for
/// inline JSON in messages. Throws InputError; files of programs that are known and not read are refused with what to
/// do.
Document readTree(const std::string& source, const std::string& option, ReadingTree taken = {});

/// Adds the members of the file beside it to a file called intri…, or extri…: the same name with the other word.
void addOtherFile(const Document& file);

/// The beginning of a binary glTF is read as its JSON. Throws InputError, also for more than `most` bytes.
std::string readWithoutGlb(const std::string& name, std::size_t most);

/// Words before numbers are their name, and blocks without a name are #1, #2 …; a block ends at a blank line or at
/// other words. "[heading]" opens an object. The second block of a name goes into the list "name#". An object without
/// members if there are no numbers. Where names come again, words alone above lines with names open objects too;
/// where all do, the text is a list of objects.
/// hasHeadings: set to true where several have no colon, so that the text is no YAML.
Json textTree(std::string_view text, bool* hasHeadings = nullptr);

/// What exiftool prints of pictures with a place, a tag and its value a line: an array of objects. Null for other text.
Json tagTree(std::string_view text);

/// A header of four names or more, then lines with as many cells: an array of objects. Null for other text.
Json tableTree(std::string_view text);

/// Why a file of this name, which another program wrote, is not read, and what to do; or null.
const char* refusalOf(std::string_view name, std::string_view text);

}  // namespace viewproj::cmd
