#include "input/kinds/lookup.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "input/distortion_names.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

bool hasShape(const Document& document, const Found& found, const Known& known) {
  if (known.isArray) return found.value->is_array();
  if (known.isObject) return found.value->is_object();
  if (!known.count) return true;
  std::vector<double> numbers;
  if (!numbersOf(document, found, numbers)) return false;
  if (numbers.size() == *known.count) return true;
  // What a stored matrix says of itself, though its data are too few.
  if (!found.value->is_object()) return false;
  const auto rows = found.value->find("rows"), columns = found.value->find("cols");
  return rows != found.value->end() && rows->is_number() && columns != found.value->end() && columns->is_number() &&
         rows->get<double>() * columns->get<double>() == static_cast<double>(*known.count);
}

/// The places at the end of steps of which some are "*", in order; visit returns false to end.
template <class Visit>
bool eachPlace(const Document& document, const Found& from, const Steps& steps, std::size_t at,
               std::vector<std::string>& stars, const Visit& visit) {
  if (at == steps.size()) return visit(from, stars);
  const auto on = [&](const std::string& step, const nlohmann::json& value) {
    Found next{from.path, &value};
    next.path.push_back(step);
    return eachPlace(document, next, steps, at + 1, stars, visit);
  };
  if (steps[at] != "*") {
    const auto next = follow(document, from, {steps[at]});
    return !next || eachPlace(document, *next, steps, at + 1, stars, visit);
  }
  bool goesOn = true;
  const auto star = [&](const std::string& step, const nlohmann::json& value) {
    stars.push_back(step);
    goesOn = on(step, value);
    stars.pop_back();
  };
  if (from.value->is_object())
    for (auto item = from.value->begin(); goesOn && item != from.value->end(); ++item) star(item.key(), item.value());
  if (from.value->is_array())
    for (std::size_t i = 0; goesOn && i < from.value->size(); ++i) star(std::to_string(i), (*from.value)[i]);
  return goesOn;
}

/// An array that stands for the whole file has a key of no letters.
Found rootOf(const Document& document) {
  const nlohmann::json& root = document.root();
  if (const auto list = root.find(""); list != root.end() && list->is_array()) return {{""}, &*list};
  return {{}, &root};
}

bool fits(const Document& document, const Kind& kind, const Found& camera) {
  return std::all_of(kind.known.begin(), kind.known.end(), [&](const std::vector<Known>& choice) {
    return std::any_of(choice.begin(), choice.end(), [&](const Known& known) {
      const auto found = follow(document, known.fromRoot ? rootOf(document) : camera, known.path);
      return found && hasShape(document, *found, known);
    });
  });
}

bool asksTheFileAlone(const Kind& kind) {
  return std::all_of(kind.known.begin(), kind.known.end(), [](const std::vector<Known>& choice) {
    return std::all_of(choice.begin(), choice.end(), [](const Known& known) { return known.fromRoot; });
  });
}

/// Whether it is an entry of an array.
bool isInList(const Document& document, const Found& camera) {
  if (camera.path.empty()) return false;
  const auto parent = follow(document, {{}, &document.root()}, Steps(camera.path.begin(), camera.path.end() - 1));
  return parent && parent->value->is_array();
}

/// The first of the kind's places of cameras where one fits; nothing where none does.
const Steps* placeOf(const Document& document, const Kind& kind) {
  static const Steps kFile;
  if (kind.cameras.empty()) return fits(document, kind, rootOf(document)) ? &kFile : nullptr;
  if (asksTheFileAlone(kind)) return fits(document, kind, rootOf(document)) ? &kind.cameras.front() : nullptr;
  for (const Steps& place : kind.cameras) {
    bool found = false;
    std::vector<std::string> stars;
    eachPlace(document, rootOf(document), place, 0, stars, [&](const Found& camera, const auto&) {
      found = camera.value->is_object() && fits(document, kind, camera);
      return !found;
    });
    if (found) return &place;
  }
  return nullptr;
}

}  // namespace

std::string_view CameraPlace::key() const { return own_.path.empty() ? std::string_view() : own_.path.back(); }

std::string_view CameraPlace::keyInFile() const {
  if (own_.path.empty()) return {};
  const auto parent = follow(*document_, {{}, &document_->root()}, Steps(own_.path.begin(), own_.path.end() - 1));
  if (!parent || !parent->value->is_object()) return {};
  return parent->value->find(own_.path.back()).key();
}

