# OpenCV, a calibration and the poses of its pictures, as rvecs and tvecs or as views. NAME: the picture, from 0.
# World: the board, in its unit. The result is a calibration of OpenCV, which viewproj reads.
($name | tonumber) as $i
| (.views[$i] // {rvec: .rvecs[$i], tvec: .tvecs[$i]} | select(.rvec)) as $view
| del(.rvecs, .tvecs, .views) + {rvec: $view.rvec, tvec: $view.tvec}
