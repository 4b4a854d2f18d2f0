# Where exact cuts a row's entries and a difference in two: high parts are multiples of one number, low parts are small,
# and off by one rounding. For a row whose largest entry is in [1, 2), and D in [1, 2]: all else is a power of two away.
# Taken from the text: the rest of a sum of doubles, entry - rowHigh and d - high, is a double. A low part of nothing has
# no rounding; any other is normal.
#: split: rowGrid = 0x1.8p28;
#! split: rowGrid = 0x1.8p29
#! split: rowGrid = 0x1.8p27
#! split: kSplit = 0x1p26
#! split: kSplit = 0x1p28
@rnd = float<ieee_64, ne>;
entry = rnd(anyEntry);
entryLo = rnd(anyEntryLo);
d = rnd(anyD);
dLo = rnd(anyDLo);
D = rnd(anyReach);

rowSum = rnd(entry + rowGrid);
rowHigh = rowSum - rowGrid;
rowRest = (entry - rowHigh) + entryLo;
rowLow = rnd(rowRest);

grid = kSplit * D;
sum = rnd(d + grid);
high = sum - grid;
rest = (d - high) + dLo;
low = rnd(rest);

{ |entry| <= 2 /\ |entryLo| <= 0x1p-53 /\ |rowRest| >= 0x1p-1000 /\
  D in [1, 2] /\ |d| <= 2 /\ |dLo / D| <= 0x1p-53 /\ |rest| >= 0x1p-1000
-> @FIX(rowHigh, -24) /\ |rowHigh| <= 2 /\ rnd(rowHigh) - rowHigh in [0, 0] /\
   |rowLow| <= 0x1.00001p-25 /\ |rowLow - rowRest| <= 0x1.00001p-78 /\
   @FIX(high, -26) /\ rnd(high) - high in [0, 0] /\ |(d - high) / D| <= 0x1.00001p-26 /\
   |low / D| <= 0x1.00002p-26 /\ |(low - rest) / D| <= 0x1.00001p-79 }

entry - rowHigh -> -(rowSum - (entry + rowGrid));
(d - high) / D -> -((sum - (d + grid)) / (d + grid)) * (kSplit + d / D) { D <> 0, d + grid <> 0 };
rest / D -> (d - high) / D + dLo / D { D <> 0 };
