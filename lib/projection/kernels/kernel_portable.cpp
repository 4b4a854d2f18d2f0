// One point after the other: for every processor, and what the others are compared with.
#define VIEWPROJ_PORTABLE_KERNEL
#define VIEWPROJ_KERNELS kPortableKernels
#define VIEWPROJ_KERNELS_NAME "portable"
#include "projection/kernels/kernel_source.inc"
