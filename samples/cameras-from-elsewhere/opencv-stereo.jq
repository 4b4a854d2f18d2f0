# OpenCV, what stereoCalibrate returns: M1 D1 M2 D2 R T. NAME: 1 or 2. World: the first camera, in the unit of T.
# Picture sizes are not in the file: --viewport. The result is a calibration of OpenCV, which viewproj reads.
{camera_matrix: .["M" + $name], distortion_coefficients: .["D" + $name]}
+ if $name == "2" then {R: .R, T: .T} else {} end
