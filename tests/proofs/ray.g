# A ray's direction, w + (a x + b y) divided by its length: each component before the division is within five roundings of
# the sum of its terms' sizes, M (n0 + n1 + n2): of the rounded columns w, x and y with 1, a and b, themselves a rounding
# off. The angle is that times sqrt(3), as the columns are at right angles (to kPoseOrthogonality, 0.001), and one more
# rounding for the division: below kRayDirectionBound.
#: ray: roundings = 5;
#! ray: roundings = 4
#! ray: kRayDirectionBound = 1.06e-15
u = kUnitDouble;
k = roundings * u * (1 + 0x1p-12);
T = n0 + n1 + n2;
computed = (n0 * g0 + (n1 * g1 * (1 + u * a) * (1 + u * e1) + n2 * g2 * (1 + u * b) * (1 + u * e2)) * (1 + u * e3)) * (1 + u * e4) +
           T * u * 0x1p-20 * h;
true = n0 * g0 * (1 + u * c0) + n1 * g1 * (1 + u * c1) + n2 * g2 * (1 + u * c2);
angle = (k * sqrt(3) * 1.002 + u) * (1 + 0x1p-20);

e34 = e3 + e4 + u * e3 * e4;
f1 = e1 + e34 + u * e1 * e34;
f2 = e2 + e34 + u * e2 * e34;
s0 = u * (g0 * (e4 - c0) + 0x1p-20 * h);
s1 = u * (g1 * (a + f1 + u * a * f1 - c1) + 0x1p-20 * h);
s2 = u * (g2 * (b + f2 + u * b * f2 - c2) + 0x1p-20 * h);

{ n0 in [0, 0x1p1000] /\ n1 in [0, 0x1p1000] /\ n2 in [0, 0x1p1000] /\ |g0| <= 1 /\ |g1| <= 1 /\ |g2| <= 1 /\
  |a| <= 0x1.00001p0 /\ |b| <= 0x1.00001p0 /\ |c0| <= 0x1.00001p0 /\ |c1| <= 0x1.00001p0 /\ |c2| <= 0x1.00001p0 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |e4| <= 1 /\ |h| <= 1
-> computed - true - k * T <= 0 /\ computed - true + k * T >= 0 /\ angle - kRayDirectionBound <= 0 }

computed - true - k * T -> n0 * (s0 - k) + n1 * (s1 - k) + n2 * (s2 - k);
computed - true + k * T -> n0 * (s0 + k) + n1 * (s1 + k) + n2 * (s2 + k);
