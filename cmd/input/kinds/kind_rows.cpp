#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "input/convention_names.hpp"
#include "input/kinds/kind.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {
namespace {

/// Of which a number may stand for every file.
constexpr std::string_view kNumberWords[] = {"width", "height", "fx",   "fy",  "fovX",        "fovY",
                                             "cx",    "cy",     "near", "far", "sensorWidth", "sensorHeight"};

Steps stepsOf(std::string_view path) {
  if (path.starts_with('/')) path.remove_prefix(1);
  return path.empty() ? Steps{} : undotted(path);
}

/// Reads one row; base: what it is like.
class RowReader {
 public:
  RowReader(const Document& document, const nlohmann::json& row, Path path, bool isView = false)
      : document_(document), row_(row), path_(std::move(path)), isView_(isView) {
    if (!row_.is_object())
      document_.fail(path_, std::string("expected an object: ") +
                                (isView_ ? "what differs in the view" : "a kind of camera file"));
  }

  Kind over(Kind kind) const {
    dropOtherWays(kind);
    for (const auto& [name, value] : row_.items()) {
      const KindField* const field = kindField(name);
      if (!field) {
        std::vector<std::string_view> names;
        for (const KindField& each : kindFields()) names.push_back(each.name);
        fail(name, "is no word of a kind" + suggestion(name, names));
      }
      if (isView_ && !field->ofView) fail(name, "is of a whole kind, and of none of its views");
      read(kind, *field, value);
    }
    if (!isView_) requireWhole(kind);
    requireOneWay(kind);
    // A view is as the kind is, where it says nothing else.
    const auto views = row_.find("views");
    if (views == row_.end() || views->is_null()) requirePoseMeant(kind);
    if (views != row_.end())
      readViews(kind, *views);
    else if (!kind.views.empty() && !isView_)
      document_.fail(path_, "is like a kind with views, and needs views of its own; null is none");
    requireActs(kind);
    if (kind.views.empty()) requireCamera(kind);
    return kind;
  }

 private:
  void read(Kind& kind, const KindField& field, const nlohmann::json& value) const {
    const std::string name(field.name);
    switch (field.value) {
      case KindValue::text:
        if (field.name == "kind") kind.name = text(name, value);
        if (field.name == "form") kind.form = text(name, value);
        if (field.name == "lengths") kind.help = "lengths are " + text(name, value);
        break;
      case KindValue::path:
        kind.places[name] = where(name, value);
        break;
      case KindValue::paths:
        if (field.name == "distortion") {
          kind.distortion.reset();
          if (!value.is_null()) kind.distortion = pathsOf(name, value);
        } else if (field.name == "passedOver") {
          kind.passedOver = texts(name, value);
        } else if (field.name == "needs") {
          kind.needs = pathsOf(name, value);
        } else if (field.name == "model") {
          kind.models = pathsOf(name, value);
        } else {
          (field.name == "cameras" ? kind.cameras : kind.beside) = pathsOf(name, value);
        }
        break;
      case KindValue::known:
        kind.known = known(value);
        break;
      case KindValue::word:
        readWord(kind, field, value);
        break;
      case KindValue::number:
        readNumber(kind, name, value);
        break;
      case KindValue::preset:
        if (!value.is_string() || !findPreset(value.get_ref<const std::string&>()))
          fail(name,
               "is none of the known names" + suggestion(value.is_string() ? text(name, value) : "", presetNames()));
        kind.words[name] = text(name, value);
        break;
      case KindValue::axes:
        readAxes(kind, value);
        break;
      case KindValue::views:  // after all else
        break;
      case KindValue::allowed:
        kind.only = allowed(name, value);
        break;
      case KindValue::euler:
        readEuler(kind, value);
        break;
    }
  }

  void readNumber(Kind& kind, const std::string& name, const nlohmann::json& value) const {
    kind.numbers.erase(name);
    if (value.is_null()) return;
    if (!value.is_number()) fail(name, "expected a number");
    const double number = value.get<double>();
    if (name == "pixelCenter" && number != 0 && number != 0.5)
      fail(name, "expected 0 or 0.5, where in a pixel its centre is");
    if (name == "scale" && !(number > 0 && std::isfinite(number)))
      fail(name, "expected a number above 0, which lengths are multiplied by");
    kind.numbers[name] = number;
  }

