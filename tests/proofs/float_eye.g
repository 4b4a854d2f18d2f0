# The difference of a float32 P to the eye, (P - high) - low in float32, is within two roundings of d = P - E.
#
# l = E - high is exact, low is l rounded. near: the first difference is exact, and |l| at most |d|. far: |P - high| is at
# least half of |high|, and |l| at most unit * |high|. Why it is one or the other, error_model.hpp says.
#: float: unit = kUnitFloat; roundings = 2;
#! float: roundings = 1
bound = roundings * unit * (1 + 0x1p-20);
low = 1 + unit * v;

# In shares of d, where P - high = d + l.
near = (1 + l - l * low) * (1 + unit * e2) - 1;

# In shares of P - high.
m = 2 * unit * r;
d = 1 - m;
far = (((1 + unit * e1) - m * low) * (1 + unit * e2) - d) / d;

{ |l| <= 1 /\ |r| <= 1 /\ |v| <= 1 /\ |e1| <= 1 /\ |e2| <= 1 -> |near| - bound <= 0 /\ |far| - bound <= 0 }

near -> unit * (e2 - l * v - unit * (l * v * e2));
far -> unit * ((e1 - m * v + e2 * ((1 + unit * e1) - m * low)) / d) { d <> 0 };
