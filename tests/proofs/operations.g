# What the other scripts take of one operation, by Gappa's own rounding operators (to nearest, subnormal numbers and all).
# A product, a quotient or a conversion x becomes x (1 + unit e), |e| <= 1, and next to the subnormal numbers x + h, |h|
# at most half of the smallest number. A sum of two numbers of the format becomes (a + b) (1 + unit e) wherever it lies.
#: both:
#! both: kUnitDouble = 0x1p-54
#! both: kUnitFloat = 0x1p-25
@double = float<ieee_64, ne>;
@single = float<ieee_32, ne>;
a = double(a0);
b = double(b0);
c = single(c0);
d = single(d0);

# The error as a share of the computed value, in units.
ofComputed = -e / (1 + kUnitFloat * e);

{ |x| in [0x1p-1021, 0x1p1023] /\ |y| <= 0x1p-1021 /\ |a| <= 0x1p1022 /\ |b| <= 0x1p1022 /\
  |z| in [0x1p-125, 0x1p127] /\ |w| <= 0x1p-125 /\ |c| <= 0x1p126 /\ |d| <= 0x1p126 /\ |e| <= 1
-> double(x) -/ x in [-0x1p-53, 0x1p-53] /\ double(a + b) -/ (a + b) in [-0x1p-53, 0x1p-53] /\
   single(z) -/ z in [-0x1p-24, 0x1p-24] /\ single(c + d) -/ (c + d) in [-0x1p-24, 0x1p-24] /\
   kUnitDouble >= 0x1p-53 /\ kUnitFloat >= 0x1p-24 /\
   |double(y) - y| <= 0x1p-1075 /\ |single(w) - w| <= 0x1p-150 /\ |ofComputed| <= 0x1.00001p0 }
