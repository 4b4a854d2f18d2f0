// Compiled with -march=x86-64-v4.
#define VIEWPROJ_KERNELS kV4Kernels
#define VIEWPROJ_KERNELS_NAME "x86-64-v4"
#define VIEWPROJ_KERNELS_SUPPORTED                                                                                  \
  (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && \
   __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("fma"))
#include "viewproj/view/kernels/kernel_source.inc"
