// What a command does with the records of a stream.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "output/record_writer.hpp"
#include "records/layout.hpp"

namespace viewproj::cmd {

/// Each worker of a stream has one of its own. Records come in batches: added one by one, computed together, written
/// one by one.
class RecordWork {
 public:
  virtual ~RecordWork() = default;

  /// Where records of this one's shape have their numbers. Throws RecordError where they lack some.
  virtual Layout find(const RecordParts& record) const = 0;
  /// The results of such records in a form, in order. Throws RecordError where the form has no place for them.
  /// None where records are read alone.
  virtual Results results(const Layout& /*layout*/, OutputForm /*form*/) const { return {}; }

  /// Throws RecordError where the numbers are none to work on; nothing was added then.
  virtual void add(const Layout& layout, const Numbers& numbers) = 0;
  virtual void compute() {}
  /// The results of the record that was added as number i. Throws RecordError where it has none.
  virtual void write(std::size_t /*i*/, ResultSink& /*sink*/) {}
  /// Where records are read alone, instead of write: the record that was added as number i, and its line.
  virtual void read(std::size_t /*i*/, const Record& /*record*/, std::size_t /*line*/) {}
  /// The batch is done.
  virtual void clear() {}

  /// From f64 to f64, many records at once: three numbers a record in, what the writer would write out. Returns how
  /// many records from the start it took: those after it are for add and write.
  virtual std::size_t convert(std::span<const double> /*in*/, TextBuffer& /*out*/) { return 0; }
};

using MakeWork = std::function<std::unique_ptr<RecordWork>()>;

}  // namespace viewproj::cmd
