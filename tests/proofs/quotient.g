# A quotient of exact, a / w in double-double: high and low part against (a.hi + a.lo) / (w.hi + w.lo), in shares of
# Q = |a.hi / w.hi|; of N = |a.lo / w.hi|, as where a cancelled its low part need not be small beside the high one; and of
# what the low part of w is, next to the eye plane, beyond a rounding of the high one: y of 16 u^2, y = F D / |W|.
#
# remainder is one rounding of what it says, multiplyAdd at most two.
#: quotient: roundings = 16.1;
#! quotient: roundings = 14.9
u = kUnitDouble;
# 1.01 / kSignUncertaintyExact is as large as y gets.
y = 1.01 / kSignUncertaintyExact * share;
pu = u * (1 + 0x1p-20);
w = (pu + 16 * u * u * y) * l;
a = Q * g;
b = N * f;

first = a * ((1 + u * e1) * (1 + u * e2));
left = ((a - first) * (1 + u * e3) + (b - first * w * (1 + u * e4)) * (1 + u * e5)) * (1 + u * e6);
computed = first + left * (1 + u * e1) * (1 + u * e7);
true = (a + b) / (1 + w);
bQ = roundings * u * u;
bQy = 0x1p-30 * u * u;
bN = 5.1 * u;
bNy = 17 * u * u;
# And the low part alone.
low = left * (1 + u * e1) * (1 + u * e7);
boundLow = Q * (3.1 * u) + y * Q * (17 * u * u) + N * 1.1;
bound = Q * bQ + y * Q * bQy + N * bN + y * N * bNy;

e12 = e1 + e2 + u * e1 * e2;
e17 = e1 + e7 + u * e1 * e7;
e617 = e6 + e17 + u * e6 * e17;
e36 = e3 + e617 + u * e3 * e617;
e56 = e5 + e617 + u * e5 * e617;
e46 = e4 + e56 + u * e4 * e56;
e146 = e12 + e46 + u * e12 * e46;
z = pu * l / (1 + w) + u * e146;
cQ = g * (-u * u * e12 * e36 - pu * l * z);
cQy = -g * (pu * l * (16 * u * u * l / (1 + w)) + 16 * u * u * l * (w / (1 + w) + u * e146));
cN = f * (u * e56 + pu * l / (1 + w));
cNy = f * (16 * u * u * l / (1 + w));
lQ = g * (-u * e12 * (1 + u * e36) - pu * l * (1 + u * e146));
lQy = -g * (16 * u * u * l * (1 + u * e146));
lN = f * (1 + u * e56);

{ Q in [0, 0x1p900] /\ N in [0, 0x1p900] /\ share in [0, 1] /\ |g| <= 1 /\ |f| <= 1 /\ |l| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\
  |e3| <= 1 /\ |e4| <= 1 /\ |e5| <= 1 /\ |e6| <= 1 /\ |e7| <= 1
-> computed - true - bound <= 0 /\ computed - true + bound >= 0 /\
   low - boundLow <= 0 /\ low + boundLow >= 0 }

computed - true - bound ->
  Q * (cQ - bQ) + (y * Q) * (cQy - bQy) + N * (cN - bN) + (y * N) * (cNy - bNy) { 1 + w <> 0 };
computed - true + bound ->
  Q * (cQ + bQ) + (y * Q) * (cQy + bQy) + N * (cN + bN) + (y * N) * (cNy + bNy) { 1 + w <> 0 };
low - boundLow -> Q * (lQ - 3.1 * u) + (y * Q) * (lQy - 17 * u * u) + N * (lN - 1.1);
low + boundLow -> Q * (lQ + 3.1 * u) + (y * Q) * (lQy + 17 * u * u) + N * (lN + 1.1);