std::optional<Steps> CameraPlace::filled(const Steps& beside, std::optional<Found>& key) const {
  Steps steps;
  std::size_t star = 0;
  for (const std::string& step : beside) {
    if (step == "*" && star < stars_.size()) {
      steps.push_back(stars_[star++]);
    } else if (step.starts_with('{') && step.ends_with('}')) {
      key = follow(*document_, own_, {step.substr(1, step.size() - 2)});
      if (!key || !(key->value->is_string() || key->value->is_number())) return std::nullopt;
      steps.push_back(key->value->is_string() ? key->value->get<std::string>() : key->value->dump());
    } else {
      steps.push_back(step);
    }
  }
  return steps;
}

std::vector<Found> CameraPlace::spots() const {
  std::vector<Found> spots{own_};
  for (const Steps& beside : kind_->beside) {
    std::optional<Found> key;
    const auto steps = filled(beside, key);
    if (const auto found = steps ? follow(*document_, rootOf(*document_), *steps) : std::nullopt)
      if (found->value->is_object()) spots.push_back(*found);
  }
  return spots;
}

std::vector<Found> CameraPlace::lensSpots() const {
  std::vector<Found> all = spots();
  for (const char* const word : {"width", "fx", "K", "P", "intrinsics"})
    for (const Steps& path : kind_->at(word).paths)
      if (path.size() > 1)
        if (auto holder = find(Steps(path.begin(), path.end() - 1)); holder && holder->value->is_object())
          all.push_back(std::move(*holder));
  return all;
}

void CameraPlace::requireBeside() const {
  std::optional<Found> namer;
  std::string named;
  for (const Steps& beside : kind_->beside) {
    std::optional<Found> key;
    const auto steps = filled(beside, key);
    if (!steps || !key) continue;
    const auto found = follow(*document_, rootOf(*document_), *steps);
    if (found && found->value->is_object()) return;
    namer = key;
    named = dotted(*steps);
  }
  if (namer) document_->fail(namer->path, "names " + named + ", which the file does not have");
  // A row of --format may be new.
  const bool isPlain = std::none_of(kind_->beside.begin(), kind_->beside.end(), [](const Steps& beside) {
    return beside.empty() ||
           std::any_of(beside.begin(), beside.end(), [](const std::string& step) { return step.starts_with('{'); });
  });
  if (!document_->ownKinds().empty() && !kind_->beside.empty() && isPlain && spots().size() == 1)
    document_->fail(own_.path, "has nothing beside it at " + dotted(kind_->beside.front()) + ", where --format looks");
}

std::optional<CameraPlace> CameraPlace::sibling(const std::string& key) const {
  if (own_.path.empty()) return std::nullopt;
  const auto parent = follow(*document_, {{}, &document_->root()}, Steps(own_.path.begin(), own_.path.end() - 1));
  auto found = parent ? follow(*document_, *parent, {key}) : std::nullopt;
  if (!found || !found->value->is_object()) return std::nullopt;
  std::vector<std::string> stars = stars_;
  if (!stars.empty() && stars.back() == own_.path.back()) stars.back() = key;
  return CameraPlace(*document_, *kind_, std::move(*found), std::move(stars));
}

std::optional<Found> CameraPlace::find(const Steps& steps) const {
  for (const Found& spot : spots())
    if (auto found = follow(*document_, spot, steps)) return found;
  return std::nullopt;
}

std::optional<Found> CameraPlace::find(std::string_view word) const {
  const Where& where = kind_->at(word);
  if (where.paths.empty()) return std::nullopt;
  for (const Found& spot : spots()) {
    std::optional<Found> first;
    for (const Steps& path : where.paths) {
      const auto found = follow(*document_, spot, path);
      if (!found) continue;
      if (!first) first = found;
      const bool areParts = where.paths.size() > 1 && where.paths.size() == numbersOfWord(word) &&
                            (first->value->is_number() || found->value->is_number());
      if (first->path != found->path && !areParts && !isSame(*document_, *first, *found))
        document_->fail(found->path, "says what " + dotted(first->path) + " does" +
                                         (first->value->is_number() ? ", which is " + first->value->dump() : "") +
                                         "; one of them is expected");
    }
    if (first) return first;
  }
  return std::nullopt;
}

std::optional<double> CameraPlace::number(std::string_view word) const {
  if (const auto constant = kind_->at(word).constant) return constant;
  const auto found = find(word);
  if (!found) return std::nullopt;
  if (!found->value->is_number()) document_->fail(found->path, "expected a number");
  return found->value->get<double>();
}