  void readWord(Kind& kind, const KindField& field, const nlohmann::json& value) const {
    const std::string name(field.name);
    kind.words.erase(name);
    if (value.is_null()) return;
    std::vector<std::string_view> words;
    for (const std::string_view word : field.words)
      if (!word.empty()) words.push_back(word);
    const std::string word = text(name, value);
    if (std::find(words.begin(), words.end(), word) == words.end())
      fail(name, "is none of the known words" + suggestion(word, words));
    kind.words[name] = word;
  }

  void readAxes(Kind& kind, const nlohmann::json& value) const {
    const std::string axes = text("axes", value);
    int seen[3] = {0, 0, 0};
    for (const char c : axes)
      for (int i = 0; i < 3; ++i)
        if (std::string_view("RLUDFB").substr(2 * static_cast<std::size_t>(i), 2).find(c) != std::string_view::npos)
          ++seen[i];
    if (axes.size() != 3 || seen[0] != 1 || seen[1] != 1 || seen[2] != 1)
      fail("axes", "expected three letters: one of R and L, one of U and D, one of F and B, as in RDF");
    kind.words["axes"] = axes;
  }

  void readEuler(Kind& kind, const nlohmann::json& value) const {
    for (const char* const word : {"euler", "eulerUnit"}) kind.words.erase(word);
    kind.places.erase("euler");
    if (value.is_null()) return;
    constexpr const char* kExpected =
        R"(expected an order and the angles' places, as in {"order": "ZYX", "degrees": ["yaw", "pitch", "roll"]})";
    const bool isWhole = value.is_object() && value.size() == 2 && value.contains("order") &&
                         (value.contains("degrees") || value.contains("radians"));
    if (!isWhole || !value["order"].is_string()) fail("euler", kExpected);
    const std::string order = value["order"].get<std::string>();
    const bool isOrder = order.size() == 3 && order.find_first_not_of("XYZ") == std::string::npos &&
                         order[0] != order[1] && order[1] != order[2];
    if (!isOrder) fail("euler", "expected an order of three of X, Y and Z, none twice in a row, as in ZYX");
    const std::string unit = value.contains("degrees") ? "degrees" : "radians";
    const Where angles = where("euler", value[unit]);
    if (angles.constant || (angles.paths.size() != 1 && angles.paths.size() != 3)) fail("euler", kExpected);
    kind.words["euler"] = order;
    kind.words["eulerUnit"] = unit;
    kind.places["euler"] = angles;
  }

  void requireWhole(const Kind& kind) const;
  void dropOtherWays(Kind& kind) const;
  void requireOneWay(const Kind& kind) const;
  void requirePoseMeant(const Kind& kind) const;
  void requireActs(const Kind& kind) const;
  void requireTurn(const Kind& kind) const;
  void requireCamera(const Kind& kind) const;
  void requireRange(const Kind& kind, const char* word) const;
  bool says(const char* word) const { return row_.contains(word) && !row_[word].is_null(); }
  void readViews(Kind& kind, const nlohmann::json& value) const;

  std::string text(const std::string& name, const nlohmann::json& value) const {
    if (!value.is_string()) fail(name, "expected a text");
    return value.get<std::string>();
  }

  std::vector<std::string> texts(const std::string& name, const nlohmann::json& value) const {
    if (value.is_string()) return {value.get<std::string>()};
    std::vector<std::string> all;
    if (!value.is_array() && !value.is_null())
      fail(name, "expected a place, as in \"camera.width\", or a list of them");
    if (value.is_array())
      for (const auto& each : value) all.push_back(text(name, each));
    return all;
  }

  std::vector<Steps> pathsOf(const std::string& name, const nlohmann::json& value) const {
    std::vector<Steps> paths;
    for (const std::string& each : texts(name, value)) paths.push_back(stepsOf(each));
    return paths;
  }

  Where where(const std::string& name, const nlohmann::json& value) const {
    if (!value.is_number()) return {pathsOf(name, value)};
    if (std::find(std::begin(kNumberWords), std::end(kNumberWords), name) == std::end(kNumberWords))
      fail(name, "expected a place, as in \"camera.width\", or a list of them");
    return {{}, value.get<double>()};
  }

  Known knownPlace(std::string path) const {
    Known known;
    known.fromRoot = path.starts_with('/');
    if (path.ends_with("[]") || path.ends_with("{}")) {
      (path.ends_with("[]") ? known.isArray : known.isObject) = true;
      path.resize(path.size() - 2);
    } else if (const std::size_t open = path.find('['); open != std::string::npos && path.ends_with(']')) {
      std::size_t count = 0;
      const char* const end = path.data() + path.size() - 1;
      if (std::from_chars(path.data() + open + 1, end, count).ptr != end)
        fail("knownBy", "expected a whole number between [ and ]");
      known.count = count;
      path.resize(open);
    }
    known.path = stepsOf(path);
    return known;
  }

