// An explanation: lines that each compute one number from those above, by name.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viewproj/convention.hpp"
#include "viewproj/vectors.hpp"

namespace viewproj::cmd {

/// Names of numbers to be multiplied; "1" and "-1" are themselves.
using Term = std::vector<std::string>;

/// NAME.x, NAME.y, NAME.z.
std::array<std::string, 3> components(const std::string& name);

enum class LineKind {
  given,     ///< taken as it is
  sum,       ///< of the terms
  quotient,  ///< of the two names in the first term
  root,      ///< square root of the sum of the terms
};

/// Digits lost where the sum is 0: more than doubles can lose otherwise.
inline constexpr int kAllDigits = 1000;

struct Line {
  std::string name;
  LineKind kind = LineKind::given;
  std::vector<Term> terms;
  double value = 0;  ///< the double nearest the true one, not what the terms as shown come to; NaN: there is none
  std::string remark;
  int lost = 0;  ///< digits that cancel in the sum; filled in by Explanation
};

struct ShownMatrix {
  std::string name;
  Mat4 matrix;  ///< as on paper
};

struct Stage {
  std::string name;
  std::string says;
  std::vector<ShownMatrix> matrices;
  std::vector<Line> lines;
};

/// Results by their names in `project` and `ray`. No value: null.
struct Result {
  std::string name;
  std::vector<double> numbers;                    ///< one: a number; more: an array; null as a whole where one is NaN
  std::optional<std::vector<std::string>> words;  ///< instead of numbers: an array of strings
  std::optional<bool> flag;
};

class Explanation {
 public:
  explicit Explanation(const Convention& writing) : writing_(writing) {}

  void stage(std::string name, std::string says);
  /// Its entries become "NAME[row][column]", counted from 0 as on paper. column: the matrix for column vectors.
  void matrix(const std::string& name, const Mat4& column);

  void given(const std::string& name, double value, const std::string& remark = "");
  void sum(const std::string& name, std::vector<Term> terms, double value, const std::string& remark = "");
  void quotient(const std::string& name, const std::string& over, const std::string& under, double value,
                const std::string& remark = "");
  void root(const std::string& name, std::vector<Term> terms, double value);

  /// The terms of a row of a matrix for column vectors times the numbers of these names; zero entries and empty names
  /// left out.
  std::vector<Term> product(const std::string& matrix, std::size_t row, const std::vector<std::string>& vector) const;

  /// "M * v", or "v * M" where vectors are rows.
  std::string timesInWords(const std::string& matrix, const std::string& vector) const;

  /// A line of text after the last stage.
  void remark(std::string text) { remarks_.push_back(std::move(text)); }
  void result(Result result) { results_.push_back(std::move(result)); }

  double valueOf(const std::string& name) const;
  const Convention& writing() const { return writing_; }
  const std::vector<Stage>& stages() const { return stages_; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  const std::vector<Result>& results() const { return results_; }

 private:
  void add(Line line);

  Convention writing_;
  std::vector<Stage> stages_;
  std::vector<std::string> remarks_;
  std::vector<Result> results_;
  std::map<std::string, double> values_;
};

}  // namespace viewproj::cmd