std::optional<std::vector<double>> CameraPlace::numbers(std::string_view word, std::size_t count) const {
  const auto found = find(word);
  if (!found) return std::nullopt;
  std::vector<double> numbers;
  if (row_ && (word == "rotationVector" || word == "translation")) {
    if (!numbersOfRow(*document_, *found, *row_, numbers))
      document_->fail(found->path, "has no row " + std::to_string(*row_) + " of numbers");
    constexpr std::ptrdiff_t kThree = 3;
    if (numbers.size() == 6)  // both
      numbers = word == "translation" ? std::vector(numbers.begin() + kThree, numbers.end())
                                      : std::vector(numbers.begin(), numbers.begin() + kThree);
    if (numbers.size() != count)
      document_->fail(found->path, "expected rows of a rotation vector and a translation, of 3 numbers each");
    return numbers;
  }
  if (const auto& paths = kind_->at(word).paths; found->value->is_number() && count > 1 && paths.size() == count) {
    for (const Steps& path : paths) {  // one of them at each
      const auto part = find(path);
      if (!part) document_->fail(found->path, "needs " + dotted(path) + " beside it");
      if (!part->value->is_number()) document_->fail(part->path, "expected a number");
      numbers.push_back(part->value->get<double>());
    }
    return numbers;
  }
  if (!numbersOf(*document_, *found, numbers)) {
    if (found->value->is_object() && !found->value->contains("data"))
      document_->fail(found->path, "needs data, or an array in its place");
    document_->fail(found->path, "expected " + std::to_string(count) + " numbers");
  }
  requireStored(*document_, *found, numbers.size());
  if (numbers.size() != count) document_->fail(found->path, "expected " + std::to_string(count) + " numbers");
  return numbers;
}

std::optional<std::vector<double>> CameraPlace::matrix(std::string_view word, std::size_t rows,
                                                       std::size_t columns) const {
  const auto numbers = this->numbers(word, rows * columns);
  if (!numbers) return std::nullopt;
  const bool turned = kind_->word("order") == "columns";
  const std::size_t outer = turned ? columns : rows, inner = turned ? rows : columns;
  // A single row or column has its numbers one after the other, as a flat array does.
  if (const auto shape = shapeOf(*document_, *find(word)); shape && (*shape)[0] > 1 && (*shape)[1] > 1)
    if ((*shape)[0] != static_cast<double>(outer) || (*shape)[1] != static_cast<double>(inner)) {
      const auto by = [](double r, double c) { return formatNumber(r) + " x " + formatNumber(c); };
      fail(word, "expected a matrix of " + by(static_cast<double>(rows), static_cast<double>(columns)) +
                     (turned ? " by columns" : "") + ", and it is one of " + by((*shape)[0], (*shape)[1]));
    }
  if (!turned) return numbers;
  std::vector<double> byRows;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < columns; ++j) byRows.push_back((*numbers)[rows * j + i]);
  return byRows;
}

Path CameraPlace::pathOf(std::string_view word) const {
  const auto found = find(word);
  return found ? found->path : own_.path;
}

void CameraPlace::fail(std::string_view word, const std::string& message) const {
  if (kind_->at(word).constant) document_->fail(own_.path, std::string(word) + " of its row: " + message);
  document_->fail(pathOf(word), message);
}

bool isOfKind(const Document& document, const Kind& kind) { return placeOf(document, kind) != nullptr; }

std::string lackOf(const Document& document, const Kind& kind) {
  Found camera = rootOf(document);
  std::string where;
  if (!kind.cameras.empty() && !asksTheFileAlone(kind)) {
    std::optional<Found> first;
    for (const Steps& place : kind.cameras) {
      std::vector<std::string> stars;
      eachPlace(document, rootOf(document), place, 0, stars, [&](const Found& each, const auto&) {
        if (!first && each.value->is_object()) first = each;
        return !first;
      });
    }
    if (!first) return "no object stands at " + dotted(kind.cameras.front());
    camera = *first;
    if (!dotted(camera.path).empty()) where = " in " + dotted(camera.path);
  }
  for (const std::vector<Known>& choice : kind.known) {
    std::string names;
    bool isThere = false;
    for (const Known& known : choice) {
      const auto found = follow(document, known.fromRoot ? rootOf(document) : camera, known.path);
      if (found && hasShape(document, *found, known)) isThere = true;
      names += (names.empty() ? "" : " or ") + dotted(known.path);
      if (!found) continue;
      if (known.count) names += " of " + std::to_string(*known.count) + " numbers";
      if (known.isArray) names += " that is an array";
      if (known.isObject) names += " that is an object";
    }
    if (!isThere) return "there is no " + names + (choice.front().fromRoot ? "" : where);
  }
  return "no camera has all that it is known by";
}

