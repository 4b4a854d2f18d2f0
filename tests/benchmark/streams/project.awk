# awk -v m="16 numbers, row by row" -v width=W -v height=H; CSV with a header and without quotes
BEGIN { FS = ","; split(m, a, " ") }
NR == 1 { print $0 ",screen_x,screen_y,depth"; next }
{
  w = $2 * a[13] + $3 * a[14] + $4 * a[15] + a[16]
  sx = (($2 * a[1] + $3 * a[2] + $4 * a[3] + a[4]) / w + 1) / 2 * width
  sy = (1 - ($2 * a[5] + $3 * a[6] + $4 * a[7] + a[8]) / w) / 2 * height
  d = (($2 * a[9] + $3 * a[10] + $4 * a[11] + a[12]) / w + 1) / 2
  printf "%s,%.17g,%.17g,%.17g\n", $0, sx, sy, d
}
