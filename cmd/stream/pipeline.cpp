#include "stream/pipeline.hpp"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace viewproj::cmd {
namespace {

class Pipeline {
 public:
  Pipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output)
      : setup_(setup), reader_(reader), output_(output) {}

  void run() {
    work(true);
    for (std::thread& thread : threads_) thread.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void work(bool isFirst) {
    try {
      Block block;
      BlockResult result;
      const auto worker = setup_.makeWorker(result);
      bool startsOthers = isFirst && setup_.jobs > 1;
      for (std::size_t ticket = 0; read(block, ticket);) {
        if (startsOthers && isWorthMore(block) && setup_.mayShare()) {
          startOthers();
          startsOthers = false;
        }
        worker->work(block, result);
        if (!waitForTurn(ticket)) return;
        output_.put(block, result);
        endTurn();
      }
    } catch (...) {
      if (setup_.jobs > 1 && setup_.failed) setup_.failed();  // others may be waiting for input
      stop(std::current_exception());
    }
  }

  /// Whether there is more input, and blocks are large enough to share work. Pipes often give less than a block.
  bool isWorthMore(const Block& block) const { return !block.last && block.bytes.size() >= reader_.blockSize() / 4; }

  void startOthers() {
    for (unsigned i = 1; i < setup_.jobs; ++i) {
      try {
        threads_.emplace_back([this] { work(false); });
      } catch (const std::system_error&) {
        return;  // continue with fewer threads
      }
    }
  }

  bool read(Block& block, std::size_t& ticket) {
    const std::lock_guard lock(reading_);
    if (stopped_ || !reader_.next(block)) return false;
    ticket = tickets_++;
    return true;
  }

  /// False if the run has ended.
  bool waitForTurn(std::size_t ticket) {
    std::unique_lock lock(ordering_);
    turned_.wait(lock, [&] { return stopped_ || turn_ == ticket; });
    return !stopped_;
  }

  void endTurn() {
    {
      const std::lock_guard lock(ordering_);
      ++turn_;
    }
    turned_.notify_all();
  }

  void stop(const std::exception_ptr& error) {
    {
      const std::lock_guard lock(ordering_);
      if (!error_) error_ = error;
      stopped_ = true;
    }
    turned_.notify_all();
  }

  const PipelineSetup& setup_;
  BlockReader& reader_;
  OrderedOutput& output_;
  std::mutex reading_, ordering_;
  std::condition_variable turned_;
  std::size_t tickets_ = 0, turn_ = 0;
  std::exception_ptr error_;
  std::atomic<bool> stopped_{false};
  std::vector<std::thread> threads_;
};

}  // namespace

void runPipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output) {
  Pipeline(setup, reader, output).run();
}

}  // namespace viewproj::cmd
