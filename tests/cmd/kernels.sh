#!/bin/sh
# Code compiled for a later processor must not be what the rest of the library is linked to: such a kernel defines nothing
# that a linker could take for another file's.
#   sh kernels.sh LIBRARY      77: nm is not there
set -eu
command -v nm >/dev/null || { echo "nm is not installed"; exit 77; }
symbols=$(nm -A --defined-only "$1")
echo "$symbols" | awk '
  /(kernel|point)_v[34]/ && / [WVu] / && !/ DW\.ref\./ { print; shared = 1 }
  /kernel_v[34].*Kernels/ { ++kernels }
  END {
    if (shared || kernels < 2) exit 1
    print kernels " kernels keep their code to themselves"
  }'
