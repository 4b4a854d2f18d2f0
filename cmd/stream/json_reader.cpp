// The one file that knows simdjson. Records that are like one of before but for numbers and strings are read by its
// pattern, the others by simdjson. What that rejects, or what is of a shape not met before, goes to the parts that
// nlohmann-json judges: so that is valid which nlohmann-json calls valid, and its words are in the messages.
#include <simdjson.h>

#include <algorithm>
#include <limits>
#include <span>

#include "stream/batch.hpp"
#include "stream/json_splitter.hpp"
#include "text/json_text.hpp"

namespace viewproj::cmd {
namespace {

namespace dom = simdjson::dom;

static_assert(simdjson::SIMDJSON_PADDING <= ByteBuffer::kPadding);

constexpr std::size_t npos = std::string_view::npos;
bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// False where it is none, or -0 written as an integer, whose sign simdjson drops.
bool readNumber(dom::element value, std::string_view record, double& number) {
  if (value.get_double().get(number) != simdjson::SUCCESS) return false;
  return number != 0 || value.type() == dom::element_type::DOUBLE || record.find("-0") == npos;
}

/// What a part is of its field's value.
bool readInner(dom::element& value, const NumberField& part) {
  dom::object object;
  if (!part.inner.empty()) {
    if (value.get_object().get(object)) return false;
    std::size_t count = 0;
    for (const auto [name, inner] : object)
      if (name == part.inner && count++ == 0) value = inner;
    return count == 1;
  }
  dom::array array;
  if (part.items == 0) return true;
  return !value.get_array().get(array) && array.size() == part.items && !array.at(part.item).get(value);
}

constexpr std::string_view kXyz[] = {"x", "y", "z"};

/// A point as an object of x, y, z in order; false for any other, which may be one all the same.
bool readXyz(const dom::object& object, std::string_view record, double* numbers) {
  std::size_t count = 0;
  for (const auto [name, value] : object) {
    if (count == std::size(kXyz) || name != kXyz[count] || !readNumber(value, record, numbers[count])) return false;
    ++count;
  }
  return count == std::size(kXyz);
}

/// As readNumbers; false where it would throw, and for points as other objects.
bool readNumbers(const std::vector<dom::element>& values, const Layout& layout, std::string_view record,
                 Numbers& numbers) {
  double* slot = numbers.data();
  for (const NumberField& part : layout.parts) {
    dom::element value = values[part.field];
    if (!readInner(value, part)) return false;
    std::size_t count = 0;
    if (part.mayBeAbsent && value.is_null()) {
      // no numbers
    } else if (dom::object object; part.point != PointForm::none && !value.get_object().get(object)) {
      if (!readXyz(object, record, slot)) return false;
      count = std::size(kXyz);
    } else if (part.isArray) {
      dom::array array;
      if (value.get_array().get(array)) return false;
      for (dom::element item : array)
        if (count == part.most || !readNumber(item, record, slot[count++])) return false;
      if (count < part.fewest || (count == 3 && part.point == PointForm::ofTheEarth)) return false;
    } else if (!readNumber(value, record, slot[count++])) {
      return false;
    }
    for (; count < part.most; ++count) slot[count] = std::numeric_limits<double>::quiet_NaN();
    slot += part.most;
  }
  return true;
}

class JsonReader final : public RecordReader {
 public:
  explicit JsonReader(bool fast) : fast_(fast) {
#ifdef SIMDJSON_THREADS_ENABLED
    parser_.threaded = false;
#endif
  }

  void read(Block& block, Batch& batch) override {
    batch_ = &batch;
    text_ = block.records;
    bad_ = block.bad;
    // Where the last record is none, as [1,2 3], parse_many cuts it short and takes the byte after the text, whatever
    // it is, for what comes next.
    if (!text_.empty()) *(block.bytes.data() + (text_.data() - block.bytes.data()) + text_.size()) = 0;
    if (block.inArray)
      readElements();
    else
      readPieces(block);
  }

 private:
  /// How many records are read one by one after one that the fast way rejected: more and more, so that many of them do
  /// not cost a pass over the rest each.
  static constexpr std::size_t kOneByOne = 32;

  /// Records of a block that may be read one by one between those that are alike, and one for every four of those.
  static constexpr std::size_t kFewOthers = 8;

