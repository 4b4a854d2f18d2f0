#include "stream/batch.hpp"

#include <algorithm>

#include "records/coordinates.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kRows = 256;

}  // namespace

void BlockResult::clear() {
  out.clear();
  closing = "";
  records = 0;
  passedOver.clear();
  notes.clear();
  fault.reset();
}

void BlockResult::note(const std::string& text) {
  if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
}

void PositionCounter::begin(const Block& block, std::size_t binaryRecord) {
  block_ = &block;
  binaryRecord_ = binaryRecord;
  countedTo_ = 0;
  counted_ = block.position;
}

TextPosition PositionCounter::positionOf(const char* where) {
  const std::string_view records = block_->bytes.view();
  const auto at = static_cast<std::size_t>(where - records.data());
  if (binaryRecord_ > 0) return {block_->position.line + at / binaryRecord_, 1 + at % binaryRecord_};
  counted_ = positionAt(records.substr(countedTo_), at - countedTo_, counted_);
  countedTo_ = at;
  return counted_;
}

void requireNoClash(const RecordView& record, const ResultRows& rows, const std::string& prefix) {
  for (const ResultRow* row : rows) {
    const std::string name = prefix + std::string(row->name);
    if (const auto field = record.schema->find(name))
      throw RecordError(record.offset(*field),
                        "already has a field '" + name + "'; --prefix P puts P in front of the results' names");
  }
}

ResultRows withCameraName(const StreamSetup& setup, ResultRows rows) {
  if (setup.namesCameras) rows.insert(rows.begin(), &results::camera);
  return rows;
}

Batch::Batch(const WriterSetup& setup, const RecordCameras& cameras, RecordProcessor& processor, RecordWriter& writer,
             std::size_t binaryRecord, bool mayConvert, BlockResult& result)
    : setup_(setup),
      cameras_(cameras),
      camerasOfBatch_(cameras),
      processor_(processor),
      writer_(writer),
      binaryRecord_(binaryRecord),
      mayConvert_(mayConvert && cameras.only() && !setup.stream.visibleOnly),
      result_(result) {
  rows_.reserve(kRows);
}

void Batch::begin(const Block& block) {
  position_.begin(block, binaryRecord_);
  rows_.clear();
  values_.clear();
  errors_.clear();
  processor_.clear();
}

Plan Batch::plan(const RecordView& record) {
  Plan plan{processor_.locate(record)};
  for (const std::string& text : plan.numbers.notes) result_.note(text);
  plan.rows = withCameraName(setup_.stream, processor_.rows(plan.numbers));
  plan.camera = cameras_.locate(record, plan.numbers);
  if (!record.schema->isArray && (setup_.form == OutputForm::lines || setup_.form == OutputForm::array))
    requireNoClash(record, plan.rows, setup_.stream.prefix);
  return plan;
}

void Batch::take(const RecordView& record, const Plan& plan, const Numbers& numbers) {
  for (const RecordCamera* const camera : camerasOfBatch_.find(record, plan.camera)) {
    processor_.add(plan.numbers, numbers, *camera);
    keep({.record = record, .plan = &plan, .camera = camera});
  }
  if (!numbers.seaLevel.empty()) result_.note(seaLevelNote(numbers.seaLevel));
}

void Batch::bad(std::string_view text, const RecordError& error, std::span<const std::string_view> values) {
  errors_.push_back(error);
  keep({.record = {text, nullptr, values}, .error = errors_.size() - 1});
  if (!setup_.stream.keepGoing) flush();
}

void Batch::takeError(const RecordView& record, std::size_t field) {
  keep({.record = record, .error = field, .saysError = true});
}

/// Whether the record is not written as it is.
bool Batch::needsValues(const Row& row) const {
  if (!row.plan) return true;
  if (hasNumbersOnly(setup_.form)) return false;
  const Schema& schema = *row.record.schema;
  return hasColumns(setup_.form) ? schema.form != Form::csv : schema.form == Form::csv || schema.isArray;
}

void Batch::keep(Row row) {
  if (needsValues(row)) {
    row.values = values_.size();
    row.count = row.record.values.size();
    values_.insert(values_.end(), row.record.values.begin(), row.record.values.end());
  }
  rows_.push_back(row);
  if (rows_.size() == kRows) flush();
}

void Batch::beginArray(std::string_view asWritten) {
  flush();
  writer_.beginArray(asWritten);
}

void Batch::endArray(std::string_view asWritten) {
  flush();
  writer_.endArray(asWritten);
}

void Batch::flush() {
  processor_.compute();
  std::size_t added = 0;
  for (Row& row : rows_) {
    row.record.values = std::span(values_).subspan(row.values, row.count);
    row.record.numbers = {};  // the reader has those of other records by now
    row.record.points = {};
    if (row.saysError) {
      writer_.writeError(row.record, position_.positionOf(row.record.text.data()).line, row.error);
      ++result_.records;
    } else if (!row.plan) {
      writeBad(row.record, errors_[row.error]);
    } else {
      try {
        results_.clear();
        if (setup_.stream.namesCameras) results_.addWord(row.camera->name);
        processor_.results(added++, results_);
        if (setup_.stream.visibleOnly && !processor_.isVisible(added - 1)) continue;
        writer_.write(row.record, row.plan->rows, results_);
        ++result_.records;
      } catch (const RecordError& e) {
        CsvRecord cells;
        if (const Schema& schema = *row.record.schema; schema.form == Form::csv) {
          cells.split(row.record.text, schema.separator);
          row.record.values = cells.fields;
        }
        writeBad(row.record, e);
      }
    }
  }
  rows_.clear();
  values_.clear();
  errors_.clear();
  processor_.clear();
  camerasOfBatch_.clear();
}

void Batch::writeBad(const RecordView& record, const RecordError& error) {
  const TextPosition position = position_.positionOf(record.text.data() + error.offset);
  if (!setup_.stream.keepGoing) {
    result_.fault = StreamFault{position, error.what()};
    throw Stop{};
  }
  writer_.writeBad(record.values, position.line, error.what());
  result_.passedOver.push_back({position, error.what()});
  ++result_.records;
}

std::size_t Batch::convert(std::span<const double> numbers) {
  if (!mayConvert_) return 0;
  flush();
  const std::size_t count = processor_.convert(numbers, result_.out);
  result_.records += count;
  return count;
}

}  // namespace viewproj::cmd
