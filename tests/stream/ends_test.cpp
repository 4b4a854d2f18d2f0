// How a run ends that is cut short: by its reader, the disk, a signal or its input.
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "stream/process.hpp"
#include "stream/run.hpp"

using namespace viewproj::tests;

namespace {

#if defined(__has_feature)
#define WATCHED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define WATCHED 1
#else
#define WATCHED 0
#endif
#if WATCHED
constexpr std::size_t kMostMemory = std::size_t{1} << 30;
#else
constexpr std::size_t kMostMemory = std::size_t{16} << 20;
#endif

using Arguments = std::vector<std::string>;

bool exitedWith(int status, int code) { return WIFEXITED(status) && WEXITSTATUS(status) == code; }
bool diedOf(int status, int signal) { return WIFSIGNALED(status) && WTERMSIG(status) == signal; }

bool isF64(const Arguments& arguments) { return arguments[1] == "f64"; }
bool isArray(const Arguments& arguments) { return arguments[1] == "json"; }

const Arguments kOutputs[] = {{"--to", "ndjson"}, {"--to", "json"}, {"--to", "csv"}, {"--to", "text"}, {"--to", "f64"}};

/// Records that CSV writes over two lines.
constexpr const char* kRecord = "{\"name\":\"a\\nb\",\"x\":1,\"y\":2,\"z\":3}\n";

/// Nothing but whole records, and an array that is closed.
void checkWhole(const std::string& out, const Arguments& arguments, bool closed = true) {
  if (isF64(arguments)) {
    CHECK(out.size() % 24 == 0);
    return;
  }
  if (isArray(arguments) && closed) {
    CHECK(nlohmann::json::accept(out));
    return;
  }
  if (out.empty()) return;
  CHECK(out.back() == '\n');
  const std::size_t before = out.size() > 1 ? out.rfind('\n', out.size() - 2) + 1 : 0;
  std::string last = out.substr(before);
  if (arguments[1] == "ndjson") CHECK(nlohmann::json::accept(last));
  if (arguments[1] == "json") CHECK((last == "[\n" || last.ends_with("},\n")));
  if (arguments[1] == "csv") CHECK((last.starts_with("b\",1,2,3,") || last.starts_with("name,")));
  if (arguments[1] == "text") CHECK(std::count(last.begin(), last.end(), ' ') == 2);
}

/// Waits until nothing more comes into the pipe: its writer is stuck, or has nothing to write.
int waitUntilStill(int pipe) {
  int before = -1, now = 0;
  for (int still = 0; still < 5; still = now == before && now > 0 ? still + 1 : 0) {
    before = now;
    ::usleep(20000);
    ::ioctl(pipe, FIONREAD, &now);
  }
  return now;
}

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    char name[] = "/tmp/viewproj-stream-XXXXXX";
    const Descriptor file(::mkstemp(name));
    name_ = name;
    (void)writeAll(file, content);
  }
  ~TemporaryFile() { ::unlink(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

std::string times(const std::string& text, std::size_t count) {
  std::string all;
  all.reserve(count * text.size());
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("a reader that goes away ends an endless run quietly") {
  for (const Arguments& to : kOutputs)
    for (const char* jobs : {"1", "4"}) {
      Pipe in, out, err;
      Tool tool({to[0], to[1], "--jobs", jobs}, {.in = in.read, .out = out.write, .err = err.write});
      in.read.close();
      out.write.close();
      err.write.close();
      const Feeder feeder(std::move(in.write), "", times(kRecord, 1000));
      (void)readUpTo(out.read, 10);
      out.read.close();
      CHECK(exitedWith(tool.wait(), 0));
      CHECK(readUpTo(err.read).empty());
    }
}

TEST_CASE("a full device is an error in every form") {
  for (const Arguments& to : kOutputs) {
    const TemporaryFile file(times(kRecord, 10));
    const Descriptor full(::open("/dev/full", O_WRONLY | O_CLOEXEC));
    Pipe err;
    Tool tool({to[0], to[1], "--from", "json", file.name()}, {.out = full, .err = err.write});
    err.write.close();
    CHECK(exitedWith(tool.wait(), 1));
    CHECK(readUpTo(err.read) == "viewproj: standard output: No space left on device\n");
  }
}

TEST_CASE("a full disk keeps whole records") {
  const TemporaryFile file(times(kRecord, 20000));
  for (const Arguments& to : kOutputs)
    for (const std::size_t size : {1000u, 1001u, 1013u, 1024u, 400001u}) {
      INFO(to[1] << ", " << size);
      Descriptor out(::memfd_create("out", MFD_CLOEXEC));
      Pipe err;
      Tool tool({to[0], to[1], "--from", "json", file.name()}, {.out = out, .err = err.write, .fileSize = size});
      err.write.close();
      CHECK(exitedWith(tool.wait(), 1));
      CHECK(readUpTo(err.read) == "viewproj: standard output: File too large\n");
      ::lseek(out, 0, SEEK_SET);
      const std::string written = readUpTo(out);
      CHECK(written.size() <= size);
      CHECK(written.size() > size - 300);
      checkWhole(written, to, false);
    }
}

TEST_CASE("files that cannot be read are named") {
  const auto messageOf = [](const std::string& name) {
    Pipe err;
    Tool tool({name}, {.err = err.write});
    err.write.close();
    CHECK(exitedWith(tool.wait(), 1));
    return readUpTo(err.read);
  };
  CHECK(messageOf("/nowhere/points.csv") == "viewproj: /nowhere/points.csv: No such file or directory\n");
  CHECK(messageOf("/tmp") == "viewproj: /tmp: Is a directory\n");
  CHECK(messageOf("/proc/self/mem") == "viewproj: /proc/self/mem: Input/output error\n");
  const TemporaryFile file("[1,2,3]\n");
  std::filesystem::permissions(file.name(), std::filesystem::perms::none);
  if (::access(file.name().c_str(), R_OK) != 0)
    CHECK(messageOf(file.name()) == "viewproj: " + file.name() + ": Permission denied\n");
}

TEST_CASE("a file that is removed is read to its end, and one that is cut off to its last whole record") {
  for (const bool cut : {false, true}) {
    const std::string record = "[1,2,3]\n";
    const std::size_t count = 400000;
    const TemporaryFile file(times(record, count));
    Pipe out, err;
    Tool tool({"--to", "text", file.name(), "--from", "json"}, {.out = out.write, .err = err.write});
    out.write.close();
    err.write.close();
    (void)waitUntilStill(out.read);
    if (cut)
      CHECK(::truncate(file.name().c_str(), static_cast<off_t>(record.size() * (count - 10) + 4)) == 0);
    else
      ::unlink(file.name().c_str());
    const std::string all = readUpTo(out.read);
    CHECK(static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n')) == (cut ? count - 10 : count));
    CHECK(exitedWith(tool.wait(), cut ? 1 : 0));
    const std::string said = readUpTo(err.read);
    CHECK(said.find(":" + std::to_string(count - 9) + ":5: not valid JSON") ==
          (cut ? 10 + file.name().size() : std::string::npos));
  }
}

TEST_CASE("a signal while waiting for input ends the run behind whole records") {
  struct Input {
    const char* form;
    std::string bytes;
    std::size_t lines;
  };
  const Input inputs[] = {
      {"json", "[1,2,3]\n[4,5,6]\n[7,", 2}, {"json", "[[1,2,3],[4,5,6],", 2}, {"json", "{\"points\":[[1,2,3],\n", 1},
      {"csv", "x,y,z\n1,2,3\n4,5", 2},      {"text", "1 2 3\n4 5", 1},        {"json", "", 0}};
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    for (const Input& input : inputs) {
      INFO(input.bytes << ", signal " << signal);
      Pipe in, out;
      Tool tool({"--from", input.form, "--jobs", "2"}, {.in = in.read, .out = out.write});
      out.write.close();
      (void)writeAll(in.write, input.bytes);
      std::string all = readLines(out.read, input.lines);
      if (input.lines == 0) ::usleep(50000);
      tool.signal(signal);
      CHECK(diedOf(tool.wait(), signal));
      all += readUpTo(out.read);
      if (!all.empty()) CHECK(all.back() == '\n');
      if (input.bytes.starts_with("[[") || input.bytes.starts_with("{")) CHECK(nlohmann::json::accept(all));
      CHECK(static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n')) >= input.lines);
    }
}

TEST_CASE("a signal in the midst of the work ends the run behind whole records, with an open array closed") {
  std::string lines, array = "[";
  for (int i = 0; i < 3000; ++i) {
    const std::string record = "[" + std::to_string(i == 2000 ? 4714 : i % 1000) + ",2,3]";
    lines += record + "\n";
    array += (i > 0 ? "," : "") + record;
  }
  array += "]";
  for (const unsigned jobs : {1u, 3u})
    for (const std::string& input : {lines, array}) {
      const StreamRun run = runStream(input, {.from = viewproj::cmd::Form::json, .jobs = jobs, .block = 1000});
      CHECK(run.status == 128 + SIGTERM);
      CHECK(run.err.empty());
      const auto count = std::count(run.out.begin(), run.out.end(), '{');
      CHECK(count > 1000);
      CHECK(count <= 2001);
      if (input.starts_with("[["))
        CHECK(nlohmann::json::accept(run.out));
      else
        CHECK(run.out.ends_with("}\n"));
    }
}

TEST_CASE("a signal while the reader sleeps ends the run behind a whole record; another ends it at once") {
  for (const Arguments& to : kOutputs)
    for (const bool twice : {false, true}) {
      INFO(to[1] << (twice ? ", twice" : ""));
      Pipe in, out;
      Tool tool({to[0], to[1], "--jobs", "3"}, {.in = in.read, .out = out.write});
      in.read.close();
      out.write.close();
      const Feeder feeder(std::move(in.write), "", times(kRecord, 1000));
      CHECK(waitUntilStill(out.read) > 60000);
      CHECK(tool.peakMemory() < kMostMemory);
      tool.signal(SIGTERM);
      ::usleep(20000);
      if (twice) {
        tool.signal(SIGTERM);
        CHECK(diedOf(tool.wait(), SIGTERM));
        continue;
      }
      const std::string all = readUpTo(out.read);
      CHECK(diedOf(tool.wait(), SIGTERM));
      CHECK(all.size() < 200000);
      checkWhole(all, to);
    }
}

TEST_CASE("a record is answered before the next one is there") {
  using namespace std::string_literals;
  struct Talk {
    Arguments arguments;
    std::vector<std::string> said;
    std::size_t answerBytes;  ///< 0: a line
  };
  const std::string three("\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\xF0\x3F", 24);
  const Talk talks[] = {
      {{"--jobs", "4"}, {"[1,2,3]\n", "{\"x\":1,\n\"y\":2,\"z\":3}\n", "[1,2,3]\n"}, 0},
      {{}, {"[1,2,3]", "[1,2,3]"}, 0},
      {{}, {"{\"x\":1,\"y\":2,\"z\":3}", "\n[1,2,3]"}, 0},
      {{"--from", "json"}, {"[1,2,3]", "[1,2,3]", " {\"x\":1,\"y\":2,\"z\":3}"}, 0},
      {{"--from", "json", "--to", "ndjson"}, {"[[1,2,3]", ",[1,2,3]", ",\n[1,2,3]", ",[1,2,3]]"}, 0},
      {{"--to", "json", "--from", "json"}, {"", "[1,2,3]\n", "[1,2,3]\n"}, 0},
      {{}, {"x,y,z\n", "1,2,3\n", "\"1\",2,3\n"}, 0},
      {{"--to", "csv"}, {"1 2 3\n", "1 2 3\n"}, 0},
      {{"--from", "f64"}, {three, three}, 24},
      {{"--from", "text"}, {"1 2 3\n", "1 2 3\r\n"}, 0},
  };
  for (const Talk& talk : talks) {
    Pipe in, out;
    Tool tool(talk.arguments, {.in = in.read, .out = out.write});
    out.write.close();
    for (const std::string& said : talk.said) {
      INFO(said);
      (void)writeAll(in.write, said);
      const bool first = &said == &talk.said.front();
      // JSON --to json: a record is written behind what separates it from the last.
      const bool array = talk.arguments.size() > 1 && talk.arguments[1] == "json" && talk.arguments[0] == "--to";
      if (array && first) continue;
      const std::string answer = talk.answerBytes > 0 ? readUpTo(out.read, talk.answerBytes)
                                 : array              ? readUpTo(out.read, 20)
                                                      : readLines(out.read, 1);
      CHECK(answer.size() >= std::max<std::size_t>(talk.answerBytes, 3));
      if (array) break;
    }
    in.write.close();
    CHECK(exitedWith(tool.wait(), 0));
  }
}

TEST_CASE("progress is told on a terminal alone, and taken away in the end") {
  const auto run = [](Terminal& terminal, int err, int out, std::size_t pieces) {
    Pipe in;
    Tool tool({}, {.in = in.read, .out = out >= 0 ? out : -1, .err = err});
    in.read.close();
    for (std::size_t i = 0; i < pieces; ++i) {
      (void)writeAll(in.write, times("[1,2,3]\n", 1000));
      ::usleep(100000);
    }
    in.write.close();
    CHECK(exitedWith(tool.wait(), 0));
    terminal.end.close();
    return readUpTo(terminal.read);
  };
  {
    Terminal terminal;
    const std::string shown = run(terminal, terminal.end, -1, 15);
    CHECK(shown.find(" records, ") != std::string::npos);
    CHECK(shown.find(" records/s") != std::string::npos);
    CHECK(shown.ends_with("\r\033[K"));
  }
  {
    Terminal terminal;
    CHECK(run(terminal, terminal.end, -1, 5).empty());  // half a second
  }
  {
    Terminal terminal;
    Pipe err;
    (void)run(terminal, err.write, -1, 15);
    err.write.close();
    CHECK(readUpTo(err.read).empty());
  }
  // Of a file it is known how much is left; the reader is slow here.
  const TemporaryFile file(times("[1,2,3]\n", 200000));
  Terminal terminal;
  Pipe out;
  Tool tool({"--from", "json", "--jobs", "1", file.name()}, {.out = out.write, .err = terminal.end});
  out.write.close();
  for (std::size_t got = 1; got > 0;) {
    got = readUpTo(out.read, 1 << 20).size();
    ::usleep(100000);
  }
  CHECK(exitedWith(tool.wait(), 0));
  terminal.end.close();
  const std::string shown = readUpTo(terminal.read);
  CHECK(shown.find(" %, ") != std::string::npos);
  CHECK(shown.find(" left") != std::string::npos);
  CHECK(shown.ends_with("\r\033[K"));
}

TEST_CASE("workers are started where there is work for them, by a pipe or a file") {
  constexpr std::size_t kOwn = WATCHED;  // threads that a sanitizer may have
  const std::string some = times("[1,2,33]\n", 1000);
  for (const bool fromFile : {false, true}) {
    INFO(fromFile);
    const TemporaryFile file(times(some, 100));
    Pipe in, out;
    Tool tool({"--from", "json", "--jobs", "4", fromFile ? file.name() : "-"}, {.in = in.read, .out = out.write});
    in.read.close();
    out.write.close();
    const Feeder feeder(std::move(in.write), "", some);
    CHECK(waitUntilStill(out.read) > 0);
    CHECK(tool.threads() >= 4);
    CHECK(tool.threads() <= 4 + kOwn);
    tool.signal(SIGKILL);
    (void)tool.wait();
  }
  // A little at a time, or all of it at once.
  Pipe in, out;
  Tool tool({"--from", "json", "--jobs", "4"}, {.in = in.read, .out = out.write});
  in.read.close();
  (void)writeAll(in.write, some);
  (void)readLines(out.read, 1000);
  for (int i = 0; i < 20; ++i) {
    (void)writeAll(in.write, "[1,2,33]\n");
    (void)readLines(out.read, 1);
  }
  CHECK(tool.threads() <= 1 + kOwn);
  in.write.close();
  CHECK(exitedWith(tool.wait(), 0));
}

TEST_CASE("memory does not grow with the input") {
  // VIEWPROJ_STREAM_MEGABYTES in the environment: of each form.
  const char* wanted = std::getenv("VIEWPROJ_STREAM_MEGABYTES");
  const std::size_t most = (wanted ? std::strtoull(wanted, nullptr, 10) : 10) << 20;
  struct Input {
    const char* name;
    Arguments arguments;
    std::string first, again;
    std::size_t bytesOut;  ///< of a record; 0: a line
  };
  const std::string record = "{\"id\":\"p1\",\"x\":1.25,\"y\":-3.5,\"z\":10.75}";
  const Input inputs[] = {
      {"NDJSON", {"--from", "json"}, "", record + "\n", 0},
      {"an array on one line", {"--from", "json"}, "[" + record, "," + record, 0},
      {"a document over many lines", {"--from", "json"}, "{\"points\":[\n" + record, ",\n" + record, 0},
      {"arrays of two on lines", {"--from", "json", "--to", "ndjson"}, "", "[" + record + "," + record + "]\n", 0},
      {"records on one line", {"--from", "json"}, "", record + " ", 0},
      {"CSV", {"--from", "csv"}, "id,x,y,z\n", "p1,1.25,-3.5,10.75\n", 0},
      {"text", {"--from", "text"}, "", "1.25 -3.5 10.75\n", 0},
      {"f64", {"--from", "f64"}, "", std::string(24, '\x40'), 24},
      {"f64 as NDJSON", {"--from", "f64", "--to", "ndjson"}, "", std::string(24, '\x40'), 0},
  };
  for (const Input& input : inputs) {
    Pipe in, out;
    Arguments arguments = input.arguments;
    arguments.insert(arguments.end(), {"--jobs", "2"});
    Tool tool(arguments, {.in = in.read, .out = out.write});
    in.read.close();
    out.write.close();
    const std::size_t rounds = most / (1000 * input.again.size()) + 1;
    std::thread writer([&] {
      const std::string thousand = times(input.again, 1000);
      (void)writeAll(in.write, input.first);
      for (std::size_t i = 0; i < rounds; ++i) (void)writeAll(in.write, thousand);
    });
    // All but the last answers: an array's last record has no line break behind it yet.
    const std::size_t records = 1000 * rounds * (input.again.starts_with('[') ? 2 : 1);
    std::size_t left = input.bytesOut > 0 ? records * input.bytesOut : records - 1;
    std::vector<char> buffer(1 << 16);
    while (left > 0) {
      const ssize_t got = ::read(out.read, buffer.data(), buffer.size());
      if (got <= 0) break;
      const auto count = input.bytesOut > 0 ? got : std::count(buffer.begin(), buffer.begin() + got, '\n');
      left -= std::min(left, static_cast<std::size_t>(count));
    }
    writer.join();
    INFO(input.name << ": " << (tool.peakMemory() >> 10) << " KiB");
    CHECK(left == 0);
    CHECK(tool.peakMemory() > 0);
    CHECK(tool.peakMemory() < kMostMemory);
  }
}
