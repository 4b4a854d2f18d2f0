#include "stream/pipeline.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace viewproj::cmd {
namespace {

class Pipeline {
 public:
  Pipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output, InterruptGuard& guard)
      : setup_(setup), reader_(reader), output_(output), guard_(guard) {}

  void run() {
    worker(setup_.jobs);
    for (std::thread& thread : threads_) thread.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// mayStart: how many workers this one may make of itself.
  void worker(unsigned mayStart) {
    try {
      Block block;
      BlockResult result;
      const auto own = setup_.makeWorker(result);
      std::size_t number = 0;
      while (read(block, number)) {
        if (mayStart > 1 && block.bytes.size() >= reader_.blockSize()) {
          start(mayStart - 1);
          mayStart = 1;
        }
        if (inOrder_ && !waitForTurn(number)) return;
        result.out.clear();
        result.records = 0;
        result.arrays = false;
        result.passedOver.clear();
        result.notes.clear();
        result.fault.reset();
        own->work(block, result);
        if (!waitForTurn(number)) return;
        output_.put(block, result);
        passOn();
      }
    } catch (...) {
      stop(std::current_exception());
    }
  }

  void start(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      try {
        threads_.emplace_back([this] { worker(1); });
      } catch (const std::system_error&) {
        // uncounted: faults_call has it fail, but not beside sanitizers
        return;  // with fewer, then
      }
    }
  }

  bool read(Block& block, std::size_t& number) {
    const std::lock_guard lock(reading_);
    if (stopped_ || !reader_.next(block)) return false;
    number = blocks_++;
    return true;
  }

  bool waitForTurn(std::size_t number) {
    std::unique_lock lock(ordering_);
    turned_.wait(lock, [&] { return stopped_ || turn_ == number; });
    return !stopped_;
  }

  void passOn() {
    {
      const std::lock_guard lock(ordering_);
      inOrder_ = setup_.inOrder();
      ++turn_;
    }
    turned_.notify_all();
  }

  /// Only the one whose turn it is can fail, or one that keeps all others from theirs.
  void stop(const std::exception_ptr& error) {
    {
      const std::lock_guard lock(ordering_);
      if (!error_) error_ = error;
      stopped_ = true;
    }
    turned_.notify_all();
    guard_.wake();
  }

  const PipelineSetup& setup_;
  BlockReader& reader_;
  OrderedOutput& output_;
  InterruptGuard& guard_;

  std::mutex reading_;
  std::size_t blocks_ = 0;

  std::mutex ordering_;
  std::condition_variable turned_;
  std::size_t turn_ = 0;
  std::exception_ptr error_;
  std::atomic<bool> stopped_{false};
  std::atomic<bool> inOrder_{setup_.inOrder()};

  std::vector<std::thread> threads_;
};

}  // namespace

void runPipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output, InterruptGuard& guard) {
  Pipeline(setup, reader, output, guard).run();
}

}  // namespace viewproj::cmd
