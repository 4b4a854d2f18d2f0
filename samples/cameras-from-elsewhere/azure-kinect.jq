# Azure Kinect, the calibration of a device as JSON (or in the "calibration.json" of a recording). NAME: PV0 (colour) or
# D0 (depth). World: the depth camera's, metres. Lengths of the lens are in widths and heights of the sensor's picture.
.CalibrationInformation.Cameras[]
| select(.Location == "CALIBRATION_CameraLocation" + $name)
| . as $camera
| .Intrinsics.ModelParameters as $m
| if $m[10] != 0 or $m[11] != 0 then error("codx and cody other than 0 are not modelled") else . end
| {convention: "opencv",
   cameraFromWorld: {rotation: [.Rt.Rotation[0:3], .Rt.Rotation[3:6], .Rt.Rotation[6:9]], translation: .Rt.Translation},
   projection: {type: "intrinsics", fx: ($m[2] * .SensorWidth), fy: ($m[3] * .SensorHeight),
                cx: ($m[0] * .SensorWidth), cy: ($m[1] * .SensorHeight)},
   distortion: ({model: "brown", k: $m[4:10], p: [$m[13], $m[12]]}  # p2 comes first in the file
                + if ($m[14] // 0) > 0 then {limit: {radius: $m[14]}} else {} end),
   viewport: {width: .SensorWidth, height: .SensorHeight, pixelCenter: 0.5}}
