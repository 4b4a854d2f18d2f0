# The window depth in perspective against the true one, z = offset + scale / W: the bound that bounds.cpp computes,
#   (|scale| + smallest) / |W| (c2 t + unit kSecondOrder + 2 last kSecondOrder) + last kSecondOrder |z| + lo +
#   smallest (1 + 1 / |W|),
# lo what the offset's double leaves of it. y = F D / |W|, S = |scale's double / W|, Z = |z|.
#
# Taken from dot.g: W is within k F D. Taken from the text: offset and scale are double-doubles within kExactParameter,
# the bound's own roundings take 2^-48 of it, and a product that underflows loses smallest / 8 at most.
#
# narrowed: whether scale and offset are rounded to float32.
#: standard: unit = kUnitDouble; roundings = kRoundings; last = kUnitDouble; narrowed = 0;
#: fast: unit = kUnitFloat; roundings = kRoundings; last = kUnitDouble; narrowed = 0;
#: float: unit = kUnitFloat; roundings = kRoundingsFloat; last = kUnitFloat; narrowed = 1;
#! standard: kSecondOrder = 1 + 0x1p-10
#! fast: kSecondOrder = 1 + 0x1p-10
#! float: kSecondOrder = 1 + 0x1p-10
k = roundings * unit * (1 + 0x1p-12);
coefficient = roundings * unit * kSecondOrder;
evaluated = 1 - 0x1p-48;
near = kUnitDouble * (1 + 0x1p-20);

y = kLargestRelativeError / coefficient * (1 + 0x1p-48) * share;
z = Z * gz;
slope = S * g * (1 + near * s);
size = Z + S * (1 + 0x1p-20);
lo = last * (1 + 0x1p-20) * part * size;
offset = z - slope - o * (lo + kExactParameter * size);

W = 1 + k * y * b;
product = S * g * (1 + narrowed * last * (1 + 0x1p-20) * n) * (1 + unit * e1) / W * (1 + last * e2) + T * 0.125 * h;
computed = (offset + product) * (1 + last * e3);
bound = (S * (y * coefficient + unit * kSecondOrder + 2 * last * kSecondOrder) + last * kSecondOrder * Z + lo + T) * evaluated;

third = 1 + last * e3;
w = k * y * b;
n2 = narrowed * (1 + 0x1p-20) * n + e2 + last * (narrowed * (1 + 0x1p-20) * n) * e2;
n12 = unit * e1 + last * n2 + unit * last * e1 * n2;
l = last * (1 + 0x1p-20) * part;
el = -o * third;
ez = last * (gz * e3) + kExactParameter * el;
ey = -(k * b * (1 + near * s)) * g * third / W;
es = (n12 - near * s) * g * third / W + kExactParameter * (1 + 0x1p-20) * el;
bs = (unit + 2 * last) * kSecondOrder * evaluated;
by = coefficient * evaluated;
bz = last * kSecondOrder * evaluated;

{ S in [0, 0x1p1000] /\ Z in [0, 0x1p1000] /\ T in [0, 1] /\ share in [0, 1] /\ |g| <= 1 /\ |gz| <= 1 /\ |s| <= 1 /\
  |o| <= 1 /\ part in [0, 1] /\ |b| <= 1 /\ |n| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |h| <= 1
-> computed - z - bound <= 0 /\ computed - z + bound >= 0 }

computed - z - bound ->
  (y * S) * (ey - by) + S * (es - bs + l * (1 + 0x1p-20) * (el - evaluated)) + Z * (ez - bz + l * (el - evaluated)) +
  T * (0.125 * h * third - evaluated) { W <> 0 };
computed - z + bound ->
  (y * S) * (ey + by) + S * (es + bs + l * (1 + 0x1p-20) * (el + evaluated)) + Z * (ez + bz + l * (el + evaluated)) +
  T * (0.125 * h * third + evaluated) { W <> 0 };
