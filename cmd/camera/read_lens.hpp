// Lenses of a camera document: {"model": NAME, parameters, "limit"}. To add a model, add a row to the table in
// read_lens.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "camera/document.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {

/// A parameter of a model, such as "k".
struct LensParameter {
  std::string_view name = {};
  std::string_view counts = {};  ///< in messages: "1, 2, 3 or 6 numbers"; empty: one number
  unsigned allowed = 0;          ///< bit n: n numbers are allowed
  double absent = NAN;           ///< one number: its value where it is absent; NaN: it must be there
};

struct LensNumbers;

struct LensForm {
  std::string_view model;
  std::array<LensParameter, 3> parameters;  ///< unused ones have no name
  bool hasRadius;                           ///< "limit" may be a radius, and not degrees alone
  Lens (*make)(const LensNumbers& numbers);
  LensModel ofLibrary;
};
std::span<const LensForm> lensForms();
std::vector<std::string_view> lensModelNames();
std::string_view nameOf(LensModel model);
/// model, the parameters, limit.
std::vector<std::string_view> lensMembers(const LensForm& form);

/// The value of the field distortion.
struct LensNumbers {
  const LensForm* form = nullptr;
  std::array<std::array<double, 6>, 3> numbers{};        ///< of each parameter; missing ones are 0
  std::array<std::size_t, 3> counts{};                   ///< how many the document gives
  double degrees = kInfiniteFar, radius = kInfiniteFar;  ///< the limit that the document states
};

/// Reads and checks the value of the field distortion.
LensNumbers readLensNumbers(const Node& distortion);
/// Throws CameraError naming "distortion.k.0" and the like.
Lens makeLens(const LensNumbers& numbers);

}  // namespace viewproj::cmd
