#!/bin/sh
# Code compiled for a later processor must not be what the rest of the library is linked to: such a kernel defines nothing
# that a linker could take for another file's.
#   sh kernels.sh LIBRARY
set -eu
command -v nm >/dev/null || { echo "no nm here: not checked"; exit 0; }
shared=$(nm -A --defined-only "$1" | grep 'kernel_v[34]' | grep ' [WVu] ' | grep -v ' DW\.ref\.' || true)
if [ -n "$shared" ]; then
  echo "$shared"
  exit 1
fi
nm -A --defined-only "$1" | grep -c 'kernel_v[34].*Kernels' | sed 's/$/ kernels keep their code to themselves/'
