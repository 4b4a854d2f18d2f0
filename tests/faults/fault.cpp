// Preloaded into the tool, lets one of its calls fail: VIEWPROJ_FAULT="CALL N KIND", CALL by name, the Nth of them in
// main from 1, KIND what happens (once, or with a + behind it from then on): an errno by number, or `short` for one
// byte. With VIEWPROJ_FAULT_COUNTS=FILE it counts: a line `CALL COUNT` for each.
#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Call { kMalloc, kOpen, kRead, kWrite, kPoll, kStat, kSeek, kThread, kCalls };
constexpr const char* kNames[kCalls] = {"malloc", "open", "read", "write", "poll", "stat", "seek", "thread"};

std::atomic<long> counts[kCalls];
std::atomic<bool> inMain{false};
int failing = -1, errorNumber = 0;
long first = 0, last = 0;
bool isShort = false;

/// Whether this one fails; errno is set then.
bool fails(Call call) {
  if (!inMain) return false;
  const long number = ++counts[call];
  if (call != failing || number < first || number > last) return false;
  if (!isShort) errno = errorNumber;
  return true;
}

void readSetup() {
  const char* setup = std::getenv("VIEWPROJ_FAULT");
  char name[16], kind[16];
  if (!setup || std::sscanf(setup, "%15s %ld %15s", name, &first, kind) != 3) return;
  for (int call = 0; call < kCalls; ++call)
    if (std::strcmp(name, kNames[call]) == 0) failing = call;
  last = std::strchr(kind, '+') ? 1L << 60 : first;
  isShort = std::strncmp(kind, "short", 5) == 0;
  errorNumber = std::atoi(kind);
}

void writeCounts() {
  const char* file = std::getenv("VIEWPROJ_FAULT_COUNTS");
  if (!file) return;
  if (std::FILE* out = std::fopen(file, "w")) {
    for (int call = 0; call < kCalls; ++call) std::fprintf(out, "%s %ld\n", kNames[call], counts[call].load());
    std::fclose(out);
  }
}

int (*realMain)(int, char**, char**);

int mainBetween(int argc, char** argv, char** environment) {
  readSetup();
  inMain = true;
  const int status = realMain(argc, argv, environment);
  inMain = false;
  writeCounts();
  return status;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void* __libc_malloc(size_t);

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*end)(), void* stack) {
  realMain = main;
  return next<decltype(&__libc_start_main)>("__libc_start_main")(mainBetween, argc, argv, init, fini, end, stack);
}

void* malloc(size_t size) { return fails(kMalloc) ? nullptr : __libc_malloc(size); }

int open(const char* name, int flags, ...) {  // none of the tool's creates a file
  return fails(kOpen) ? -1 : static_cast<int>(::syscall(SYS_openat, AT_FDCWD, name, flags, 0));
}

ssize_t read(int file, void* to, size_t most) {
  if (fails(kRead)) {
    if (!isShort) return -1;
    most = most > 1 ? 1 : most;
  }
  return ::syscall(SYS_read, file, to, most);
}

ssize_t write(int file, const void* from, size_t size) {
  if (file == STDOUT_FILENO && fails(kWrite)) {
    if (!isShort) return -1;
    size = size > 1 ? 1 : size;
  }
  return ::syscall(SYS_write, file, from, size);
}

int poll(pollfd* files, nfds_t count, int milliseconds) {
  return fails(kPoll) ? -1 : static_cast<int>(::syscall(SYS_poll, files, count, milliseconds));
}

int fstat(int file, struct stat* state) { return fails(kStat) ? -1 : next<decltype(&fstat)>("fstat")(file, state); }

off_t lseek(int file, off_t at, int from) { return fails(kSeek) ? -1 : ::syscall(SYS_lseek, file, at, from); }

int pthread_create(pthread_t* thread, const pthread_attr_t* how, void* (*run)(void*), void* with) {
  if (fails(kThread)) return errorNumber;
  return next<decltype(&pthread_create)>("pthread_create")(thread, how, run, with);
}
}
