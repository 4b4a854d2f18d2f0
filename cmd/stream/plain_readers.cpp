// Records of CSV, text and f64.
#include <algorithm>
#include <bit>
#include <cmath>

#include "stream/batch.hpp"
#include "text/csv.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

static_assert(std::endian::native == std::endian::little, "f64 is copied from memory, which must be little-endian");

/// Reads numbers that need no trimming or unquoting. False does not mean that they are wrong.
bool readBareNumbers(const RecordParts& record, const Layout& layout, Numbers& numbers) {
  const char* const end = record.text.data() + record.text.size();
  double* slot = numbers.data();
  for (const NumberField& part : layout.parts) {
    if (part.isArray) return false;
    const std::string_view value = record.values[part.field];
    if (readNumber(value.data(), end, *slot) != value.data() + value.size() || !std::isfinite(*slot++)) return false;
  }
  return true;
}

/// Adds one record, which partsOf splits into fields. Returns its plan, or null if it is bad.
template <class PartsOf>
const Plan* addRecord(std::string_view text, Batch& batch, const PartsOf& partsOf) {
  try {
    const RecordParts record = partsOf();
    const Plan& plan = batch.planFor(record);
    Numbers numbers;
    if (!readBareNumbers(record, plan.layout, numbers)) readNumbers(record, plan.layout, numbers);
    batch.add(text, plan, numbers);
    return &plan;
  } catch (const RecordError& e) {
    batch.bad(text, e);
    return nullptr;
  }
}

class CsvReader final : public RecordReader {
 public:
  explicit CsvReader(const Shape& header) : header_(header), separator_(header.separator) {}

  void read(const Block& block, Batch& batch) override {
    const std::string_view text = block.bytes.view();
    for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
      if ((end = readBareRecord(text, at, batch)) != npos) continue;
      std::size_t unclosed = npos;
      end = endOfCsvRecord(text, at, separator_, &unclosed);
      std::string_view line = text.substr(at, end - at);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (unclosed != npos)
        batch.bad(line, RecordError(unclosed - at, "the quote that opens here is not closed"));
      else if (!isBlank(line))
        readLine(line, batch);
    }
  }

 private:
  static constexpr std::size_t npos = std::string_view::npos;
  static constexpr std::size_t kNoSlot = kMostNumbers;
  /// The slot of each field's number.
  static std::vector<std::size_t> slotsOf(const Layout& layout, std::size_t fields) {
    std::vector<std::size_t> slots(fields, kNoSlot);
    std::size_t slot = 0;
    for (const NumberField& part : layout.parts) {
      if (part.isArray || slots[part.field] != kNoSlot) return {};
      slots[part.field] = slot++;
    }
    return slots;
  }

  /// Adds a record with as many fields as the header, if its numbers need no trimming or unquoting, in one pass.
  /// Returns its end, or npos for any other record.
  std::size_t readBareRecord(std::string_view text, std::size_t begin, Batch& batch) {
    if (slots_.empty()) return npos;
    const char* at = text.data() + begin;
    const char* const end = text.data() + text.size();
    const char separator = separator_;
    Numbers numbers;
    for (std::size_t field = 0; field < slots_.size(); ++field) {
      if (field > 0 && (at == end || *at++ != separator)) return npos;
      if (slots_[field] != kNoSlot) {
        double& number = numbers[slots_[field]];
        at = readNumber(at, end, number);
        if (!at || !std::isfinite(number)) return npos;
      } else {
        if (at < end && *at == '"') {
          const std::size_t after = afterQuotes(text, static_cast<std::size_t>(at - text.data()));
          if (after == npos) return npos;
          at = text.data() + after;
        } else {
          while (at < end && *at != separator && *at != '\n' && *at != '\r') ++at;
        }
      }
    }
    if (at < end && *at == '\r') ++at;
    if (at < end && *at != '\n') return npos;
    const auto lineEnd = static_cast<std::size_t>(at - text.data());
    std::string_view line = text.substr(begin, lineEnd - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    batch.add(line, *batch.plans().front(), numbers);
    return lineEnd;
  }

  void readLine(std::string_view line, Batch& batch) {
    const Plan* const plan = addRecord(line, batch, [&] { return csvParts(line, header_); });
    if (plan && slots_.empty()) slots_ = slotsOf(plan->layout, header_.size);
  }

  const Shape& header_;
  char separator_;
  std::vector<std::size_t> slots_;
};

class TextReader final : public RecordReader {
 public:
  void read(const Block& block, Batch& batch) override {
    const std::string_view text = block.bytes.view();
    for (std::size_t at = 0, end; at < text.size(); at = end + 1) {
      end = std::min(text.find('\n', at), text.size());
      std::string_view line = text.substr(at, end - at);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (!isBlank(line) && !isTextComment(line)) addRecord(line, batch, [&] { return textParts(line); });
    }
  }
};

class BinaryReader final : public RecordReader {
 public:
  static constexpr std::size_t kAtOnce = 1024;

  void read(const Block& block, Batch& batch) override {
    const std::string_view text = block.bytes.view();
    const std::size_t count = text.size() / kBinaryRecord;
    const auto* doubles = reinterpret_cast<const double*>(text.data());  // aligned: a block begins its buffer
    for (std::size_t i = 0; i < count;) {
      // In parts, because records after one that the work does not convert are converted again.
      const std::size_t some = std::min(count - i, kAtOnce);
      const std::size_t done = batch.convert({doubles + 3 * i, 3 * some});
      i += done;
      if (done < some) readOne(text.substr(i++ * kBinaryRecord, kBinaryRecord), batch);
    }
    if (const std::string_view rest = text.substr(count * kBinaryRecord); !rest.empty())
      batch.bad(rest, RecordError(0, "has " + std::to_string(rest.size()) + " bytes; expected three doubles, " +
                                         std::to_string(kBinaryRecord) +
                                         " bytes; other columns are left out first, as in numpy's a[:, :3].tofile"));
  }

 private:
  void readOne(std::string_view bytes, Batch& batch) {
    try {
      const Plan& plan = batch.planFor({bytes, {Form::f64, true, 3, {}}, {}});
      const std::vector<double> values = binaryNumbers(bytes);
      Numbers numbers;
      double* slot = numbers.data();
      for (const NumberField& part : plan.layout.parts) {
        const double value = values[part.field];
        if (!std::isfinite(value) && !(part.mayBeAbsent && std::isnan(value)))
          throw RecordError(part.field * sizeof(double),
                            std::string(std::isnan(value) ? "NaN" : "infinity") + " is not a finite number");
        *slot++ = value;
      }
      batch.add(bytes, plan, numbers);
    } catch (const RecordError& e) {
      batch.bad(bytes, e);
    }
  }
};

}  // namespace

std::unique_ptr<RecordReader> makeCsvReader(const Shape& header) { return std::make_unique<CsvReader>(header); }
std::unique_ptr<RecordReader> makeTextReader() { return std::make_unique<TextReader>(); }
std::unique_ptr<RecordReader> makeBinaryReader() { return std::make_unique<BinaryReader>(); }

}  // namespace viewproj::cmd
