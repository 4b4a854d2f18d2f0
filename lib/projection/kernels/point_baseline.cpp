// Compiled for any processor.
#define VIEWPROJ_POINT_KERNELS kBaselinePoints
#include "projection/kernels/point_source.inc"
