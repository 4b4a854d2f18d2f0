// JSON Schemas from the tables of what is read and written.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace viewproj::cmd {

/// Of records that project, cull, draw, measure and ray read.
std::string pointsSchema();

/// Of what commands print: records with their results, and reports, whose definitions are given.
std::string resultsSchema(std::string_view reports);

/// Members of an object in JSON, in order: names, and values as text.
class JsonObject {
 public:
  JsonObject& add(std::string_view name, const std::string& value);
  /// A string.
  JsonObject& say(std::string_view name, std::string_view text);
  std::string text() const { return "{" + members_ + "}"; }
  /// For the top of a schema: each on lines of its own.
  std::string lines() const;

 private:
  std::string members_, lines_;
};

std::string jsonArray(const std::vector<std::string>& values);
std::string jsonWords(const std::vector<std::string_view>& words);

/// {"$ref": "#/$defs/NAME"}
std::string reference(std::string_view name);

/// {"type": "number"} from least to most, where these are finite.
std::string numberSchema(double least, double most);

/// An array of so many items.
std::string arraySchema(const std::string& items, std::size_t fewest, std::size_t most);

/// An object that has these fields.
std::string requiring(const std::vector<std::string_view>& names);

/// A value of a stream: a record, an array of them, or a document.
std::string documentSchema(std::string_view record);

}  // namespace viewproj::cmd
