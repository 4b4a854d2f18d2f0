# The dot product of exact against the true one: row . d + residual, within kExactDotX M D, and of W within kExactDotW F D.
#
# In shares of M T and M rho, with T = n0 + n1 + n2 the sizes of the differences and rho the residual's reach, D = T + rho.
# Taken from exact_low.g: low is within 20.1 u^2 M T of what it should be, and at most 5.1 u M T. From quick_sum.g: quickSum
# is off by 1.00001 u of the low term at most. From the text: all sums of two doubles but these are pairs without an
# error, their low parts within u of the sum; underflow takes 2^-150 at most.
#
# rows: what the scaled rows and the residual are off by.
#: x: bound = kExactDotX; rows = 0x1p-98;
#: w: bound = kExactDotW; rows = 0x1p-100;
#! x: kExactDotX = 0x1.1p-98
#! w: kExactDotW = 0x1.7p-100
u = kUnitDouble;
part = u * (1 + 0x1p-20);
mT = M * T;
mR = M * rho;

# The true product without its residual is high + what should be low; high is the two sums'.
high = mT * (1 + 0x1p-20) * g;
lowTrue = mT * (5.1 * u) * l - mT * (20.1 * u * u) * e;
low = mT * (5.1 * u) * l;
R = mR * c;
Rlow = mR * part * d;
true = high + lowTrue + (R + Rlow) + rows * (mT + mR) * r;

# quickSum; its low part is within u of the sum, or of a low term that is larger than the high one.
sum = high + low + part * low * q;
sumLow = mT * part * s;
# sum(result.hi, residual.hi), then quickSum with the rest.
shiftedLow = (mT + mR) * part * t;
rest = (shiftedLow + (sumLow + Rlow) * (1 + u * e1)) * (1 + u * e2);
computed = (sum - sumLow) + R - shiftedLow + rest + part * rest * z + (mT + mR) * 0x1p-150 * h;

e12 = e1 + e2 + u * e1 * e2;
lost = 0x1p-150 * h - rows * r;
eT = (20.1 * u * u) * e + part * (5.1 * u) * l * q + part * (t * (u * e2) + s * (u * e12)) +
     part * z * (part * (t * (1 + u * e2) + s * (1 + u * e12))) + lost;
eR = part * (t * (u * e2) + d * (u * e12)) + part * z * (part * (t * (1 + u * e2) + d * (1 + u * e12))) + lost;

{ M in [0x1p-300, 0x1p300] /\ T in [0, 0x1p402] /\ rho in [0, 0x1p402] /\ |g| <= 1 /\ |l| <= 1 /\ |e| <= 1 /\ |c| <= 0x1.00001p0 /\
  |d| <= 1 /\ |r| <= 1 /\ |q| <= 1 /\ |s| <= 1 /\ |t| <= 1 /\ |z| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\ |h| <= 1
-> computed - true - bound * M * (T + rho) <= 0 /\ computed - true + bound * M * (T + rho) >= 0 }

computed - true - bound * M * (T + rho) -> mT * (eT - bound) + mR * (eR - bound);
computed - true + bound * M * (T + rho) -> mT * (eT + bound) + mR * (eR + bound);
