// The records of a block, with the plan by which their numbers are read.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "output/results.hpp"
#include "records/number_plan.hpp"
#include "stream/block_reader.hpp"
#include "stream/record_cameras.hpp"

namespace viewproj::cmd {

/// How records of a schema are read, and what they get.
struct Plan {
  NumberPlan numbers;
  ResultRows rows = {};
  RecordCameraFields camera = {};  ///< what says the record's camera
};

/// Takes the records of a stream in their order.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  /// The plan for records like this one. Throws RecordError if there is none.
  virtual Plan plan(const RecordView& record) = 0;
  /// All plans and schemas are about to be dropped.
  virtual void forgetPlans() {}

  /// The text is in the block; the schema and the plan stay, the view's values do not. Throws RecordError.
  virtual void take(const RecordView& record, const Plan& plan, const Numbers& numbers) = 0;
  /// values: of a row of CSV, as far as it could be split.
  virtual void bad(std::string_view text, const RecordError& error, std::span<const std::string_view> values = {}) = 0;
  /// A record that says itself what is wrong with it, in this field.
  virtual void takeError(const RecordView& record, std::size_t field) = 0;
  /// The text as written: `[` or `{"points": [` at the beginning, `]` and the rest of a document at the end.
  virtual void beginArray(std::string_view /*asWritten*/) {}
  virtual void endArray(std::string_view /*asWritten*/) {}
  /// Converts three doubles of each record at once. Returns how many records from the first it took.
  virtual std::size_t convert(std::span<const double> /*numbers*/) { return 0; }

  /// Ends the block after what was taken.
  struct Stop {};
};

/// One class per format. Each worker has its own.
class RecordReader {
 public:
  /// passErrors: a record with a field `error` that is not empty is taken as it is.
  explicit RecordReader(bool passErrors) : passErrors_(passErrors) {}
  virtual ~RecordReader() = default;
  /// Throws RecordSink::Stop.
  virtual void read(const Block& block, RecordSink& sink) = 0;

 protected:
  /// Records with the same key have the same schema, which makeSchema makes of the first; it may throw RecordError.
  template <class MakeSchema>
  void take(std::string_view key, const RecordView& unread, RecordSink& sink, const MakeSchema& makeSchema) {
    try {
      if (!last_ || key != lastKey_) {
        const auto known = schemas_.find(std::string(key));
        last_ = known != schemas_.end() ? known->second.get() : add(key, makeSchema(), sink);
        lastKey_ = key;
      }
      RecordView record = unread;
      record.schema = &last_->schema;
      takeKnown(record, sink);
    } catch (const RecordError& e) {
      sink.bad(unread.text, e, unread.values);
    }
  }

 private:
  struct Known {
    Schema schema;
    std::optional<std::size_t> error;          ///< the field `error`
    std::vector<std::unique_ptr<Plan>> plans;  ///< records differ in the conditions on their values
  };

  Known* add(std::string_view key, Schema schema, RecordSink& sink);
  void takeKnown(const RecordView& record, RecordSink& sink);

  bool passErrors_;
  std::unordered_map<std::string, std::unique_ptr<Known>> schemas_;
  std::size_t names_ = 0;  ///< of all schemas
  Known* last_ = nullptr;
  std::string lastKey_;
};

std::unique_ptr<RecordReader> makeJsonReader(bool passErrors);
std::unique_ptr<RecordReader> makeCsvReader(const Schema& header, bool passErrors);
std::unique_ptr<RecordReader> makeTextReader();
std::unique_ptr<RecordReader> makeBinaryReader(const Schema& schema);

}  // namespace viewproj::cmd
