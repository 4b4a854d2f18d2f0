// The results' numbers alone, as text or as doubles; NaN where there is none, and for a bad record.
#include <algorithm>
#include <cmath>

#include "output/record_writer.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

class NumbersWriter : public RecordWriter {
 public:
  NumbersWriter(const WriterSetup& setup, TextBuffer& out) : RecordWriter(out), setup_(setup) {}

  void writeBad(std::span<const std::string_view>, std::size_t, const std::string&) override {
    begin_ = out_.size();
    for (const ResultRow* row : setup_.rows) putNone(*row);
    end();
  }
  void writeError(const RecordView&, std::size_t, std::size_t) override { writeBad({}, 0, ""); }

 protected:
  virtual void put(double value) = 0;
  virtual void end() {}

  const WriterSetup& setup_;
  std::size_t begin_ = 0;  ///< of the record in out_

 private:
  void append(const RecordView&, const ResultRows& rows, ResultCursor values) override {
    begin_ = out_.size();
    for (const ResultRow* row : rows) putRow(*row, values);
    end();
  }

  void putNone(const ResultRow& row) {
    for (std::size_t count = numbersOf(row); count > 0; --count) put(NAN);
  }

  void putRow(const ResultRow& row, ResultCursor& values) {
    switch (row.kind) {
      case ResultKind::number:
      case ResultKind::flag:
        return put(*values.number++);
      case ResultKind::vector: {
        const auto numbers = values.vector(row.size);
        std::for_each(numbers.begin(), numbers.end(), [&](double number) { put(number); });
        if (numbers.empty()) putNone(row);
        return;
      }
      case ResultKind::group:
        if (values.count() == 0) return putNone(row);
        for (const ResultRow* part : row.parts) putRow(*part, values);
        return;
      case ResultKind::word:
      case ResultKind::json:
        ++values.word;  // left out
        return;
      case ResultKind::names:
      case ResultKind::list:
        return;  // requireRoom refuses them
    }
  }
};

/// A record a line.
class TextWriter final : public NumbersWriter {
 public:
  using NumbersWriter::NumbersWriter;

 private:
  void put(double value) override {
    if (out_.size() > begin_) out_ += ' ';
    if (!std::isfinite(value))
      out_ += "NaN";
    else
      appendNumber(out_, toDigits(value, setup_.stream.digits));
  }
  void end() override { out_ += '\n'; }
};

/// Little-endian doubles.
class BinaryWriter final : public NumbersWriter {
 public:
  using NumbersWriter::NumbersWriter;

 private:
  void put(double value) override {
    if (!std::isfinite(value)) value = NAN;
    char* room = out_.room(sizeof value);
    std::memcpy(room, &value, sizeof value);
    out_.written(room + sizeof value);
  }
};

}  // namespace

void RecordWriter::write(const RecordView& record, const ResultRows& rows, const ResultValues& values) {
  const std::size_t begin = out_.size();
  try {
    append(record, rows, ResultCursor(values));
  } catch (...) {
    out_.truncate(begin);
    throw;
  }
}

std::unique_ptr<RecordWriter> makeTextWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<TextWriter>(setup, out);
}

std::unique_ptr<RecordWriter> makeBinaryWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<BinaryWriter>(setup, out);
}

}  // namespace viewproj::cmd
