// Where a record has what a row of the coordinates says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "records/coordinates.hpp"
#include "records/field_names.hpp"
#include "records/layout.hpp"
#include "records/record.hpp"

namespace viewproj::cmd {

/// The parts of a row in the fields of a record, if it has all that are required. Adds to forms which values it went
/// by. rule any: in any letter case and by aliases too. Throws RecordError where two names fit as well.
std::optional<Layout> find(const Coordinate& row, const RecordParts& record, std::vector<FormOfField>& forms,
                           NameRule rule = NameRule::exact);

/// "has lat but no height", of a row of which a record has some parts; empty: it has none.
std::string partlyThere(const Coordinate& row, const Shape& shape);

/// What the record calls them: "x, y, z".
std::string namesIn(const Layout& layout, const Shape& shape);

}  // namespace viewproj::cmd
