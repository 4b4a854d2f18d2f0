# The window depth in perspective against the true one, z = offset + scale / W: the bound that bounds.cpp computes,
#   (|scale| + smallest) / |W| (c2 t + unit kSecondOrder + 2 unit kSecondOrder) + unit kSecondOrder |z| + lo +
#   smallest (1 + 1 / |W|),
# lo what the offset's double leaves of it. y = F D / |W|, S = |scale's double / W|, Z = |z|.
#
# Taken from dot.g: W is within k F D. Taken from the text: offset and scale are double-doubles within kExactParameter,
# the bound's own roundings take 2^-48 of it, and a product that underflows loses smallest / 8 at most.
#
#: standard: unit = kUnitDouble; roundings = kRoundings;
#! standard: kSecondOrder = 1 + 0x1p-10
k = roundings * unit * (1 + 0x1p-12);
coefficient = roundings * unit * kSecondOrder;
evaluated = 1 - 0x1p-48;
near = kUnitDouble * (1 + 0x1p-20);

y = kLargestRelativeError / coefficient * (1 + 0x1p-48) * share;
z = Z * gz;
slope = S * g * (1 + near * s);
size = Z + S * (1 + 0x1p-20);
lo = unit * (1 + 0x1p-20) * part * size;
offset = z - slope - o * (lo + kExactParameter * size);

W = 1 + k * y * b;
product = S * g * (1 + unit * e1) / W * (1 + unit * e2) + T * 0.125 * h;
computed = (offset + product) * (1 + unit * e3);
bound = (S * (y * coefficient + unit * kSecondOrder + 2 * unit * kSecondOrder) + unit * kSecondOrder * Z + lo + T) * evaluated;

third = 1 + unit * e3;
w = k * y * b;
e12 = e1 + e2 + unit * e1 * e2;
l = unit * (1 + 0x1p-20) * part;
el = -o * third;
ez = unit * (gz * e3) + kExactParameter * el;
ey = -(k * b * (1 + near * s)) * g * third / W;
es = (unit * e12 - near * s) * g * third / W + kExactParameter * (1 + 0x1p-20) * el;
bs = 3 * unit * kSecondOrder * evaluated;
by = coefficient * evaluated;
bz = unit * kSecondOrder * evaluated;

{ S in [0, 0x1p1000] /\ Z in [0, 0x1p1000] /\ T in [0, 1] /\ share in [0, 1] /\ |g| <= 1 /\ |gz| <= 1 /\ |s| <= 1 /\
  |o| <= 1 /\ part in [0, 1] /\ |b| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |h| <= 1
-> computed - z - bound <= 0 /\ computed - z + bound >= 0 }

computed - z - bound ->
  (y * S) * (ey - by) + S * (es - bs + l * (1 + 0x1p-20) * (el - evaluated)) + Z * (ez - bz + l * (el - evaluated)) +
  T * (0.125 * h * third - evaluated) { W <> 0 };
computed - z + bound ->
  (y * S) * (ey + by) + S * (es + bs + l * (1 + 0x1p-20) * (el + evaluated)) + Z * (ez + bz + l * (el + evaluated)) +
  T * (0.125 * h * third + evaluated) { W <> 0 };
