# Unity, what JsonUtility writes of members named as a Camera's, and either worldToCameraMatrix or the transform's
# position and rotation. World: Unity's, left-handed, y up. Pixels count from the bottom left, as in WorldToScreenPoint.
{convention: "unity",
 projection: {type: "perspective", fovY: .fieldOfView, near: .nearClipPlane, far: .farClipPlane},
 viewport: {width: .pixelWidth, height: .pixelHeight, origin: "bottom-left"}}
+ if .worldToCameraMatrix then  # to a space that looks along -z, which is not the transform's
    {cameraAxes: "RUB", cameraFromWorld: (.worldToCameraMatrix as $m | [range(4) as $i | [$m["e\($i)\(range(4))"]]])}
  else {position: (.position | [.x, .y, .z]), rotation: (.rotation | [.x, .y, .z, .w])} end
