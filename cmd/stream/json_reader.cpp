// Most records are split in one scan. Those that are not valid, and what begins arrays, the splitter finds.
#include "stream/json_splitter.hpp"
#include "stream/record_reader.hpp"
#include "text/error.hpp"
#include "text/json_scan.hpp"

namespace viewproj::cmd {
namespace {

class JsonReader final : public RecordReader {
 public:
  using RecordReader::RecordReader;

  void read(const Block& block, RecordSink& sink) override {
    const std::string_view text = block.bytes.view();
    const JsonEnd end = block.last ? JsonEnd::input : JsonEnd::block;
    JsonState state = block.state;
    for (std::size_t at = 0;;) {
      at = readGood(text, at, state, sink);
      const JsonPiece piece = nextPiece(text.substr(at), state, end);
      if (piece.event == JsonEvent::end) return;
      if (!piece.message.empty()) sink.bad(piece.text, RecordError(piece.at, piece.message));
      if (piece.event == JsonEvent::record) readWhole(piece.text, sink);
      if (piece.event == JsonEvent::beginArray) sink.beginArray(piece.text);
      if (piece.event == JsonEvent::endArray) sink.endArray(piece.message.empty() ? piece.text : std::string_view());
      at += piece.end;
    }
  }

 private:
  /// Takes records, and the commas between them, up to what is not certainly one. Returns its offset.
  std::size_t readGood(std::string_view text, const std::size_t from, JsonState& state, RecordSink& sink) {
    using Place = JsonState::Place;
    std::size_t at = from;
    for (;;) {
      at = afterJsonSpace(text, at);
      if (state.place == Place::record || state.place == Place::bad) {
        if (at == text.size() || text[at] != ',') break;
        state.place = Place::comma;
        at = afterJsonSpace(text, at + 1);
      }
      const std::size_t size = fields_.split(text.substr(at, kLongestRecord), false);
      if (size == 0) break;
      takeFields(text.substr(at, size), sink);
      at += size;
      if (state.insideArray()) state.place = Place::record;
    }
    state.moveOver(text.substr(from, at - from));
    return at;
  }

  /// text: a record, if it is valid.
  void readWhole(std::string_view text, RecordSink& sink) {
    try {
      fields_.splitWhole(text);
    } catch (const RecordError& e) {
      return sink.bad(text, e);
    }
    takeFields(text, sink);
  }

  void takeFields(std::string_view text, RecordSink& sink) {
    if (!hasKey()) makeKey();
    take(key_, {text, nullptr, fields_.values, fields_.numbers, fields_.points}, sink,
         [&] { return fields_.schema(text); });
  }

  void makeKey() {
    key_.clear();
    if (fields_.isArray) key_ = '[' + std::to_string(fields_.values.size());
    for (const std::string_view key : fields_.keys) {
      key_ += key;
      key_ += '\n';  // which no key has
    }
  }

  /// Whether the key is that of the record, as most have that of the one before.
  bool hasKey() const {
    std::string_view rest = key_;
    for (const std::string_view key : fields_.keys) {
      if (!rest.starts_with(key) || rest.size() == key.size() || rest[key.size()] != '\n') return false;
      rest.remove_prefix(key.size() + 1);
    }
    return !fields_.isArray && rest.empty();
  }

  JsonFields fields_;
  std::string key_;
};

}  // namespace

std::unique_ptr<RecordReader> makeJsonReader(bool passErrors) { return std::make_unique<JsonReader>(passErrors); }

}  // namespace viewproj::cmd
