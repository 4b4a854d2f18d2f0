// The work of a command on the records of a stream.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "output/record_writer.hpp"
#include "records/layout.hpp"

namespace viewproj::cmd {

/// Each worker of a stream has its own. The records of a batch are added one by one, computed together, then written.
class RecordWork {
 public:
  virtual ~RecordWork() = default;

  /// Where records of this shape have their numbers. Throws RecordError if they lack some.
  virtual Layout find(const RecordParts& record) const = 0;
  /// The results of such records in a format, in order. Throws RecordError if the format cannot hold them. Empty if
  /// records are only read.
  virtual Results results(const Layout& /*layout*/, OutputForm /*form*/) const { return {}; }

  /// Throws RecordError, without adding anything, if the numbers are not valid for this work.
  virtual void add(const Layout& layout, const Numbers& numbers) = 0;
  virtual void compute() {}
  /// Writes the results of record i, in the order of adding. Throws RecordError if it has none.
  virtual void write(std::size_t /*i*/, ResultSink& /*sink*/) {}
  /// Instead of write, if records are only read: record i, and its line.
  virtual void read(std::size_t /*i*/, const Record& /*record*/, std::size_t /*line*/) {}
  /// The batch is finished.
  virtual void clear() {}

  /// Converts many records at once from f64 to f64: three numbers per record in, and the writer's bytes out. Returns
  /// how many records from the start it converted; the others go through add and write.
  virtual std::size_t convert(std::span<const double> /*in*/, TextBuffer& /*out*/) { return 0; }
};

using MakeWork = std::function<std::unique_ptr<RecordWork>()>;

}  // namespace viewproj::cmd
