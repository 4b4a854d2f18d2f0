// Records that differ from an earlier one only in their numbers are read by its pattern. All others are checked by the
// JSON scanner and split into fields.
#include <algorithm>

#include "stream/batch.hpp"
#include "stream/json_splitter.hpp"
#include "text/json_scan.hpp"
#include "text/json_text.hpp"

namespace viewproj::cmd {
namespace {

/// The most patterns that a plan keeps, and the most patterns that a record is compared with.
constexpr std::size_t kPatternsOfPlan = 4, kPatterns = 32;

class JsonReader final : public RecordReader {
 public:
  explicit JsonReader(bool byPattern) : byPattern_(byPattern) {}

  void read(const Block& block, Batch& batch) override {
    batch_ = &batch;
    text_ = block.bytes.view();
    const auto end = block.last ? JsonSplitter::End::input : JsonSplitter::End::block;
    JsonSplitter splitter(block.state);
    for (std::size_t at = 0;;) {
      at = readByPatterns(at, splitter);
      const JsonPiece piece = splitter.next(text_.substr(at), end);
      if (piece.event == JsonEvent::end) return;
      handle(piece);
      at += piece.end;
    }
  }

 private:
  /// Reads records by their patterns, up to the first record without one. Returns its offset.
  std::size_t readByPatterns(const std::size_t from, JsonSplitter& splitter) {
    using Place = JsonState::Place;
    JsonState state = splitter.state();
    std::size_t at = from;
    for (;;) {
      at = afterJsonSpace(text_, at);
      if (state.place == Place::record || state.place == Place::bad) {
        if (at == text_.size() || text_[at] != ',') break;
        state.place = Place::comma;
        at = afterJsonSpace(text_, at + 1);
      }
      const std::size_t size = addByPattern(text_.substr(at, kLongestRecord));
      if (size == 0) break;
      at += size;
      if (state.insideArray()) state.place = Place::record;
    }
    if (at > from) {
      state.moveOver(text_.substr(from, at - from));
      splitter = JsonSplitter(state);
    }
    return at;
  }

  /// Adds the record at the start of text if it matches a pattern, and returns its size; otherwise returns 0.
  std::size_t addByPattern(std::string_view text) {
    const auto& plans = batch_->plans();
    Numbers numbers;
    std::size_t tried = 0;
    for (std::size_t i = 0; i < plans.size() && tried < kPatterns; ++i)
      for (auto pattern = plans[i]->patterns.begin(); pattern != plans[i]->patterns.end() && tried < kPatterns;
           ++pattern) {
        ++tried;
        const std::size_t size = pattern->read(text, numbers);
        if (size == 0) continue;
        Plan& plan = *plans[i];
        if (pattern != plan.patterns.begin()) std::rotate(plan.patterns.begin(), pattern, pattern + 1);
        batch_->moveToFront(i);
        batch_->add(text.substr(0, size), plan, numbers);
        return size;
      }
    return 0;
  }

  void handle(const JsonPiece& piece) {
    if (!piece.message.empty()) batch_->bad(piece.text, RecordError(piece.at, piece.message));
    if (piece.event == JsonEvent::record) readRecord(piece.text);
    if (piece.event == JsonEvent::beginArray) batch_->beginArray(piece.text);
    if (piece.event == JsonEvent::endArray) batch_->endArray(piece.message.empty() ? piece.text : std::string_view());
  }

  /// text: a record, if it is valid.
  void readRecord(std::string_view text) {
    try {
      const RecordParts record = jsonParts(text);
      Plan& plan = batch_->planFor(record);
      Numbers numbers;
      NumberTexts texts;
      readNumbers(record, plan.layout, numbers, &texts);
      if (byPattern_) keepPattern(plan, RecordPattern(record, plan.layout, numbers, texts));
      batch_->add(text, plan, numbers);
    } catch (const RecordError& e) {
      batch_->bad(text, e);
    }
  }

  static void keepPattern(Plan& plan, RecordPattern pattern) {
    if (pattern.isEmpty()) return;
    if (plan.patterns.size() == kPatternsOfPlan) plan.patterns.pop_back();
    plan.patterns.insert(plan.patterns.begin(), std::move(pattern));
  }

  bool byPattern_;
  Batch* batch_ = nullptr;
  std::string_view text_;
};

}  // namespace

std::unique_ptr<RecordReader> makeJsonReader(bool byPattern) { return std::make_unique<JsonReader>(byPattern); }

}  // namespace viewproj::cmd
