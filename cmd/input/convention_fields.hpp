// The convention of a file, as a preset's name or axis by axis.
#pragma once

#include <optional>
#include <string>

#include "input/document.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::cmd {

/// A preset, whole but for the axes that were changed.
struct StatedConvention {
  Convention convention;
  const ConventionPreset* preset;
  bool isNamed = true;  ///< and not the one that stands for none
};

/// The field "convention" of the file, or nothing. What it does not name is its preset's, or the fallback's.
std::optional<StatedConvention> readConvention(const ObjectReader& file, const ConventionPreset& fallback);

/// The preset named (--read-as), or else the file's own convention, or else the fallback.
StatedConvention readStated(const ObjectReader& file, const std::string& readAs, const ConventionPreset& fallback);

/// {"world": ..., every axis}.
std::string jsonOf(const Convention& convention);

/// Axis by axis, each that is not named from base.
Convention readAxes(const ObjectReader& fields, Convention base);

}  // namespace viewproj::cmd
