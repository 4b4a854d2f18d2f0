# BOP, scene_camera.json. NAME: the image. World: the scene's, or without a pose the camera's. Lengths are
# millimetres, and so must the points be. Picture sizes are not in the file: --viewport.
def rows: [.[0:3], .[3:6], .[6:9]];
.[$name]
| {convention: "opencv",
   cameraFromWorld: {rotation: (.cam_R_w2c // [1, 0, 0, 0, 1, 0, 0, 0, 1] | rows),
                     translation: (.cam_t_w2c // [0, 0, 0])},
   projection: (.cam_K | {type: "intrinsics", fx: .[0], skew: .[1], cx: .[2], fy: .[4], cy: .[5]})}
