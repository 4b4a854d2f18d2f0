// Compiled for AVX-512 as in x86-64-v4. lib/CMakeLists.txt sets the options.
#define VIEWPROJ_KERNELS kV4Kernels
#define VIEWPROJ_KERNELS_NAME "x86-64-v4"
#define VIEWPROJ_POINT_KERNELS kV3Points
#include "projection/kernels/kernel_source.inc"
