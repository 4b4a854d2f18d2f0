# The dot product of exact, row . d + residual, against the true one, and the size of its low part, in shares of M D with
# D = n0 + n1 + n2 + rho: what the differences and the residual have, as the code adds it up. high has no error.
#
# Taken from exact_split.g: high parts of a row are a, low ones b; those of a difference h and t (of D), and computed low
# parts are off by s and v. From exact_sum.g: the sum of high products is exact. From the text: so are differences to
# the eye, their second parts being l, and the sum with the residual, its second part being z. multiplyAdd is taken to
# round twice, which it does at most. rows: what the scaled rows and the residual are off by. unit: of 2^-77.
#: plain: units = 7.01; residual = 0;
#: residual: units = 9.51; residual = 1;
#! plain: units = 6.99
#! plain: kExactDot = 7 * 0x1p-77
#! residual: units = 9.49
#! residual: kExactDot = 9.4 * 0x1p-77
u = kUnitDouble;
rows = 0x1p-98;
k = 1 + 0x1p-18;
bound = units * 0x1p-77;
size = 1.25001 * 0x1p-24;
D = n0 + n1 + n2 + rho;

# What high leaves of the true product, of which h = n (g + u l) - D t.
true = M * ((b0 + rows * r0) * (n0 * (g0 + u * l0)) + (b1 + rows * r1) * (n1 * (g1 + u * l1)) +
            (b2 + rows * r2) * (n2 * (g2 + u * l2)) + D * (a0 * t0 + a1 * t1 + a2 * t2));
low0 = M * (b0 + 0x1p-78 * k * s0) * (n0 * g0) * (1 + u * i0);
low1 = (M * (b1 + 0x1p-78 * k * s1) * (n1 * g1) * (1 + u * i1) + low0) * (1 + u * e1);
low2 = (M * (b2 + 0x1p-78 * k * s2) * (n2 * g2) * (1 + u * i2) + low1) * (1 + u * e2);
low3 = (M * a0 * (D * (t0 + 0x1p-79 * k * v0)) * (1 + u * i3) + low2) * (1 + u * e3);
low4 = (M * a1 * (D * (t1 + 0x1p-79 * k * v1)) * (1 + u * i4) + low3) * (1 + u * e4);
low5 = (M * a2 * (D * (t2 + 0x1p-79 * k * v2)) * (1 + u * i5) + low4) * (1 + u * e5);

# The residual's second part, and that of its sum with high.
R = residual * (M * rho * (u * k * c));
Z = residual * (M * D * (u * k * z));
computed = (Z + (low5 + R) * (1 + residual * u * e6)) * (1 + residual * u * e7);
error = computed - (true + R + residual * (M * rho * rows * r3) + Z);

# The roundings of each product, with those of the sums that follow it.
e67 = residual * (e6 + e7 + u * e6 * e7);
x5 = e5 + e67 + u * e5 * e67;
x4 = e4 + x5 + u * e4 * x5;
x3 = e3 + x4 + u * e3 * x4;
x2 = e2 + x3 + u * e2 * x3;
x1 = e1 + x2 + u * e1 * x2;
y0 = i0 + x1 + u * i0 * x1;
y1 = i1 + x1 + u * i1 * x1;
y2 = i2 + x2 + u * i2 * x2;
y3 = i3 + x3 + u * i3 * x3;
y4 = i4 + x4 + u * i4 * x4;
y5 = i5 + x5 + u * i5 * x5;

# Of each size, the error's share and that of low.
p0 = b0 * g0 * (u * y0) + 0x1p-78 * k * s0 * g0 * (1 + u * y0) - b0 * (u * l0) - rows * r0 * (g0 + u * l0);
p1 = b1 * g1 * (u * y1) + 0x1p-78 * k * s1 * g1 * (1 + u * y1) - b1 * (u * l1) - rows * r1 * (g1 + u * l1);
p2 = b2 * g2 * (u * y2) + 0x1p-78 * k * s2 * g2 * (1 + u * y2) - b2 * (u * l2) - rows * r2 * (g2 + u * l2);
q = a0 * (t0 * (u * y3) + 0x1p-79 * k * v0 * (1 + u * y3)) + a1 * (t1 * (u * y4) + 0x1p-79 * k * v1 * (1 + u * y4)) +
    a2 * (t2 * (u * y5) + 0x1p-79 * k * v2 * (1 + u * y5)) + residual * (u * k * z) * (residual * u * e7);
q3 = residual * (u * k * c) * (u * e67) - residual * rows * r3;
m0 = (b0 + 0x1p-78 * k * s0) * g0 * (1 + u * y0);
m1 = (b1 + 0x1p-78 * k * s1) * g1 * (1 + u * y1);
m2 = (b2 + 0x1p-78 * k * s2) * g2 * (1 + u * y2);
m = a0 * (t0 + 0x1p-79 * k * v0) * (1 + u * y3) + a1 * (t1 + 0x1p-79 * k * v1) * (1 + u * y4) +
    a2 * (t2 + 0x1p-79 * k * v2) * (1 + u * y5) + residual * (u * k * z) * (1 + residual * u * e7);
m3 = residual * (u * k * c) * (1 + u * e67);

{ M in [0x1p-600, 0x1p600] /\ n0 in [0, 0x1p304] /\ n1 in [0, 0x1p304] /\ n2 in [0, 0x1p304] /\ rho in [0, 0x1p304] /\
  |a0| <= 0x1.00001p0 /\ |a1| <= 0x1.00001p0 /\ |a2| <= 0x1.00001p0 /\
  |b0| <= 0x1.00001p-25 /\ |b1| <= 0x1.00001p-25 /\ |b2| <= 0x1.00001p-25 /\
  |t0| <= 0x1.00002p-26 /\ |t1| <= 0x1.00002p-26 /\ |t2| <= 0x1.00002p-26 /\
  |g0| <= 1 /\ |g1| <= 1 /\ |g2| <= 1 /\ |l0| <= 1 /\ |l1| <= 1 /\ |l2| <= 1 /\ |c| <= 1 /\ |z| <= 1 /\
  |r0| <= 1 /\ |r1| <= 1 /\ |r2| <= 1 /\ |r3| <= 1 /\ |s0| <= 1 /\ |s1| <= 1 /\ |s2| <= 1 /\
  |v0| <= 1 /\ |v1| <= 1 /\ |v2| <= 1 /\ |i0| <= 1 /\ |i1| <= 1 /\ |i2| <= 1 /\ |i3| <= 1 /\ |i4| <= 1 /\ |i5| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |e4| <= 1 /\ |e5| <= 1 /\ |e6| <= 1 /\ |e7| <= 1
-> error - bound * M * D <= 0 /\ error + bound * M * D >= 0 /\
   computed - size * M * D <= 0 /\ computed + size * M * D >= 0 /\ bound - kExactDot <= 0 }

error - bound * M * D ->
  (M * n0) * (p0 + q - bound) + (M * n1) * (p1 + q - bound) + (M * n2) * (p2 + q - bound) + (M * rho) * (q3 + q - bound);
error + bound * M * D ->
  (M * n0) * (p0 + q + bound) + (M * n1) * (p1 + q + bound) + (M * n2) * (p2 + q + bound) + (M * rho) * (q3 + q + bound);
computed - size * M * D ->
  (M * n0) * (m0 + m - size) + (M * n1) * (m1 + m - size) + (M * n2) * (m2 + m - size) + (M * rho) * (m3 + m - size);
computed + size * M * D ->
  (M * n0) * (m0 + m + size) + (M * n1) * (m1 + m + size) + (M * n2) * (m2 + m + size) + (M * rho) * (m3 + m + size);
