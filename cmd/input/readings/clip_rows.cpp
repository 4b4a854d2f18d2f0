#include "input/readings/clip_rows.hpp"

#include "camera/exact_vectors.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

/// Entries smaller than this beside the largest of their row give products whose last bits underflow; what is lost is
/// less than kLostBits of a row.
constexpr double kSmallestEntry = 0x1p-300;
constexpr double kLostBits = 0x1p-1000;

/// A row brought to unit size by a power of two.
struct Row {
  std::array<double, 4> entries;
  int exponent;  ///< the row is entries * 2^exponent
  bool isWide;   ///< with an entry below kSmallestEntry
};

Row unitRow(const std::array<double, 4>& row) noexcept {
  const int k = exponentToUnit({row[0], row[1], row[2]});
  Row r{{}, -k, false};
  for (std::size_t i = 0; i < 4; ++i) {
    r.entries[i] = std::ldexp(row[i], k);
    if (row[i] != 0 && std::fabs(r.entries[i]) < kSmallestEntry) r.isWide = true;
  }
  return r;
}

using Product = Expansion<6>;

Product dotProduct(const Row& a, const Row& b) noexcept {
  Product sum;
  for (std::size_t i = 0; i < 3; ++i) sum.addProduct(a.entries[i], b.entries[i]);
  return sum;
}

/// A sum in fewer terms, and what did not fit.
struct Kept {
  Expansion<8> terms;
  double lost = 0;
};

Kept kept(const Expansion<24>& sum) noexcept {
  Kept k{sum.leading<8>()};
  Expansion<32> rest;
  for (std::size_t i = 0; i < sum.size(); ++i) rest.add(sum.term(i));
  for (std::size_t i = 0; i < k.terms.size(); ++i) rest.add(-k.terms.term(i));
  k.lost = std::fabs(rest.rounded().hi);
  return k;
}

DoubleDouble lengthOf(const ExactVec3& v) noexcept { return DoubleDouble(1) / inverseLength(rounded(v)); }

/// The part of a row that lies across the w row, times w . w:  (w . w) row - (row . w) w.
struct Across {
  ExactVec3 axis;
  Expansion<8> translation;
  double axisLost = 0, translationLost = 0;
  DoubleDouble scale, offset;  ///< of the row: scale unit(axis) + offset unit(w)
};

Across across(const Row& row, const Row& w) noexcept {
  const Product square = dotProduct(w, w), along = dotProduct(row, w);
  Across a;
  for (std::size_t i = 0; i < 4; ++i) {
    Expansion<24> sum;
    sum.addScaled(square, row.entries[i]);
    sum.addScaled(along, -w.entries[i]);
    const Kept k = kept(sum);
    (i < 3 ? a.axis[i] : a.translation) = k.terms;
    double& lost = i < 3 ? a.axisLost : a.translationLost;
    lost = std::max(lost, k.lost);
  }
  // clip.x / clip.w is scale X / W + offset, with W the distance and so the w row over its length.
  const DoubleDouble length = sqrt(square.rounded());
  const int exponent = row.exponent - w.exponent;
  a.scale = scaleByPowerOfTwo(lengthOf(a.axis) / (square.rounded() * length), exponent);
  a.offset = scaleByPowerOfTwo(along.rounded() / square.rounded(), exponent);
  return a;
}

}  // namespace

ClipRows perspectiveRows(const Mat4& m, double up) noexcept {
  const Row w = unitRow(m[3]);
  const Row rows[] = {unitRow(m[0]), unitRow(m[1])};
  const Across x = across(rows[0], w), y = across(rows[1], w);
  ClipRows r{{}, x.scale, x.offset, y.scale, y.offset};
  ExactRows& e = r.rows;
  e.right = x.axis;
  e.up = y.axis;
  for (std::size_t i = 0; i < 3; ++i) e.forward[i] = {w.entries[i]};
  e.translation = {x.translation, y.translation, {w.entries[3]}};
  e.rightScale = inverseLength(rounded(e.right));
  e.upScale = inverseLength(rounded(e.up)) * DoubleDouble(up);
  e.forwardScale = inverseLength(rounded(e.forward));
  const double scales[] = {e.rightScale.hi, std::fabs(e.upScale.hi)};
  double largest = std::fabs(w.entries[3] * e.forwardScale.hi);
  for (std::size_t i = 0; i < 2; ++i) largest = std::max(largest, std::fabs(e.translation[i].rounded().hi) * scales[i]);
  const Across* const parts[] = {&x, &y};
  for (std::size_t i = 0; i < 2; ++i) {
    e.error = std::max(e.error, parts[i]->axisLost * scales[i]);
    if (parts[i]->translationLost > 0) e.error = std::max(e.error, parts[i]->translationLost * scales[i] / largest);
    if (w.isWide || rows[i].isWide) e.error = std::max(e.error, kLostBits * scales[i]);
  }
  return r;
}

ClipRows orthographicRows(const Mat4& m, double up, double forward) noexcept {
  ClipRows r;
  ExactVec3* const rows[] = {&r.rows.right, &r.rows.up, &r.rows.forward};
  DoubleDouble* const scales[] = {&r.rows.rightScale, &r.rows.upScale, &r.rows.forwardScale};
  DoubleDouble* const lensScales[] = {&r.scaleX, &r.scaleY};
  DoubleDouble* const offsets[] = {&r.offsetX, &r.offsetY};
  const double signs[] = {1, up, forward};
  for (std::size_t i = 0; i < 3; ++i) {
    const Row row = unitRow(m[i]);
    for (std::size_t j = 0; j < 3; ++j) (*rows[i])[j] = {row.entries[j]};
    *scales[i] = inverseLength(rounded(*rows[i])) * DoubleDouble(signs[i]);
    if (i == 2) continue;
    const int k = std::ilogb(m[3][3]);
    const DoubleDouble whole = std::ldexp(m[3][3], -k);
    *lensScales[i] = scaleByPowerOfTwo(lengthOf(*rows[i]) / whole, row.exponent - k);
    *offsets[i] = scaleByPowerOfTwo(DoubleDouble(row.entries[3]) / whole, row.exponent - k);
  }
  return r;
}

}  // namespace viewproj::cmd
