// The readings of matrices, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include "commands/inspect/calibration.hpp"
#include "commands/inspect/conversion.hpp"
#include "input/matrix_numbers.hpp"

namespace viewproj::cmd {

struct NumberedReading {
  std::size_t number;  ///< among all readings of the matrix, from 1 on
  MatrixCamera reading;
};

struct InspectedMatrix {
  WrittenMatrix written;
  std::vector<NumberedReading> readings;  ///< those that were asked for
  std::size_t all = 0;                    ///< how many there are
  std::string asWrittenFault, transposedFault;
  std::vector<std::string> notes;
};

std::string nameOf(const WrittenMatrix& matrix, std::size_t index);

/// "1 projection, as written, view RUB, ndcZ -1..1, ... : opengl, unity".
std::string oneLine(const NumberedReading& reading, NumberOrder order);

/// The text or the JSON, matrix by matrix: what there is of it is to be written at once.
class Report {
 public:
  Report(bool json, bool asFloat) : json_(json), asFloat_(asFloat) {}
  std::string add(const InspectedMatrix& matrix);
  std::string add(const WrittenMatrix& matrix, const Calibration& calibration);
  /// After one matrix or more.
  std::string end() const;

 private:
  /// Its numbers have no more digits than float32s.
  bool isRough(const WrittenMatrix& matrix) const;
  std::string item(const std::string& text, const std::string& json);

  bool json_, asFloat_;
  std::size_t count_ = 0;
};

}  // namespace viewproj::cmd
