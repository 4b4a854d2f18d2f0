#include "records/record_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "text/json_scan.hpp"
#include "text/json_text.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// The most that a pattern stores.
constexpr std::size_t kMostValues = 1024, kMostCommon = 16384;  // bytes
/// Nesting of arrays and objects in a field that is not read.
constexpr int kDeepest = 16;

/// The text must contain a comma or a bracket.
std::string_view withoutSpaceAround(std::string_view text) {
  while (isJsonSpace(text.front())) text.remove_prefix(1);
  while (isJsonSpace(text.back())) text.remove_suffix(1);
  return text;
}

/// Whether the text is a record only in some places: it begins like an array of records or a document of them, or like
/// an array that may contain a line that begins a record.
bool isRecordOnlyInSomePlaces(const RecordParts& record) {
  if (!record.shape.isArray) return record.shape.find(kRecordsField) == 0 && record.values[0].starts_with('[');
  return std::any_of(record.values.begin(), record.values.end(),
                     [](std::string_view value) { return opensJson(value[0]); });
}

/// For each field, whether it may have any value: the layout does not use it, and the record stays a record.
std::vector<bool> freeFields(const RecordParts& record, const Layout& layout) {
  const Shape& shape = record.shape;
  std::vector<bool> isFree(record.values.size(), !shape.isArray);
  for (const NumberField& part : layout.parts) isFree[part.field] = false;
  for (const FormOfField& form : layout.forms) isFree[form.field] = false;
  if (shape.find(kRecordsField) == 0) isFree[0] = false;
  return isFree;
}

}  // namespace

RecordPattern::RecordPattern(const RecordParts& record, const Layout& layout, const Numbers& numbers,
                             const NumberTexts& texts) {
  if (record.values.size() > kMostValues || isRecordOnlyInSomePlaces(record)) return;
  for (std::size_t i = 0; i < layout.slots(); ++i) {
    if (texts[i].empty() && !std::isnan(numbers[i])) return;
    absent_[i] = numbers[i];
  }
  const std::string_view text = record.text;
  const std::vector<bool> isFree = freeFields(record, layout);
  std::size_t done = 0;
  const auto addPiece = [&](std::size_t begin, std::size_t end, Kind kind) {
    const auto slot = std::find_if(texts.begin(), texts.end(),
                                   [&](std::string_view value) { return value.data() == text.data() + begin; });
    const std::string_view before = withoutSpaceAround(text.substr(done, begin - done));
    common_ += before;
    pieces_.push_back({before.size(), kind, static_cast<std::size_t>(slot - texts.begin())});
    done = end;
  };
  for (std::size_t field = 0; field < record.values.size(); ++field) {
    const std::string_view value = record.values[field];
    const std::size_t begin = record.offset(field);
    if (isFree[field]) {
      addPiece(begin, begin + value.size(), Kind::any);
      continue;
    }
    for (std::size_t at = 0; at < value.size();) {
      const char c = value[at];
      if (c != '"' && c != 't' && c != 'f' && !beginsJsonNumber(c)) {
        ++at;
        continue;
      }
      const std::size_t end = endOfValue(value, at);
      const char* const after = passJsonSpace(value.data() + end, value.data() + value.size());
      const bool isName = c == '"' && after < value.data() + value.size() && *after == ':';
      if (!isName)
        addPiece(begin + at, begin + end, c == '"' ? Kind::string : beginsJsonNumber(c) ? Kind::number : Kind::flag);
      at = end;
    }
  }
  common_ += withoutSpaceAround(text.substr(done));
  if (common_.size() > kMostCommon || pieces_.size() > kMostValues) *this = {};
}

std::size_t RecordPattern::read(std::string_view text, Numbers& numbers) const {
  if (isEmpty()) return 0;
  const char* at = text.data();
  const char* const end = at + text.size();
  const char* common = common_.data();
  const auto passCommon = [&](std::size_t size) {
    if (static_cast<std::size_t>(end - at) < size || std::memcmp(at, common, size) != 0) return false;
    at += size;
    common += size;
    return true;
  };
  std::copy(absent_.begin(), absent_.end(), numbers.begin());
  for (const Piece& piece : pieces_) {
    if (!passCommon(piece.size)) return 0;
    at = passJsonSpace(at, end);
    double unused = 0;
    switch (piece.kind) {
      case Kind::number:
        at = readJsonNumber(at, end, piece.slot == kNoSlot ? unused : numbers[piece.slot]);
        break;
      case Kind::string:
        at = passJsonString(at, end);
        break;
      case Kind::flag:
        at = passJsonFlag(at, end);
        break;
      case Kind::any:
        at = passJson(at, end, kDeepest);
        break;
    }
    if (!at) return 0;
    at = passJsonSpace(at, end);
  }
  const auto left = static_cast<std::size_t>(common_.data() + common_.size() - common);
  return passCommon(left) ? static_cast<std::size_t>(at - text.data()) : 0;
}

}  // namespace viewproj::cmd
