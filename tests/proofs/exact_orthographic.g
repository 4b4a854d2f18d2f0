# A coordinate of exact in orthographic, before it is certified, against the true one, x = center + X: within margin, of the
# kZivMargin (4) that the code takes, of kExactDotX M D + kExactParameter (|X| + reach). And a depth, with the offset for the
# centre and scale W for X: dot is kExactDotW then, m is |scale| F D, or 0
# (forwardIsAxis). m = M D, Q = |X|, r = reach.
#
# Taken from exact_dot.g: X and W. From product.g: the depth's product; a coordinate has none. From the text: the rest, as in
# exact_perspective.g.
#: x: margin = 1.01; dot = kExactDotX;
#: depth: margin = 1.01; dot = kExactDotW;
#! x: margin = 0.99
#! depth: margin = 0.99
u = kUnitDouble;
part = u * (1 + 0x1p-20);
X = Q * g;
H = (1.01 * Q + 0x1p-90 * m) * p;
N = (part * H + 16 * u * u * m) * n;
product = X * (1 + kExactParameter * 0.5 * f) + dot * m * (1 + kExactParameter) * a + (H * (6.1 * u * u) + N * (5.1 * u)) * v;
low = (H * (2.1 * u) + N * 1.1) * l;
center = c0 + kExactParameter * 0.5 * r * c;
centerLow = part * (1.01 * r) * d;
x = c0 + X;

sumLow = part * (1.01 * (r + H)) * s;
rest = (sumLow + (low + centerLow) * (1 + u * e1)) * (1 + u * e2);
computed = (center - centerLow) + (product - low) - sumLow + rest + part * rest * z;
bound = margin * (dot * m + kExactParameter * (Q + r));

e12 = e1 + e2 + u * e1 * e2;
oS = u * e2 + part * z * (1 + u * e2);
oL = u * e12 + part * z * (1 + u * e12);
cH = (6.1 * u * u + 5.1 * u * (part * n)) * v + (2.1 * u + part * n * 1.1) * l * oL + part * 1.01 * s * oS;
cQ = kExactParameter * 0.5 * f * g + 1.01 * p * cH;
cm = dot * (1 + kExactParameter) * a + 0x1p-90 * p * cH + 16 * u * u * n * (5.1 * u * v + 1.1 * l * oL);
cr = kExactParameter * 0.5 * c + part * 1.01 * (d * oL + s * oS);

{ m in [0, 0x1p1000] /\ Q in [0, 0x1p1000] /\ r in [0, 0x1p1000] /\ p in [0, 1] /\ n in [0, 1] /\
  |g| <= 1 /\ |a| <= 1 /\ |f| <= 1 /\ |v| <= 1 /\ |l| <= 1 /\ |c| <= 1 /\ |d| <= 1 /\ |s| <= 1 /\ |z| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |c0| <= 0x1p1000
-> computed - x - bound <= 0 /\ computed - x + bound >= 0 }

computed - x - bound ->
  m * (cm - margin * dot) + Q * (cQ - margin * kExactParameter) + r * (cr - margin * kExactParameter);
computed - x + bound ->
  m * (cm + margin * dot) + Q * (cQ + margin * kExactParameter) + r * (cr + margin * kExactParameter);
