#!/bin/sh
# What 1,500 pixels see, from a metre to 30 km away: pseudo-random numbers of Park and Miller.
awk '
  function uniform(low, high) { seed = seed * 16807 % 2147483647; return low + (high - low) * seed / 2147483647 }
  BEGIN { for (seed = 1; i < 1500; ++i) print uniform(0, 1920), uniform(0, 1080), exp(uniform(0, log(30000))) }' |
  viewproj ray -c camera.json --from text --columns x,y,viewDistance --fields point --digits 10 --to text
