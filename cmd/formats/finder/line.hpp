// A line of parts as it grows, a lens first, or a pose where there is none; and how well parts go together, by their
// names and by where they stand.
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

struct LineDraft {
  std::vector<std::pair<std::string, std::string>> parts;
  double score = 0;
  std::vector<std::string> ask;  ///< what a person has to decide
  Chosen first;
  std::vector<Chosen> used;
  std::vector<Match> poses{};      ///< that go with it, the best first
  std::vector<std::string> set{};  ///< for --set
  std::string pose{};              ///< the paths of its pose
  bool isOfPair = false;           ///< its pose stands beside several lenses
  bool isEitherWay = false;        ///< its worldFromCamera may be cameraFromWorld
  std::string turnOfNoOrder = {};  ///< see ProposedLine

  void add(const std::string& name, const std::vector<Chosen>& chosen, double value, const std::string& suffix = "") {
    parts.emplace_back(name, sumOf(chosen) + suffix);
    score += value;
    used.insert(used.end(), chosen.begin(), chosen.end());
  }
};

/// The lines that begin with a lens.
std::vector<LineDraft> lensLines(const Candidates& all, const std::vector<Scalars>& boxes);
void putSize(LineDraft& line, const Candidates& all, const std::vector<Scalars>& boxes);
void putLens(LineDraft& line, const Candidates& all, const std::vector<Scalars>& boxes, bool isFisheye);
/// What may be wrong with a lens that begins with these coefficients.
void askAboutLens(LineDraft& line, const Candidate& lens, const Candidates& all, std::string_view text);

/// A matrix, or a turn and a place of the same tag.
std::vector<Match> posesFor(const Candidate& first, const Candidates& all);
void putPose(LineDraft& line, const Match& match, const Candidate* lens);
/// A place, and what is looked at from there.
void putAim(LineDraft& line, const Candidate& first, const Candidates& all);
/// The place and the angles of a camera without another pose; the angle of view of Unreal and CARLA is that across.
void putAngles(LineDraft& line, const Candidates& all, bool isUnreal);
/// One pose beside two lenses of one template is the last one's, or that of B in A_to_B.
void sharePoses(std::vector<LineDraft>& lines);

}  // namespace viewproj::cmd
