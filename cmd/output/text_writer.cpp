#include <algorithm>
#include <cmath>

#include "output/record_writer.hpp"
#include "output/results.hpp"
#include "text/csv.hpp"
#include "text/number.hpp"

namespace viewproj::cmd {
namespace {

/// The results' numbers alone; NaN where there is none, and for a bad record.
class NumbersWriter : public RecordWriter {
 public:
  NumbersWriter(const WriterSetup& setup, TextBuffer& out) : RecordWriter(out), setup_(setup) {}

  void beginRecord(const Record&, const Results&) override { start_ = out_.size(); }

  void badRecord(std::string_view, std::size_t, const std::string&) override {
    start_ = out_.size();
    for (const ResultRow* row : setup_.results)
      for (std::size_t count = numbersOf(*row); count > 0; --count) put(NAN);
    endRecord();
  }

  bool isText() const override { return true; }

  void number(const ResultRow&, double value) override { put(value); }

  void vector(const ResultRow&, std::span<const double> values) override {
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    for (const double value : values) put(finite ? value : NAN);
  }

  void flag(const ResultRow&, bool value) override { put(value ? 1 : 0); }
  void text(const ResultRow&, std::span<const std::string_view>) override {}  // left out

 protected:
  virtual void put(double value) = 0;

  const WriterSetup& setup_;
};

/// A record a line.
class TextWriter final : public NumbersWriter {
 public:
  using NumbersWriter::NumbersWriter;

  void endRecord() override {
    out_ += '\n';
    ++records_;
  }

 private:
  void put(double value) override {
    if (out_.size() > start_) out_ += ' ';
    if (!std::isfinite(value))
      out_ += "NaN";
    else
      appendNumber(out_, toDigits(value, setup_.digits));
  }
};

/// Little-endian doubles.
class BinaryWriter final : public NumbersWriter {
 public:
  using NumbersWriter::NumbersWriter;

  bool hasFixedColumns() const override { return true; }
  void endRecord() override { ++records_; }

 private:
  void put(double value) override {
    if (!std::isfinite(value)) value = NAN;
    char* room = out_.room(sizeof value);
    std::memcpy(room, &value, sizeof value);
    out_.written(room + sizeof value);
  }
};

}  // namespace

std::unique_ptr<RecordWriter> makeTextWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<TextWriter>(setup, out);
}

std::unique_ptr<RecordWriter> makeBinaryWriter(const WriterSetup& setup, TextBuffer& out) {
  return std::make_unique<BinaryWriter>(setup, out);
}

}  // namespace viewproj::cmd
