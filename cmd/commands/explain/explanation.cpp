#include "commands/explain/explanation.hpp"

#include <algorithm>
#include <cmath>

#include "viewproj/matrices.hpp"

namespace viewproj::cmd {
namespace {

std::string entryName(const std::string& matrix, std::size_t row, std::size_t column) {
  return matrix + "[" + std::to_string(row) + "][" + std::to_string(column) + "]";
}

}  // namespace

std::array<std::string, 3> components(const std::string& name) { return {name + ".x", name + ".y", name + ".z"}; }

void Explanation::stage(std::string name, std::string says) {
  stages_.push_back({std::move(name), std::move(says), {}, {}});
}

void Explanation::matrix(const std::string& name, const Mat4& column) {
  const Mat4 paper = laidOut(column, writing_);
  stages_.back().matrices.push_back({name, paper});
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) values_[entryName(name, i, j)] = paper[i][j];
}

std::vector<Term> Explanation::product(const std::string& matrix, std::size_t row,
                                       const std::vector<std::string>& vector) const {
  std::vector<Term> terms;
  for (std::size_t j = 0; j < vector.size(); ++j) {
    if (vector[j].empty()) continue;
    const bool byRows = writing_.vectors == Vectors::row;
    const std::string entry = byRows ? entryName(matrix, j, row) : entryName(matrix, row, j);
    if (valueOf(entry) == 0) continue;
    if (vector[j] == "1")
      terms.push_back({entry});
    else
      terms.push_back(byRows ? Term{vector[j], entry} : Term{entry, vector[j]});
  }
  return terms;
}

std::string Explanation::timesInWords(const std::string& matrix, const std::string& vector) const {
  return writing_.vectors == Vectors::row ? vector + " * " + matrix : matrix + " * " + vector;
}

double Explanation::valueOf(const std::string& name) const {
  if (name == "1") return 1;
  if (name == "-1") return -1;
  const auto found = values_.find(name);
  return found == values_.end() ? std::nan("") : found->second;
}

void Explanation::given(const std::string& name, double value, const std::string& remark) {
  add({name, LineKind::given, {}, value, remark, 0});
}

void Explanation::sum(const std::string& name, std::vector<Term> terms, double value, const std::string& remark) {
  Line line{name, LineKind::sum, std::move(terms), value, remark, 0};
  double sizes = 0;
  for (const Term& term : line.terms) {
    double product = 1;
    for (const std::string& factor : term) product *= valueOf(factor);
    sizes += std::fabs(product);
  }
  if (std::isfinite(sizes) && std::isfinite(value) && sizes > 0)
    line.lost = value == 0
                    ? (line.terms.size() > 1 ? kAllDigits : 0)
                    : std::clamp(static_cast<int>(std::log10(sizes) - std::log10(std::fabs(value))), 0, kAllDigits - 1);
  add(std::move(line));
}

void Explanation::quotient(const std::string& name, const std::string& over, const std::string& under, double value,
                           const std::string& remark) {
  add({name, LineKind::quotient, {{over, under}}, value, remark, 0});
}

void Explanation::root(const std::string& name, std::vector<Term> terms, double value) {
  add({name, LineKind::root, std::move(terms), value, "", 0});
}

void Explanation::add(Line line) {
  values_[line.name] = line.value;
  stages_.back().lines.push_back(std::move(line));
}

}  // namespace viewproj::cmd
