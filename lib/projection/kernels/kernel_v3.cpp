// Compiled for AVX2 and FMA: what x86-64-v3 has of use here. lib/CMakeLists.txt says which options.
#define VIEWPROJ_KERNELS kV3Kernels
#define VIEWPROJ_KERNELS_NAME "x86-64-v3"
#include "projection/kernels/kernel_source.inc"
