// The convention of a file, as a preset's name or axis by axis.
#pragma once

#include <optional>
#include <string>

#include "input/document.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::cmd {

struct StatedConvention {
  Convention convention;
  std::string preset;  ///< the name that the file gives, or empty
};

/// The field "convention" of the file, or nothing. Axes that it does not name are those of its preset, or of fallback.
std::optional<StatedConvention> readConvention(const ObjectReader& file, const Convention& fallback);

/// Axis by axis, each that is not named from base.
Convention readAxes(const ObjectReader& fields, Convention base);

}  // namespace viewproj::cmd
