#include <algorithm>
#include <cmath>

#include "output/record_writer.hpp"
#include "text/error.hpp"
#include "text/format_number.hpp"

namespace viewproj::cmd {
namespace {

/// The results' numbers alone; NaN where there is none, and for a bad record.
class NumbersWriter : public RecordWriter {
 public:
  NumbersWriter(const WriterSetup& setup, TextBuffer& out) : RecordWriter(out), setup_(setup) {}

  void beginRecord(const Record&) override { start_ = out_.size(); }
  void cancelRecord() override { out_.truncate(start_); }

  void badRecord(std::string_view, std::size_t, const std::string&) override {
    start_ = out_.size();
    bad_ = true;
    setup_.exampleResults(*this);
    bad_ = false;
    endRecord();
  }

  bool isText() const override { return true; }

  void number(std::string_view, double value) override { put(bad_ ? NAN : value); }

  void vector(std::string_view name, std::span<const double> values) override {
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    for (double value : values) number(name, finite ? value : NAN);
  }

  void flag(std::string_view name, bool value) override { number(name, value ? 1 : 0); }
  void names(std::string_view name, std::span<const std::string_view>, bool) override {
    throw UsageError("--fields " + std::string(name) + ": text and f64 have numbers only; use JSON or CSV");
  }
  void word(std::string_view, std::string_view) override {}
  void json(std::string_view, std::string_view) override {}
  void group(std::string_view, bool, const std::function<void(ResultSink&)>& write) override { write(*this); }
  void list(std::string_view name, std::size_t, const std::function<void(ResultSink&, std::size_t)>&) override {
    throw UsageError("a list of " + std::string(name) + " has no place in text and f64; use JSON");
  }

 protected:
  virtual void put(double value) = 0;

  const WriterSetup& setup_;
  std::size_t start_ = 0;

 private:
  bool bad_ = false;
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
    if (std::isfinite(value))
      appendNumber(out_, value);
    else
      out_ += "NaN";
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
