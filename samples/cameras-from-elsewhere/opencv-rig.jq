# OpenCV, several calibrations by name. NAME: the camera. World: the rig's, which R (or rvec) and t take to the camera.
# The result is a calibration of OpenCV, which viewproj reads.
.[$name]
