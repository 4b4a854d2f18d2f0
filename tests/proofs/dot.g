# A dot product of standard against the true one: row . d + residual, within roundings * unit * M * D.
#
# M is the row's largest entry, D = n0 + n1 + n2 + rho the sum that the code's bound takes: the sizes of the computed
# differences and the residual's reach. Every quantity is one of these sizes times a share; e, f, r, s are roundings
# in units, h what is lost to underflow (operations.g).
#
# roundings * unit * (1 + 2^-12) is proved; what kSecondOrder grants beyond that is left for what comes after.
#
#: standard: unit = kUnitDouble; roundings = kRoundings;
#! standard: kRoundings = 5
k = roundings * unit * (1 + 0x1p-12);
wide = 1 + 0x1p-20;
D = n0 + n1 + n2 + rho;
lost = M * D * unit * 0x1p-20;

# The true row, difference and residual, from the doubles that the camera has.
A0 = M * (a0 + unit * wide * r0);
A1 = M * (a1 + unit * wide * r1);
A2 = M * (a2 + unit * wide * r2);
d0 = n0 * g0 * (1 + unit * wide * f0);
d1 = n1 * g1 * (1 + unit * wide * f1);
d2 = n2 * g2 * (1 + unit * wide * f2);
R = M * rho * c;
X = A0 * d0 + A1 * d1 + A2 * d2 + R;

# What is computed.
p0 = M * a0 * (n0 * g0) * (1 + unit * e0) + lost * h0;
p1 = M * a1 * (n1 * g1) * (1 + unit * e1) + lost * h1;
p2 = M * a2 * (n2 * g2) * (1 + unit * e2) + lost * h2;
computed = (((p0 + p1) * (1 + unit * e3) + p2) * (1 + unit * e4) + (R * (1 + unit * s) + lost * h3)) * (1 + unit * e5);

# (1 + unit e4) (1 + unit e5) = 1 + unit e45, and so on; fi, ri of each term apart.
e45 = e4 + e5 + unit * e4 * e5;
e345 = e3 + e45 + unit * e3 * e45;
t0 = e0 + e345 + unit * e0 * e345;
t1 = e1 + e345 + unit * e1 * e345;
t2 = e2 + e45 + unit * e2 * e45;
H = unit * 0x1p-20 * ((h0 + h1) * (1 + unit * e345) + h2 * (1 + unit * e45) + h3 * (1 + unit * e5));
c0 = unit * (g0 * (a0 * (t0 - wide * f0) - (wide * r0) * (1 + unit * wide * f0))) + H;
c1 = unit * (g1 * (a1 * (t1 - wide * f1) - (wide * r1) * (1 + unit * wide * f1))) + H;
c2 = unit * (g2 * (a2 * (t2 - wide * f2) - (wide * r2) * (1 + unit * wide * f2))) + H;
c3 = unit * (c * (s + e5 + unit * s * e5)) + H;

{ M in [0x1p-600, 0x1p600] /\
  n0 in [0, 0x1p304] /\ n1 in [0, 0x1p304] /\ n2 in [0, 0x1p304] /\ rho in [0, 0x1p304] /\
  |a0| <= 1 /\ |a1| <= 1 /\ |a2| <= 1 /\ |g0| <= 1 /\ |g1| <= 1 /\ |g2| <= 1 /\ |c| <= 0x1.00001p0 /\
  |r0| <= 1 /\ |r1| <= 1 /\ |r2| <= 1 /\ |f0| <= 1 /\ |f1| <= 1 /\ |f2| <= 1 /\
  |s| <= 0x1.00001p0 /\
  |e0| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |e4| <= 1 /\ |e5| <= 1 /\
  |h0| <= 1 /\ |h1| <= 1 /\ |h2| <= 1 /\ |h3| <= 1
-> computed - X - k * M * D <= 0 /\ computed - X + k * M * D >= 0 }

computed - X - k * M * D -> (M * n0) * (c0 - k) + (M * n1) * (c1 - k) + (M * n2) * (c2 - k) + (M * rho) * (c3 - k);
computed - X + k * M * D -> (M * n0) * (c0 + k) + (M * n1) * (c1 + k) + (M * n2) * (c2 + k) + (M * rho) * (c3 + k);
