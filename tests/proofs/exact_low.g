# The low sum of exact's dot product against what it should be, and its size, in shares of M (n0 + n1 + n2): the low parts
# of differences and rows times the other's high part, the errors of the products, and those of the two sums, which are
# pairs without an error (twoSum, productError). Low parts are in units of their high ones; their products are left out
# by the code. multiplyAdd is taken to round twice, which it does at most.
#: low: error = 20.1; size = 5.1;
#! low: error = 19.9
#! low: size = 4.9
u = kUnitDouble;
part = u * (1 + 0x1p-20);
T = n0 + n1 + n2;

crossed0 = (M * a0 * (n0 * g0 * part * c0) * (1 + u * i0) + M * part * b0 * (n0 * g0) * (1 + u * j0)) * (1 + u * k0);
crossed1 = (M * a1 * (n1 * g1 * part * c1) * (1 + u * i1) + M * part * b1 * (n1 * g1) * (1 + u * j1)) * (1 + u * k1);
crossed2 = (M * a2 * (n2 * g2 * part * c2) * (1 + u * i2) + M * part * b2 * (n2 * g2) * (1 + u * j2)) * (1 + u * k2);
p0 = M * n0 * part * q0;
p1 = M * n1 * part * q1;
p2 = M * n2 * part * q2;
s = M * (n0 + n1) * part * s0;
t = M * T * part * t0;
low = ((crossed0 + crossed1) * (1 + u * e1) + (crossed2 + ((p0 + p1) * (1 + u * e2) + p2) * (1 + u * e3)) * (1 + u * e4)) *
      (1 + u * e5) * (1 + u * e7) + (s + t) * (1 + u * e6) * (1 + u * e7);
true = M * (a0 * (n0 * g0 * part * c0) + part * b0 * (n0 * g0) + part * b0 * (n0 * g0 * part * c0)) +
       M * (a1 * (n1 * g1 * part * c1) + part * b1 * (n1 * g1) + part * b1 * (n1 * g1 * part * c1)) +
       M * (a2 * (n2 * g2 * part * c2) + part * b2 * (n2 * g2) + part * b2 * (n2 * g2 * part * c2)) + (p0 + p1 + p2 + s + t);

e57 = e5 + e7 + u * e5 * e7;
e67 = e6 + e7 + u * e6 * e7;
e157 = e1 + e57 + u * e1 * e57;
e457 = e4 + e57 + u * e4 * e57;
e3457 = e3 + e457 + u * e3 * e457;
e23457 = e2 + e3457 + u * e2 * e3457;
x0 = k0 + e157 + u * k0 * e157;
x1 = k1 + e157 + u * k1 * e157;
x2 = k2 + e457 + u * k2 * e457;
y0 = i0 + x0 + u * i0 * x0;
y1 = i1 + x1 + u * i1 * x1;
y2 = i2 + x2 + u * i2 * x2;
z0 = j0 + x0 + u * j0 * x0;
z1 = j1 + x1 + u * j1 * x1;
z2 = j2 + x2 + u * j2 * x2;

# Of each size, low's share and the error's.
l0 = part * (g0 * (a0 * c0 * (1 + u * y0) + b0 * (1 + u * z0)) + q0 * (1 + u * e23457) + (s0 + t0) * (1 + u * e67));
l1 = part * (g1 * (a1 * c1 * (1 + u * y1) + b1 * (1 + u * z1)) + q1 * (1 + u * e23457) + (s0 + t0) * (1 + u * e67));
l2 = part * (g2 * (a2 * c2 * (1 + u * y2) + b2 * (1 + u * z2)) + q2 * (1 + u * e3457) + t0 * (1 + u * e67));
r0 = part * (g0 * (a0 * c0 * (u * y0) + b0 * (u * z0) - part * b0 * c0) + q0 * (u * e23457) + (s0 + t0) * (u * e67));
r1 = part * (g1 * (a1 * c1 * (u * y1) + b1 * (u * z1) - part * b1 * c1) + q1 * (u * e23457) + (s0 + t0) * (u * e67));
r2 = part * (g2 * (a2 * c2 * (u * y2) + b2 * (u * z2) - part * b2 * c2) + q2 * (u * e3457) + t0 * (u * e67));
E = error * u * u;
L = size * u;

{ M in [0x1p-300, 0x1p300] /\ n0 in [0, 0x1p400] /\ n1 in [0, 0x1p400] /\ n2 in [0, 0x1p400] /\
  |a0| <= 1 /\ |a1| <= 1 /\ |a2| <= 1 /\ |g0| <= 1 /\ |g1| <= 1 /\ |g2| <= 1 /\
  |b0| <= 1 /\ |b1| <= 1 /\ |b2| <= 1 /\ |c0| <= 1 /\ |c1| <= 1 /\ |c2| <= 1 /\
  |i0| <= 1 /\ |i1| <= 1 /\ |i2| <= 1 /\ |j0| <= 1 /\ |j1| <= 1 /\ |j2| <= 1 /\ |k0| <= 1 /\ |k1| <= 1 /\ |k2| <= 1 /\
  |q0| <= 1 /\ |q1| <= 1 /\ |q2| <= 1 /\ |s0| <= 1 /\ |t0| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |e4| <= 1 /\ |e5| <= 1 /\ |e6| <= 1 /\ |e7| <= 1
-> low - true - E * M * T <= 0 /\ low - true + E * M * T >= 0 /\ low - L * M * T <= 0 /\ low + L * M * T >= 0 }

low - true - E * M * T -> (M * n0) * (r0 - E) + (M * n1) * (r1 - E) + (M * n2) * (r2 - E);
low - true + E * M * T -> (M * n0) * (r0 + E) + (M * n1) * (r1 + E) + (M * n2) * (r2 + E);
low - L * M * T -> (M * n0) * (l0 - L) + (M * n1) * (l1 - L) + (M * n2) * (l2 - L);
low + L * M * T -> (M * n0) * (l0 + L) + (M * n1) * (l1 + L) + (M * n2) * (l2 + L);
