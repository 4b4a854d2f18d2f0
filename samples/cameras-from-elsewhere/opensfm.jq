# OpenSfM, reconstruction.json. NAME: the shot. World: the reconstruction's, z up, in metres where it had GPS. Focal
# lengths, c_x and c_y count the larger side of the picture, c_x and c_y from its middle. Fisheyes are refused.
.[] | .shots[$name] as $shot | select($shot) | .cameras[$shot.camera] | ([.width, .height] | max) as $side
| {convention: "opencv",
   cameraFromWorld: {rotationVector: $shot.rotation, translation: $shot.translation},
   projection: {type: (.projection_type | sub("perspective|brown"; "intrinsics")), pixels: [.width, .height],
     fx: ((.focal // .focal_x) * $side), cx: ((.c_x // 0) * $side + (.width - 1) / 2),
     fy: ((.focal // .focal_y) * $side), cy: ((.c_y // 0) * $side + (.height - 1) / 2)},
   distortion: {model: "brown", k: [.k1, .k2, .k3 // 0], p: [.p1 // 0, .p2 // 0]}}
