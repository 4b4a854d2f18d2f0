// libFuzzer's two functions. --target=NAME chooses the target: one program, linked once.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fuzz.hpp"

namespace {

const viewproj::fuzz::Target* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr const char* kOption = "--target=";
  for (int i = 1; i < *argc; ++i)
    if (std::strncmp((*argv)[i], kOption, std::strlen(kOption)) == 0)
      target = viewproj::fuzz::findTarget((*argv)[i] + std::strlen(kOption));
  if (!target) {
    std::fprintf(stderr, "--target=NAME is needed, one of");
    for (const auto& known : viewproj::fuzz::targets()) std::fprintf(stderr, " %s", known.name.data());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  viewproj::fuzz::takeOverStandardStreams();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
