# A product of exact, scale * w in double-double (times): against (1 + scale.lo / scale.hi) (w.hi + w.lo), in shares of
# H = |scale.hi w.hi| and N = |scale.hi w.lo|, and its low part. The product of the high parts is a pair without an error.
#: product: roundings = 6.1;
#! product: roundings = 5.9
u = kUnitDouble;
part = u * (1 + 0x1p-20);
a = H * g;
b = N * f;
aLow = part * l;

productLow = -u * e1 * a;
low = (productLow + (b * (1 + u * e2) + aLow * a * (1 + u * e3)) * (1 + u * e4)) * (1 + u * e5);
computed = a - productLow + low + part * low * z;
true = (1 + aLow) * (a + b);
bound = H * (roundings * u * u) + N * (5.1 * u);
boundLow = H * (2.1 * u) + N * 1.1;

e45 = e4 + e5 + u * e4 * e5;
e245 = e2 + e45 + u * e2 * e45;
e345 = e3 + e45 + u * e3 * e45;
lH = g * (-u * e1 * (1 + u * e5) + aLow * (1 + u * e345));
lN = f * (1 + u * e245);
cH = g * (-u * e1 * (u * e5) + aLow * (u * e345)) + part * z * lH;
cN = f * (u * e245 - aLow) + part * z * lN;

{ H in [0, 0x1p1000] /\ N in [0, 0x1p1000] /\ |g| <= 1 /\ |f| <= 1 /\ |l| <= 1 /\ |z| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |e4| <= 1 /\ |e5| <= 1
-> computed - true - bound <= 0 /\ computed - true + bound >= 0 /\ low - boundLow <= 0 /\ low + boundLow >= 0 }

computed - true - bound -> H * (cH - roundings * u * u) + N * (cN - 5.1 * u);
computed - true + bound -> H * (cH + roundings * u * u) + N * (cN + 5.1 * u);
low - boundLow -> H * (lH - 2.1 * u) + N * (lN - 1.1);
low + boundLow -> H * (lH + 2.1 * u) + N * (lN + 1.1);
