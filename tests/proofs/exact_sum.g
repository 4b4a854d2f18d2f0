# The products of exact's high parts and their sum have no rounding, with a fused multiply-add and without. In the sizes
# of exact_split.g: there high parts are multiples of 2^-24 and 2^-26, of a row at most 2, of a difference at most D and a
# little, and so are the sizes of all three together, by which largest is 2 (2 + 3 2^-25 + 2^-51), and a little.
#: sum: largest = 4.01;
#! sum: largest = 8.1
@rnd = float<ieee_64, ne>;
x = a0 * d0;
y = a1 * d1;
z = a2 * d2;
{ @FIX(a0, -24) /\ @FIX(a1, -24) /\ @FIX(a2, -24) /\ @FIX(d0, -26) /\ @FIX(d1, -26) /\ @FIX(d2, -26) /\
  |x| <= 4.01 /\ |y| <= 4.01 /\ |z| <= 4.01 /\ |y + z| - largest <= 0 /\ |x + (y + z)| - largest <= 0
-> rnd(x) - x in [0, 0] /\ rnd(y) - y in [0, 0] /\ rnd(z) - z in [0, 0] /\
   rnd(y + z) - (y + z) in [0, 0] /\ rnd(x + (y + z)) - (x + (y + z)) in [0, 0] }
