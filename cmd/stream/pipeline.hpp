// Passes a stream's blocks through identical workers, in order and with bounded memory.
//
// Each worker locks the reader, reads a block into its own buffer, takes a ticket and unlocks the reader. It processes
// the block and waits until all blocks before it are written, then writes its own. So memory is two buffers per worker,
// however long the input is and however slow the output.
#pragma once

#include <functional>
#include <memory>

#include "stream/batch.hpp"
#include "stream/ordered_output.hpp"

namespace viewproj::cmd {

class BlockWorker {
 public:
  virtual ~BlockWorker() = default;
  virtual void work(const Block& block, BlockResult& result) = 0;
};

struct PipelineSetup {
  unsigned jobs = 1;
  std::function<std::unique_ptr<BlockWorker>(BlockResult&)> makeWorker;
  /// The first worker runs alone until this is true.
  std::function<bool()> mayShare = [] { return true; };
  /// With several jobs, called in the catch block of a worker that fails. It may end the process. Otherwise the run
  /// ends when no other worker waits for input.
  void (*failed)() = nullptr;
};

/// Runs to the end of the input. Throws the exception of a worker or of the output.
void runPipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output);

}  // namespace viewproj::cmd