  std::vector<std::vector<Known>> known(const nlohmann::json& value) const {
    std::vector<std::vector<Known>> all;
    if (!value.is_array() || value.empty()) fail("knownBy", "expected a list of places");
    for (const auto& each : value) {
      all.emplace_back();
      for (const std::string& path : texts("knownBy", each)) all.back().push_back(knownPlace(path));
    }
    return all;
  }

  std::vector<Kind::Allowed> allowed(const std::string& name, const nlohmann::json& value) const {
    std::vector<Kind::Allowed> all;
    if (!value.is_object()) fail(name, "expected places and what is allowed there, as in {\"binning\": [0, 1]}");
    for (const auto& [path, values] : value.items()) {
      Kind::Allowed one{stepsOf(path), {}, false, {}};
      for (const auto& each : values.is_array() ? values : nlohmann::json::array({values})) {
        if (each.is_number())
          one.numbers.push_back(each.get<double>());
        else if (each == "identity")
          one.identity = true;
        else if (each.is_string())
          one.sameAs.push_back(stepsOf(each.get<std::string>()));
        else
          fail(name, "expected numbers, \"identity\" or places");
      }
      all.push_back(std::move(one));
    }
    return all;
  }

  [[noreturn]] void fail(const std::string& name, const std::string& message) const {
    Path path = path_;
    path.push_back(name);
    document_.fail(path, message);
  }

