# Ziv's test of exact in perspective: of a coordinate or a depth, center + a / w, computed as s.hi + low, the true number
# is s.hi and what is at most low + error, as computed; and by symmetry at least low - error. Rounding to double is
# monotone: where both give one double, so does the true number. m = M D / |w|, of a depth |scale / w|; y = F D / |w|, or
# nothing where W is a coordinate's difference to the eye (forwardIsAxis); r = reach, of a depth |offset|; T = the
# smallest that error allows for underflow. The error is kZivMargin times
#   (numerator + kExactQuotient) m + kExactDot m y + kExactParameter r + T.
#
# Taken from exact_dot.g: X and W, and their low parts. From exact_quotient.g: the quotient without a fused multiply-add,
# which is less with one. From the text: centre, scale and offset are double-doubles within kExactParameter; the sum s
# is exact; the error's own roundings take 2^-48 of it; products that underflow lose half of T at most.
#
# off, low: of M D / |w| or |scale / w|, what the numerator is off by and its low part at most.
#: x: numerator = kExactDot; off = 9.51 * 0x1p-77; low = 1.25001 * 0x1p-24; under = 0;
#: depth: numerator = 0; off = kExactParameter; low = 1.001 * 0x1p-53; under = 1;
#! x: kZivMargin = 1.21
#! x: kExactDot = 7 * 0x1p-77
#! x: kExactParameter = 0x1p-106
#! depth: kZivMargin = 1.24
#! depth: kExactQuotient = 0x1p-77
u = kUnitDouble;
evaluated = 1 - 0x1p-48;
k = 1 + 0x1p-18;
wOff = 9.51 * 0x1p-77;
wLow = 1.25001 * 0x1p-24;
ofQ = 10.01 * 0x1p-79;
ofV = 5.01 * u;
ofN = 2.01 * u;
# D / |w| is below 1.01 / kSignUncertaintyExact, as computed, and F below 2.
y = 2.02 / kSignUncertaintyExact * share;
my = m * y;

# The true quotient, a / w and what is added to q, by which q is a / w - added + lost.
a = m * k * g;
true = (a - m * off * b) / (1 + wOff * y * c);
lost = (m * (ofQ * k + ofN * low + 1.001 * u * ofV * k) + my * (wLow * ofV * k)) * v;
added = (m * (4.01 * u * k + ofN * low + 1.001 * u * ofV * k) + my * (wLow * ofV * k)) * n;
q = a - added + lost;
sLow = u * (1.01 * (r + m)) * s;
sHigh = center + q - sLow;
centerLow = u * 1.01 * r * d;
x = center + centerLow + kExactParameter * r * p + true;

sum = (added * (1 + u * e1) + (sLow + centerLow) * (1 + u * e2)) * (1 + u * e3) + under * T * 0.5 * h;
error = kZivMargin * ((numerator + kExactQuotient) * m + kExactDot * my + kExactParameter * r + under * T) * evaluated;
upper = (sum + error) * (1 + u * e4);

# Of each size, a share of upper + s.hi - x.
e34 = e3 + e4 + u * e3 * e4;
x1 = e1 + e34 + u * e1 * e34;
x2 = e2 + e34 + u * e2 * e34;
grows = kZivMargin * evaluated * (1 + u * e4);
added1 = (4.01 * u * k + ofN * low + 1.001 * u * ofV * k) * n;
addedY = (wLow * ofV * k) * n;
cm = grows * (numerator + kExactQuotient) + added1 * (u * x1) + u * 1.01 * s * (u * x2) +
     (ofQ * k + ofN * low + 1.001 * u * ofV * k) * v + off * b / (1 + wOff * y * c);
cy = grows * kExactDot + addedY * (u * x1) + wLow * ofV * k * v + wOff * c * k * g / (1 + wOff * y * c);
cr = grows * kExactParameter + (u * 1.01 * s + u * 1.01 * d) * (u * x2) - kExactParameter * p;
cT = under * (grows + 0.5 * h * (1 + u * e4));

{ m in [0, 0x1p900] /\ r in [0, 0x1p900] /\ T in [0, 1] /\ share in [0, 1] /\ |center| <= 0x1p900 /\
  |g| <= 1 /\ |b| <= 1 /\ |c| <= 1 /\ |v| <= 1 /\ |n| <= 1 /\ |s| <= 1 /\ |d| <= 1 /\ |p| <= 1 /\ |h| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 /\ |e4| <= 1
-> sHigh + upper - x >= 0 }

sHigh + upper - x -> m * cm + my * cy + r * cr + T * cT { 1 + wOff * y * c <> 0 };
