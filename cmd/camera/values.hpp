// The values of a camera document. readValues() checks the document and reads each value once; the readers of a pose, a
// projection and a lens take the values from it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "camera/document.hpp"
#include "camera/fields.hpp"
#include "camera/read_lens.hpp"
#include "viewproj/camera.hpp"
#include "viewproj/geodesy.hpp"

namespace viewproj::cmd {

/// x, y, z; or a place, and its ECEF coordinates.
struct Position {
  Vec3 point;
  std::optional<Geodetic> place;
  double error = 0;        ///< how far point may be from the place
  bool isRounded = false;  ///< lat or lon is in radians, and rounded to degrees
};

/// Turns about the camera's own axes.
struct EulerTurns {
  const NameRow<EulerOrder>* order;
  std::array<Turn, 3> turns;
};

/// A direction, which is the axis, times the angle in radians.
struct RotationVector {
  Vec3 vector;
};

/// The value of worldFromCamera and cameraFromWorld. The matrix has the translation too.
struct RigidTransform {
  std::variant<Mat4, Quaternion, RotationVector> rotation;
  Vec3 translation;
};

/// 16 numbers. isStored: in the order of memory; else rows as written on paper.
struct MatrixNumbers {
  Mat4 rows;
  bool isStored = false;
};

/// The type for each kind: text std::string; word std::string_view, of the table of words; flag bool; number, positive,
/// far (infinite for "inf") and zero double; ratio Aspect; angle, pitch and turn Angle; pair, range and size Vec2;
/// direction Vec3; place Position; quaternion Quaternion; euler EulerTurns; rigid RigidTransform; matrix MatrixNumbers;
/// lens LensNumbers.
using FieldValue = std::variant<std::string, std::string_view, bool, double, Angle, Aspect, Vec2, Vec3, Position,
                                Quaternion, EulerTurns, RigidTransform, MatrixNumbers, LensNumbers>;

/// The values of the fields that a document has. Holds the document, for messages.
class FieldValues {
 public:
  const Document& document() const { return document_; }

  bool has(FieldId field) const { return value(field) != nullptr; }
  /// Null if the field is absent. T: the type of the field's kind.
  template <class T>
  const T* find(FieldId field) const {
    const FieldValue* const found = value(field);
    return found ? &std::get<T>(*found) : nullptr;
  }
  template <class T>
  T valueOr(FieldId field, T fallback) const {
    const T* const found = find<T>(field);
    return found ? *found : fallback;
  }
  /// Fails with "projection: needs fx" if the field is absent.
  template <class T>
  const T& require(FieldId field) const {
    if (!has(field)) failMissing(field);
    return *find<T>(field);
  }

  /// The field, or the nearest object around it that the document has.
  Node node(FieldId field) const { return nodeAt(field->path); }
  Node nodeAt(std::string_view path) const;
  /// Fails at the field. See Node::fail.
  [[noreturn]] void fail(FieldId field, const std::string& message) const { node(field).fail(message); }
  /// Fails at the object with this path; "" is the document.
  [[noreturn]] void failAt(std::string_view path, const std::string& message) const { nodeAt(path).fail(message); }

 private:
  friend FieldValues readValues(const Document& document, std::string_view under);

  explicit FieldValues(Document document) : document_(std::move(document)) {}
  const FieldValue* value(FieldId field) const;
  [[noreturn]] void failMissing(FieldId field) const;

  Document document_;
  std::vector<std::pair<const Field*, FieldValue>> values_;  ///< in the order of the table
};

/// Checks a normalized document (see normalize) and reads its values. Throws InputError, or UsageError for what options
/// and --set gave, at the first member that is not known, value of the wrong kind, or field that contradicts another.
/// under: reads only the members of that object, such as "convention", and does not compare them with others.
FieldValues readValues(const Document& document, std::string_view under = "");

/// Reads a value of this field's kind.
FieldValue readValue(const Node& value, const Field& field);
/// 4 rows of 4, a rotation and a translation, or a list of these.
RigidTransform readRigid(const Node& value);
/// A number of degrees, "60deg" or "1.0472rad".
Angle readAngle(const Node& value, double least = -HUGE_VAL, double most = HUGE_VAL, const char* range = "in degrees");
/// x, y, z, or {"lat", "lon", "height"}.
Position readPosition(const Node& value);

/// Throws if the object has a member that is not among the names.
void allowMembers(const Node& object, const std::vector<std::string_view>& names);
/// Throws if the last row of the value's matrix is not 0 0 0 1.
void requireAffine(const Mat4& matrix, const Node& value);
/// "; did you mean 'projection.fovY'?" if a field's path ends like this one, or the field is also called so; else
/// suggestion() for name among names.
std::string suggestField(std::string_view path, std::string_view name, const std::vector<std::string_view>& names);

/// An angle in degrees, rounded once.
double degreesOf(Angle angle);

}  // namespace viewproj::cmd
