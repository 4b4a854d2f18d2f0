// Text with keys and tables. TOML, INI, MATLAB's assignments and the calibration files of many programs are text with
// keys.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/tree.hpp"
#include "text/csv.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

/// A number of a text, inf and nan included, and one that ends a sentence.
std::optional<double> numberIn(std::string_view word) {
  if (const auto number = parseNumber(word)) return number;
  if (word.size() > 1 && word.ends_with('.') && word.find('.') + 1 < word.size())
    return parseNumber(word.substr(0, word.size() - 1));
  const bool isNegative = word.starts_with('-');
  if (isNegative || word.starts_with('+')) word.remove_prefix(1);
  if (sameButForCase(word, "nan")) return std::numeric_limits<double>::quiet_NaN();
  if (!sameButForCase(word, "inf")) return std::nullopt;
  return isNegative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

/// A name of the text: none ends with #, under which the other values of a name are kept.
std::string nameIn(std::string_view word) { return std::string(word.substr(0, word.find_last_not_of('#') + 1)); }

/// The line without a comment, which begins with #, // or % at the start or after a blank.
std::string_view withoutComment(std::string_view line) {
  for (std::size_t at = 0; at < line.size(); ++at)
    if ((at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t') &&
        (line[at] == '#' || line[at] == '%' || line.substr(at, 2) == "//"))
      return line.substr(0, at);
  return line;
}

class TextReader {
 public:
  /// hasSections: lines of words alone in front of lines with names open objects, as [heading] does.
  explicit TextReader(bool hasSections) : hasSections_(hasSections) {}

  void readLine(std::string_view line) {
    std::string_view text = withoutComment(line);
    if (const std::size_t first = text.find_first_not_of(" \t");
        first < text.size() && text.substr(first, 2) == "- " && isLetter(text[std::min(first + 2, text.size() - 1)]))
      text.remove_prefix(first + 2);  // an item of a list
    const std::string_view bare = trimmed(text);
    if (bare.size() > 2 && bare.front() == '[' && (isLetter(bare[1]) || bare[1] == '_') &&
        bare.find(']') == bare.size() - 1) {
      close();
      key_.clear();
      Json& box = root_[nameIn(bare.substr(1, bare.size() - 2))];
      if (!box.is_object()) box = Json::object();
      box_ = &box;
      return;
    }
    if (bare.empty()) {
      if (isBlank(line)) endBlock();
      return;
    }
    const bool isHeading = hasSections_ && isWords(bare);
    if (isHeading && headings_.size() > 1) headings_.erase(headings_.begin());
    if (isHeading)
      headings_.emplace_back(bare);
    else
      openSection(bare);
    if (!isHeading && readSeveral(text)) return;
    std::vector<std::string_view> words = partsOf(text, " \t[](){};,=<>|");
    while (words.size() > 1 && isCallee(text, words.front())) words.erase(words.begin());
    std::size_t lead = 0;
    while (lead < words.size() && !numberIn(words[lead])) ++lead;
    if (lead > 0) {
      close();
      key_.clear();
      for (std::size_t i = 0; i < lead; ++i) key_.append(i > 0 ? "_" : "").append(stripped(words[i], "\":'"));
      key_ = stripped(key_, "_:");
    }
    std::vector<double> row;
    for (std::size_t i = lead; i < words.size() && numberIn(words[i]); ++i) row.push_back(*numberIn(words[i]));
    if (row.empty()) return keepText(text);
    if (row.size() == 1 && words.back() == "*" && words.size() == lead + 2) {  // 1.0e+03 * of MATLAB
      factor_ = row.front();
      return;
    }
    const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), ';')) + 1;
    const bool isMatrix = rows > 1 && text.find('[') != std::string_view::npos &&
                          text.find("];") == std::string_view::npos && row.size() % rows == 0;
    const std::size_t columns = isMatrix ? row.size() / rows : row.size();
    for (auto at = row.begin(); at != row.end(); at += static_cast<std::ptrdiff_t>(columns))
      block_.emplace_back(at, at + static_cast<std::ptrdiff_t>(columns));
  }

  Json finished() {
    close();
    return blocks_ > 0 ? std::move(root_) : Json::object();
  }
  /// Sections under words without a colon, which YAML has not.
  std::size_t plainHeadings() const { return plainHeadings_; }

 private:
  static std::string_view stripped(std::string_view text, std::string_view characters) {
    const std::size_t first = text.find_first_not_of(characters);
    if (first == std::string_view::npos) return "";
    return text.substr(first, text.find_last_not_of(characters) + 1 - first);
  }

  /// Whether a word makes the list or matrix in the bracket behind it: array([[1, 2]]).
  static bool isCallee(std::string_view text, std::string_view word) {
    const std::size_t end = static_cast<std::size_t>(word.data() - text.data()) + word.size();
    return (word.ends_with("array") || word.ends_with("tensor") || word.ends_with("Matrix")) && end < text.size() &&
           text[end] == '(';
  }

  /// Whether a line has no value behind a mark, as 'Intrinsic of "Depth" / 640x480' and "Color camera:".
  static bool isWords(std::string_view line) {
    const std::size_t mark = line.find_first_of("=:");
    const std::vector<std::string_view> words = partsOf(line, " \t[](){};,=<>");
    return !words.empty() && !numberIn(words.front()) &&
           (mark == std::string_view::npos ? !numberIn(words.back()) : mark + 1 == line.size());
  }

  /// The words above a line with a name, and what stands above the words over numbers alone.
  void openSection(std::string_view line) {
    const std::vector<std::string_view> words = partsOf(line, " \t[](){};,=<>");
    const bool isNumbers = !words.empty() && numberIn(words.front());
    const std::size_t count = isNumbers ? 2 : 1;
    if (headings_.size() >= count) {
      const std::string& heading = headings_[headings_.size() - count];
      plainHeadings_ += heading.ends_with(':') ? 0 : 1;
      std::string name;
      for (const std::string_view word : partsOf(heading, " \t\"'/:#[](){}<>=,;"))
        name.append(name.empty() ? "" : "_").append(word);
      if (root_.contains(name)) name += "_" + std::to_string(++sectionsOf_[name] + 1);
      box_ = &(root_[name] = Json::object());
    }
    headings_.clear();
  }

  Json& box() { return box_ ? *box_ : root_; }

  static bool isAmong(char c, std::string_view characters) { return characters.find(c) != std::string_view::npos; }

  static bool isName(std::string_view word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
      return isLetter(c) || isDigit(c) || isAmong(c, "_.-") || static_cast<unsigned char>(c) > 127;
    });
  }

  /// "fx = 1462.5, fy 1460.2", "640x480 f[610 611]", "pose {position = {x=1, y=2}}", "Location: X=1 Y=2": whether the
  /// line has several names with numbers, or names within names, which are then kept.
  bool readSeveral(std::string_view text) {
    struct Level {  // of brackets
      std::string opener, heading;
    };
    std::vector<Level> levels(1);
    std::vector<std::pair<std::string, std::vector<double>>> found;
    std::vector<std::pair<std::string, std::string>> texts;
    std::string heading, name;  // a heading if a mark follows the name too, else the name is its text
    bool isAssigned = false, goesOn = false, isNested = false;  // goesOn: a number belongs to the one before it
    const auto add = [&](double number) {
      if (goesOn && name.empty()) return found.back().second.push_back(number);
      std::string path;
      std::size_t depth = 0;
      const auto step = [&](const std::string& each) {
        if (!each.empty()) path.append(depth++ > 0 ? "." : "").append(each);
      };
      for (const Level& level : levels) {
        step(level.opener);
        step(level.heading);
      }
      step(name);
      isNested = isNested || depth > 1;
      goesOn = depth > 0;
      if (goesOn && (found.empty() || found.back().first != path)) found.emplace_back(path, 0);
      if (goesOn) found.back().second.push_back(number);
      name.clear();
      heading.clear();
      isAssigned = false;
    };
    const auto endName = [&] {
      if (!heading.empty() && !name.empty()) texts.emplace_back(std::exchange(heading, ""), name);
      name.clear();
    };
    constexpr std::string_view kMarks = " \t=:,;[{(<>)}]|";
    constexpr std::ptrdiff_t kPairs = 3;
    const bool hasAxes = text.find(" Y ") != text.npos && text.find(" Z ") != text.npos;
    const bool hasPairs = std::count(text.begin(), text.end(), '=') >= kPairs;
    const bool hasAngles = text.find('>') != std::string_view::npos;  // << alone is no bracket
    for (std::size_t at = 0; at < text.size();) {
      const char c = text[at];
      if (isAmong(c, kMarks)) {
        const bool isMark = isAmong(c, "=:"), isOpening = isAmong(c, "[{(") || (c == '<' && hasAngles),
                   isBracket = isOpening || isAmong(c, ")}]>");
        if (isMark && !name.empty() && !heading.empty()) levels.back().heading = std::exchange(heading, "");
        constexpr std::size_t kDeepestNames = 20;
        if (isOpening) levels.push_back({name, ""});
        // What <Pinhole fx=1> has after its bracket is its type.
        if (c == '<' && isOpening && at + 1 < text.size() && isLetter(text[at + 1]))
          at = std::min(text.find_first_of(kMarks, at + 1), text.size()) - 1;
        if (levels.size() > kDeepestNames) return false;
        if (isBracket && !isOpening && levels.size() > 1) levels.pop_back();
        if (isBracket) name.clear();
        if (isAmong(c, ",;")) endName();
        goesOn = goesOn && !isBracket;
        isAssigned = isMark || (isAssigned && isAmong(c, " \t"));
        ++at;
        continue;
      }
      const std::size_t end = std::min(text.find_first_of(kMarks, at), text.size());
      const std::string_view word = text.substr(at, end - at);
      const std::size_t by = word.find('x');
      at = end;
      if (const auto number = numberIn(word)) {
        if (found.empty() && name.empty() && levels.size() == 1) return false;  // a row of numbers
        add(*number);
      } else if (isSize(word)) {
        if (name.empty()) name = "size";
        add(*parseNumber(word.substr(0, by)));
        add(*parseNumber(word.substr(by + 1)));
        goesOn = false;
      } else if (!isName(stripped(word, "\"'"))) {
        name.clear();
        goesOn = isAssigned = false;
      } else if (word.ends_with('.') || word == "and" || word == "with" || word == "is" || word == "are" ||
                 word == "has" || word == "at") {
        isAssigned = true;  // words of prose are no names
      } else {
        if (isAssigned) heading = std::exchange(name, "");
        isAssigned = false;
        // "cam1 fx=1 fy=2 cx=3" and "Position X 1 Y 2 Z 3"
        const bool isFirst = found.empty() && texts.empty() && levels.size() == 1 && levels.back().heading.empty();
        const bool isOfSeveral = hasAxes ? sameButForCase(word, "x") : hasPairs && text.substr(at).starts_with('=');
        if (isFirst && isOfSeveral) levels.back().heading = std::exchange(name, "");
        name.append(name.empty() ? "" : "_").append(stripped(word, "\"'"));
      }
    }
    if (found.size() < 2 && !isNested) return false;
    endName();
    close();
    key_.clear();
    blocks_ += found.size();
    for (auto& [path, value] : texts) put(box(), path, std::move(value));
    for (auto& [path, numbers] : found) put(box(), path, numbers.size() == 1 ? Json(numbers.front()) : Json(numbers));
    return true;
  }

  /// 640x480, and not the 3x3 of a matrix.
  static bool isSize(std::string_view word) {
    const std::size_t by = word.find('x');
    if (by == std::string_view::npos) return false;
    const auto width = parseNumber(word.substr(0, by)), height = parseNumber(word.substr(by + 1));
    constexpr double kLeast = 5;  // more than a matrix has
    return width && height && *width >= kLeast && *height >= kLeast;
  }

  static bool isPicture(std::string_view name) {
    const std::string_view kind = name.substr(std::min(name.rfind('.'), name.size()));
    return std::any_of(std::begin(kPictures), std::end(kPictures),
                       [&](const char* picture) { return sameButForCase(kind, picture); });
  }

  /// pose.position is a member of pose. Of one name several values are a list beside the first.
  static void put(Json& box, std::string_view word, Json value) {
    const std::string name = nameIn(word);
    const std::size_t dot = name.find('.');
    constexpr std::size_t kLongest = 200;  // of a name that has members
    if (name.size() < kLongest && !isPicture(name) && dot != std::string::npos && dot > 0 && dot + 1 < name.size() &&
        isLetter(name[dot + 1])) {
      Json& inner = box[nameIn(name.substr(0, dot))];
      if (inner.is_null()) inner = Json::object();
      if (inner.is_object()) return put(inner, name.substr(dot + 1), std::move(value));
    }
    if (box.emplace(name, value).second) return;
    Json& list = box[name + "#"];
    if (!list.is_array()) list = Json::array();
    list.push_back(std::move(value));
  }

  /// name = "text"
  void keepText(std::string_view text) {
    const std::size_t sign = text.find_first_of("=:");
    if (sign == std::string_view::npos) return;
    const std::string name(stripped(trimmed(text.substr(0, sign)), "\"'"));
    const std::string_view value = stripped(text.substr(sign + 1), " \t\r;,");
    if (!name.empty() && !value.empty()) put(box(), name, stripped(value, "\"'"));
    key_ = name;
    std::replace_if(
        key_.begin(), key_.end(), [](char c) { return c == ' ' || c == '\t'; }, '_');
  }

  void endBlock() {
    close();
    if (box().contains(key_)) key_.clear();
  }

  /// Three whole numbers and a matrix of 4 rows, in turn: a trajectory of Open3D.
  bool isTrajectory() const {
    if (block_.empty() || block_.size() % 5 != 0) return false;
    for (std::size_t i = 0; i < block_.size(); ++i)
      if (block_[i].size() != (i % 5 == 0 ? 3 : 4) || (i % 5 == 4 && block_[i] != std::vector<double>{0, 0, 0, 1}))
        return false;
    return true;
  }

  void close() {
    if (block_.empty()) return;
    ++blocks_;
    for (std::vector<double>& row : block_)
      for (double& number : row) number *= factor_;
    factor_ = 1;
    const std::size_t columns = block_.front().size();
    const bool isMatrix =
        block_.size() > 1 && columns > 1 &&
        std::all_of(block_.begin(), block_.end(), [&](const auto& row) { return row.size() == columns; });
    Json value = Json::array();
    const bool areTimed = isTrajectory();
    for (std::size_t i = 0; i < block_.size() && areTimed; ++i)
      if (i % 5 == 0)
        value.push_back(Json::array());
      else
        for (const double number : block_[i]) value.back().push_back(number);
    if (areTimed) block_.clear();
    for (const auto& row : block_) {
      if (isMatrix)
        value.push_back(row);
      else
        for (const double number : row) value.push_back(number);
    }
    if (value.size() == 1 && value.front().is_number()) value = Json(value.front());
    const std::string name = key_.empty() ? "#" + std::to_string(blocks_) : key_;
    put(box(), name, std::move(value));
    block_.clear();
  }

  static constexpr const char* kPictures[] = {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".dng", ".bmp"};

  const bool hasSections_;
  std::vector<std::string> headings_;                        ///< the last two of the lines before
  std::unordered_map<std::string, std::size_t> sectionsOf_;  ///< that had a name again
  std::size_t plainHeadings_ = 0;
  Json root_ = Json::object();
  Json* box_ = nullptr;  ///< of the last heading
  std::string key_;
  double factor_ = 1;  ///< of the next block
  std::vector<std::vector<double>> block_;
  std::size_t blocks_ = 0;
};