  /// Plans used last whose patterns are tried.
  static constexpr std::size_t kPatterns = 4;

  /// Bytes. Of what is longer, simdjson would need several times its size at once.
  static constexpr std::size_t kMostFast = 256 << 10;

  bool mayReadMany(std::size_t at) const { return fast_ && at < text_.size() && text_.size() - at <= kMostFast; }

  /// All records up to the first that is not an ordinary one. Returns where that begins, or the end.
  std::size_t readMany(std::size_t begin) {
    begin = readAlike(begin);
    if (begin == text_.size()) return begin;
    const std::size_t size = text_.size() - begin;
    dom::document_stream stream =
        parser_.parse_many(text_.data() + begin, size, std::max(size, dom::MINIMAL_BATCH_SIZE));
    std::size_t done = begin;
    for (auto document = stream.begin(); document != stream.end(); ++document) {
      dom::element value;
      if ((*document).get(value)) break;
      const std::string_view source = document.source();
      if (!add(value, source)) break;
      done = offset(source) + source.size();
    }
    return skipSpace(done);
  }

  /// Records as they were before but for their numbers and strings, and some others between them. Returns where the
  /// first one begins that is left, or the end.
  std::size_t readAlike(std::size_t at) {
    at = skipSpace(at);
    for (std::size_t alike = 0, others = 0; at < text_.size(); at = skipSpace(at)) {
      if (const std::size_t size = addAlike(at)) {
        at += size;
        ++alike;
        continue;
      }
      if (others++ > kFewOthers + alike / 4) break;
      const std::string_view record = text_.substr(at, endOfValue(text_, at) - at);
      dom::element value;
      if (parser_.parse(record.data(), record.size(), false).get(value) || !add(value, record)) break;
      Plan& plan = *batch_->plans().front();
      plan.pattern = RecordPattern(jsonParts(record), plan.layout);
      at += record.size();
    }
    return at;
  }

  /// Returns how long the record is that begins there, or 0 if it is like none of before.
  std::size_t addAlike(std::size_t at) {
    const auto& plans = batch_->plans();
    Numbers numbers;
    for (std::size_t i = 0; i < std::min(plans.size(), kPatterns); ++i) {
      const Plan& plan = *plans[i];
      const std::size_t size = plan.pattern.read(text_.substr(at), numbers);
      if (size == 0) continue;
      const std::string_view record = text_.substr(at, size);
      passBadBefore(record);
      batch_->usedAgain(i);
      batch_->add(record, plan, numbers);
      return size;
    }
    return 0;
  }

  /// An array's records, separated by white space, and between them what the block says is wrong.
  void readElements() {
    std::size_t oneByOne = kOneByOne;
    for (std::size_t at = skipSpace(0); at < text_.size(); oneByOne *= 2) {
      if (mayReadMany(at)) at = readMany(at);
      for (std::size_t i = 0; i < oneByOne && at < text_.size(); ++i) {
        const std::size_t end = endOfValue(text_, at);
        readRecord(text_.substr(at, end - at));
        at = skipSpace(end);
      }
    }
    passBadBefore(text_.substr(text_.size()));
  }

  /// What is missing before a record stands where it begins.
  void passBadBefore(std::string_view record) {
    for (; !bad_.empty() && bad_.front().begin <= offset(record); bad_ = bad_.subspan(1)) {
      const Block::Bad& bad = bad_.front();
      batch_->bad(text_.substr(bad.begin, 0), RecordError(bad.at - bad.begin, bad.message));
    }
  }

  /// Records, and arrays of them.
  void readPieces(const Block& block) {
    const auto end = block.last ? JsonSplitter::End::ofInput : JsonSplitter::End::ofBlock;
    JsonSplitter splitter(block.state);
    std::size_t oneByOne = kOneByOne;
    for (std::size_t at = 0;; oneByOne *= 2) {
      if (splitter.isFresh() && mayReadMany(at))
        if (const std::size_t next = readMany(at); next > at) {
          JsonState state;
          const std::size_t line = findLastLineBreak(text_.substr(0, next));
          state.column = line == npos ? block.state.column + next : next - line - 1;
          splitter = JsonSplitter(state);
          at = next;
        }
      for (std::size_t i = 0; i < oneByOne; ++i) {
        const JsonPiece piece = splitter.next(text_.substr(at), end);
        if (piece.event == JsonEvent::end || piece.event == JsonEvent::needMore) return;
        take(piece, at);
        at += piece.end;
      }
    }
  }

