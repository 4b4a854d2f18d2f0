# Ziv's test of exact in orthographic, as in exact_perspective.g: of a coordinate, center + X, of a depth, offset + scale W,
# by times(), and of a distance, which is W without a center. m = M D, of a depth |scale| F D, or nothing where W is a
# coordinate's difference to the eye (forwardIsAxis); H = |scale.hi w.hi|; r = reach, of a depth |offset|; T = the
# smallest that error allows for underflow. The error is kZivMargin times
#   kExactDot m + kExactParameter (r + the depth's |product|) + T.
#
# Taken from exact_dot.g: X and W, and their low parts. From the text: the product of high parts is a pair without an
# error, and the rest, as in exact_perspective.g. isProduct: whether there is a scale.
#: x: isProduct = 0; off = 9.51 * 0x1p-77;
#: depth: isProduct = 1; off = 9.51 * 0x1p-77;
#! x: kZivMargin = 1.01
#! x: kExactDot = 6.6 * 0x1p-77
#! depth: kZivMargin = 1.39
#! depth: off = 18 * 0x1p-77
#! depth: kExactParameter = 0x1p-105
u = kUnitDouble;
evaluated = 1 - 0x1p-48;
k = 1 + 0x1p-18;
wLow = 1.25001 * 0x1p-24;
pu = u * 1.001;

# The high part of X, or of the product with its error; the low part of X, or of W times scale.hi.
high = (1 - isProduct) * (m * k * g) + isProduct * (H * g);
productLow = isProduct * (H * u * e);
wide = wLow * m * l + isProduct * (H * pu * f);
scaleLow = isProduct * (pu * a);
value = high + wide + scaleLow * (H * g + wide) + off * k * m * b +
        isProduct * (kExactParameter * 1.001 * (H + m) * q);

low = (productLow + (wide * (1 + isProduct * u * i1) + scaleLow * (H * g) * (1 + isProduct * u * i2)) *
       (1 + isProduct * u * i3)) * (1 + isProduct * u * i4);
sLow = u * (1.01 * (r + m + isProduct * H)) * s;
sHigh = center + high - productLow - sLow;
centerLow = u * 1.01 * r * d;
x = center + centerLow + kExactParameter * r * p + value;

sum = (sLow + (low + centerLow) * (1 + u * e1)) * (1 + u * e2) + isProduct * (T * 0.5 * h);
error = kZivMargin * (kExactDot * m + kExactParameter * (r + isProduct * (1 - pu) * H) + isProduct * T) * evaluated;
upper = (sum + error) * (1 + u * e3);

# Of each size, a share of upper + s.hi - x.
e23 = e2 + e3 + u * e2 * e3;
x1 = e1 + e23 + u * e1 * e23;
y4 = isProduct * i4 + x1 + u * (isProduct * i4) * x1;
y3 = isProduct * i3 + y4 + u * (isProduct * i3) * y4;
y1 = isProduct * i1 + y3 + u * (isProduct * i1) * y3;
y2 = isProduct * i2 + y3 + u * (isProduct * i2) * y3;
grows = kZivMargin * evaluated * (1 + u * e3);
cm = grows * kExactDot + wLow * l * (u * y1 - scaleLow) + u * 1.01 * s * (u * e23) - off * k * b -
     isProduct * (kExactParameter * 1.001 * q);
cH = grows * kExactParameter * (1 - pu) + u * e * (u * y4) + pu * f * (u * y1 - scaleLow) + scaleLow * g * (u * y2) +
     u * 1.01 * s * (u * e23) - kExactParameter * 1.001 * q;
cr = grows * kExactParameter + u * 1.01 * s * (u * e23) + u * 1.01 * d * (u * x1) - kExactParameter * p;
cT = grows + 0.5 * h * (1 + u * e3);

{ m in [0, 0x1p1000] /\ H in [0, 0x1p1000] /\ r in [0, 0x1p1000] /\ T in [0, 1] /\ |center| <= 0x1p1000 /\
  |g| <= 1 /\ |e| <= 1 /\ |l| <= 1 /\ |f| <= 1 /\ |a| <= 1 /\ |b| <= 1 /\ |q| <= 1 /\ |s| <= 1 /\ |d| <= 1 /\ |p| <= 1 /\
  |h| <= 1 /\ |i1| <= 1 /\ |i2| <= 1 /\ |i3| <= 1 /\ |i4| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1
-> sHigh + upper - x >= 0 }

sHigh + upper - x -> m * cm + isProduct * (H * cH) + r * cr + isProduct * (T * cT);