template <class Read>
void eachLine(std::string_view text, const Read& read) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    at = end + 1;
    if (!read(line)) return;
  }
}

/// The cells of a line: CSV, or parts between blanks.
std::vector<std::string> cellsOf(std::string_view line, char separator) {
  std::vector<std::string> cells;
  if (separator == ' ') {
    for (const std::string_view part : partsOf(line, " \t")) cells.emplace_back(part);
    return cells;
  }
  CsvRecord record;
  record.split(line, separator);
  for (const std::string_view field : record.fields) cells.push_back(csvValue(trimmed(field)));
  return cells;
}

/// A header is made of names; nearly all of them have letters.
bool isHeader(const std::vector<std::string>& names) {
  const auto isName = [](std::string_view word) {
    return !numberIn(word) && std::any_of(word.begin(), word.end(), isLetter);
  };
  constexpr std::size_t kLeast = 4;
  return names.size() >= kLeast && 10 * std::count_if(names.begin(), names.end(), isName) >= 9 * std::ssize(names);
}

}  // namespace

Json textTree(std::string_view text, bool* hasHeadings) {
  std::size_t headings = 0;
  const auto read = [&](bool hasSections) {
    TextReader reader(hasSections);
    eachLine(text, [&](std::string_view line) {
      reader.readLine(line);
      return true;
    });
    headings = reader.plainHeadings();
    return reader.finished();
  };
  // Where names come again, words above them tell what each is of.
  constexpr std::size_t kLeast = 3;
  std::vector<std::string> names;
  Json tree = read(false);
  for (const auto& [name, value] : tree.items())
    if (name.ends_with('#')) names.push_back(name.substr(0, name.size() - 1));
  // A text in which names come again together is a list: those that come once in a round do so in each, and those that
  // stand once in the text are of all.
  std::size_t rounds = names.size() > 1 ? SIZE_MAX : 0;
  for (const std::string& name : names) rounds = std::min(rounds, tree[name + "#"].size() + 1);
  const auto isEven = [&](const std::string& name) { return (tree[name + "#"].size() + 1) % rounds == 0; };
  Json shared = Json::object();
  for (const auto& [name, value] : tree.items())
    if (rounds > 0 && !name.ends_with('#') && !tree.contains(name + "#")) shared[name] = value;
  constexpr std::size_t kMostCopied = 1 << 20;
  if (rounds > 0 && std::all_of(names.begin(), names.end(), isEven) &&
      rounds * shared.dump(-1, ' ', false, Json::error_handler_t::replace).size() <= kMostCopied) {
    Json list = Json::array();
    for (std::size_t i = 0; i < rounds; ++i) {
      list.push_back(shared);
      for (const std::string& name : names) {
        const std::size_t each = (tree[name + "#"].size() + 1) / rounds;
        const auto valueAt = [&](std::size_t k) { return k > 0 ? tree[name + "#"][k - 1] : tree[name]; };
        list[i][name] = valueAt(i * each);
        for (std::size_t k = 1; k < each; ++k) list[i][name + "#"].push_back(valueAt(i * each + k));
      }
    }
    tree = std::move(list);
  }
  if (names.size() < kLeast) return tree;
  Json sections = read(true);
  std::unordered_map<std::string, std::size_t> sectionsWith;
  for (const Json& section : sections)
    if (section.is_object())
      for (const auto& [name, value] : section.items())
        if (!section.contains(name + "#")) ++sectionsWith[name];
  if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return sectionsWith[name] < 2; }))
    return tree;
  if (hasHeadings) *hasHeadings = headings > 1;
  return sections;
}

