// Compiled for AVX2 and FMA, the useful part of x86-64-v3. lib/CMakeLists.txt sets the options.
#define VIEWPROJ_KERNELS kV3Kernels
#define VIEWPROJ_KERNELS_NAME "x86-64-v3"
#define VIEWPROJ_POINT_KERNELS kV3Points
#include "projection/kernels/kernel_source.inc"
