# What the other scripts take of one operation, by Gappa's own rounding operators (to nearest, subnormal numbers and all).
# A product, a quotient or a conversion x becomes x (1 + unit e), |e| <= 1, and next to the subnormal numbers x + h, |h|
# at most half of the smallest number. A sum of two numbers of the format becomes (a + b) (1 + unit e) wherever it lies.
#: double:
#! double: kUnitDouble = 0x1p-54
@double = float<ieee_64, ne>;
a = double(a0);
b = double(b0);

# The error as a share of the computed value, in units.
ofComputed = -e / (1 + kUnitDouble * e);

{ |x| in [0x1p-1021, 0x1p1023] /\ |y| <= 0x1p-1021 /\ |a| <= 0x1p1022 /\ |b| <= 0x1p1022 /\
  |e| <= 1
-> double(x) -/ x in [-0x1p-53, 0x1p-53] /\ double(a + b) -/ (a + b) in [-0x1p-53, 0x1p-53] /\
   kUnitDouble >= 0x1p-53 /\ |double(y) - y| <= 0x1p-1075 /\ |ofComputed| <= 0x1.00001p0 }
