// Nothing is half read: what a format has not read of a file, and holds numbers.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>

#include "camera/camera_set.hpp"

namespace viewproj::cmd {

/// Judges what is left of a file after cameras of it were read.
class Unread {
 public:
  /// known: members that say nothing about the picture, separated by blanks; "*" is any text.
  Unread(const Document& file, const Import& result, std::string_view known);

  /// Throws InputError for what looks like the camera's pose or lens. Returns what else has three numbers or more, by
  /// path; empty if nothing has.
  std::string judge(std::size_t which);

 private:
  struct Left {
    Node node;
    std::vector<double> numbers;
    std::string name;
    bool isBesideRead;  ///< a member beside one that was read
  };
  struct Lists {
    std::vector<Left> left;
    std::vector<std::vector<double>> read;
  };

  void walk(const Node& node, std::string_view name, std::size_t depth, bool isBesideRead, Lists& lists) const;
  bool isKnown(std::string_view name) const;
  void judge(const Left& left, const Lists& lists, std::string& names) const;

  const Document& file_;
  std::string_view known_;
  std::function<std::optional<Node>(std::size_t)> own_;
  std::unordered_set<const void*> apart_;
  std::optional<Lists> shared_;  ///< of what belongs to no camera alone
};

}  // namespace viewproj::cmd
