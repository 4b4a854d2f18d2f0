# A screen coordinate in perspective against the true one, x = center + q with q = X / W: the bound that bounds.cpp
# computes,
#   t (c1 + c2 |q|) + 2 unit kSecondOrder |q| + unit kSecondOrder |x| + lo + K,
# lo what the centre's double leaves of it, K = kExactParameter * reach. m = M D / |W|, y = F D / |W|, Q = |q|, S = |x|.
#
# Taken from dot.g: X and W are within k M D and k F D. Taken from the text: the centre's double-double is within K / 2,
# the bound's own roundings take 2^-48 of it, and its |q|, from the rounded x and the rounded centre, falls short of
# the true one by 2^-53 * 1.0625 |x| + lo + K / 2 at most.
#: standard: unit = kUnitDouble; roundings = kRoundings;
#! standard: kSecondOrder = 1 + 0x1p-10
k = roundings * unit * (1 + 0x1p-12);
coefficient = roundings * unit * kSecondOrder;
evaluated = 1 - 0x1p-48;

# Below kLargestRelativeError, as computed.
y = kLargestRelativeError / coefficient * (1 + 0x1p-48) * share;
x = S * gx;
q = Q * gq;
lo = unit * (1 + 0x1p-20) * part * (S + Q + K);
center = x - q - g * (lo + K * 0.5);

W = 1 + k * y * b;
quotient = (q + k * m * a) / W * ((1 + unit * e1) * (1 + unit * e2)) + m * unit * 0x1p-20 * h;
computed = (center + quotient) * (1 + unit * e3);
ofQ = y * coefficient + 2 * unit * kSecondOrder;
bound = (m * coefficient + (Q - short * (0x1.1p-53 * S + lo + K * 0.5)) * ofQ + unit * kSecondOrder * S + (lo + K)) * evaluated;

# The error and the bound, a share of each size.
e12 = e1 + e2 + unit * e1 * e2;
third = 1 + unit * e3;
em = k * a * (1 + unit * e12) * third / W + unit * 0x1p-20 * h * third;
ey = -k * b * gq * third / W;
eq = unit * e12 * gq * third / W;
es = unit * (gx * e3);
el = -g * third;
l = unit * (1 + 0x1p-20) * part;
bm = coefficient * evaluated;
bq = 2 * unit * kSecondOrder * evaluated;
bs = (unit * kSecondOrder - short * 0x1.1p-53 * ofQ) * evaluated;
bl = (1 - short * ofQ) * evaluated;
bk = (1 - short * 0.5 * ofQ) * evaluated;

{ m in [0, 0x1p1000] /\ Q in [0, 0x1p1000] /\ S in [0, 0x1p1000] /\ K in [0, 0x1p1000] /\ share in [0, 1] /\
  |gx| <= 1 /\ |gq| <= 1 /\ |g| <= 1 /\ part in [0, 1] /\ short in [0, 1] /\ |a| <= 1 /\ |b| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |h| <= 1
-> computed - x - bound <= 0 /\ computed - x + bound >= 0 }

computed - x - bound ->
  m * (em - bm) + (y * Q) * (ey - bm) + Q * (eq - bq + l * (el - bl)) + S * (es - bs + l * (el - bl)) +
  K * (el * 0.5 - bk + l * (el - bl)) { W <> 0 };
computed - x + bound ->
  m * (em + bm) + (y * Q) * (ey + bm) + Q * (eq + bq + l * (el + bl)) + S * (es + bs + l * (el + bl)) +
  K * (el * 0.5 + bk + l * (el + bl)) { W <> 0 };
