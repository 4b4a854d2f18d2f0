#include "stream/pipeline.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace viewproj::cmd {
namespace {

/// So many blocks, and one for each worker, may be done before their turn. Fewer, and pipes let workers sleep; more,
/// and nothing is faster.
constexpr std::size_t kAhead = 4;

class Pipeline {
 public:
  Pipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output)
      : setup_(setup), reader_(reader), output_(output) {}

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
        if (mayStart > 1 && isWorthMore(block)) {
          start(mayStart - 1);
          mayStart = 1;
        }
        if (inOrder_ && !waitForTurn(number)) return;
        result.out.clear();
        result.records = 0;
        result.passedOver.clear();
        result.notes.clear();
        result.fault.reset();
        own->work(block, result);
        if (!finish(number, block, result)) return;
      }
    } catch (...) {
      if (setup_.jobs > 1 && setup_.failed) setup_.failed();  // others may wait for input
      stop(std::current_exception());
    }
  }

  /// Whether there is more to come, and as much at a time as work for others. Pipes often give less than a full block.
  bool isWorthMore(const Block& block) const { return !block.last && block.bytes.size() >= reader_.blockSize() / 4; }

  void start(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      try {
        threads_.emplace_back([this] { worker(1); });
      } catch (const std::system_error&) {
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

  /// Hands over what was made of a block for its buffers of before, and puts out what is next, unless another one does.
  bool finish(std::size_t number, BlockFrame& frame, BlockResult& result) {
    std::unique_lock lock(ordering_);
    turned_.wait(lock, [&] { return stopped_ || number - turn_ < finished_.size(); });
    if (stopped_) return false;
    Finished& own = finished_[number % finished_.size()];
    std::swap(own.frame, frame);
    std::swap(own.result, result);
    own.ready = true;
    if (std::exchange(writing_, true)) return true;
    for (Finished* next; (next = &finished_[turn_ % finished_.size()])->ready;) {
      lock.unlock();
      output_.put(next->frame, next->result);
      lock.lock();
      next->ready = false;
      inOrder_ = setup_.inOrder();
      ++turn_;
      turned_.notify_all();
    }
    writing_ = false;
    return true;
  }

  /// Only the one who puts blocks out can fail, or one that keeps all others from theirs.
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

  std::mutex reading_;
  std::size_t blocks_ = 0;

  std::mutex ordering_;
  std::condition_variable turned_;
  std::size_t turn_ = 0;  ///< the block that is to be put out next
  /// What is done before its turn, the block with number n at n modulo the size.
  struct Finished {
    BlockFrame frame;
    BlockResult result;
    bool ready = false;
  };
  std::vector<Finished> finished_ = std::vector<Finished>(setup_.jobs + kAhead);
  bool writing_ = false;  ///< one of the workers is putting blocks out
  std::exception_ptr error_;
  std::atomic<bool> stopped_{false};
  std::atomic<bool> inOrder_{setup_.inOrder()};

  std::vector<std::thread> threads_;
};

}  // namespace

void runPipeline(const PipelineSetup& setup, BlockReader& reader, OrderedOutput& output) {
  Pipeline(setup, reader, output).run();
}

}  // namespace viewproj::cmd