  const Document& document_;
  const nlohmann::json& row_;
  Path path_;
  bool isView_;
};

/// Throws for what a row has to say and does not.
void RowReader::requireWhole(const Kind& kind) const {
  const auto needs = [&](const char* what) { document_.fail(path_, std::string("needs ") + what); };
  if (kind.form.empty()) needs("form, what messages call such a file");
  if (kind.known.empty()) needs("knownBy, what such a file is known by");
  if (!kind.words.count("convention")) needs("convention, the name of one");
  const auto views = row_.find("views");
  if (views != row_.end() && !views->is_null() && !kind.cameras.empty())
    document_.fail(path_, "views and cameras do not go together");
  if (kind.has("rows") && (!kind.cameras.empty() || !kind.views.empty() || (views != row_.end() && !views->is_null())))
    fail("rows", "go together with neither cameras nor views");
}

/// Words of which a row says one or, of those in braces, some.
using Ways = std::vector<std::vector<std::string>>;
const std::vector<Ways>& exclusiveWays() {
  static const std::vector<Ways> kWays = {
      {{"size"}, {"width", "height"}},
      {{"K"}, {"intrinsics"}, {"P"}, {"fx", "fy", "fovX", "fovY"}},
      {{"P"}, {"matrix"}, {"rotation", "quaternion", "rotationVector", "euler"}},
      {{"P"}, {"matrix"}, {"translation"}, {"position"}},
      {{"K"}, {"intrinsics"}, {"P"}, {"cx", "cy"}},
  };
  return kWays;
}

/// Of what the row is like, only the ways remain that the row does not say in another.
void RowReader::dropOtherWays(Kind& kind) const {
  const auto says = [&](const std::string& word) { return row_.contains(word) && !row_[word].is_null(); };
  for (const Ways& ways : exclusiveWays())
    for (const auto& own : ways) {
      if (std::none_of(own.begin(), own.end(), says)) continue;
      for (const auto& other : ways)
        if (other != own && own.front() != "cx")
          for (const std::string& word : other) kind.places.erase(word);
    }
}

/// Throws where the row says in two ways where the same numbers stand.
void RowReader::requireOneWay(const Kind& kind) const {
  for (const Ways& ways : exclusiveWays()) {
    const std::string* first = nullptr;
    for (const auto& way : ways) {
      const auto word = std::find_if(way.begin(), way.end(), [&](const std::string& each) { return kind.has(each); });
      if (word == way.end()) continue;
      if (first) fail(*word, "says what " + *first + " does; one of them is expected");
      first = &*word;
    }
  }
  for (const char* const word : {"focalIn", "centerIn"})
    if (kind.word(word) == "sensor" && !kind.has("sensorWidth")) fail(word, "needs sensorWidth beside it");
}

/// Throws where the row leaves open what a rotation means: the camera would stand elsewhere.
void RowReader::requirePoseMeant(const Kind& kind) const {
  for (const char* const word : kTurnWords)
    if (kind.has(word) && !kind.words.count("pose"))
      fail(word, "needs pose beside it, what it maps: cameraFromWorld, worldFromCamera or cameraFromPrevious");
  if (kind.has("quaternion") && !kind.words.count("quaternionOrder"))
    fail("quaternion", "needs quaternionOrder beside it: wxyz or xyzw");
}

/// A word that says how others are meant, and those: it acts on nothing where the row has none of them.
struct Modifier {
  const char* word;
  std::span<const char* const> others;
};
constexpr const char *kFocal[] = {"fx", "fy"}, *kCenter[] = {"cx", "cy"}, *kAngles[] = {"fovX", "fovY"},
                     *kQuaternion[] = {"quaternion"}, *kMatrices[] = {"K", "P", "matrix", "rotation"},
                     *kLengths[] = {"matrix", "translation", "position"};
constexpr Modifier kModifiers[] = {
    {"focalIn", kFocal},  {"centerIn", kCenter}, {"angles", kAngles}, {"quaternionOrder", kQuaternion},
    {"order", kMatrices}, {"pose", kTurnWords},  {"scale", kLengths},
};

/// Throws at a word of this row that acts on nothing.
void RowReader::requireActs(const Kind& kind) const {
  const auto any = [&](const auto& good) {
    return good(kind) || std::any_of(kind.views.begin(), kind.views.end(), good);
  };
  for (const Modifier& modifier : kModifiers) {
    if (!says(modifier.word)) continue;
    std::string names;
    const bool acts = any([&](const Kind& each) {
      return std::any_of(modifier.others.begin(), modifier.others.end(),
                         [&](const char* other) { return each.has(other); });
    });
    for (const char* const other : modifier.others) names += (names.empty() ? "" : " or ") + std::string(other);
    if (!acts) fail(modifier.word, "says how " + names + " is meant, and the row has none");
  }
  for (const char* const word : {"sensorWidth", "sensorHeight"})
    if (says(word) &&
        !any([](const Kind& each) { return each.word("focalIn") == "sensor" || each.word("centerIn") == "sensor"; }))
      fail(word, "counts beside focalIn or centerIn: sensor alone");
  if (says("pose") && kind.word("pose") == "cameraFromPrevious" &&
      !any([](const Kind& each) { return each.has("matrix"); }))
    fail("pose", "is of a link that is a matrix, and the row has no matrix");
  if (says("axes") && !any([](const Kind& each) { return !each.has("P"); }))
    fail("axes", "turn nothing: P has the axes of a picture, RDF");
  if (says("axes")) requireTurn(kind);
  if (says("skipWithout") && kind.cameras.empty())
    fail("skipWithout", "passes over cameras of a list: it needs cameras");
  if (says("name") && !kind.views.empty()) fail("name", "names nothing: views have names of their own");
}

/// Each direction and its opposite: right, up and backward are right-handed.
constexpr std::string_view kLetters = "RLUDBF";

bool isRightHanded(std::string_view axes) {
  std::array<std::size_t, 3> axis{};
  bool isRight = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t at = kLetters.find(axes[i]);
    axis[i] = at / 2;
    if (at % 2 == 1) isRight = !isRight;
  }
  const bool isTurn = (axis[0] + 1) % 3 == axis[1];
  return isRight == isTurn;
}

/// Throws for axes that mirror, where nothing of the file can mirror them back.
void RowReader::requireTurn(const Kind& kind) const {
  const ConventionPreset& preset = *findPreset(kind.words.at("convention"));
  const bool isRight = preset.convention.world == Handedness::right;
  const std::string& axes = kind.words.at("axes");
  if (isRightHanded(axes) == isRight || kind.has("matrix") || kind.has("rotation")) return;
  std::string fitting;
  for (std::size_t i = 0; i < 3; ++i) {
    std::string other = axes;
    other[i] = kLetters[kLetters.find(axes[i]) ^ 1U];
    fitting += (i == 0 ? "" : i == 2 ? " or " : ", ") + other;
  }
  const auto handed = [](bool right) { return std::string(right ? "right-handed" : "left-handed"); };
  fail("axes", "mirror: they are " + handed(!isRight) + ", and the world of " + std::string(preset.name) + " is " +
                   handed(isRight) + ", as " + fitting + " would be");
}

