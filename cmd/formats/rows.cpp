#include "formats/rows.hpp"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/claims.hpp"
#include "formats/parts.hpp"
#include "text/error.hpp"

namespace viewproj::cmd {
namespace {

// Names of one thing, the usual one first.
#define K_NAMES                                                                                                    \
  "K|camera_matrix|cameraMatrix|mtx|Camera_Matrix|cam_matrix|intrinsic_matrix|cam_K|cam_mtx|camera_mtx|camMatrix|" \
  "intrinsic|intrinsics|Intrinsics|cameraIntrinsics|M|camera_intrinsic|camera_intrinsics|matrix"
#define K_SHAPES                                                                                                    \
  "K:9/12|camera_matrix:9|cameraMatrix:9|mtx:9|Camera_Matrix:9|cam_matrix:9|intrinsic_matrix:3x3|cam_K:9/"          \
  "12|cam_mtx:9|"                                                                                                   \
  "camera_mtx:9|camMatrix:9|intrinsic:9/12/16|intrinsics:9|Intrinsics:9|cameraIntrinsics:9|M:9|camera_intrinsic:9|" \
  "camera_intrinsics:9|matrix:K3"
#define D_NAMES                                                                                                        \
  "distortion_coefficients|dist_coeffs|distCoeffs|distortionCoefficients|dist|D|d|distortion|Distortion_Coefficients|" \
  "distortion_coeffs|dist_coeff|dist_coefs|distCoef|distCoeff|kc|distortion_vec|distortions|Distortion|cam_dist|"      \
  "camera_dist_coeffs|disto"
#define SIZES                                                                                                     \
  "size?=width|image_width|image_Width|w|W|img_width|cols+height|image_height|image_Height|h|H|img_height|rows||" \
  "image_size|img_size|imageSize|resolution|cameraRes|size"
#define MODELS "model?=distortion_model|camera_model|lens_model|lensmodel, isFisheye?=fisheye_model|is_fisheye|fisheye"
#define POSES                                                                                                         \
  "cameraFromWorld?=extrinsic|extrinsics|extrinsic_matrix|T_cam_world|cameraFromWorld|w2c|world_to_cam|T_lidar_to_"   \
  "cam|"                                                                                                              \
  "CameraMatrix, worldFromCamera?=T_world_cam|worldFromCamera|c2w|cam_to_world|camera_to_world, "                     \
  "cameraFromWorld.rotation?=R|rotation_matrix|cam_R_w2c|poses.R, cameraFromWorld.rotationVector?=rvec|"              \
  "rotation_vector|rotationVector|rvecs, cameraFromWorld.translation?=t|tvec|T|translation_vector|translationVector|" \
  "translation|cam_t_w2c|poses.T|tvecs"
#define NOTHING_READ                                                                                                 \
  "ret rms rms_error rms_err rmse error *_error *_errors *Error *Errors per_view* avg_* mean_* objpoints imgpoints " \
  "obj_points img_points nrow ncol board* square* pattern* grid* image_points flags nframes nr_of_frames "           \
  "calibration_time calibration_date header camera_name sensor_type comment rate_hz fps id calobject* observations " \
  "perViewErrors standardDeviation* *_gt raw_camera_matrix raw_dist* E F Q newcameramtx new_camera_matrix newmtx "   \
  "new_K "                                                                                                           \
  "roi map1 map2 mapx mapy depth_scale"

#define FLAT(P)                                                                                                       \
  "K=" P "fx|" P "fl_x|" P "focal_x|" P "f_x|" P "focalLengthX|" P "fl|" P "focal_length|" P "f+" P "fy|" P "fl_y|" P \
  "focal_y|" P "f_y|" P "focalLengthY|" P "fx|" P "fl|" P "focal_length|" P "f+" P "cx|" P "c_x|" P "u0|" P           \
  "principal_point_x+" P "cy|" P "c_y|" P "v0|" P "principal_point_y"
#define FLAT_IS                                                                                                 \
  "fx|fl_x|focal_x|f_x|focalLengthX|fl|focal_length|f cx|c_x|u0|principal_point_x cy|c_y|v0|principal_point_y " \
  "!ppx !/t_00 !camera_matrix:9 !/model_type !/frames !K:9 !/projection.type !/Camera.fx !/Camera1.fx "         \
  "!/calibration.projection !/*.projection_type !/0.x !/0.lat !/0.latitude"

constexpr Row kRows[] = {
    {"ros", "a camera_info of ROS", "camera_matrix|K|k projection_matrix|P:12|p:12",
     "raw: K=camera_matrix|K|k, size?=image_width|width+image_height|height, lens?=distortion_coefficients|D|d, "
     "model?=distortion_model\n"
     "rectified: P=projection_matrix|P|p, size?=image_width|width+image_height|height",
     "", 0, "RDF", "header camera_name R r rectification_matrix"},
    {"ros", "", "image.width *.projection:12 *.distortion",
     "raw: K=*.camera_matrix, size=/image.width+/image.height, lens=*.distortion\n"
     "rectified: P=*.projection, size=/image.width+/image.height",
     "", 0, "RDF", "rectification"},
    {"opencv", "a calibration of OpenCV (YAML, XML, JSON, .npz)",
     K_SHAPES " !projection_matrix !P:12 !p:12 !rvecs.0:3 !extrinsic_parameters !rVector !T_BS !/camera_poses "
              "!rotation:4 !/cameraPoseARFrame "
              "!cameras.0 !poses:list "
              "!#3 !camera_data_ !image.width !class_name !world_mat_0",
     "K=" K_NAMES ", " SIZES ", lens?=" D_NAMES "|distortion_coefficients.#|distortion.#|dist.#, xi?=xi|Xi, " MODELS
     ", " POSES ", near?=near, far?=far, name?=name",
     ". r3live_vio camera * cameras.*", 0, "RDF", NOTHING_READ},
    {"opencv", "", K_SHAPES " extrinsic_parameters:Nx6",
     "*: K=" K_NAMES ", " SIZES ", lens?=" D_NAMES ", " MODELS
     ", cameraFromWorld.rotationVector=extrinsic_parameters.*[0:3], "
     "cameraFromWorld.translation=extrinsic_parameters.*[3:6]\n"
     "K: K=" K_NAMES ", " SIZES ", lens?=" D_NAMES ", " MODELS,
     "", 0, "RDF", NOTHING_READ},
    {"opencv", "", K_SHAPES " rvecs.0:3|rVector.0:3|rotation_vecs.0:3 !projection_matrix",
     "*: K=" K_NAMES ", " SIZES ", lens?=" D_NAMES ", " MODELS
     ", cameraFromWorld.rotationVector=rvecs.*|rVector.*|rotation_vecs.*, "
     "cameraFromWorld.translation=tvecs.*|tVector.*|translation_vecs.*\n"
     "K: K=" K_NAMES ", " SIZES ", lens?=" D_NAMES ", " MODELS,
     "", 0, "RDF", NOTHING_READ},
    {"euroc", "a sensor.yaml of EuRoC", "intrinsics:4 resolution:2 !cam0",
     "K=intrinsics, size=resolution, lens?=distortion_coefficients|distortion_coeffs, model?=distortion_model, "
     "worldFromCamera?=T_BS",
     "", 0, "RDF", "sensor_type comment rate_hz camera_model"},
    {"flat", "fx, fy, cx, cy by name", FLAT_IS,
     FLAT("") ", " SIZES "||/width|/image_width|/w|/W+/height|/image_height|/h|/H||/image_size|/resolution, "
              "lens?=#|distortion.#|dist.#|distortion_coefficients.#|" D_NAMES
              "|/distortion_coefficients.#|/distortion.#|/distortion_coefficients|/dist_coeffs|/distortion|/dist, "
              "model?=distortion_model|camera_model|model|camera_type|/distortion_model|/camera_model, "
              "isFisheye?=is_fisheye|/is_fisheye|fisheye|/fisheye, " POSES ", name?=name",
     ". cam Camera camera intrinsics intrinsic calibration camera_matrix color rgb depth *", 0, "RDF",
     NOTHING_READ " raw_* setup color_order"},
    {"realsense", "intrinsics of a RealSense", "fx fy ppx ppy",
     "K=fx+fy+ppx+ppy, size?=width+height, lens?=coeffs, model?=model", ". * *.intrinsics", 0, "RDF",
     "fps format serial Kmx *_extrinsics depth_scale"},
    {"slam", "settings of ORB-SLAM, VINS, OKVIS or SVO", "Camera.fx !Camera.type=KannalaBrandt8",
     "K=Camera.fx+Camera.fy+Camera.cx+Camera.cy, size?=Camera.width+Camera.height, lens?=Camera.#", "", 0, "RDF",
     "Camera.* ORB* Viewer* ThDepth DepthMapFactor IMU* LEFT* RIGHT* RGBD* System* Stereo.ThDepth Tbc"},
    {"slam", "", "Camera.fx Camera.type=KannalaBrandt8",
     "K=Camera.fx+Camera.fy+Camera.cx+Camera.cy, size?=Camera.width+Camera.height, "
     "fisheye=Camera.k1+Camera.k2+Camera.k3+Camera.k4\n"
     "right: K=Camera2.fx+Camera2.fy+Camera2.cx+Camera2.cy, size?=Camera.width+Camera.height, "
     "fisheye=Camera2.k1+Camera2.k2+Camera2.k3+Camera2.k4, worldFromCamera=Tlr",
     "", 0, "RDF", "Camera.* Camera2.* ORB* Viewer* ThDepth DepthMapFactor IMU* RGBD* System* Tbc"},
    {"slam", "", "Camera1.fx !Camera.type=KannalaBrandt8",
     "Camera1: K=Camera1.fx+Camera1.fy+Camera1.cx+Camera1.cy, size?=Camera.width+Camera.height, lens?=Camera1.#\n"
     "Camera2: K=Camera2.fx+Camera2.fy+Camera2.cx+Camera2.cy, size?=Camera.width+Camera.height, lens?=Camera2.#, "
     "worldFromCamera=Stereo.T_c1_c2\n"
     "Camera2: K=Camera1.fx+Camera1.fy+Camera1.cx+Camera1.cy, size?=Camera.width+Camera.height, position=Stereo.b+0+0, "
     "worldFromCamera.quaternion=0+0+0+1\n"
     "body/Camera1: K=Camera1.fx+Camera1.fy+Camera1.cx+Camera1.cy, size?=Camera.width+Camera.height, lens?=Camera1.#, "
     "worldFromCamera=IMU.T_b_c1",
     "", 0, "RDF", "Camera.* ORB* Viewer* ThDepth DepthMapFactor IMU* RGBD* System* Stereo.ThDepth File*"},
    {"slam", "", "Camera1.fx Camera.type=KannalaBrandt8",
     "Camera1: K=Camera1.fx+Camera1.fy+Camera1.cx+Camera1.cy, size?=Camera.width+Camera.height, "
     "fisheye=Camera1.k1+Camera1.k2+Camera1.k3+Camera1.k4\n"
     "Camera2: K=Camera2.fx+Camera2.fy+Camera2.cx+Camera2.cy, size?=Camera.width+Camera.height, "
     "fisheye=Camera2.k1+Camera2.k2+Camera2.k3+Camera2.k4, worldFromCamera=Stereo.T_c1_c2\n"
     "body/Camera1: K=Camera1.fx+Camera1.fy+Camera1.cx+Camera1.cy, size?=Camera.width+Camera.height, "
     "fisheye=Camera1.k1+Camera1.k2+Camera1.k3+Camera1.k4, worldFromCamera=IMU.T_b_c1",
     "", 0, "RDF",
     "Camera.* Camera1.overlapping* Camera2.overlapping* ORB* Viewer* ThDepth DepthMapFactor IMU* RGBD* System* "
     "Stereo.ThDepth File*"},
    {"slam", "", "model_type=PINHOLE|model_type=PINHOLE_FULL projection_parameters",
     "K=projection_parameters.fx+projection_parameters.fy+projection_parameters.cx+projection_parameters.cy, "
     "size=image_width+image_height, lens=distortion_parameters.#",
     "", 0, "RDF", "camera_name"},
    {"slam", "", "model_type=KANNALA_BRANDT projection_parameters",
     "K=projection_parameters.mu+projection_parameters.mv+projection_parameters.u0+projection_parameters.v0, "
     "size=image_width+image_height, "
     "fisheye=projection_parameters.k2+projection_parameters.k3+projection_parameters.k4+"
     "projection_parameters.k5",
     "", 0, "RDF", "camera_name"},
    {"slam", "", "model_type=MEI projection_parameters",
     "K=projection_parameters.gamma1+projection_parameters.gamma2+projection_parameters.u0+projection_parameters.v0, "
     "size=image_width+image_height, omni=mirror_parameters.xi+distortion_parameters.k1+distortion_parameters.k2+"
     "distortion_parameters.p1+distortion_parameters.p2",
     "", 0, "RDF", "camera_name"},
    {"slam", "", "cameras.*.T_SC cameras.*.focal_length",
     "K=cameras.*.focal_length+cameras.*.principal_point, size=cameras.*.image_dimension, "
     "lens=cameras.*.distortion_coefficients, model=cameras.*.distortion_type, worldFromCamera=cameras.*.T_SC",
     "", 0, "RDF", "imu_params ceres* detection* imageDelay publishing* camera_params cam_params *_params"},
    {"slam", "", "cameras.*.T_B_C cameras.*.camera.intrinsics",
     "K=cameras.*.camera.intrinsics, size=cameras.*.camera.image_width+cameras.*.camera.image_height, "
     "lens?=cameras.*.camera.distortion.parameters, model?=cameras.*.camera.distortion.type, "
     "worldFromCamera=cameras.*.T_B_C",
     "", 0, "RDF", "label imu_params imu_initialization line-delay-nanoseconds"},
    {"basalt", "a calib.json of basalt", "value0.T_imu_cam value0.intrinsics",
     "K=value0.intrinsics.*.intrinsics.fx+value0.intrinsics.*.intrinsics.fy+value0.intrinsics.*.intrinsics.cx+"
     "value0.intrinsics.*.intrinsics.cy, size=value0.resolution.*, "
     "lens?=value0.intrinsics.*.intrinsics.#|value0.intrinsics.*.intrinsics.w, model=value0.intrinsics.*.camera_type, "
     "worldFromCamera.quaternion=value0.T_imu_cam.*.qx+value0.T_imu_cam.*.qy+value0.T_imu_cam.*.qz+value0.T_imu_cam.*."
     "qw, "
     "worldFromCamera.translation=value0.T_imu_cam.*.px+value0.T_imu_cam.*.py+value0.T_imu_cam.*.pz",
     "", 0, "RDF", "vignette calib_* cam_time_offset_ns imu_* gyro_* accel_* mocap_* T_mocap_world T_imu_marker"},
    {"matrix34", "a 3x4 matrix K [R | t]", "P:12|projection_matrix:12|P_matrix:12 !K !k !camera_matrix !D !d !P0 !R1",
     "P=P|projection_matrix|P_matrix, size?=width|image_width+height|image_height", ". *"},
    {"numbers", "a K as numbers alone", "#1:K3|#1:K4 !#2 !extrinsic", "K=#1"},
    {"numbers", "", "#1:F4 !#2", "K=#1"},
    {"numbers", "", "#1:F8/F9 !#2", "K=#1[0:4], distortion=#1[4:]"},
    {"matrix34", "", "#1:P !#2", "P=#1"},
    {"matrix34", "", "#1:PN !#2", "*: P=#1.*"},
    {"mvsnet", "a cam.txt of MVSNet", "extrinsic:4x4 intrinsic:3x3 #3", "K=intrinsic, cameraFromWorld=extrinsic", "",
     0.5, "RDF", "#3"},
    {"llff", "a poses_bounds.npy of LLFF", "#1:Nx17",
     "*: K=#1.*[14], size=#1.*[9,4], position=#1.*[3,8,13], direction=#1.*[2,7,12]/-1, up=#1.*[0,5,10]/-1", "", 0.5},
    {"strecha", "a .camera of Strecha's scenes", "#1:L26",
     "K=#1[0:9], worldFromCamera.rotation=#1[12:21], position=#1[21:24], size=#1[24:26]"},
    {"pix4d", "cameras of Pix4D", "*:28",
     "K=*[2:11], size=*[0:2], distortion=*[11,12,14,15,13], position=*[16:19], cameraFromWorld.rotation=*[19:28]"},
    {"3dgs", "a cameras.json of 3D Gaussian splatting", "*.img_name *.rotation *.position",
     "K=*.fx+*.fy, size=*.width+*.height, worldFromCamera.rotation=*.rotation, position=*.position, name?=*.img_name, "
     "id?=*.id",
     "", 0.5, "RDF", "id img_name"},
    {"open3d", "cameras of Open3D", "intrinsic_matrix:9 !intrinsic_matrix:3x3 width height !K !camera_matrix",
     "K=intrinsic_matrix^T, size=width+height", "", 0, "RDF",
     "depth_scale stream_length_msec device_name serial_number fps color_format depth_format color_mode depth_mode"},
    {"open3d", "", "intrinsic.intrinsic_matrix extrinsic:16",
     "K=intrinsic.intrinsic_matrix^T, size=intrinsic.width+intrinsic.height, cameraFromWorld=extrinsic^T", "", 0, "RDF",
     "class_name version_*"},
    {"open3d", "", "intrinsic.intrinsic_matrix extrinsic.0:16",
     "K=intrinsic.intrinsic_matrix^T, size=intrinsic.width+intrinsic.height, cameraFromWorld=extrinsic.*^T", "", 0,
     "RDF", "class_name version_*"},
    {"open3d", "", "parameters.*.intrinsic.intrinsic_matrix",
     "K=parameters.*.intrinsic.intrinsic_matrix^T, size=parameters.*.intrinsic.width+parameters.*.intrinsic.height, "
     "cameraFromWorld=parameters.*.extrinsic^T",
     "", 0, "RDF", "class_name version_*"},
    {"polycam", "a camera of Polycam", "t_00 t_23 fx",
     "K=fx+fy+cx+cy, size=width+height, worldFromCamera=t_00+t_01+t_02+t_03+t_10+t_11+t_12+t_13+t_20+t_21+t_22+t_23",
     "", 0, "RUB", "timestamp blur_score center_depth neighbors manual_keyframe"},
    {"record3d", "cameras of Record3D", "K:9 poses:Nx7",
     "K=K^T, size=w+h, worldFromCamera.quaternion=poses.*[0:4], worldFromCamera.translation=poses.*[4:7]", "", 0, "RUB",
     "fps perFrameIntrinsicCoeffs initPose dw dh frameTimestamps cameraType"},
    {"middlebury", "a calib.txt of Middlebury", "cam0:9 cam1:9 baseline",
     "cam0: K=cam0, size=width+height\ncam1: K=cam1, size=width+height, position=baseline+0+0, "
     "worldFromCamera.quaternion=0+0+0+1",
     "", 0, "RDF", "doffs ndisp vmin vmax isint dyavg dymax"},
    {"multical", "cameras of multical", "cameras:object cameras.*.K camera_poses",
     "K=cameras.*.K, size=cameras.*.image_size, lens=cameras.*.dist, model?=cameras.*.model, "
     "cameraFromWorld.rotation=camera_poses.*.R|camera_poses.*_to_~.R, "
     "cameraFromWorld.translation=camera_poses.*.T|camera_poses.*_to_~.T",
     "", 0, "RDF", "image_sets"},
    {"anipose", "a calibration of Anipose", "*.matrix:9 *.rotation:3 *.translation:3",
     "K=*.matrix, size=*.size, lens=*.distortions|*.distortion, isFisheye?=*.fisheye, "
     "cameraFromWorld.rotationVector=*.rotation, "
     "cameraFromWorld.translation=*.translation, name?=*.name",
     "", 0, "RDF", "metadata name"},
    {"nuscenes", "sensors of nuScenes", "*.camera_intrinsic *.rotation:4 *.translation:3",
     "K=*.camera_intrinsic, worldFromCamera.quaternionWFirst=*.rotation, worldFromCamera.translation=*.translation, "
     "name?=*.token"},
    {"argoverse", "a calibration of Argoverse 1", "camera_data_.*.value.focal_length_x_px_",
     "K=camera_data_.*.value.focal_length_x_px_+camera_data_.*.value.focal_length_y_px_+camera_data_.*.value.focal_"
     "center_x_px_+"
     "camera_data_.*.value.focal_center_y_px_, "
     "distortion=camera_data_.*.value.distortion_coefficients_[0,1]+0+0+camera_data_.*.value.distortion_coefficients_["
     "2], "
     "worldFromCamera.quaternionWFirst=camera_data_.*.value.vehicle_SE3_camera_.rotation.coefficients, "
     "worldFromCamera.translation=camera_data_.*.value.vehicle_SE3_camera_.translation, name?=camera_data_.*.key",
     "", 0, "RDF", "vehicle_SE3_up_lidar_ vehicle_SE3_down_lidar_ skew_"},
    {"bouguet", "a Calib_Results.m of Bouguet", "fc:2 cc:2 kc:5",
     "*: K=fc+cc, size?=nx+ny, distortion=kc, cameraFromWorld.rotationVector=omc_*, cameraFromWorld.translation=Tc_*\n"
     "K: K=fc+cc, size?=nx+ny, distortion=kc",
     "", 0, "RDF", "*_error err_std n_ima est_* center_optim skew_optim check_cond *_error_* alpha_c_error"},
    {"easymocap", "an intri.yml of EasyMocap", "names K_*:9 !S_* !P_rect_*",
     "*: K=K_*, lens?=dist_*|D_*, model?=model_*, size?=W_*+H_*, cameraFromWorld.rotation?=Rot_*, "
     "cameraFromWorld.translation?=T_*",
     "", 0, "RDF", "names R_*"},
    {"neus", "cameras of NeuS", "world_mat_0:16", "*: P=world_mat_*", "", 0, "RDF", "scale_mat_* *_inv_*"},
    {"camera-path", "a camera_path.json of nerfstudio", "camera_path.*.camera_to_world",
     "fovY=camera_path.*.fov, size=render_width+render_height, worldFromCamera=camera_path.*.camera_to_world", "", 0.5,
     "RUB",
     "keyframes aspect fps seconds smoothness_value is_cycle crop default_fov default_transition_sec camera_type"},
    {"visp", "a camera.xml of ViSP", "root.camera.model",
     "K=root.camera.model.1.px+root.camera.model.1.py+root.camera.model.1.u0+root.camera.model.1.v0, "
     "size=root.camera.image_width+root.camera.image_height, distortion=root.camera.model.1.kud",
     "", 0, "RDF", "model additional_information name"},
};

#undef K_NAMES
#undef K_SHAPES
#undef D_NAMES
#undef SIZES
#undef MODELS
#undef POSES
#undef NOTHING_READ
#undef FLAT
#undef FLAT_IS

struct RowLine {
  std::string_view names;
  std::vector<Part> parts;
};

std::vector<RowLine> rowLines(const Row& row, std::string_view container) {
  std::vector<RowLine> lines;
  for (std::string_view rest = row.lines; !rest.empty();) {
    std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    RowLine line;
    if (const std::size_t colon = text.find(": "); colon < text.find('=')) {
      line.names = text.substr(0, colon);
      text.remove_prefix(colon + 2);
    }
    line.parts = parseParts(text, std::string(row.name));
    requireNames(line.parts, std::string(row.name), true);
    placeUnder(line.parts, container);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::span<const Row> rows() { return kRows; }

std::optional<std::string> containerOf(const Row& row, const Node& root) {
  const std::string_view containers = row.containers.empty() ? "." : row.containers;
  for (std::size_t at = 0; at < containers.size();) {
    const std::size_t end = std::min(containers.find(' ', at), containers.size());
    const std::string container(containers.substr(at, end - at) == "." ? "" : containers.substr(at, end - at));
    at = end + 1;
    if (!holds(root, row.when, container)) continue;
    const std::vector<RowLine> lines = rowLines(row, container);
    if (std::any_of(lines.begin(), lines.end(), [&](const RowLine& line) { return hasParts(root, line.parts); }))
      return container;
  }
  return std::nullopt;
}

Import importRow(const Row& row, const Node& root, std::string_view container) {
  std::vector<Import> imports;
  for (RowLine& line : rowLines(row, container))
    if (hasParts(root, line.parts))
      imports.push_back(importParts(root, std::move(line.parts), {row.pixelCenter, row.cameraAxes}, line.names));
  Import all;
  std::vector<std::pair<std::size_t, std::size_t>> places;  // of each camera: the line, and its number there
  for (std::size_t i = 0; i < imports.size(); ++i)
    for (std::size_t j = 0; j < imports[i].cameras.size(); ++j) {
      const CameraEntry& camera = imports[i].cameras[j];
      // A later line of the same name is another way to say the camera.
      const bool isKnown = i > 0 && std::any_of(all.cameras.begin(), all.cameras.end(), [&](const CameraEntry& each) {
                             return each.name == camera.name && !camera.name.empty();
                           });
      if (isKnown) continue;
      all.cameras.push_back(camera);
      places.emplace_back(i, j);
    }
  all.document = [imports = std::move(imports), places](std::size_t which) {
    return imports[places[which].first].document(places[which].second);
  };
  return all;
}

}  // namespace viewproj::cmd
