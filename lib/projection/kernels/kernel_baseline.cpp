// Compiled for any x86-64.
#define VIEWPROJ_KERNELS kBaselineKernels
#define VIEWPROJ_KERNELS_NAME "x86-64"
#include "projection/kernels/kernel_source.inc"
