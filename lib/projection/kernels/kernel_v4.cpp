// Compiled for AVX-512, as x86-64-v4 has it. lib/CMakeLists.txt says which options.
#define VIEWPROJ_KERNELS kV4Kernels
#define VIEWPROJ_KERNELS_NAME "x86-64-v4"
#include "projection/kernels/kernel_source.inc"
