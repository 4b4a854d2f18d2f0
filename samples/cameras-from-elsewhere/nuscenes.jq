# nuScenes, calibrated_sensor.json. NAME: the token. World: the vehicle, in metres; the pose is from the sensor to the
# vehicle, and ego_pose.json leads on to the map. Picture sizes are in sample_data.json: --viewport.
.[] | select(.token == $name)
| {convention: "opencv",
   worldFromCamera: {rotation: (.rotation[1:] + .rotation[:1]), translation: .translation},  # the file has w first
   projection: (.camera_intrinsic | add | {type: "intrinsics", fx: .[0], skew: .[1], cx: .[2], fy: .[4], cy: .[5]})}
