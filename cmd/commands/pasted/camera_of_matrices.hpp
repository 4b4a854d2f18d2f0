// Matrices of a text in a stated convention: what matrix writes of them, and the camera that -c reads of them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "commands/pasted/report.hpp"
#include "output/matrix_text.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {

/// A matrix whose readings give different matrices.
struct AmbiguousMatrix : InputError {
  using InputError::InputError;
  std::string text = {};  ///< of the file
};

/// The one matrix that all readings give. writing: the convention to write in, of that of a reading. world: that of the
/// matrices with a pose, which is one for all. mayLackDepth: of readings that differ in depth alone its z row is 0 0 0
/// 0. Throws AmbiguousMatrix.
NamedMatrix convertOne(const ReadMatrix& matrix, const std::string& name,
                       const std::function<Convention(const Convention&)>& writing, std::optional<Handedness>& world,
                       bool mayLackDepth = false);

/// The options beside -c FILE by which the matrices of a text are read as a camera, in their first readings; or empty.
std::string optionsOf(const std::vector<ReadMatrix>& matrices, const std::string& text, bool isTree);

/// Notes the numbers of a file that no matrix of it has. Of plain text, those without a name: of others info tells.
void noteOthers(const Document& file, const std::vector<PastedMatrix>& matrices);

/// What the matrices in the text of a file make, in JSON: a view, or its inverse, and a projection as a file of
/// matrices; a view-projection, or its inverse, as a camera; K or P in pixels, with a view, as a calibration. Nothing
/// where the text has none of these. Throws InputError where they can be read in several ways, or where a tree has
/// other numbers too and no convention is given.
std::optional<std::string> cameraOfMatrices(const UnknownFormat& file, const std::string& source,
                                            const std::optional<Convention>& readAs);

}  // namespace viewproj::cmd