  void take(const JsonPiece& piece, std::size_t at) {
    if (!piece.message.empty()) batch_->bad(piece.text, RecordError(at + piece.at - offset(piece.text), piece.message));
    if (piece.event == JsonEvent::record) readRecord(piece.text);
    if (piece.event == JsonEvent::beginArray) batch_->beginArray(piece.text);
    if (piece.event == JsonEvent::endArray) batch_->endArray(piece.text);
  }

  std::size_t offset(std::string_view part) const { return static_cast<std::size_t>(part.data() - text_.data()); }
  std::size_t skipSpace(std::size_t at) const {
    while (at < text_.size() && isSpace(text_[at])) ++at;
    return at;
  }

  void readRecord(std::string_view text) {
    passBadBefore(text);
    dom::element value;
    const bool accepted = fast_ && text.size() <= kMostFast &&
                          parser_.parse(text.data(), text.size(), false).get(value) == simdjson::SUCCESS;
    if (accepted && add(value, text)) return;
    try {
      const RecordParts record = jsonParts(text);
      if (const auto message = markedBad(record)) throw RecordError(0, *message);
      const Plan& plan = batch_->planFor(record);
      Numbers numbers;
      cmd::readNumbers(record, plan.layout, numbers);
      batch_->add(text, plan, numbers);
    } catch (const RecordError& e) {
      batch_->bad(text, e);
    }
  }

  /// False where it is not of a shape met before, or lacks its numbers.
  bool add(dom::element value, std::string_view text) {
    const bool isArray = value.is_array();
    if (!isArray && !value.is_object()) return false;
    const auto& plans = batch_->plans();
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const Shape& shape = plans[i]->shape;
      if (shape.isArray != isArray || !(isArray ? isOfSize(value, shape.size) : hasNames(value, shape.names))) continue;
      const Plan& plan = *plans[i];
      if (!fits(plan.layout)) continue;
      Numbers numbers;
      if (!readNumbers(values_, plan.layout, text, numbers)) return false;
      passBadBefore(text);
      batch_->usedAgain(i);
      batch_->add(text, plan, numbers);
      return true;
    }
    return false;
  }

  bool isOfSize(dom::element value, std::size_t size) {
    values_.clear();
    for (dom::element item : dom::array(value)) values_.push_back(item);
    return values_.size() == size;
  }

  bool hasNames(dom::element value, const std::vector<std::string>& names) {
    if (names.empty() || names[0] == "points") return false;  // it may be a document
    const dom::object object(value);
    values_.resize(names.size());
    std::size_t count = 0;
    for (auto field = object.begin(), end = object.end(); field != end; ++field) {
      if (count == names.size() || !field.key_equals(names[count])) return false;
      values_[count++] = field.value();
    }
    return count == names.size();
  }

  /// As FormOfField::holds of a point; nothing where it takes a closer look.
  static std::optional<bool> isPoint(dom::element value) {
    if (value.is_object()) {
      double unused[3];
      return readXyz(dom::object(value), "", unused) ? std::optional(true) : std::nullopt;
    }
    if (!value.is_array()) return false;
    std::size_t count = 0;
    for (const dom::element item : dom::array(value))
      if (!item.is_number() || ++count > 4) return false;
    return count >= 3;
  }

  /// As Layout::fits; false too where that is not certain.
  bool fits(const Layout& layout) const {
    return std::all_of(layout.forms.begin(), layout.forms.end(), [&](const FormOfField& form) {
      const dom::element value = values_[form.field];
      if (form.first == FormOfField::kPoint) {
        const std::optional<bool> point = isPoint(value);
        return point && *point == form.is;
      }
      const bool is = form.first == '{' ? value.is_object() : form.first == '[' ? value.is_array() : value.is_string();
      return is == form.is;
    });
  }

  bool fast_;
  dom::parser parser_;
  Batch* batch_ = nullptr;
  std::string_view text_;
  std::span<const Block::Bad> bad_;
  std::vector<dom::element> values_;
};

}  // namespace

std::unique_ptr<RecordReader> makeJsonReader(bool fast) { return std::make_unique<JsonReader>(fast); }

}  // namespace viewproj::cmd
