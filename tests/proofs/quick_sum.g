# quickSum(t, low) of exact where low is larger than t, for which it is not made: off by a little more than a rounding of low,
# its low part a little more than three. In shares of low; elsewhere it is exact, and its low part a rounding of the sum.
#: quick: units = 1; lows = 3;
#! quick: units = 0.99
#! quick: lows = 2.99
u = kUnitDouble;
s = (t + 1) * (1 + u * e1);
part = (s - t) * (1 + u * e2);
rest = (1 - part) * (1 + u * e3);
error = s + rest - (t + 1);
off = units * u * (1 + 0x1p-20);
least = lows * u * (1 + 0x1p-20);

{ |t| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 /\ |e3| <= 1 -> |error| - off <= 0 /\ |rest| - least <= 0 }

1 - part -> -u * (e1 * (t + 1) + e2 + u * e1 * e2 * (t + 1));
error -> u * (-e2 * (1 + u * e1 * (t + 1)) - u * e3 * (e1 * (t + 1) + e2 + u * e1 * e2 * (t + 1)));
