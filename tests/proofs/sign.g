# Where a kernel says that W is certain, computed W > reach * kSignUncertainty, W is positive (and the other way round,
# by symmetry), and the bound's own test lets the point through: roundings unit kSecondOrder F D / |W|, as computed, is
# below kLargestRelativeError. Everything in shares of D: of W and computed W, of the reach that the kernel has added up.
# sizeW, F, is an entry of a row that is at most a little longer than 1 (kPoseOrthogonality).
#
# Taken from dot.g: W is within k F D. In exact, from exact_dot.g, both parts of it are within kExactDot F D, and their sum
# is a rounding of itself off.
#: standard: unit = kUnitDouble; roundings = kRoundings; sign = kSignUncertainty;
#: exact: unit = kExactDot; roundings = 1; sign = kSignUncertaintyExact;
#! standard: kSignUncertainty = 0x1p-41
#! exact: kSignUncertaintyExact = 0x1p-64
k = roundings * unit * (1 + 0x1p-12);
F = (1 + 0x1p-9) * f;
computed = sign * (1 - 0x1p-19) + more;
W = computed - k * F * b;
relative = roundings * unit * kSecondOrder * F * (kSecondOrder / W) * (1 + 0x1p-48);
{ f in [0, 1] /\ more in [0, 0x1p10] /\ |b| <= 1 -> W >= 0x1p-100 /\ relative - kLargestRelativeError <= 0 }
