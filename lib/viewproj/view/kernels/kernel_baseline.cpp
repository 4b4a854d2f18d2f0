#define VIEWPROJ_KERNELS kBaselineKernels
#define VIEWPROJ_KERNELS_NAME "baseline"
#define VIEWPROJ_KERNELS_SUPPORTED true
#include "viewproj/view/kernels/kernel_source.inc"
