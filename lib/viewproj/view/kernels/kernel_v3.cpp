// Compiled with -march=x86-64-v3.
#define VIEWPROJ_KERNELS kV3Kernels
#define VIEWPROJ_KERNELS_NAME "x86-64-v3"
#define VIEWPROJ_KERNELS_SUPPORTED (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
#include "viewproj/view/kernels/kernel_source.inc"
