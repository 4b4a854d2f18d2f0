// Where the fields of a camera stand in a file of a kind.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/kinds/found.hpp"
#include "input/kinds/kind.hpp"

namespace viewproj::cmd {

/// One of the cameras of a file, and the places where its fields are looked for: its own first.
class CameraPlace {
 public:
  CameraPlace(const Document& document, const Kind& kind, Found own, std::vector<std::string> stars)
      : document_(&document), kind_(&kind), own_(std::move(own)), stars_(std::move(stars)) {}

  /// Of several in one place: which row of what has one for each.
  void setRow(std::size_t row) { row_ = row; }

  const Document& document() const { return *document_; }
  const Kind& kind() const { return *kind_; }
  const Found& own() const { return own_; }
  /// The name of its view, or empty.
  std::string_view view() const { return kind_->view; }
  /// The key or number that leads to it.
  std::string_view key() const;
  /// The key, as the document has it; empty in a list.
  std::string_view keyInFile() const;
  /// The camera itself and what stands beside it.
  std::vector<Found> spots() const;
  /// These, and the objects in them in which the numbers of the lens stand.
  std::vector<Found> lensSpots() const;
  /// Throws where the camera names what should stand beside it, as its lens, and nothing of the name does.
  void requireBeside() const;
  /// Another entry of the same array or object, a camera or not; nothing where there is no object.
  std::optional<CameraPlace> sibling(const std::string& key) const;

  /// What stands where the row says that this word's value does. Throws where the file has
  /// two of its places, with different values.
  std::optional<Found> find(std::string_view word) const;
  std::optional<Found> find(const Steps& steps) const;
  std::optional<double> number(std::string_view word) const;
  std::optional<std::vector<double>> numbers(std::string_view word, std::size_t count) const;
  /// The numbers of a matrix by rows, however they stand in the file. Throws where its rows and columns are others.
  std::optional<std::vector<double>> matrix(std::string_view word, std::size_t rows, std::size_t columns) const;
  /// Where a word's value stands, for messages; the camera where it has none.
  Path pathOf(std::string_view word) const;
  [[noreturn]] void fail(std::string_view word, const std::string& message) const;
  [[noreturn]] void fail(const std::string& message) const { document_->fail(own_.path, message); }

 private:
  /// Where something stands beside the camera; nothing where it lacks the key. key: the camera's, if it has one.
  std::optional<Steps> filled(const Steps& beside, std::optional<Found>& key) const;

  const Document* document_;
  const Kind* kind_;
  Found own_;
  std::vector<std::string> stars_;  ///< what the stars of the place stand for
  std::optional<std::size_t> row_ = {};
};

/// Whether the file has what the kind is known by.
bool isOfKind(const Document& document, const Kind& kind);

/// What a file that is not of the kind lacks: "there is no lens.f".
std::string lackOf(const Document& document, const Kind& kind);

/// Where a file has all that the kind is known by, though not of the numbers that it has: a place, and how many
/// numbers are expected there. Nothing where it lacks more.
struct OddShape {
  Path path;
  std::size_t count;
};
std::optional<OddShape> oddShapeFor(const Document& document, const Kind& kind);

/// The fields of a file around a list of cameras, where the row looks for none of them: no objects, which may be other
/// cameras.
std::vector<Found> fieldsAround(const Document& document, const Kind& kind);
/// Objects among them that are called as a distortion is.
std::vector<Found> distortionsAround(const Document& document, const Kind& kind);

/// The cameras of a file of the kind, in the order of the list, or of their keys. Throws where there is none.
std::vector<CameraPlace> camerasOf(const Document& document, const Kind& kind);

}  // namespace viewproj::cmd
