// A stream's blocks through identical workers, in order and in bounded memory.
//
// Each worker takes the reader's lock, reads a block into its own buffer and takes the next number, gives the lock
// back, works and hands over what it made; whoever hands over the block whose turn it is puts it out, and those that
// are done behind it. So none sleeps while there is input, unless it is some blocks ahead. Memory is workers times
// three buffers and a few more, however long the input and however slow the reader downstream.
#pragma once

#include <functional>
#include <memory>

#include "stream/block_reader.hpp"
#include "stream/ordered_output.hpp"

namespace viewproj::cmd {

class BlockWorker {
 public:
  virtual ~BlockWorker() = default;
  virtual void work(Block& block, BlockResult& result) = 0;
};

struct PipelineSetup {
  unsigned jobs = 1;
  std::function<std::unique_ptr<BlockWorker>(BlockResult&)> makeWorker;
  /// While it says so, a block may only be worked on when all before it are out. Asked in that order.
  std::function<bool()> inOrder = [] { return false; };
  /// With several jobs, called in the catch block of the worker that fails: it ends the process, or else the run ends
  /// once no other worker waits for input.
  void (*failed)() = nullptr;
};

/// Runs to the end of the input. Threads are started with the first block of some size that is not the last one. Throws
/// what a worker or the output throws.
void runPipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output);

}  // namespace viewproj::cmd
