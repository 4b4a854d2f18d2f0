#include <algorithm>
#include <cmath>

#include "input/error.hpp"
#include "output/number.hpp"
#include "output/record_writer.hpp"

namespace viewproj::cmd {
namespace {

/// The results' numbers alone, a record a line; NaN where there is none, and for a bad record.
class TextWriter final : public RecordWriter {
 public:
  TextWriter(WriterSetup setup, std::string& out) : setup_(std::move(setup)), out_(out) {}

  void beginRecord(const Record&) override { start_ = out_.size(); }
  void endRecord() override { out_ += '\n'; }
  void cancelRecord() override { out_.resize(start_); }

  void badRecord(std::string_view, std::size_t, const std::string&) override {
    start_ = out_.size();
    bad_ = true;
    setup_.exampleResults(*this);
    bad_ = false;
    out_ += '\n';
  }

  bool isText() const override { return true; }

  void number(std::string_view, double value) override {
    if (out_.size() > start_) out_ += ' ';
    if (std::isfinite(value) && !bad_)
      appendNumber(out_, value);
    else
      out_ += "NaN";
  }

  void vector(std::string_view name, std::span<const double> values) override {
    const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    for (double value : values) number(name, finite ? value : NAN);
  }

  void flag(std::string_view name, bool value) override { number(name, value ? 1 : 0); }
  void names(std::string_view name, std::span<const std::string_view>, bool) override {
    throw UsageError("--fields " + std::string(name) + ": text has numbers only; use JSON or CSV");
  }

 private:
  WriterSetup setup_;
  std::string& out_;
  std::size_t start_ = 0;
  bool bad_ = false;
};

}  // namespace

std::unique_ptr<RecordWriter> makeTextWriter(WriterSetup setup, std::string& out) {
  return std::make_unique<TextWriter>(std::move(setup), out);
}

}  // namespace viewproj::cmd
