#include "stream/run.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "records/points.hpp"
#include "stream/random_text.hpp"
#include "text/error.hpp"

namespace viewproj::tests {
namespace {

using namespace cmd;

constexpr double kUnlucky = 4713;

constexpr ResultRow kSum{"sum"}, kTwice{"twice", ResultKind::vector, 3};

class Summing final : public RecordProcessor {
 public:
  explicit Summing(const ColumnChoice& columns) : reading_{.columns = columns} {}
  NumberPlan locate(const RecordView& record) const override { return findPoint(record, reading_); }
  ResultRows rows(const NumberPlan&) const override { return {&kSum, &kTwice}; }
  void add(const NumberPlan& plan, const Numbers& numbers, const RecordCamera&) override {
    points_.push_back(toPoint(plan, numbers));
  }
  void results(std::size_t i, ResultValues& values) override {
    const Vec4& p = points_[i];
    if (p.x == kUnlucky) throw RecordError(0, "x is 4713");
    values.add(p.x + p.y + p.z);
    values.add(Vec3{2 * p.x, 2 * p.y, 2 * p.z});
  }
  bool isVisible(std::size_t i) const override { return std::fmod(std::fabs(points_[i].x), 4) < 1; }
  void clear() override { points_.clear(); }

  std::size_t convert(std::span<const double> in, TextBuffer& out) override {
    std::size_t count = 0;
    for (; count < in.size() / 3; ++count) {
      const double x = in[3 * count], y = in[3 * count + 1], z = in[3 * count + 2];
      const double results[] = {x + y + z, 2 * x, 2 * y, 2 * z};
      const double all = results[0] + results[1] + results[2] + results[3];
      if (x == kUnlucky || !std::isfinite(all)) break;
      out += std::string_view(reinterpret_cast<const char*>(results), sizeof results);
    }
    return count;
  }

 private:
  PointReading reading_;
  std::vector<Vec4> points_;
};

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {
    if (descriptor < 0) throw std::runtime_error("no descriptor");
  }
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return descriptor_; }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_;
};

void writeAll(int to, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(to, text.data(), text.size());
    if (written < 0) return;  // the run has ended
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string contentOf(int memory) {
  std::string text(static_cast<std::size_t>(::lseek(memory, 0, SEEK_END)), '\0');
  if (::pread(memory, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    throw std::runtime_error("cannot read back");
  return text;
}

/// While it lives, a standard descriptor is another.
class Standard {
 public:
  Standard(int which, int instead) : which_(which), before_(::fcntl(which, F_DUPFD_CLOEXEC, 3)) {
    ::dup2(instead, which);
  }
  ~Standard() {
    if (before_ >= 0)
      ::dup2(before_, which_);
    else
      ::close(which_);
  }

 private:
  int which_;
  Descriptor before_;
};

}  // namespace

const char* nameOf(OutputForm form) {
  static constexpr const char* kNames[] = {"ndjson", "json", "csv", "text", "f64"};
  return kNames[static_cast<std::size_t>(form)];
}

StreamRun runStream(const std::string& input, const StreamHow& how) {
  StreamSetup setup;
  setup.from = how.from;
  setup.to = how.to;
  setup.keepGoing = how.keepGoing;
  setup.visibleOnly = how.visibleOnly;
  setup.jobs = how.jobs;
  setup.failed = nullptr;
  setup.blockSize = how.block;
  setup.delimiter = how.delimiter;
  setup.width = how.width;
  setup.csvDefaults = {"x", "y", "z"};
  if (!how.columns.empty()) {
    setup.columns = chooseColumns(how.columns, kPointColumns);
    setup.numberNames = setup.columns.columnNames();
  }
  setup.arrayName = "position";
  setup.prefix = how.prefix;
  std::signal(SIGPIPE, SIG_IGN);

  Descriptor out(::memfd_create("out", MFD_CLOEXEC)), err(::memfd_create("err", MFD_CLOEXEC));
  int in[2] = {-1, -1};
  std::thread feeder;
  if (how.largestPiece > 0) {
    if (::pipe2(in, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  } else {
    in[0] = ::memfd_create("in", MFD_CLOEXEC);
    writeAll(in[0], input);
    ::lseek(in[0], 0, SEEK_SET);
  }
  Descriptor from(in[0]);
  StreamRun run;
  {
    const Standard standardIn(STDIN_FILENO, from), standardOut(STDOUT_FILENO, out), standardErr(STDERR_FILENO, err);
    from.close();
    if (how.largestPiece > 0)
      feeder = std::thread([&, to = in[1]] {
        RandomText random(how.seed);
        for (std::size_t at = 0; at < input.size();) {
          const std::size_t size = std::min(1 + random.below(how.largestPiece), input.size() - at);
          writeAll(to, std::string_view(input).substr(at, size));
          at += size;
          if (random.oneIn(3)) std::this_thread::sleep_for(std::chrono::microseconds(random.below(80)));
        }
        ::close(to);
      });
    try {
      const RecordCameras camera(cameraIn({}, {}));  // which these results do not need
      run.status = runFilter(setup, camera, [&](OutputForm) { return std::make_unique<Summing>(setup.columns); });
    } catch (const InputError& e) {
      run.status = 1;
      run.err = e.what();
    } catch (const UsageError& e) {
      run.status = 2;
      run.err = e.what();
    } catch (...) {
      run.status = -1;
      run.err = "something unknown";
    }
  }
  if (feeder.joinable()) feeder.join();
  run.out = contentOf(out);
  run.err = contentOf(err) + run.err;
  return run;
}

}  // namespace viewproj::tests
