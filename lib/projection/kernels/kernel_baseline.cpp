// Compiled for any x86-64, with SSE2, and for any aarch64, with NEON.
#define VIEWPROJ_KERNELS kBaselineKernels
#ifdef __aarch64__
#define VIEWPROJ_KERNELS_NAME "aarch64"
#else
#define VIEWPROJ_KERNELS_NAME "x86-64"
#endif
#define VIEWPROJ_POINT_KERNELS kBaselinePoints
#include "projection/kernels/kernel_source.inc"