Json tagTree(std::string_view text) {
  Json pictures = Json::array();
  bool areTags = text.find("GPS") != std::string_view::npos, hasPlace = false;
  eachLine(text, [&](std::string_view line) {
    const std::size_t colon = line.find(':');
    const bool isFile = line.starts_with("======== ");
    if (isFile || pictures.empty()) pictures.push_back(Json::object());
    if (isFile) pictures.back()["SourceFile"] = trimmed(line.substr(line.find(' ')));
    if (isFile || isBlank(line) || line.starts_with("---- ")) return true;
    if (colon == std::string_view::npos) return areTags = false;
    std::string name;
    for (const char c : line.substr(0, colon))
      if (isLetter(c) || isDigit(c))
        name += c;
      else if (c == ']')
        name += ':';  // after a group
    hasPlace = hasPlace || name.ends_with("GPSLatitude");
    const std::string value(trimmed(line.substr(colon + 1)));
    const auto number = numberIn(value);
    pictures.back().emplace(name, number && formatNumber(*number) == value ? Json(*number) : Json(value));
    return areTags;
  });
  return areTags && hasPlace ? pictures : Json();
}

Json tableTree(std::string_view text) {
  std::vector<std::string_view> lines;
  eachLine(text, [&](std::string_view line) {
    if (!isBlank(line)) lines.push_back(line);
    return lines.size() < 4;
  });
  for (std::size_t header = 0; header < 3 && header + 1 < lines.size(); ++header)
    for (const char separator : {',', '\t', ';', ' '}) {
      std::string_view first = trimmed(lines[header]);
      while (first.starts_with('#')) first = trimmed(first.substr(1));
      const std::vector<std::string> names = cellsOf(first, separator);
      if (!isHeader(names)) continue;
      // The header of a table of blanks may have commas.
      for (const char between : {separator, ' '}) {
        Json rows = Json::array();
        std::size_t numbers = 0, words = 0;  // of the first row
        bool isTable = true;
        eachLine(text.substr(static_cast<std::size_t>(lines[header].data() - text.data()) + lines[header].size()),
                 [&](std::string_view line) {
                   if (isBlank(line)) return true;
                   const std::vector<std::string> cells = cellsOf(line, between);
                   if (cells.size() != names.size()) return isTable = false;
                   Json row = Json::object();
                   for (std::size_t i = 0; i < names.size(); ++i) {
                     const auto number = numberIn(cells[i]);
                     // A name may be 007, or a time in nanoseconds.
                     const bool isExact = number && formatNumber(*number) == cells[i];
                     const std::vector<std::string_view> parts = partsOf(cells[i], " ,;[]");
                     const bool areNumbers = std::all_of(parts.begin(), parts.end(), numberIn);
                     if (rows.empty() && !parts.empty()) ++(areNumbers ? numbers : words);
                     row.emplace(names[i], isExact ? Json(*number) : Json(cells[i]));
                   }
                   if (rows.empty() && numbers < words) return isTable = false;
                   rows.push_back(std::move(row));
                   return true;
                 });
        if (isTable && !rows.empty()) return rows;
      }
    }
  return nullptr;
}

}  // namespace viewproj::cmd
