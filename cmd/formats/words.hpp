// Names of members, taken apart, and numbers by their form: what the judge of unread members and the finder share.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/names.hpp"

namespace viewproj::cmd {

/// The words of a name, in lower case: cut at what is no letter or digit, at aB, and between letters and digits.
/// "cameraMatrix1" is camera, matrix, 1.
std::vector<std::string> wordsOf(std::string_view name);
/// In lower case.
std::string lowered(std::string_view text);
/// Whether one of the name's words is among words separated by blanks.
bool hasWord(std::string_view name, std::string_view words);

/// The order of a quaternion's numbers that its name states: "wxyz", "xyzw"; or empty.
std::string_view quaternionOrderOf(std::string_view name);

bool areZero(std::span<const double> numbers);
/// 6 numbers, two rows of a rotation, with the third behind them; others as they are.
std::vector<double> withThirdRow(std::vector<double> m);
/// 9 numbers by rows that are a rotation within 1e-3.
bool isRotation(const std::vector<double>& m);
/// 12 or 16 numbers by rows whose 3x3 is a rotation, with a last row of 0 0 0 1.
bool isRigid(const std::vector<double>& m);
/// 12 numbers, or 16 with a last row of 0 0 0 1, that are K [R | t] with focal lengths above `least` and no skew.
bool isProjection(const std::vector<double>& m, double least);
/// A K by rows: 3 rows of 3, or 3 or 4 rows of 4 with a fourth column of zeros.
bool isIntrinsic(const std::vector<double>& m);

/// Words of members that are statistics, boards, or of another picture.
inline constexpr std::string_view kNoise =
    "error errors err std stddev deviation deviations covariance cov uncertainty rms homography fundamental essential "
    "board square corner corners points map roi new optimal rect rectified rectification undistorted mean initial init "
    "gyro gyr acc accel noise bias time stamp timestamp color colour";

/// Patterns of members that no format reads and that say nothing about the picture.
inline constexpr std::string_view kSaysNothing =
    "T_imu_body timestamp* time date *_time version* description name id index serial* frame_id seq stamp "
    "sec nsec class_name comment* license $schema depth* *_id *_index *fps exposure* gain iso* *count num_* n_*";
/// Whether a name fits one of these patterns, separated by blanks.
bool fitsAny(std::string_view name, std::string_view patterns);

}  // namespace viewproj::cmd
