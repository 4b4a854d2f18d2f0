// Records of CSV, text, f64 and f32.
#include <algorithm>
#include <bit>

#include "stream/record_reader.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

static_assert(std::endian::native == std::endian::little, "binary numbers are little-endian, as memory must be");

class CsvReader final : public RecordReader {
 public:
  CsvReader(const Schema& header, bool passErrors) : RecordReader(passErrors), header_(header) {}

  void read(const Block& block, RecordSink& sink) override {
    const std::string_view text = block.bytes.view();
    for (std::size_t at = 0; at < text.size(); at += record_.end + 1) {
      record_.splitSome(text.substr(at), header_.separator, header_.size, kMostFields);
      std::string_view line = text.substr(at, record_.end);
      if (line.ends_with('\r')) line.remove_suffix(1);
      const std::size_t size = record_.fields.size();
      if (size > kMostFields)
        sink.bad(line,
                 RecordError(static_cast<std::size_t>(record_.fields.back().data() - line.data()),
                             "has more than " + std::to_string(kMostFields) + " fields"),
                 record_.fields);
      else if (!record_.fault.empty())
        sink.bad(line, RecordError(record_.faultAt, record_.fault), record_.fields);
      else if (size == header_.size && (size > 1 || !isBlank(line)))
        take("", {line, nullptr, record_.fields, record_.numbers}, sink, [&] { return header_; });
      else if (!isBlank(line))
        sink.bad(line, wrongSize(line), record_.fields);
    }
  }

 private:
  RecordError wrongSize(std::string_view line) const {
    const std::size_t size = record_.fields.size(), expected = header_.size;
    const char* const where = size > expected ? record_.fields[expected].data() : line.data() + line.size();
    return {static_cast<std::size_t>(where - line.data()),
            "has " + std::to_string(size) + (size == 1 ? " field" : " fields") + "; expected " +
                std::to_string(expected) + (header_.hasHeader ? " as the header has" : " as the first line has")};
  }

  const Schema& header_;
  CsvRecord record_;
};

class TextReader final : public RecordReader {
 public:
  TextReader() : RecordReader(false) {}

  void read(const Block& block, RecordSink& sink) override {
    const std::string_view text = block.bytes.view();
    for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
      end = std::min(text.find('\n', at), text.size());
      std::string_view line = text.substr(at, end - at);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (!isBlank(line) && !isTextComment(line)) readLine(line, sink);
    }
  }

 private:
  void readLine(std::string_view line, RecordSink& sink) {
    try {
      splitText(line, words_);
    } catch (const RecordError& e) {
      return sink.bad(line, e);
    }
    take(std::to_string(words_.size()), {line, nullptr, words_}, sink, [&] {
      return Schema{Form::text, true, words_.size(), {}};
    });
  }

  std::vector<std::string_view> words_;
};

class BinaryReader final : public RecordReader {
 public:
  explicit BinaryReader(const Schema& schema) : RecordReader(false), schema_(schema) {}

  void read(const Block& block, RecordSink& sink) override {
    constexpr std::size_t kAtOnce = 1024;
    const std::string_view text = block.bytes.view();
    const std::size_t record = schema_.size * bytesOf(schema_.form), count = text.size() / record;
    const bool areTriples = schema_.form == Form::f64 && schema_.size == 3;
    const auto* doubles = reinterpret_cast<const double*>(text.data());  // aligned: a block begins its buffer
    for (std::size_t i = 0; i < count;) {
      // In parts, because records after one that is not converted are converted again.
      const std::size_t some = areTriples ? std::min(count - i, kAtOnce) : 0;
      const std::size_t done = some > 0 ? sink.convert({doubles + 3 * i, 3 * some}) : 0;
      i += done;
      if (done == some && some > 0) continue;
      take("", {text.substr(i++ * record, record), nullptr, {}}, sink, [&] { return schema_; });
    }
    if (const std::string_view rest = text.substr(count * record); !rest.empty())
      sink.bad(rest, RecordError(0, "has " + std::to_string(rest.size()) + " bytes; expected " +
                                        std::to_string(schema_.size) +
                                        (schema_.form == Form::f32 ? " floats, " : " doubles, ") +
                                        std::to_string(record) + " bytes; --width N tells how many"));
  }

 private:
  const Schema& schema_;
};

}  // namespace

std::unique_ptr<RecordReader> makeCsvReader(const Schema& header, bool passErrors) {
  return std::make_unique<CsvReader>(header, passErrors);
}
std::unique_ptr<RecordReader> makeTextReader() { return std::make_unique<TextReader>(); }
std::unique_ptr<RecordReader> makeBinaryReader(const Schema& schema) { return std::make_unique<BinaryReader>(schema); }

}  // namespace viewproj::cmd