/// Throws for a number that no camera has.
void RowReader::requireRange(const Kind& kind, const char* word) const {
  const auto& number = kind.at(word).constant;
  if (!number) return;
  const std::string_view name = word;
  const auto refuse = [&](const std::string& message) {
    Path path = path_;
    if (row_.contains(word)) path.emplace_back(word);
    document_.fail(path, (row_.contains(word) ? "" : std::string(word) + ": ") + message);
  };
  if (name == "cx" || name == "cy") {
    if (!std::isfinite(*number)) refuse("expected a finite number");
  } else if (name == "fovX" || name == "fovY") {
    const bool inRadians = kind.word("angles") == "radians";
    if (!(*number > 0 && *number < (inRadians ? std::numbers::pi : 180)))
      refuse(std::string("expected an angle between 0 and ") + (inRadians ? "pi radians" : "180 degrees"));
  } else if (!(*number > 0) || (name != "far" && !std::isfinite(*number))) {
    refuse(name == "far" ? "expected a number above 0" : "expected a finite number above 0");
  }
}

/// Throws where no file of the kind could give a camera.
void RowReader::requireCamera(const Kind& kind) const {
  for (const std::string_view word : kNumberWords) requireRange(kind, word.data());
  const auto &near = kind.at("near").constant, &far = kind.at("far").constant;
  if (near && far && !(*far > *near)) fail(says("far") ? "far" : "near", "expected far to be beyond near");
  if (std::none_of(std::begin(kLensWords), std::end(kLensWords), [&](const char* word) { return kind.has(word); }))
    document_.fail(path_, "needs a focal length: one of K, intrinsics, P, fx, fy, fovX and fovY");
}

void RowReader::readViews(Kind& kind, const nlohmann::json& value) const {
  kind.views.clear();
  if (value.is_null()) return;
  if (!value.is_object() || value.empty()) fail("views", "expected names, and for each what differs");
  std::vector<Kind> views;
  for (const auto& [name, row] : value.items()) {
    Path path = path_;
    path.insert(path.end(), {"views", name});
    views.push_back(RowReader(document_, row, path, true).over(kind));
    views.back().view = name;
  }
  kind.views = std::move(views);
  // What one view reads contradicts no other.
  for (Kind& view : kind.views)
    for (const Kind& other : kind.views)
      for (const auto& [word, where] : other.places)
        for (const Steps& steps : where.paths)
          if (other.view != view.view && !steps.empty()) view.passedOver.push_back(steps.back());
}

/// "cam_K", "K or camera_matrix or ...".
std::string textOf(const std::vector<std::vector<Known>>& known) {
  std::string text;
  constexpr std::size_t kMost = 3;  // alternatives
  for (const std::vector<Known>& choice : known) {
    text += text.empty() ? "" : ", ";
    std::vector<std::string> names;
    for (const Known& place : choice)  // the same place may have several shapes
      if (names.empty() || names.back() != dotted(place.path)) names.push_back(dotted(place.path));
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i == 0 ? "" : " or ") + names[i];
    if (names.size() > kMost) text += " or ...";
  }
  return text;
}

const Kind* kindNamed(std::span<const Kind> kinds, std::string_view name) {
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

}  // namespace

std::vector<Kind> readKinds(const Document& document, std::span<const Kind> earlier) {
  const nlohmann::json* rows = &document.root();
  Path path;
  for (const char* const key : {"", "kinds"})  // "": a document that is an array
    if (const auto list = rows->find(key); list != rows->end() && list->is_array()) {
      path = {key};
      rows = &*list;
      break;
    }
  std::vector<Kind> kinds;
  const auto read = [&](const nlohmann::json& row, const Path& at) {
    Kind base;
    if (row.is_object() && row.contains("like")) {
      const std::string name = row["like"].is_string() ? row["like"].get<std::string>() : "";
      const Kind* const other = kindNamed(kinds, name) ? kindNamed(kinds, name) : kindNamed(earlier, name);
      if (!other) {
        Path like = at;
        like.emplace_back("like");
        document.fail(like, "is the name of no kind before this one");
      }
      base = *other;
      base.help.clear();
    }
    Kind kind = RowReader(document, row, at).over(std::move(base));
    kind.help = "known by " + textOf(kind.known) + (kind.help.empty() ? "" : "; " + kind.help);
    kinds.push_back(std::move(kind));
  };
  if (!rows->is_array()) {
    read(*rows, path);
    return kinds;
  }
  if (rows->empty())
    document.fail(document.isArray() ? Path() : path, "has no row: expected an object, a kind of camera file");
  for (std::size_t i = 0; i < rows->size(); ++i) {
    Path at = path;
    at.push_back(std::to_string(i));
    read((*rows)[i], at);
  }
  return kinds;
}

}  // namespace viewproj::cmd
