// What a person asks about who has no file yet: a page each, from the tables that the readers go by.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace viewproj::cmd {

struct Topic {
  std::string_view name, summary;
  std::string (*page)(std::size_t width);
  /// Command lines that work beside samples/.
  std::array<std::string_view, 2> examples;
};

/// To add one: a row.
std::span<const Topic> topics();

/// The page of a topic, as wide as the terminal.
std::string helpText(const Topic& topic);

}  // namespace viewproj::cmd
