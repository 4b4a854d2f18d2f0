#include "colors.inc"
camera {
  location <0, 2, -3>
  look_at <0, 1, 2>
}
