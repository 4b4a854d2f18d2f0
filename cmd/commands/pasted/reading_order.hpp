// Which reading of a pasted matrix is the usual one.
#pragma once

#include <vector>

#include "commands/pasted/readings.hpp"

namespace viewproj::cmd {

/// Of a projection or a view-projection.
bool isInverse(const Reading& reading);

/// Whether it is the lens of no usual camera: without depth, of other size, very wide or narrow.
bool isStrange(const Reading& reading);

/// Puts the likeliest reading first.
void sortByCost(std::vector<Reading>& readings, const KindHint& hint, const PastedMatrix& matrix);

/// Puts the views and poses first whose axes a projection in the same text has in its likeliest reading. lens: its
/// readings, the likeliest first.
void orderBeside(std::vector<Reading>& readings, const std::vector<Reading>& lens);

}  // namespace viewproj::cmd
