#include "formats/rows.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>

#include "camera/fields.hpp"
#include "formats/claims.hpp"
#include "formats/parts.hpp"
#include "formats/tree.hpp"

namespace viewproj::cmd {
namespace {

// Names of one thing, the usual one first.
#define K_NAMES                                                                                                    \
  "K|camera_matrix|cameraMatrix|mtx|Camera_Matrix|cam_matrix|intrinsic_matrix|cam_K|cam_mtx|camera_mtx|camMatrix|" \
  "intrinsic|intrinsics|Intrinsics|cameraIntrinsics|M|camera_intrinsic|camera_intrinsics|matrix"
#define K_SHAPES                                                                                              \
  "K:9/12|camera_matrix:9|cameraMatrix:9|mtx:9|Camera_Matrix:9|cam_matrix:9|intrinsic_matrix:3x3|cam_K:9/12|" \
  "cam_mtx:9|camera_mtx:9|camMatrix:9|intrinsic:9/12/16|intrinsics:9|Intrinsics:9|cameraIntrinsics:9|M:9|"    \
  "camera_intrinsic:9|camera_intrinsics:9|matrix:K3"
#define D_NAMES                                                                                                        \
  "distortion_coefficients|dist_coeffs|distCoeffs|distortionCoefficients|dist|D|d|distortion|Distortion_Coefficients|" \
  "distortion_coeffs|dist_coeff|dist_coefs|distCoef|distCoeff|kc|distortion_vec|distortions|Distortion|cam_dist|"      \
  "camera_dist_coeffs|disto"
#define SIZES                                                                                                       \
  "size?=width|image_width|image_Width|w|W|img_width|cols|viewport.width+height|image_height|image_Height|h|H|img_" \
  "height|rows|viewport.height||"                                                                                   \
  "image_size|img_size|imageSize|resolution|cameraRes|camera_resolution|size"
#define EYES "eye|origin|from|eye_position|eyePosition|camera_position|cameraPosition"
#define TARGETS                                                                                                 \
  "target|lookAt|look_at|lookat|lookAtPoint|at|center|centre|to|focal_point|focalPoint|interest|camera_target|" \
  "cameraTarget"
#define VERTICAL_FOVS "fovY|fovy|fov_y|vfov|v_fov|verticalFov|vertical_fov|fov_vertical|yfov|view_angle|viewAngle"
#define MODELS "model?=distortion_model|camera_model|lens_model|lensmodel, isFisheye?=fisheye_model|is_fisheye|fisheye"
#define POSES                                                                                                         \
  "cameraFromWorld?=extrinsic|extrinsics|extrinsic_matrix|T_cam_world|T_cw|cameraFromWorld|w2c|world_to_cam|"         \
  "T_lidar_to_cam|CameraMatrix, worldFromCamera?=T_world_cam|T_wc|worldFromCamera|c2w|cam_to_world|camera_to_world, " \
  "cameraFromWorld.rotation?=R|rotation_matrix|cam_R_w2c|poses.R, "                                                   \
  "cameraFromWorld.rotationVector?=rvec|rotation_vector|rotationVector|rvecs, "                                       \
  "cameraFromWorld.quaternionWFirst?=qvec, "                                                                          \
  "cameraFromWorld.translation?=t|tvec|T|translation_vector|translationVector|translation|cam_t_w2c|poses.T|tvecs"
#define NOTHING_READ                                                                                                 \
  "ret rms rms_error rms_err rmse error *_error *_errors *Error *Errors per_view* avg_* mean_* objpoints imgpoints " \
  "obj_points img_points nrow ncol board* square* pattern* grid* image_points flags nframes nr_of_frames "           \
  "calibration_time calibration_date header camera_name sensor_type comment rate_hz fps id calobject* observations " \
  "perViewErrors standardDeviation* *_gt raw_camera_matrix raw_dist* E F Q"

#define ROS_SIZE "size?=image_width|width+image_height|height"
#define ROS_RAW "K=camera_matrix|K|k, " ROS_SIZE ", lens?=distortion_coefficients|D|d, model?=distortion_model"
#define OST_RAW "K=*.camera_matrix, size=/image.width+/image.height, lens=*.distortion"
// The calibration of one camera, and the poses of N views of it.
#define OPENCV "K=" K_NAMES ", " SIZES ", lens?=" D_NAMES ", " MODELS
#define VIEWS(R, T) \
  "*: " OPENCV ", cameraFromWorld.rotationVector=" R ", cameraFromWorld.translation=" T "\n~K: " OPENCV
// MATLAB's pictures have their height first, and count pixels from 1.
#define MATLAB                                                                            \
  "K=FocalLength+PrincipalPoint||K||IntrinsicMatrix^T, size?=ImageSize[1,0], distortion=" \
  "RadialDistortion[0,1]+TangentialDistortion+RadialDistortion[2:]"
#define INTRINSICS(P) "K=" P "fx+" P "fy+" P "cx+" P "cy"
#define ORB(C) INTRINSICS(C ".") ", size?=Camera.width+Camera.height"
#define ORB_BROWN(C) ORB(C) ", lens?=" C ".#"
#define ORB_FISHEYE(C) ORB(C) ", fisheye=" C ".k1+" C ".k2+" C ".k3+" C ".k4"
#define ORB_3(LENS) \
  "Camera1: " LENS("Camera1") "\nCamera2: " LENS("Camera2") ", worldFromCamera=Stereo.T_c1_c2\n" \
  "body/Camera1: " LENS("Camera1") ", worldFromCamera=IMU.T_b_c1"
// ORB-SLAM3 makes its pictures smaller by itself.
#define ORB_NOTHING                                                                                                   \
  "?Camera.new* ?Camera.imageScale Camera.fps Camera.RGB Camera.bf Camera.lapping* Camera.overlapping* ORB* Viewer* " \
  "ThDepth DepthMapFactor IMU* RGBD* System* "
// A camera beside the first, along its x.
#define BESIDE(X) ", position=" X "+0+0, worldFromCamera.quaternion=0+0+0+1"
#define STEREO(N, SIDE)                                                                               \
  "K=M" N "|K" N "|cameraMatrix" N "|camera_matrix_" N "|" SIDE ".K, distortion?=D" N "|distCoeffs" N \
  "|dist_coeffs_" N "|" SIDE ".D, " STEREO_SIZE
#define STEREO_SIZE "size?=image_width|width+image_height|height||image_size|imageSize|size"
// As scripts call the sides of a pair: S is L, SIDE is left.
#define SIDE_K(S, LETTER, SIDE)                                                                          \
  "mtx" S "|mtx_" LETTER "|mtx_" SIDE "|" SIDE "_mtx|K_" SIDE "|" SIDE "_K|camera_matrix_" SIDE "|" SIDE \
  "_camera_matrix"
#define SIDES(S, LETTER, SIDE)                                                                                      \
  SIDE ": K=" SIDE_K(S, LETTER, SIDE) ", distortion?=dist" S "|dist_" LETTER "|dist_" SIDE "|" SIDE "_dist|D_" SIDE \
                                      "|" SIDE "_D|dist_coeffs_" SIDE "|" SIDE "_dist_coeffs, " STEREO_SIZE
#define VELODYNE "cameraFromWorld=R0_rect|R_rect?+Tr_velo_to_cam|Tr_velo_cam|Tr"
#define OPEN3D(P, POSE) \
  "K=" P "intrinsic.intrinsic_matrix^T, size=" P "intrinsic.width+" P "intrinsic.height, cameraFromWorld=" P POSE "^T"

#define RECORD(K) "K=" K ", size=w+h, worldFromCamera.quaternion=poses.*[0:4], worldFromCamera.translation=poses.*[4:7]"

constexpr Row kRows[] = {
    {"ros", "a camera_info of ROS", "camera_matrix|K|k projection_matrix|P:12|p:12",
     "raw: " ROS_RAW "\n~rectified: P=projection_matrix|P|p, " ROS_SIZE "\n~stereo: " ROS_RAW
     ", rectified=rectification_matrix|R|r?+projection_matrix|P|p",
     "header camera_name R r rectification_matrix"},
    {"ros", "", "image.width *.projection:12 *.distortion",
     "raw: " OST_RAW "\n~rectified: P=*.projection, size=/image.width+/image.height\n~stereo: " OST_RAW
     ", rectified=*.rectification?+*.projection",
     "rectification"},
    {"opencv", "a calibration of OpenCV (YAML, XML, JSON, .npz)",
     K_SHAPES
     " !projection_matrix !P:12 !p:12 !rvecs.0:3 !extrinsic_parameters !rVector !T_BS !/camera_poses "
     "!rotation:4 !/0.rotation:3 !/cameraPoseARFrame !cameras.0 !poses:list !#3 !camera_data_ !image.width !class_name "
     "!world_mat_0 !RadialDistortion !extrinsic.transform !/Camera.fx",
     "K=" K_NAMES ", " SIZES ", lens?=" D_NAMES "|distortion_coefficients.#|distortion.#|dist.#, xi?=xi|Xi, " MODELS
     ", " POSES ", near?=near, far?=far, name?=name",
     NOTHING_READ, ". r3live_vio camera * cameras.*"},
    {"opencv", "", K_SHAPES " extrinsic_parameters:Nx6",
     VIEWS("extrinsic_parameters.*[0:3]", "extrinsic_parameters.*[3:6]"), NOTHING_READ},
    {"opencv", "", K_SHAPES " rvecs.0:3|rVector.0:3|rotation_vecs.0:3 !projection_matrix",
     VIEWS("rvecs.*|rVector.*|rotation_vecs.*", "tvecs.*|tVector.*|translation_vecs.*"), NOTHING_READ},
    {"matlab", "a camera of MATLAB", "RadialDistortion TangentialDistortion",
     "*: " MATLAB ", cameraFromWorld.rotationVector=RotationVectors.*, "
     "cameraFromWorld.translation=TranslationVectors.*\n~K: " MATLAB,
     "WorldPoints WorldUnits Estimate* Num* Reproj* Detected* Version RotationMatrices IntrinsicMatrix FocalLength "
     "PrincipalPoint",
     "", 1},
    {"stereo", "a stereo calibration of OpenCV", "M1:9|K1:9|cameraMatrix1:9|camera_matrix_1:9|R1:9 !Camera.fx",
     "1: " STEREO("1", "LEFT") "\n!2: " STEREO("2",
                                               "RIGHT") ", cameraFromWorld.rotation=R, cameraFromWorld.translation=T\n"
                                                        "~rectified1: P=P1, cameraFromWorld=R1, " STEREO_SIZE
                                                        "\n~rectified2: P=P2, cameraFromWorld=R1, " STEREO_SIZE,
     "E F Q validRoi* roi* rms* error* *_error image_* board* square* map* newCameraMatrix* M1 M2 K1 K2 D1 D2 R T R1 "
     "R2 "
     "P1 P2 cameraMatrix* distCoeffs*",
     "", 0, "RDF", true},
    {"stereo", "", SIDE_K("L", "l", "left") " " SIDE_K("R", "r", "right") " R:9|Rot:9 T:3|Trns:3",
     SIDES("L", "l", "left") "\n" SIDES("R", "r", "right") ", cameraFromWorld.rotation=R|Rot, "
                                                           "cameraFromWorld.translation=T|Trns",
     NOTHING_READ " R1 R2 P1 P2 map* roi* *rvecs* *tvecs*"},
    {"kitti", "a calibration file of KITTI",
     "P0:12|P1:12|P2:12|P3:12|P_rect_00:12|P_rect_01:12|P_rect_02:12|P_rect_03:12|K_00:9|K_01:9|K_02:9|K_03:9 !R1 "
     "!names",
     "P_rect_*: P=P_rect_%, size?=S_rect_%\n"
     "K_*: K=K_%, size?=S_%, distortion?=D_%, cameraFromWorld.rotation?=R_%, cameraFromWorld.translation?=T_%\n"
     "P*: P=P%\nvelodyne/P*: P=P%, " VELODYNE "\nimu/P*: P=P%, " VELODYNE "+Tr_imu_to_velo|Tr_imu_velo",
     "calib_time corner_dist S_* R_rect_* P_rect_* K_* D_* R_* T_*"},
    {"euroc", "a sensor.yaml of EuRoC", "intrinsics:4 resolution:2 !cam0",
     "K=intrinsics, size=resolution, lens?=distortion_coefficients|distortion_coeffs, model?=distortion_model, "
     "worldFromCamera?=T_BS",
     "sensor_type comment rate_hz camera_model"},
    {"flat", "fx, fy, cx, cy by name",
     "fx|fl_x|focal_x|f_x|focalLengthX|fl|focal_length|f cx|c_x|u0|principal_point_x cy|c_y|v0|principal_point_y "
     "!ppx !/t_00 !camera_matrix:9 !/model_type !/frames !K:9 !/projection.type !/Camera.fx !/Camera1.fx "
     "!/calibration.projection !/*.projection_type !/0.x !/0.lat !/0.latitude",
     "K=fx|fl_x|focal_x|f_x|focalLengthX|fl|focal_length|f+fy|fl_y|focal_y|f_y|focalLengthY|fx|fl|focal_length|f+"
     "cx|c_x|u0|principal_point_x+cy|c_y|v0|principal_point_y, " SIZES
     "||/width|/image_width|/w|/W+/height|/image_height|/h|/H||/image_size|/resolution, "
     "lens?=#|distortion.#|dist.#|distortion_coefficients.#|" D_NAMES
     "|/distortion_coefficients.#|/distortion.#|/distortion_coefficients|/dist_coeffs|/distortion|/dist, "
     "model?=distortion_model|camera_model|model|camera_type|/distortion_model|/camera_model, "
     "isFisheye?=is_fisheye|/is_fisheye|fisheye|/fisheye, " POSES ", name?=name",
     NOTHING_READ " raw_* setup color_order",
     ". cam Camera camera intrinsics intrinsic calibration camera_matrix color rgb depth *"},
    {"lookat", "eye, target, fovY by name",
     EYES " " TARGETS " " VERTICAL_FOVS
          " !projection !fx !type !mode !ortho !orthographic !orthoSize !parallel !leftHanded !hfov !fov",
     "position=" EYES ", target=" TARGETS ", up?=up|up_vector|upVector|view_up|viewUp, fovY=" VERTICAL_FOVS ", " SIZES
     ", near?=near|zNear|znear|near_plane|near_clip, far?=far|zFar|zfar|far_plane|far_clip, "
     "aspect?=aspect|aspectRatio|aspect_ratio, name?=name",
     "id type", ". camera Camera cam view *", 0.5, "RUB"},
    {"realsense", "intrinsics of a RealSense", "fx|Fx fy|Fy ppx|PPX ppy|PPY",
     "K=fx|Fx+fy|Fy+ppx|PPX+ppy|PPY, size?=width|Width+height|Height, lens?=coeffs|Coeffs, model?=model|Distortion",
     "fps format serial Device_info Kmx *_extrinsics depth_scale FOV* ?Rotation_Matrix ?Translation_Vector",
     ". * *.intrinsics"},
    {"slam", "settings of ORB-SLAM, VINS, OKVIS or SVO", "Camera.fx !Camera.type=KannalaBrandt8", ORB_BROWN("Camera"),
     ORB_NOTHING "?LEFT* ?RIGHT* Stereo.ThDepth Tbc"},
    {"slam", "", "Camera.fx Camera.type=KannalaBrandt8",
     ORB_FISHEYE("Camera") "\nright: " ORB_FISHEYE("Camera2") ", worldFromCamera=Tlr", ORB_NOTHING "Camera2.* Tbc"},
    {"slam", "", "Camera1.fx !Camera.type=KannalaBrandt8",
     ORB_3(ORB_BROWN) "\nCamera2: " ORB("Camera1") BESIDE("Stereo.b"), ORB_NOTHING "Stereo.ThDepth File*"},
    {"slam", "", "Camera1.fx Camera.type=KannalaBrandt8", ORB_3(ORB_FISHEYE),
     ORB_NOTHING "Camera1.overlapping* Camera2.overlapping* Stereo.ThDepth File*"},
    {"slam", "", "model_type=PINHOLE|model_type=PINHOLE_FULL projection_parameters",
     INTRINSICS("projection_parameters.") ", size=image_width+image_height, lens=distortion_parameters.#",
     "camera_name"},
    {"slam", "", "/model_type=KANNALA_BRANDT /projection_parameters",
     "K=mu+mv+u0+v0, size=/image_width+/image_height, fisheye=k2+k3+k4+k5", "camera_name", "projection_parameters"},
    {"slam", "", "/model_type=MEI /projection_parameters",
     "K=gamma1+gamma2+u0+v0, size=/image_width+/image_height, omni=/mirror_parameters.xi+/distortion_parameters.k1+"
     "/distortion_parameters.k2+/distortion_parameters.p1+/distortion_parameters.p2",
     "camera_name", "projection_parameters"},
    {"slam", "", "T_SC focal_length",
     "K=focal_length+principal_point, size=image_dimension, lens=distortion_coefficients, model=distortion_type, "
     "worldFromCamera=T_SC",
     "imu_params ceres* detection* imageDelay publishing* camera_params cam_params *_params", "cameras.*"},
    {"slam", "", "T_B_C camera.intrinsics",
     "K=camera.intrinsics, size=camera.image_width+camera.image_height, lens?=camera.distortion.parameters, "
     "model?=camera.distortion.type, worldFromCamera=T_B_C",
     "label imu_params imu_initialization line-delay-nanoseconds", "cameras.*"},
    {"slam", "", "cam_model=Pinhole|cam_model=PinholeRadialTangential cam_fx",
     INTRINSICS("cam_") ", size=cam_width+cam_height, distortion=cam_d0+cam_d1+cam_d2+cam_d3, "
                        "cameraFromWorld.quaternion?=T_cam_body.qx+T_cam_body.qy+T_cam_body.qz+T_cam_body.qw, "
                        "cameraFromWorld.translation?=T_cam_body.tx+T_cam_body.ty+T_cam_body.tz",
     "", ". *"},
    {"basalt", "a calib.json of basalt", "T_imu_cam intrinsics",
     INTRINSICS("intrinsics.*.intrinsics.") ", size=resolution.*, "
                                            "lens?=intrinsics.*.intrinsics.#|intrinsics.*.intrinsics.w, "
                                            "model=intrinsics.*.camera_type, "
                                            "worldFromCamera.quaternion=T_imu_cam.*.qx+T_imu_cam.*.qy+T_imu_cam.*.qz+T_"
                                            "imu_cam.*.qw, "
                                            "worldFromCamera.translation=T_imu_cam.*.px+T_imu_cam.*.py+T_imu_cam.*.pz",
     "vignette calib_* cam_time_offset_ns imu_* gyro_* accel_* mocap_* T_mocap_world T_imu_marker", "value0"},
    {"matrix34", "a 3x4 matrix K [R | t]", "P:12|projection_matrix:12|P_matrix:12 !K !k !camera_matrix !D !d !P0 !R1",
     "P=P|projection_matrix|P_matrix, " ROS_SIZE, "", ". *"},
    {"numbers", "a K as numbers alone", "#1:K3|#1:K4 !#2 !extrinsic", "K=#1"},
    {"numbers", "", "#1:F4 !#2", "K=#1"},
    {"numbers", "", "#1:F8/F9 !#2", "K=#1[0:4], distortion=#1[4:]"},
    {"matrix34", "", "#1:P !#2", "P=#1"},
    {"matrix34", "", "#1:PN !#2", "*: P=#1.*"},
    {"mvsnet", "a cam.txt of MVSNet", "extrinsic:4x4 intrinsic:3x3 #3", "K=intrinsic, cameraFromWorld=extrinsic", "#3",
     "", 0.5},
    {"llff", "a poses_bounds.npy of LLFF", "#1:Nx17",
     "*: K=#1.*[14], size=#1.*[9,4], position=#1.*[3,8,13], direction=#1.*[2,7,12]/-1, up=#1.*[0,5,10]/-1", "", "",
     0.5},
    {"strecha", "a .camera of Strecha's scenes", "#1:L26",
     "K=#1[0:9], worldFromCamera.rotation=#1[12:21], position=#1[21:24], size=#1[24:26]"},
    {"pix4d", "cameras and lenses (.cam) of Pix4D", "*:28",
     "K=*[2:11], size=*[0:2], distortion=*[11,12,14,15,13], position=*[16:19], cameraFromWorld.rotation=*[19:28]", "",
     "", 0, "RDF", false,
     "positions are less the X, Y, Z of the project's _offset.xyz; --model=-X,-Y,-Z beside points of the map"},
    {"3dgs", "a cameras.json of 3D Gaussian splatting", "img_name rotation position",
     "K=fx+fy, size=width+height, worldFromCamera.rotation=rotation, position=position, name?=img_name, id?=id",
     "id img_name", "*", 0.5},
    {"open3d", "cameras of Open3D", "intrinsic_matrix:9 !intrinsic_matrix:3x3 width height !K !camera_matrix",
     "K=intrinsic_matrix^T, size=width+height",
     "depth_scale stream_length_msec device_name serial_number fps color_format depth_format color_mode depth_mode"},
    {"open3d", "", "intrinsic.intrinsic_matrix extrinsic:16", OPEN3D("", "extrinsic"), "class_name version_*"},
    {"open3d", "", "intrinsic.intrinsic_matrix extrinsic.0:16", OPEN3D("", "extrinsic.*"), "class_name version_*"},
    {"open3d", "", "parameters.*.intrinsic.intrinsic_matrix", OPEN3D("parameters.*.", "extrinsic"),
     "class_name version_*"},
    {"polycam", "a camera of Polycam", "t_00 t_23 fx",
     INTRINSICS("") ", size=width+height, "
                    "worldFromCamera=t_00+t_01+t_02+t_03+t_10+t_11+t_12+t_13+t_20+t_21+t_22+t_23",
     "timestamp blur_score center_depth neighbors manual_keyframe", "", 0, "RUB"},
    {"record3d", "cameras of Record3D", "K:9 poses:Nx7", RECORD("perFrameIntrinsicCoeffs.*") "\n" RECORD("K^T"),
     "fps initPose dw dh frameTimestamps cameraType", "", 0, "RUB"},
    {"middlebury", "a calib.txt of Middlebury", "cam0:9 cam1:9 baseline",
     "cam0: K=cam0, size=width+height\ncam1: K=cam1, size=width+height" BESIDE("baseline"),
     "doffs ndisp vmin vmax isint dyavg dymax"},
    {"multical", "cameras of multical", "cameras:object cameras.*.K camera_poses",
     "K=cameras.*.K, size=cameras.*.image_size, lens=cameras.*.dist, model?=cameras.*.model, "
     "cameraFromWorld.rotation=camera_poses.*.R|camera_poses.*_to_~.R, "
     "cameraFromWorld.translation=camera_poses.*.T|camera_poses.*_to_~.T",
     "image_sets"},
    {"anipose", "a calibration of Anipose", "matrix:9 rotation:3 translation:3",
     "K=matrix, size=size, lens=distortions|distortion, isFisheye?=fisheye, cameraFromWorld.rotationVector=rotation, "
     "cameraFromWorld.translation=translation, name?=name",
     "metadata name world_position world_orientation", "*"},
    {"nuscenes", "sensors of nuScenes", "camera_intrinsic rotation:4 translation:3",
     "K?=camera_intrinsic, worldFromCamera.quaternionWFirst=rotation, worldFromCamera.translation=translation, "
     "name?=token",
     "", "*"},
    // Its pictures are undistorted already: the coefficients are of the lens before that.
    {"argoverse", "a calibration of Argoverse 1 or Waymo", "value.focal_length_x_px_",
     "K=value.focal_length_x_px_+value.focal_length_y_px_+value.focal_center_x_px_+value.focal_center_y_px_, "
     "worldFromCamera.quaternionWFirst=value.vehicle_SE3_camera_.rotation.coefficients, "
     "worldFromCamera.translation=value.vehicle_SE3_camera_.translation, name?=key",
     "vehicle_SE3_up_lidar_ vehicle_SE3_down_lidar_ skew_ ?distortion_coefficients_", "camera_data_.*"},
    {"argoverse", "", "intrinsic:L9 extrinsic.transform:16 width height",
     "K=intrinsic[0:4], distortion=intrinsic[4:], size=width+height, worldFromCamera=extrinsic.transform, name?=name",
     "rolling_shutter_direction", ". * *.*", 0, "FLU"},
    {"bouguet", "a Calib_Results.m of Bouguet", "fc:2 cc:2 kc:5",
     "*: K=fc+cc, size?=nx+ny, distortion=kc, cameraFromWorld.rotationVector=omc_*, cameraFromWorld.translation=Tc_*\n"
     "K: K=fc+cc, size?=nx+ny, distortion=kc",
     "*_error err_std n_ima est_* center_optim skew_optim check_cond *_error_* alpha_c_error"},
    {"easymocap", "an intri.yml of EasyMocap, with extri.yml", "names K_*:9 !S_* !P_rect_*",
     "*: K=K_*, lens?=dist_*|D_*, model?=model_*, size?=W_*+H_*, cameraFromWorld.rotation?=Rot_*, "
     "cameraFromWorld.translation?=T_*",
     "names R_*", "", 0, "RDF", true},
    {"neus", "cameras of NeuS", "world_mat_0:16", "*: P=world_mat_%", "scale_mat_* *_inv_*"},
    {"camera-path", "a camera_path.json of nerfstudio", "camera_path.*.camera_to_world",
     "fovY=camera_path.*.fov, size=render_width+render_height, worldFromCamera=camera_path.*.camera_to_world, "
     "model?=camera_type",
     "keyframes aspect fps seconds smoothness_value is_cycle crop default_fov default_transition_sec", "", 0.5, "RUB"},
    {"visp", "a camera.xml of ViSP", "model",
     "K=model.1.px+model.1.py+model.1.u0+model.1.v0, size=image_width+image_height, distortion=model.1.kud",
     "model additional_information name", "root.camera"},
};

struct RowLine {
  std::string_view names;
  std::vector<Part> parts;
  bool isThere, isOfAnother;
};

std::vector<RowLine> rowLines(const Row& row, const Node& root, std::string_view container) {
  std::vector<RowLine> lines;
  for (std::string_view rest = row.lines; !rest.empty();) {
    std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    RowLine line{};
    const bool isFirstEnough = text.starts_with('!');
    line.isOfAnother = text.starts_with('~');
    if (isFirstEnough || line.isOfAnother) text.remove_prefix(1);
    if (const std::size_t colon = text.find(": "); colon < text.find('=')) {
      line.names = text.substr(0, colon);
      text.remove_prefix(colon + 2);
    }
    line.parts = parseParts(text, std::string(row.name), container);
    requireNames(line.parts, std::string(row.name), true);
    line.isThere = isFirstEnough ? hasParts(root, {line.parts.front()}) : hasParts(root, line.parts);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::span<const Row> rows() { return kRows; }

std::optional<std::string> containerOf(const Row& row, const Node& root) {
  for (const std::string_view each : wordsIn(row.containers.empty() ? "." : row.containers)) {
    const std::string container(each == "." ? "" : each);
    if (!holds(root, row.when, container)) continue;
    const std::vector<RowLine> lines = rowLines(row, root, container);
    if (std::any_of(lines.begin(), lines.end(), [](const RowLine& line) { return line.isThere; })) return container;
  }
  return std::nullopt;
}

Import importRow(const Row& row, const Node& root, std::string_view container) {
  if (row.hasOtherFile) addOtherFile(root.document());
  Import all;
  if (!row.note.empty()) all.notes.emplace_back(row.note);
  std::unordered_set<std::string> earlier;
  for (RowLine& line : rowLines(row, root, container)) {
    if (!line.isThere) continue;
    std::vector<CameraEntry> cameras =
        camerasOfParts(root, std::move(line.parts), {row.pixelCenter, row.cameraAxes}, line.names);
    // A later line of the same name is another way to say the camera.
    std::erase_if(cameras, [&](const CameraEntry& camera) { return earlier.contains(camera.name); });
    for (CameraEntry& camera : cameras) {
      if (!camera.name.empty()) earlier.insert(camera.name);
      camera.isOfAnother = line.isOfAnother;
      all.cameras.push_back(std::move(camera));
    }
  }
  return all;
}

}  // namespace viewproj::cmd
