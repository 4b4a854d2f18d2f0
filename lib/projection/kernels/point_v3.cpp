// Compiled for FMA, as in x86-64-v3. lib/CMakeLists.txt sets the options.
#define VIEWPROJ_POINT_KERNELS kV3Points
#include "projection/kernels/point_source.inc"
