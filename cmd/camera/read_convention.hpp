// The convention that a camera document states.
#pragma once

#include <string>

#include "camera/values.hpp"
#include "text/json_text.hpp"
#include "viewproj/convention.hpp"

namespace viewproj::cmd {

struct DocumentConvention {
  const ConventionPreset* preset;  ///< its up, axes and pixel centre apply
  Convention convention;           ///< the preset's, with the document's changes
  bool isStated;
};

/// The convention of a document; opengl if it states none, ps2 for the projection of that name.
DocumentConvention readConvention(const FieldValues& values);
/// The convention that a document states, of which nothing else is read or checked.
DocumentConvention readConvention(const Document& document);

/// {"world": ..., ...} with every axis.
std::string jsonOf(const Convention& convention);
/// The name of a preset; or an object with the preset and the axes that differ from it.
std::string jsonOf(const ConventionPreset& preset, const Convention& convention);

}  // namespace viewproj::cmd
