// A stream's blocks through identical workers, in order and in bounded memory.
//
// Each worker takes the reader's lock, reads a block into its own buffer and takes a ticket, gives the lock back,
// works, and waits until all blocks before are out to put out its own. So memory is workers times two buffers, however
// long the input and however slow the reader downstream.
#pragma once

#include <functional>
#include <memory>

#include "stream/block_reader.hpp"
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
  /// Until it is true the first worker stays alone.
  std::function<bool()> mayShare = [] { return true; };
  /// With several jobs, called in the catch block of the worker that fails: it ends the process, or else the run ends
  /// once no other worker waits for input.
  void (*failed)() = nullptr;
};

/// Runs to the end of the input. Throws what a worker or the output throws.
void runPipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output);

}  // namespace viewproj::cmd
