#!/bin/sh
# Each processor takes the best kernel that it has all instructions of, and that kernel runs on it: qemu ends a program
# that uses an instruction the processor lacks.
#   sh processors.sh UNIT_TESTS
set -eu

# kernel PROCESSOR: the one used on it.
kernel() { qemu-x86_64 -cpu "$1" "$tests" '[.kernel]' 2>/dev/null | sed -n 's/^kernel //p'; }

tests=$1
status=0
while read -r processor expected; do
  used=$(kernel "$processor")
  [ "$used" = "$expected" ] && continue
  echo "on $processor: ${used:-none} is used, not $expected"
  status=1
done <<'END'
qemu64 x86-64
Nehalem x86-64
Haswell x86-64-v3
Haswell,-avx2 x86-64
Haswell,-fma x86-64
Haswell,-xsave x86-64
Haswell,-movbe x86-64-v3
Haswell,-bmi1,-bmi2,-abm,-movbe,-f16c x86-64-v3
END

# What a virtual machine may hide of what x86-64-v3 has, and the first x86-64 processor.
for processor in Haswell,-bmi1,-bmi2,-abm,-movbe,-f16c qemu64; do
  qemu-x86_64 -cpu "$processor" "$tests" 'A batch gives the bits of single points*' >/dev/null 2>&1 && continue
  echo "on $processor: a kernel that it supports fails"
  status=1
done
[ "$status" -ne 0 ] || echo "each processor has its kernel"
exit $status
