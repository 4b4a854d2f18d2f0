# CMU Panoptic and the like, OpenCV's calibrations in a list. NAME: the camera. World: the dome, y down, in centimetres.
.cameras[] | select(.name == $name) | (.K | add) as $k
| {convention: "opencv",
   cameraFromWorld: {rotation: .R, translation: (.t | flatten)},
   projection: {type: "intrinsics", pixels: .resolution, fx: $k[0], skew: $k[1], cx: $k[2], fy: $k[4], cy: $k[5]},
   distortion: (.distCoef | {model: "brown", k: (.[0:2] + .[4:]), p: .[2:4]})}
