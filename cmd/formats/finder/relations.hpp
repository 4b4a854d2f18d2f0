// How well parts go together, by their names and by where they stand.
#pragma once

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/finder/candidates.hpp"

namespace viewproj::cmd {

using Chosen = std::shared_ptr<const Candidate>;

bool isPoseKind(std::string_view kind);

/// The paths of parts that stand one after the other: "fx+fy".
std::string sumOf(const std::vector<Chosen>& terms);

/// Whether a text has one of these in it.
bool hasPart(std::string_view text, std::string_view parts);
bool shares(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// Of rotation_left_to_right, depth2color: the words before and after.
std::optional<std::pair<std::vector<std::string>, std::vector<std::string>>> towardOf(const Candidate& pose);

/// How well a part goes with the line's first; nothing: not at all.
std::optional<double> nearness(const Candidate& first, const Candidate& part);

struct Match {
  double score = 0;
  std::vector<Chosen> parts;
};

/// The best part of a kind, if it is good enough.
std::optional<Match> bestOf(const Candidate& first, const Candidates& all, std::string_view kind);

/// Scalars of one object, or of several: by their container.
using Scalars = std::map<std::string, Chosen, std::less<>>;
std::vector<Scalars> scalarsOf(const Candidates& all);

/// The scalars of these kinds, if all are there.
std::vector<Chosen> together(const Scalars& scalars, std::initializer_list<std::string_view> kinds);

/// Adds what nine, four or three scalars make together.
void addFamilies(const std::vector<Scalars>& boxes, Candidates& all);

/// Radial coefficients k of an object that is a lens, with the tangential p beside them.
void addCoefficients(Candidates& all);

}  // namespace viewproj::cmd
