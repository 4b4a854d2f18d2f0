// The tool as a process of its own, between descriptors that the test holds.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace viewproj::tests {

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  operator int() const { return descriptor_; }
  void close();

 private:
  int descriptor_;
};

struct Pipe {
  Pipe();
  Descriptor read, write;
};

/// A terminal: what is written to its end can be read.
struct Terminal {
  Terminal();
  Descriptor read, end;
};

/// Writes all of it, or until nobody can read it. Returns whether it was all.
bool writeAll(int to, std::string_view text);
/// What is there before the end, or before so many bytes were read, or nothing came for ten seconds.
std::string readUpTo(int from, std::size_t most = static_cast<std::size_t>(-1));
/// Reads until there are so many line breaks.
std::string readLines(int from, std::size_t count);

/// Writes a text again and again from a thread of its own, until the pipe is closed at the other end.
class Feeder {
 public:
  Feeder(Descriptor to, std::string before, std::string again);
  ~Feeder() { thread_.join(); }

 private:
  std::thread thread_;
};

class Tool {
 public:
  struct Setup {
    int in = -1, out = -1, err = -1;  ///< -1: /dev/null
    std::size_t fileSize = 0;         ///< the most a file may have; 0: any
  };
  /// Runs `viewproj project -c CAMERA arguments`. It dies after a minute.
  Tool(std::vector<std::string> arguments, const Setup& setup);
  ~Tool();
  Tool(const Tool&) = delete;
  Tool& operator=(const Tool&) = delete;

  /// Waits for its end. What wait() of <sys/wait.h> says.
  int wait();
  void signal(int number) const;
  /// The most memory that it has had so far, in bytes. It must be running.
  std::size_t peakMemory() const;
  /// How many threads it has. It must be running.
  std::size_t threads() const;

 private:
  /// A number of its status by the system. name: with a colon.
  std::size_t status(const std::string& name) const;

  pid_t process_ = -1;
};

}  // namespace viewproj::tests
