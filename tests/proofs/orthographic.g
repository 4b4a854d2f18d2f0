# A screen coordinate and the window depth in orthographic against the true ones, x = center + X and z = offset + scale W:
# the bounds that bounds.cpp computes,
#   c1 D + unit kSecondOrder |x| + lo + K   and
#   (|scale| + smallest) (c2 D + 2 unit kSecondOrder |W|) + unit kSecondOrder |z| + lo + smallest (1 + |W|),
# lo what the centre's or the offset's double leaves of it, K = kExactParameter * reach. m = M D, S = |x|; V = |scale's
# double| F D, U = |scale's double W|, Z = |z|.
#
# Taken from dot.g: X and W are within k M D and k F D. Taken from the text: the centre's double-double is within K / 2,
# offset and scale are within kExactParameter, the bound's own roundings take 2^-48 of it, and a product that
# underflows loses smallest / 8 at most. |X| <= M D (1 + 2^-20), as D is a sum of sizes.
#
#: standard: unit = kUnitDouble; roundings = kRoundings;
#! standard: kSecondOrder = 1 + 0x1p-12
k = roundings * unit * (1 + 0x1p-12);
coefficient = roundings * unit * kSecondOrder;
evaluated = 1 - 0x1p-48;
near = kUnitDouble * (1 + 0x1p-20);
third = 1 + unit * e3;
l = unit * (1 + 0x1p-20) * part;
el = -o * third;

x = S * gx;
X = m * g * (1 + 0x1p-20);
lo = l * (S + m * (1 + 0x1p-20) + K);
computed = (x - X - o * (lo + K * 0.5) + (X + k * m * a)) * (1 + unit * e3);
bound = (m * coefficient + unit * kSecondOrder * S + (lo + K)) * evaluated;

z = Z * gz;
slope = U * g * (1 + near * s);
size = Z + U * (1 + 0x1p-20);
lz = l * size;
product = (U * g + k * V * b) * (1 + unit * e2) + T * 0.125 * h;
computedZ = (z - slope - o * (lz + kExactParameter * size) + product) * (1 + unit * e3);
boundZ = (V * coefficient + U * (2 * unit * kSecondOrder) + unit * kSecondOrder * Z + lz + T) * evaluated;

bm = coefficient * evaluated;
bs = unit * kSecondOrder * evaluated;
em = k * a * third;
es = unit * (gx * e3);
ev = k * b * (1 + unit * e2) * third;
eu = (unit * e2 - near * s) * g * third + kExactParameter * (1 + 0x1p-20) * el;
ez = unit * (gz * e3) + kExactParameter * el;
bu = 2 * unit * kSecondOrder * evaluated;

{ m in [0, 0x1p1010] /\ S in [0, 0x1p1010] /\ K in [0, 0x1p1000] /\ V in [0, 0x1p1010] /\ U in [0, 0x1p1010] /\
  Z in [0, 0x1p1010] /\ T in [0, 0x1p1010] /\ |gx| <= 1 /\ |g| <= 1 /\ |gz| <= 1 /\ |o| <= 1 /\ part in [0, 1] /\
  |a| <= 1 /\ |b| <= 1 /\ |s| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |h| <= 1
-> computed - x - bound <= 0 /\ computed - x + bound >= 0 /\ computedZ - z - boundZ <= 0 /\ computedZ - z + boundZ >= 0 }

computed - x - bound ->
  m * (em - bm + l * (1 + 0x1p-20) * (el - evaluated)) + S * (es - bs + l * (el - evaluated)) +
  K * (el * 0.5 - evaluated + l * (el - evaluated));
computed - x + bound ->
  m * (em + bm + l * (1 + 0x1p-20) * (el + evaluated)) + S * (es + bs + l * (el + evaluated)) +
  K * (el * 0.5 + evaluated + l * (el + evaluated));
computedZ - z - boundZ ->
  V * (ev - bm) + U * (eu - bu + l * (1 + 0x1p-20) * (el - evaluated)) + Z * (ez - bs + l * (el - evaluated)) +
  T * (0.125 * h * third - evaluated);
computedZ - z + boundZ ->
  V * (ev + bm) + U * (eu + bu + l * (1 + 0x1p-20) * (el + evaluated)) + Z * (ez + bs + l * (el + evaluated)) +
  T * (0.125 * h * third + evaluated);
