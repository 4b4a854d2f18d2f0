# viewproj info CAMERA --to json | jq -r --arg up Y -f usda.jq >camera.usda
# USD multiplies rows by matrices, so the axes right, up and back are rows, and the place is the last. Focal length,
# apertures and offsets count one unit; only their ratios say what is seen.
def row: "(" + (map(tostring) | join(", ")) + ")";
36 as $width | .projection as $p | ($width / ($p.right - $p.left)) as $focal |
"#usda 1.0
(
    upAxis = \"\($up)\"
)
def Camera \"Camera\"
{
    float focalLength = \($focal)
    float horizontalAperture = \($width)
    float verticalAperture = \($focal * ($p.top - $p.bottom))
    float horizontalApertureOffset = \($focal * ($p.left + $p.right) / 2)
    float verticalApertureOffset = \($focal * ($p.bottom + $p.top) / 2)
    float2 clippingRange = \([$p.near // 0.1, $p.far // 1e6] | row)
    matrix4d xformOp:transform = ( \([.right + [0], .up + [0], (.forward | map(-.)) + [0], .eye + [1]] | map(row) | join(", ")) )
    uniform token[] xformOpOrder = [\"xformOp:transform\"]
}"
