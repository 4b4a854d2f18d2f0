# jq -c --argjson m "[16 numbers, row by row]" --argjson width W --argjson height H
(.x * $m[12] + .y * $m[13] + .z * $m[14] + $m[15]) as $w
| (.x * $m[0] + .y * $m[1] + .z * $m[2] + $m[3]) as $cx
| (.x * $m[4] + .y * $m[5] + .z * $m[6] + $m[7]) as $cy
| (.x * $m[8] + .y * $m[9] + .z * $m[10] + $m[11]) as $cz
| .screen = [($cx / $w + 1) / 2 * $width, (1 - $cy / $w) / 2 * $height]
| .depth = ($cz / $w + 1) / 2