std::optional<OddShape> oddShapeFor(const Document& document, const Kind& kind) {
  if (!kind.cameras.empty()) return std::nullopt;
  const Found root = rootOf(document);
  std::optional<OddShape> odd;
  for (const std::vector<Known>& choice : kind.known) {
    bool isThere = false, fits = false;
    std::optional<OddShape> wrong;
    for (const Known& known : choice) {
      const auto found = follow(document, root, known.path);
      if (!found || !(known.count || known.isArray || known.isObject)) continue;
      isThere = true;
      fits = fits || hasShape(document, *found, known);
      if (known.count && !wrong) wrong = {found->path, *known.count};
    }
    if (!isThere) return std::nullopt;
    if (!fits && !odd) odd = wrong;
  }
  return odd;
}

std::vector<CameraPlace> camerasOf(const Document& document, const Kind& kind) {
  std::vector<CameraPlace> cameras;
  const Found root = rootOf(document);
  if (!kind.views.empty()) {
    // Of the views those whose lens is there.
    for (const Kind& view : kind.views) {
      CameraPlace camera(document, view, root, {});
      if (std::any_of(std::begin(kLensWords), std::end(kLensWords),
                      [&](const char* word) { return view.at(word).constant || camera.find(word); }))
        cameras.push_back(std::move(camera));
    }
    if (cameras.empty()) document.fail(root.path, "has no lens of one of its views");
    return cameras;
  }
  if (kind.has("rows")) {
    const CameraPlace all(document, kind, root, {});
    const auto found = all.find("rows");
    const std::size_t count = found ? rowsOf(document, *found) : 0;
    if (count == 0) all.fail("rows", "expected rows of a rotation vector and a translation, of 3 numbers each");
    for (const char* const word : {"rotationVector", "translation"})
      if (const auto other = all.find(word))
        if (const std::size_t rows = rowsOf(document, *other); rows != 0 && rows != count)
          document.fail(other->path, "has " + std::to_string(rows) + (rows == 1 ? " row, and " : " rows, and ") +
                                         dotted(found->path) + " " + std::to_string(count) +
                                         ": each picture needs one of both");
    for (std::size_t i = 0; i < count; ++i) {
      cameras.push_back(all);
      cameras.back().setRow(i);
    }
    return cameras;
  }
  const Steps& place = *placeOf(document, kind);
  const Where& needed = kind.at("skipWithout");
  std::vector<std::string> stars;
  const bool alone = asksTheFileAlone(kind);
  std::size_t skipped = 0;
  eachPlace(document, root, place, 0, stars, [&](const Found& camera, const std::vector<std::string>& filled) {
    const Found& own = camera;
    CameraPlace found(document, kind, own, filled);
    if (!camera.value->is_object()) {  // which is told when it is read, so that the others can be
      if (alone || (!place.empty() && isInList(document, camera))) cameras.push_back(std::move(found));
      return true;
    }
    if (!needed.paths.empty() && !found.find("skipWithout")) {
      ++skipped;
      return true;
    }
    // An object's other values are no cameras; of a list all have to be.
    if (!place.empty() && !alone && !isInList(document, camera) && !fits(document, kind, camera)) return true;
    cameras.push_back(std::move(found));
    return true;
  });
  if (cameras.empty()) {
    Path path = root.path;
    if (!place.empty() && place.front() != "*") path.push_back(place.front());
    document.fail(path, skipped == 0 ? "is empty: there is no camera"
                                     : "has no camera: none has " + dotted(needed.paths.front()) +
                                           ", without which one is passed over");
  }
  return cameras;
}

namespace {

/// The fields of the file around a list of cameras for which isGood holds.
template <class IsGood>
std::vector<Found> around(const Document& document, const Kind& kind, const IsGood& isGood) {
  std::vector<Found> fields;
  const Found root = rootOf(document);
  const bool looksThere =
      std::any_of(kind.beside.begin(), kind.beside.end(), [](const Steps& beside) { return beside.empty(); });
  if (kind.cameras.empty() || looksThere || !root.value->is_object()) return fields;
  const Steps* const place = placeOf(document, kind);
  if (!place || place->empty()) return fields;
  for (const auto& item : root.value->items())
    if (isGood(item.key(), item.value())) {
      fields.push_back({root.path, &item.value()});
      fields.back().path.push_back(item.key());
    }
  return fields;
}

}  // namespace

std::vector<Found> fieldsAround(const Document& document, const Kind& kind) {
  return around(document, kind, [](const std::string&, const nlohmann::json& value) {
    return !value.is_null() && (!value.is_object() || value.contains("data"));
  });
}

std::vector<Found> distortionsAround(const Document& document, const Kind& kind) {
  return around(document, kind, [](const std::string& name, const nlohmann::json& value) {
    return value.is_object() && !value.contains("data") && distortionName(name) == DistortionName::array;
  });
}

}  // namespace viewproj::cmd
