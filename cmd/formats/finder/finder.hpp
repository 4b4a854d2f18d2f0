// Proposes --parts for a file that no format claims.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "camera/document.hpp"

namespace viewproj::cmd {

struct ProposedLine {
  std::string parts;                ///< for --parts
  std::vector<std::string> set;     ///< for --set
  std::vector<std::string> decide;  ///< what a person has to decide
  std::size_t cameras = 1;
  bool hasLens = true;
  std::string pose;                ///< the paths of its pose, separated by commas
  bool isEitherWay = false;        ///< its worldFromCamera may be cameraFromWorld
  std::string turnOfNoOrder = {};  ///< the quaternion of which no name tells whether w is first; or empty
};

/// The line of the other direction.
ProposedLine otherWay(ProposedLine line);

/// --parts and --set, as they are typed.
std::string optionsOf(const ProposedLine& line);

struct Proposal {
  std::vector<ProposedLine> lines;   ///< the likeliest first
  std::vector<std::string> leftOut;  ///< paths of what looks like a part and is in no line
  std::vector<std::string> numbers;  ///< if there is nothing else: paths with their numbers
  std::size_t ofCamera = 0;          ///< how many of them, the first, are called as a camera's
};

Proposal proposeParts(const Document& file);

/// Paths of a file's numbers that are none of these; without those that say nothing of the picture.
std::vector<std::string> pathsOfOthers(const Document& file, const std::set<double>& known);

/// At most fourteen lines of text.
std::string textOf(const Proposal& proposal);
/// {"parts": [{"line", "set", "decide", "cameras"}], "leftOut": [...]}
Json jsonOf(const Proposal& proposal);

}  // namespace viewproj::cmd
