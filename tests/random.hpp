// Random numbers of one trial, whose index is the seed. The generator's bits are the standard's; the numbers are drawn
// from them here, because the standard's distributions differ from library to library.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "viewproj/vectors.hpp"

class Random {
 public:
  explicit Random(std::uint64_t trial) : bits_(trial) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }
  /// Uniform in the logarithm.
  double logUniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  bool coin() { return (bits_() >> 63) != 0; }
  bool oneIn(std::size_t n) { return bits_() % n == 0; }
  std::size_t below(std::size_t n) { return bits_() % n; }
  bool chance(double share) { return uniform(0, 1) < share; }
  double sign() { return coin() ? 1 : -1; }
  template <class T, std::size_t N>
  const T& oneOf(const T (&all)[N]) {
    return all[below(N)];
  }

  /// In the cube of that half side.
  viewproj::Vec3 vector(double size) {
    const double x = uniform(-size, size), y = uniform(-size, size);
    return {x, y, uniform(-size, size)};
  }

  viewproj::Vec3 direction(double length = 1) {
    const double z = uniform(-1, 1), angle = uniform(0, 6.283185307179586);
    const double r = std::sqrt(1 - z * z);
    return {length * r * std::cos(angle), length * r * std::sin(angle), length * z};
  }

 private:
  std::mt19937_64 bits_;
};
