// Files of programs that are known and not read, each with what to do instead.
#include <algorithm>

#include "formats/tree.hpp"
#include "text/utf8.hpp"

namespace viewproj::cmd {
namespace {

struct Refusal {
  std::string_view marks;  ///< one of them, separated by "|"; "*.chan" is of the file's name
  bool begins;             ///< the file begins with the mark; else it is among its first bytes
  const char* why;
};
constexpr Refusal kRefusals[] = {
    {"version https://git-lfs", true, "is a pointer of Git LFS, not the file itself; git lfs pull fetches it"},
    {"\x80\x02|\x80\x03|\x80\x04|\x80\x05", true,
     "is a pickle, which runs code when it is read; save it with np.savez(\"camera.npz\", K=K, dist=dist)"},
    {"MATLAB 5.0", true, "is a MATLAB file; write the camera as JSON: jsonencode(toStruct(cameraParams))"},
    {"SQLite format 3", true, "is a database; colmap model_converter --output_type TXT writes the model of COLMAP"},
    {"\x89HDF", true, "is an HDF5 file, which is not read; write its numbers as JSON or np.savez"},
    {"PAR1", true, "is a Parquet file, which is not read; write a CSV of it"},
    {"ARROW1", true, "is a Feather file, which is not read; write a CSV of it"},
    {"BLENDER", true, "is a Blender file; export the camera as glTF"},
    {"\xFF\xD8\xFF|\x89PNG", true, "is a picture; exiftool -json -n writes where it was taken"},
    {"ply\n", true, "is a mesh, which holds no camera"},
    {"PXR-USDC", true,
     "is USD in binary form; usdcat makes text of it, and --focal-length, --sensor-width, --position say its camera"},
    {"#usda|def Camera \"", true,
     "is USD, which is not read; give --read-as opengl, focalLength and horizontalAperture to --focal-length and "
     "--sensor-width, and translate and rotateXYZ of each prim around it and of the camera, the outermost first, as "
     "--world-from-camera 'X,Y,Z rpy:RX,RY,RZ'; where there is a horizontalApertureOffset, give --fx, --fy, --cx and "
     "--cy: cx is (0.5 - horizontalApertureOffset / horizontalAperture) of the width"},
    {"%YAML 1.1\n%TAG !u!", true,
     "is a scene of Unity, which is not read; give the Camera's \"field of view\" to --fov-y, m_LocalPosition to "
     "--position and m_LocalRotation to --rotation, with --convention unity; its pixels count from the bottom: --set "
     "viewport.origin=bottom-left"},
    {"# hugin project file", true,
     "is a project of Hugin, which is not read; give w and h of an i line to --viewport, and v, where f is 0, to "
     "--fov-x; its y, p and r turn the picture in a panorama, and its a, b and c are no lens of OpenCV's"},
    {"opparm ", false,
     "is a script of Houdini, which is not read; give t to --position, r in the order xyz as --euler ZYX:RZ,RY,RX, "
     "focal and aperture to --focal-length and --sensor-width, and res to --viewport"},
    {"*.chan", true,
     "is a track of Nuke, which is not read: of each line give numbers 2 to 4 to --position, 5 to 7, RX RY RZ, as "
     "--euler YXZ:RY,RX,RZ where the order of turns is ZXY, and the eighth to --fov-y"},
    {"[gd_scene", true,
     "is a scene of Godot, which is not read; give fov to --fov-y (to --fov-x where keep_aspect = 0; 75 where it is "
     "not there), near to --near and far to --far (0.05 and 4000 where they are not there), and the transform of each "
     "node around the camera and its own, the "
     "outermost first, as --world-from-camera 'Transform3D(…)'; --reverse-z for depths of Godot 4.3 or later"},
    {"#polynomial coefficients for the DIRECT mapping", false,
     "is a lens of OCamCalib, which is not supported; undistort the pictures first"},
    {"Camera.Parameters=[", false,
     "is of PTAM: fractions of the picture and an FOV lens; give --fx, --fy, --cx, --cy in pixels and --distortion "
     "'{\"model\": \"fov\", \"omega\": w}'"},
    {"FOV 0.|Pinhole 0.|RadTan 0.", true,
     "is of DSO, which is not read: fx, cx are fractions of the width, and fy, cy of the height, in the second line; "
     "give --fx, --fy, --cx, --cy in pixels, 0.5 taken from cx and cy, and of FOV the fifth number as --distortion "
     "'{\"model\": \"fov\", \"omega\": w}'"},
    {"model_type: SCARAMUZZA", false,
     "has a lens of the model SCARAMUZZA, which is not supported; undistort the pictures first"},
    {"'lensmodel'", false, "is a model of mrcal; mrcal-to-kalibr writes one that is read"},
    {"CAHVOR", false, "is of the CAHVOR family, which is not supported"},
    {"CameraFocalPoint", false,
     "is of ParaView, which is not read; give CameraPosition to --position, CameraFocalPoint to --target, CameraViewUp "
     "to --up and CameraViewAngle to --fov-y"},
    {"<kml", false,
     "is KML, which is not read; give latitude, longitude and altitude to --position lat=A,lon=B,height=C, heading to "
     "--heading, tilt - 90 to --pitch and roll to --roll"},
    {"type: <class 'aslam", false, "is a report of Kalibr; its camchain is read"},
    {":foc:", false,
     "is of HALCON, which is not read; give Focus / Sx, Focus / Sy, Cx and Cy to --fx, --fy, --cx and --cy"},
    {"fisheyeIntrinsics with properties:", false,
     "is a fisheye of MATLAB, a lens that is not supported; undistort the pictures first"},
    {"heading,pitch,roll,f,px,py", false,
     "is of RealityCapture, which is not read: f counts 36 mm, and px and py the picture's larger side; give --set "
     "world=enu, x, y and alt to --position, and its turns as --euler ZXY:-HEADING,PITCH,ROLL with --set "
     "cameraAxes=RUB"},
    {"<sdf ", false,
     "is SDF, which is not read; give --read-as opengl --set cameraAxes=FLU, for its cameras look along x, "
     "horizontal_fov as --fov-x 1.2rad, and the poses of model, link and sensor, in this order, each as "
     "--world-from-camera 'X,Y,Z rpy:0.1rad,0.2rad,0.3rad'"},
    {"<mujoco", false,
     "is of MuJoCo, which is not read; give --read-as opengl, fovy to --fov-y, and pos and quat of each body around it "
     "and of the camera, the outermost first, as --world-from-camera 'X,Y,Z quat:X,Y,Z,W', where MuJoCo has w x y z; "
     "xyaxes are the first two columns of a turn, right and up"},
    {"NVM_V3", true,
     "is of VisualSFM, which is not read; give --convention opencv, the focal length to --fx and --fy, the middle of "
     "the picture to --cx and --cy, of the quaternion w x y z its inverse, -x,-y,-z,w, to --rotation, and the three "
     "numbers after it to --position; the radial number is no lens of OpenCV's"},
    {"collada.org/2005/11/COLLADASchema", false,
     "is Collada, which is not read; export the scene as glTF, or give --read-as opengl, xfov or yfov to --fov-x or "
     "--fov-y, and the matrix of each node around it and of the camera, the outermost first, to --world-from-camera"},
    {"camera_calibrations {", false,
     "is a calibration of Waymo as text, which is not read; intrinsic is fx, fy, cx, cy, k1, k2, p1, p2, k3 in "
     "OpenCV's order, and transform, by rows, goes to --world-from-camera with --set cameraAxes=FLU"},
    {"CALIBRATION_LensDistortionModel", false,
     "is Azure Kinect's own calibration, which is not read; jq --arg name PV0 -f azure-kinect.jq FILE makes a camera "
     "of it (samples/cameras-from-elsewhere), D0 in place of PV0 that of depth"},
    {"type=\"static_transform_publisher\"", false,
     "is a launch file of ROS, which is not read; args are x y z and yaw pitch roll in radians, or qx qy qz qw: give "
     "--world-from-camera 'X,Y,Z rpy:0.1rad,0.2rad,0.3rad', roll first, or 'X,Y,Z quat:X,Y,Z,W'"},
    {"<scene version=", false,
     "is of Mitsuba, which is not read; give origin, target and up of lookat to --position, --target and --up, and fov "
     "to --fov-x, or to --fov-y where fov_axis is y, or smaller or larger and that is the height; "
     "principal_point_offset_x and _y move the picture too, by fractions of its sides: give --fx, --fy, --cx, --cy"},
    {"WorldBegin", false,
     "is of pbrt, whose world is left-handed, and which is not read; give --convention d3d (opengl if Scale -1 1 1 "
     "comes before LookAt), the three points of LookAt to --position, --target and --up, and fov, which is of the "
     "shorter side, to --fov-x or --fov-y"},
    {"look_at <|look_at<", false,
     "is of POV-Ray, whose world is left-handed, and which is not read; give --convention d3d, location, look_at and "
     "sky (0,1,0 if it has none) to --position, --target and --up, and angle to --fov-x"},
    {"xcr:Rotation", false,
     "is of RealityCapture, which is not read; xcr:Position is the eye and xcr:Rotation cameraFromWorld by rows, "
     "FocalLength35mm / 36 and PrincipalPointU, V count the picture's larger side"},
    {"CameraDefaults", false,
     "holds settings of AirSim; give FOV_Degrees to --fov-x, and the vehicle's place to --position"},
    {"fetch_sub_folder", false, "is of Xtreme1, which is not read"},
};

}  // namespace

const char* refusalOf(std::string_view name, std::string_view text) {
  constexpr std::size_t kMost = 1 << 16;
  const std::string_view start = withoutByteOrderMark(text.substr(0, kMost));
  const bool isText = start.find('\0') == std::string_view::npos;
  for (const Refusal& refusal : kRefusals)
    for (std::string_view rest = refusal.marks; !rest.empty();) {
      const std::string_view mark = rest.substr(0, rest.find('|'));
      if (mark[0] == '*'   ? name.ends_with(mark.substr(1))
          : refusal.begins ? start.starts_with(mark)
                           : isText && start.find(mark) != std::string_view::npos)
        return refusal.why;
      rest.remove_prefix(std::min(mark.size() + 1, rest.size()));
    }
  return nullptr;
}

}  // namespace viewproj::cmd
