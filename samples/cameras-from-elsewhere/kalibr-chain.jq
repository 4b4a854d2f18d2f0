# Kalibr, camchain.yaml as JSON. NAME: cam0, cam1 and so on. World: cam0, in metres; T_cn_cnm1 of a camera takes points
# to it from the camera before. The result is a calibration of OpenCV, which viewproj reads.
def before($a): . as $b | [range(4) as $i | [range(4) as $j | [range(4) | $a[$i][.] * $b[.][$j]] | add]];
[.["cam\(range(1; 1 + ($name[3:] | tonumber)))"].T_cn_cnm1] as $chain
| .[$name] | select(.camera_model == "pinhole") | .intrinsics as [$fx, $fy, $cx, $cy]
| {K: [[$fx, 0, $cx], [0, $fy, $cy], [0, 0, 1]], resolution: .resolution,
   distortion_model: .distortion_model, distortion_coeffs: .distortion_coeffs,
   T_cam_world: (reduce $chain[] as $next ([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]; before($next)))}
