#include "stream/batch.hpp"

#include <algorithm>

#include "records/coordinates.hpp"

namespace viewproj::cmd {
namespace {

constexpr std::size_t kRows = 256;
/// The most shapes that are kept.
constexpr std::size_t kPlans = 256;
/// The most names of all kept shapes together, unless one shape alone has more.
constexpr std::size_t kNames = 1 << 16;

}  // namespace

void requireNoClash(const RecordParts& record, const Results& results, const std::string& prefix) {
  for (const ResultRow* row : results) {
    const std::string name = prefix + std::string(row->name);
    if (const auto field = record.shape.find(name))
      throw RecordError(record.offset(*field),
                        "already has a field '" + name + "'; --prefix P puts P in front of the results' names");
  }
}

Batch::Batch(const BatchSetup& setup, RecordWork& work, RecordWriter* writer, BlockResult& result)
    : setup_(setup), work_(work), writer_(writer), result_(result) {
  rows_.reserve(kRows);
}

void Batch::begin(const Block& block) {
  block_ = &block;
  countedTo_ = 0;
  countedPosition_ = block.position;
  rows_.clear();
  errors_.clear();
  work_.clear();
}

Plan& Batch::planFor(const RecordParts& record) {
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const Shape& shape = plans_[i]->shape;
    if (shape.isArray == record.shape.isArray && shape.size == record.shape.size && shape.names == record.shape.names &&
        plans_[i]->layout.fits(record.values)) {
      moveToFront(i);
      return *plans_.front();
    }
  }
  Layout layout = work_.find(record);
  for (const std::string& text : layout.notes) note(text);
  Results results = work_.results(layout, setup_.to);
  if (setup_.checkNames && !record.shape.isArray) requireNoClash(record, results, setup_.prefix);
  std::size_t names = record.shape.size;
  for (const auto& plan : plans_) names += plan->shape.size;
  if (plans_.size() == kPlans || names > kNames) {
    flush();  // rows refer to their plans
    plans_.resize(names > kNames ? 0 : kPlans / 2);
  }
  plans_.insert(plans_.begin(), std::make_unique<Plan>(Plan{record.shape, std::move(layout), std::move(results)}));
  return *plans_.front();
}

void Batch::moveToFront(std::size_t plan) {
  const auto at = plans_.begin() + static_cast<std::ptrdiff_t>(plan);
  if (plan > 0) std::rotate(plans_.begin(), at, at + 1);
}

void Batch::add(std::string_view text, const Plan& plan, const Numbers& numbers) {
  try {
    work_.add(plan.layout, numbers);
  } catch (const RecordError& e) {
    bad(text, e);
    return;
  }
  if (!numbers.seaLevel.empty()) note(seaLevelNote(numbers.seaLevel));
  rows_.push_back({text, &plan});
  if (rows_.size() == kRows) flush();
}

void Batch::bad(std::string_view text, const RecordError& error) {
  rows_.push_back({text, nullptr});
  errors_.push_back(error);
  if (!setup_.keepGoing || rows_.size() == kRows) flush();
}

void Batch::beginArray(std::string_view asWritten) {
  flush();
  if (writer_) writer_->beginArray(asWritten);
}

void Batch::endArray(std::string_view asWritten) {
  flush();
  if (writer_) writer_->endArray(asWritten);
}

void Batch::flush() {
  work_.compute();
  std::size_t added = 0, bad = 0;
  for (const Row& row : rows_) {
    if (!row.plan) {
      writeBad(row.text, errors_[bad++]);
      continue;
    }
    const std::size_t index = added++;
    if (!writer_) {
      work_.read(index, {row.text, &row.plan->shape}, positionOf(row.text.data()).line);
      ++result_.records;
      continue;
    }
    try {
      writer_->beginRecord({row.text, &row.plan->shape}, row.plan->results);
      work_.write(index, *writer_);
      writer_->endRecord();
    } catch (const RecordError& e) {
      writer_->cancelRecord();
      writeBad(row.text, e);
    }
  }
  rows_.clear();
  errors_.clear();
  work_.clear();
}

void Batch::note(const std::string& text) {
  if (std::find(result_.notes.begin(), result_.notes.end(), text) == result_.notes.end()) result_.notes.push_back(text);
}

void Batch::writeBad(std::string_view text, const RecordError& error) {
  const TextPosition position = positionOf(text.data() + error.offset);
  if (!setup_.keepGoing) {
    result_.fault = StreamFault{position, error.what()};
    throw StopBlock{};
  }
  if (writer_) writer_->badRecord(text, position.line, error.what());
  result_.passedOver.push_back({position, error.what()});
}

std::size_t Batch::convert(std::span<const double> numbers) {
  if (!setup_.convert || !writer_) return 0;
  flush();
  const std::size_t count = work_.convert(numbers, result_.out);
  result_.records += count;
  return count;
}

TextPosition Batch::positionOf(const char* where) {
  const std::string_view records = block_->bytes.view();
  const auto at = static_cast<std::size_t>(where - records.data());
  if (setup_.form == Form::f64) return {block_->position.line + at / kBinaryRecord, 1 + at % kBinaryRecord};
  countedPosition_ = positionAt(records.substr(countedTo_), at - countedTo_, countedPosition_);
  countedTo_ = at;
  return countedPosition_;
}

}  // namespace viewproj::cmd
