# DJI, what exiftool -n -json writes of pictures. NAME: the file. World: the Earth. AbsoluteAltitude has to be above
# the ellipsoid, as it is with RTK. The distortion in DewarpData is left out.
def number: tostring | ltrimstr("+") | tonumber;
.[] | select(.FileName == $name)
| {position: {lat: .GPSLatitude, lon: .GPSLongitude, height: (.AbsoluteAltitude | number)},
   heading: (.GimbalYawDegree | number), pitch: (.GimbalPitchDegree | number), roll: (.GimbalRollDegree | number),
   projection: {type: "intrinsics", pixels: [.ImageWidth, .ImageHeight],
     fx: .CalibratedFocalLength, fy: .CalibratedFocalLength,
     cx: .CalibratedOpticalCenterX, cy: .CalibratedOpticalCenterY}}
