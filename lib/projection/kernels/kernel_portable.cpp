// Handles one point at a time: for processors without another kernel, and in tests as the reference for the others.
#define VIEWPROJ_PORTABLE_KERNEL
#define VIEWPROJ_KERNELS kPortableKernels
#define VIEWPROJ_KERNELS_NAME "portable"
#define VIEWPROJ_POINT_KERNELS kBaselinePoints
#include "projection/kernels/kernel_source.inc"
