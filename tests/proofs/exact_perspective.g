# A coordinate or a depth of exact in perspective, before it is certified, against the true one, x = center + q: within
# margin, of the kZivMargin (4) that the code takes, of
#   kExactDotX M D / |W| + kExactDotW F D / |W| |q| + kExactParameter (|q| + reach),
# and a depth the same without the first term, with the offset for the centre and scale for X. m = M D / |W|, y = F D / |W|,
# Q = |q|, r = reach. Where W is a coordinate's difference to the eye (forwardIsAxis), it has no error and y is 0.
#
# Taken from exact_dot.g: X and W. From quotient.g: the quotient and its low part. From the text: the centre is within half of
# kExactParameter * reach, and scale within half of kExactParameter; high parts of centre and X are about as large as the
# whole, low parts as quick_sum.g has them.
#: perspective: margin = 1.01;
#! perspective: margin = 0.99
u = kUnitDouble;
part = u * (1 + 0x1p-20);
y = 1.01 / kSignUncertaintyExact * share;
q = Q * g;
W = 1 + kExactDotW * y * b;

# |X.hi / W.hi| and |X.lo / W.hi|.
H = (1.01 * Q + 0x1p-90 * m) * p;
N = (part * H + 16 * u * u * m) * n;
quotient = (q * (1 + kExactParameter * 0.5 * f) + kExactDotX * m * a) / W +
           (H * (16.1 * u * u) + y * H * (0x1p-30 * u * u) + N * (5.1 * u) + y * N * (17 * u * u)) * v;
low = (H * (3.1 * u) + y * H * (17 * u * u) + N * 1.1) * l;
center = c0 + kExactParameter * 0.5 * r * c;
centerLow = part * (1.01 * r) * d;
x = c0 + q;

# sum, and quickSum with the low parts.
sumLow = part * (1.01 * (r + H)) * s;
rest = (sumLow + (low + centerLow) * (1 + u * e1)) * (1 + u * e2);
computed = (center - centerLow) + (quotient - low) - sumLow + rest + part * rest * z;
bound = margin * (kExactDotX * m + kExactDotW * y * Q + kExactParameter * (Q + r));

# Of each size, y times Q apart.
e12 = e1 + e2 + u * e1 * e2;
oS = u * e2 + part * z * (1 + u * e2);
oL = u * e12 + part * z * (1 + u * e12);
lH = 3.1 * u + part * n * 1.1;
hQ = 1.01 * p;
hm = 0x1p-90 * p;
vH = 16.1 * u * u + 5.1 * u * (part * n);
vHy = 0x1p-30 * u * u + 17 * u * u * (part * n);
cQ = kExactParameter * 0.5 * f * g / W + hQ * (vH * v + lH * l * oL + part * 1.01 * s * oS);
cQy = -kExactDotW * b * g / W + hQ * (vHy * v + 17 * u * u * l * oL);
cm = kExactDotX * a / W + hm * (vH * v + lH * l * oL + part * 1.01 * s * oS) +
     16 * u * u * n * (5.1 * u * v + 1.1 * l * oL) +
     y * (hm * (vHy * v + 17 * u * u * l * oL) + 16 * u * u * n * (17 * u * u) * v);
cr = kExactParameter * 0.5 * c + part * 1.01 * (d * oL + s * oS);

{ m in [0, 0x1p900] /\ Q in [0, 0x1p900] /\ r in [0, 0x1p900] /\ share in [0, 1] /\ p in [0, 1] /\ n in [0, 1] /\
  |g| <= 1 /\ |a| <= 1 /\ |b| <= 1 /\ |f| <= 1 /\ |v| <= 1 /\ |l| <= 1 /\ |c| <= 1 /\ |d| <= 1 /\ |s| <= 1 /\ |z| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |c0| <= 0x1p900
-> computed - x - bound <= 0 /\ computed - x + bound >= 0 }

computed - x - bound ->
  m * (cm - margin * kExactDotX) + (y * Q) * (cQy - margin * kExactDotW) + Q * (cQ - margin * kExactParameter) +
  r * (cr - margin * kExactParameter) { W <> 0 };
computed - x + bound ->
  m * (cm + margin * kExactDotX) + (y * Q) * (cQy + margin * kExactDotW) + Q * (cQ + margin * kExactParameter) +
  r * (cr + margin * kExactParameter) { W <> 0 };
