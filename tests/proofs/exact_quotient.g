# A quotient of exact, a / w of two pairs: q, and rest, whose product with inverse is to be added. In shares of
# Q = |a / w|, of N = |a.lo / w| and of V = |w.lo / w|: where a or w cancelled, its low part need not be small beside the
# whole. All is divided by w, and both parts of a and w add up to it exactly. Roundings one after the other are one of
# as many units and a little.
#
# With a fused multiply-add w and q stay whole: cut is 0, and so are the roundings of products with low halves. Taken from
# the text: without it, Veltkamp's halves of q and w.hi have 26 bits, their product is a double, and so is what is left.
#: fused: cut = 0; ofQ = 16.1 * 0x1p-106; ofV = 2.01 * 0x1p-53;
#: plain: cut = 0x1p-26; ofQ = 10.01 * 0x1p-79; ofV = 5.01 * 0x1p-53;
#! fused: ofQ = 15.9 * 0x1p-106
#! fused: ofV = 1.99 * 0x1p-53
#! plain: ofQ = 9.99 * 0x1p-79
#! plain: ofV = 4.99 * 0x1p-53
u = kUnitDouble;
halves = cut * 0x1p26;
a = Q * g;
aLow = N * f;
wLow = V * l;

rounded = 1 + u * e1;
inverse = (1 + u * e2) / rounded;
q = a * inverse * (1 + u * e3);
qHigh = q * (1 + cut * h1);
wHigh = (1 - wLow) * (1 + cut * h2);
low = qHigh * (1 - wHigh) * (1 + halves * u * f4);
first = (a - aLow - qHigh * wHigh) * (1 + u * f1);
second = (aLow - (low + (q - qHigh) * rounded * (1 + halves * u * f5))) * (1 + u * f2);
rest = (first + second) * (1 + u * f3);
added = rest * inverse;
error = q + added - a;

# inverse = 1 + u i, q = a (1 + u d), inverse with rest's rounding 1 + u j.
i = (e2 - e1) / rounded;
d = e3 + i + u * e3 * i;
j = i + f3 + u * i * f3;
# q - qHigh wHigh = q (k + V kV), and what the roundings of low halves add is q u (s + V sV).
h = h1 + h2 + cut * h1 * h2;
k = -cut * h;
kV = l * (1 + cut * h);
e15 = e1 + halves * f5 + u * e1 * (halves * f5);
s = -cut * ((1 + cut * h1) * h2 * (halves * f4) + h1 * e15);
sV = (1 + cut * h1) * (l * (1 + cut * h2)) * (halves * f4);
both = u * (f1 - f2) * (1 + u * j);
last = u * (1 + u * f2) * (1 + u * j);
cQ = g * (-u * d * (u * (j + f1 + u * j * f1)) + (1 + u * d) * (k * both - s * last));
cV = g * (1 + u * d) * (kV * both - sV * last);
cN = -f * both;
bound = Q * ofQ + V * Q * ofV + N * (2.01 * u);
# And what is added alone.
size = Q * (4.01 * u) + V * Q * ofV + N * (2.01 * u);

{ Q in [0, 0x1p900] /\ N in [0, 0x1p900] /\ V in [0, 0x1p38] /\ |g| <= 1 /\ |f| <= 1 /\ |l| <= 1 /\
  |h1| <= 1 /\ |h2| <= 1 /\
  |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 2.00001 /\ |f1| <= 1 /\ |f2| <= 1 /\ |f3| <= 1 /\ |f4| <= 3.00001 /\ |f5| <= 2.00001
-> error - bound <= 0 /\ error + bound >= 0 /\ added - size <= 0 /\ added + size >= 0 }

error - bound -> Q * (cQ - ofQ) + (V * Q) * (cV - ofV) + N * (cN - 2.01 * u) { rounded <> 0 };
error + bound -> Q * (cQ + ofQ) + (V * Q) * (cV + ofV) + N * (cN + 2.01 * u) { rounded <> 0 };
added - size -> Q * (cQ - g * u * d - 4.01 * u) + (V * Q) * (cV - ofV) + N * (cN - 2.01 * u) { rounded <> 0 };
added + size -> Q * (cQ - g * u * d + 4.01 * u) + (V * Q) * (cV + ofV) + N * (cN + 2.01 * u) { rounded <> 0 };
