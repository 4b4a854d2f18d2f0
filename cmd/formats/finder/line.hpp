// A line of parts as it grows: a lens first, or a pose where there is none.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/finder/relations.hpp"

namespace viewproj::cmd {

struct LineDraft {
  std::vector<std::pair<std::string, std::string>> parts;
  double score = 0;
  std::vector<std::string> ask;  ///< what a person has to decide
  Chosen first;
  std::vector<Chosen> used;
  std::vector<Match> poses{};  ///< that go with it, the best first
  bool isNerf = false, isUnreal = false;
  bool isOfPair = false;  ///< its pose stands beside several lenses

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
/// The place and the turns of a camera in Unreal or CARLA, whose angle of view is that across.
void putUnreal(LineDraft& line, const Candidates& all);
/// One pose beside two lenses of one template is the last one's, or that of B in A_to_B.
void sharePoses(std::vector<LineDraft>& lines);

}  // namespace viewproj::cmd
