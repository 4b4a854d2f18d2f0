// Matrices in text: which numbers they are, what they can be, how sure, and in another convention.
#include "text/pasted_matrices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "catch.hpp"
#include "commands/pasted/reading_parts.hpp"
#include "commands/pasted/readings.hpp"
#include "parts.hpp"
#include "random.hpp"
#include "viewproj/viewproj.hpp"

using namespace viewproj;
using namespace viewproj::cmd;

namespace {

/// Sixteen numbers of which no two are alike, but for what a convention needs.
constexpr double kNumbers[16] = {1.5, 0, 0.25, 0, 0, 2.5, -0.125, 0, 0, 0, -1.01, -2.02, 0, 0, -1, 0};

/// %0 to %f in a text: the numbers by rows; %A: all of them, separated by commas.
std::string filled(const std::string& form) {
  const auto text = [](std::size_t i) {
    char out[32];
    std::snprintf(out, sizeof out, "%g", kNumbers[i]);
    return std::string(out);
  };
  std::string result;
  for (std::size_t i = 0; i < form.size(); ++i) {
    if (form[i] != '%' || i + 1 == form.size()) {
      result += form[i];
      continue;
    }
    const char c = form[++i];
    if (c == 'A')
      for (std::size_t k = 0; k < 16; ++k) result += (k > 0 ? ", " : "") + text(k);
    else
      result += text(static_cast<std::size_t>(c <= '9' ? c - '0' : c - 'a' + 10));
  }
  return result;
}

std::vector<double> valuesOf(const PastedMatrix& m) {
  std::vector<double> values;
  for (std::size_t i = 0; i < m.rows; ++i)
    for (std::size_t j = 0; j < m.columns; ++j) values.push_back(m.at(i, j));
  return values;
}

const std::vector<double> kExpected(std::begin(kNumbers), std::end(kNumbers));

struct Form {
  const char* what;
  const char* text;
  const char* name;
  bool isInMemoryOrder;
  bool isByColumns = false;
};

constexpr Form kForms[] = {
    {"rows", "%0 %1 %2 %3\n%4 %5 %6 %7\n%8 %9 %a %b\n%c %d %e %f\n", "", false},
    {"a prompt and a log", "12:03:44.120 WARN frame 17: proj = [%A]\n", "proj", true},
    {"quoted mail",
     "> I get\n> [[%0, %1, %2, %3],\n>  [%4, %5, %6, %7],\n>  [%8, %9, %a, %b],\n>  [%c, %d, %e, %f]]\n> here.\n",
     "I get", false},
    {"a row that is commented out",
     "proj = [\n [%0, %1, %2, %3],\n # [7, 7, 7, 7],\n [%4, %5, %6, %7], // [8, 8, 8, 8]\n [%8, %9, %a, %b],\n [%c, "
     "%d, "
     "%e, %f]]\n",
     "proj", false},
    {"all commented out",
     "f()\n# [[%0, %1, %2, %3]\n#  [%4, %5, %6, %7]\n#  [%8, %9, %a, %b]\n#  [%c, %d, %e, %f]]\ng()\n", "", false},
    {"MATLAB", "proj = [%0 %1 %2 %3; %4 %5 %6 %7; %8 %9 %a %b; %c %d %e %f];", "proj", false},
    {"C",
     "static const float m[4][4] = { { %0f, %1, %2, %3 }, {%4, %5f, %6, %7}, {%8, %9, %a, %b}, {%c, %d, %e, %f} };", "",
     false},
    {"GLSL",
     "mat4 proj = mat4(vec4(%0, %1, %2, %3), vec4(%4, %5, %6, %7), vec4(%8, %9, %a, %b), vec4(%c, %d, %e, %f));",
     "proj", false, true},
    {"a typed array's print", "view Float32Array(16) [%A, buffer: 7]", "", true},
    {"by index",
     "m[0]=%0; m[1]=%1; m[2]=%2; m[3]=%3; m[4]=%4; m[5]=%5; m[6]=%6; m[7]=%7;\nm[8]=%8; m[9]=%9; m[10]=%a; m[11]=%b; "
     "m[12]=%c; m[13]=%d; m[14]=%e; m[15]=%f;",
     "m", true},
    {"locals of a debugger",
     "[0]\t%0\tfloat\n[1]\t%1\tfloat\n[2]\t%2\tfloat\n[3]\t%3\tfloat\n[4]\t%4\tfloat\n[5]\t%5\tfloat\n"
     "[6]\t%6\tfloat\n[7]\t%7\tfloat\n[8]\t%8\tfloat\n[9]\t%9\tfloat\n[10]\t%a\tfloat\n[11]\t%b\tfloat\n"
     "[12]\t%c\tfloat\n[13]\t%d\tfloat\n[14]\t%e\tfloat\n[15]\t%f\tfloat\n",
     "", true},
    {"members",
     "{M11:%0 M12:%1 M13:%2 M14:%3} {M21:%4 M22:%5 M23:%6 M24:%7} {M31:%8 M32:%9 M33:%a M34:%b} {M41:%c M42:%d M43:%e "
     "M44:%f}",
     "", false},
    {"a table of Markdown",
     "| a | b | c | d |\n|--|--|--|--|\n| %0 | %1 | %2 | %3 |\n| %4 | **%5** | %6 | %7 |\n| %8 | %9 | %a | %b |\n| %c "
     "| %d | %e | %f |\n",
     "", false},
    {"boxes", "  │ %0 %1 %2 %3 │\n  │ %4 %5 %6 %7 │\n  │ %8 %9 %a %b │\n  │ %c %d %e %f │\n", "", false},
    {"LaTeX",
     "P = \\begin{pmatrix} %0 & %1 & %2 & %3 \\\\\n %4 & %5 & %6 & %7 \\\\\n %8 & %9 & %a & %b \\\\\n %c & %d & %e & "
     "%f \\end{pmatrix}",
     "P", false},
    {"LaTeX on one line",
     "$P = \\begin{pmatrix}%0 & %1 & %2 & %3 \\\\ %4 & %5 & %6 & %7 \\\\ %8 & %9 & %a & %b \\\\ %c & %d & %e & "
     "%f\\end{pmatrix}$",
     "P", false},
    {"a table of Markdown whose first row is its header",
     "| %0 | %1 | %2 | %3 |\n|---|---|---|---|\n| %4 | %5 | %6 | %7 |\n| %8 | %9 | %a | %b |\n| %c | %d | %e | %f |\n",
     "", false},
    {"a table of Markdown that counts its columns",
     "| 0 | 1 | 2 | 3 |\n|--:|--:|--:|--:|\n| %0 | %1 | %2 | %3 |\n| %4 | %5 | %6 | %7 |\n| %8 | %9 | %a | %b |\n| %c "
     "| "
     "%d | %e | %f |\n",
     "", false},
    {"a table of Markdown with names of rows",
     "| | c0 | c1 | c2 | c3 |\n|--|--|--|--|--|\n| **r0** | %0 | %1 | %2 | %3 |\n| **r1** | %4 | %5 | %6 | %7 |\n| "
     "**r2** "
     "| %8 | %9 | %a | %b |\n| **r3** | %c | %d | %e | %f |\n",
     "", false},
    {"Eigen in gdb, column by column",
     "$2 = Eigen::Matrix<float,4,4,ColMajor> (data ptr: 0x7ffe) = {[0,0] = %0, [1,0] = %4, [2,0] = %8, [3,0] = %c, "
     "[0,1] "
     "= %1, [1,1] = %5, [2,1] = %9, [3,1] = %d, [0,2] = %2, [1,2] = %6, [2,2] = %a, [3,2] = %e, [0,3] = %3, [1,3] = "
     "%7, "
     "[2,3] = %b, [3,3] = %f}",
     "", false},
    {"Eigen in gdb without its printers",
     "(gdb) p T_cam_world\n$3 = {<Eigen::PlainObjectBase<Eigen::Matrix<double, 4, 4, 0, 4, 4> >> = {<Eigen::DenseBase"
     "<Eigen::Matrix<double, 4, 4, 0, 4, 4> >> = {<No data fields>}, <No data fields>}, m_storage = {m_data = {array = "
     "{%A}}}}, <No data fields>}\n",
     "T_cam_world", true},
    {"a command", "print(proj)\n%0 %1 %2 %3\n%4 %5 %6 %7\n%8 %9 %a %b\n%c %d %e %f\n", "proj", false},
    {"a row of a table in front",
     "Name\tValue\tType\nproj\t\t0\tfloat4x4\n%0 %1 %2 %3\n%4 %5 %6 %7\n%8 %9 %a %b\n%c %d %e %f\n", "proj", false},
    {"a log's level", "INFO: proj\n%0 %1 %2 %3\n%4 %5 %6 %7\n%8 %9 %a %b\n%c %d %e %f\n", "proj", false},
    {"a log's time on each line",
     "[2024-05-01 10:00:00.123] [info] the projection\n[2024-05-01 10:00:00.123] [info] %0 %1 %2 %3\n[2024-05-01 "
     "10:00:00.123] [info] %4 %5 %6 %7\n[2024-05-01 10:00:00.124] [info] %8 %9 %a %b\n[2024-05-01 10:00:00.131] [info] "
     "%c %d %e %f\n",
     "", false},
    {"XML", "<node name='x'><transform>%0 %1 %2 %3 %4 %5 %6 %7 %8 %9 %a %b %c %d %e %f</transform></node>", "transform",
     true},
    {"YAML",
     "pose:\n- - %0\n  - %1\n  - %2\n  - %3\n- - %4\n  - %5\n  - %6\n  - %7\n- - %8\n  - %9\n  - %a\n  - %b\n- - %c\n  "
     "- %d\n  - %e\n  - %f\n",
     "pose", true},
    {"a size in front", "4 4\n%0 %1 %2 %3\n%4 %5 %6 %7\n%8 %9 %a %b\n%c %d %e %f\n", "", false},
};

std::string numbered(const std::vector<PassedOver>& over) {
  std::string text;
  for (const PassedOver& each : over) text += std::to_string(each.line) + ":" + std::to_string(each.numbers) + " ";
  return text;
}

}  // namespace

TEST_CASE("One matrix is read out of every form, number by number") {
  for (const Form& form : kForms) {
    INFO(form.what << "\n" << filled(form.text));
    const PastedMatrices found = findMatrices(filled(form.text));
    INFO(numbered(found.passedOver));
    REQUIRE(found.matrices.size() == 1);
    const PastedMatrix& m = found.matrices.front();
    CHECK(valuesOf(m) == kExpected);
    CHECK(m.isInMemoryOrder == form.isInMemoryOrder);
    CHECK(m.isByColumns == form.isByColumns);
    if (form.name[0] != '\0') CHECK(m.name == form.name);
  }
}

TEST_CASE("Numbers are never reordered, added or guessed: a doubt refuses") {
  const char* const none[] = {
      "K = [[fx, 0, 320], [0, fy, 240], [0, 0, 1]]",                             // symbols
      "[1, 0, 0, -w/2]\n[0, 1, 0, 3]\n[0, 0, 1, 4]\n",                           // an expression
      "gluLookAt(1, 2, 3, 0, 0, 0, 0, 1, 0)",                                    // a call that makes one
      "m = [[1, 0, 0, 2],\n [0, 1, 0, 3],\n [0, 0, 1, 4],\n",                    // cut off
      "[1 0 0 2]   [1 0 0 5]\n[0 1 0 3] vs [0 1 0 6]\n[0 0 1 4]   [0 0 1 7]\n",  // words between two matrices
      "1 0 0 2 1 0 0 5\n0 1 0 3 0 1 0 6\n0 0 1 4 0 0 1 7\n",                     // no gap between two matrices
      "[[1 0 0 2]\n ...\n [0 1 0 3]\n [0 0 1 4]]",                               // a row left out
      "[[1 0 ... 0 2]\n [0 1 ... 0 3]\n [0 0 ... 1 4]]",                         // entries left out
      "{[0,0] = 1, [1,0] = 0, [2,0] = 0, [0,1] = 0, [1,1] = 1, [2,1] = 0, [0,2] = 0, [2,2] = 1, [3,2] = 0}",
      "Columns 1 through 3\n\n 1 0 0\n 0 1 0\n 0 0 1\n\n Column 4\n\n 2\n 3\n 4\n",
      "1 2 3 4\n5 6 7 8\n9 8 7 6\n5 4 3 2\n1 2 3 4\n",                     // five rows
      "v 1 2 3\nv 4 5 6\nv 7 8 9\nf 1 2 3\n",                              // a mesh
      "m[3]=1 m[4]=2 m[5]=3 m[6]=4 m[7]=5 m[8]=6 m[9]=7 m[10]=8 m[11]=9",  // not from the first index on
      "{M11:1 M12:0 M13:0 M14:} {M21:0 M22:1 M23:0 M24:2} {M31:0 M32:0 M33:1 M34:3} {M41:0 M42:0 M43:0 M44:1}",
      "1 2 3",
      "",
  };
  for (const char* text : none) {
    INFO(text);
    CHECK(findMatrices(text).matrices.empty());
  }
  const PastedMatrices rows = findMatrices("a\n1 2 3 4\n5 6 7 8\n9 8 7 6\n5 4 3 2\n1 2 3 4\n");
  REQUIRE(rows.passedOver.size() == 1);
  CHECK(rows.passedOver.front().line == 2);
  CHECK(rows.passedOver.front().why == "5 rows of 4 numbers are no matrix; put an empty line between two matrices");
  // What stands beside a matrix has its name, one letter too.
  for (const char* text : {"R = [1 0 0; 0 1 0; 0 0 1]\nt = [0.1; -0.2; 3]\n", "R = 1 0 0\n0 1 0\n0 0 1\nt = 1 2 3\n",
                           "{'R': [[1, 0, 0], [0, 1, 0], [0, 0, 1]], 't': [1, 2, 3]}"}) {
    INFO(text);
    const PastedMatrices both = findMatrices(text);
    CHECK(both.matrices.size() == 1);
    REQUIRE(both.passedOver.size() == 1);
    CHECK(both.passedOver.front().name == "t");
    CHECK(both.passedOver.front().numbers == 3);
  }
}

TEST_CASE("Several matrices of a text are told apart, each with its name and line") {
  const PastedMatrices two = findMatrices("R:\n1 0 0\n0 0 1\n0 -1 0\n\nt 3\nK (px):\n900 0 320\n0 900 240\n0 0 1\n");
  REQUIRE(two.matrices.size() == 2);
  CHECK(two.matrices[0].line == 2);
  CHECK(two.matrices[0].name == "R");
  CHECK(two.matrices[1].line == 8);
  // One index again, on another line, is the next matrix; twelve and nine of 25 numbers are a pose and a K.
  const std::string first = "m00 1 m01 0 m02 0 m10 0 m11 1 m12 0 m20 0 m21 0 m22 1\n";
  CHECK(findMatrices(first + first).matrices.size() == 2);
  const PastedMatrices label = findMatrices("[1,0,0,2,0,1,0,3,0,0,1,4,0,0,0,1,0.9,0,0.5,0,1.2,0.5,0,0,1]");
  REQUIRE(label.matrices.size() == 2);
  CHECK(label.matrices[0].rows == 4);
  CHECK(label.matrices[1].rows == 3);
  // Side by side, where each has brackets or a gap is between them.
  for (const char* text : {"[1 0 0 2]   [1 0 0 5]\n[0 1 0 3]   [0 1 0 6]\n[0 0 1 4]   [0 0 1 7]\n",
                           "1 0 0 2    1 0 0 5\n0 1 0 3    0 1 0 6\n0 0 1 4    0 0 1 7\n"}) {
    const PastedMatrices beside = findMatrices(text);
    REQUIRE(beside.matrices.size() == 2);
    CHECK(valuesOf(beside.matrices[0]) == std::vector<double>{1, 0, 0, 2, 0, 1, 0, 3, 0, 0, 1, 4});
    CHECK(valuesOf(beside.matrices[1]) == std::vector<double>{1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7});
  }
  CHECK(findMatrices("K = [1.2\\times10^{3} & 0 & 640 \\\\ 0 & 1.2\\times10^{3} & 360 \\\\ 0 & 0 & 1]")
            .matrices.front()
            .at(1, 1) == 1200);
  CHECK(findMatrices("P = 1.0e+03 *\n\n 0.9 0 0.3\n 0 0.9 0.2\n 0 0 0.001\n").matrices.front().at(0, 2) == 300);
  CHECK(findMatrices("1,25 0 0,5\n0 -1,123456 0\n0 0 1,5").matrices.front().at(1, 1) == -1.123456);
}

TEST_CASE("A name beside a matrix puts a kind first and takes none away") {
  struct Row {
    const char* name;
    ReadingKind kind;
  };
  using enum ReadingKind;
  const Row rows[] = {{"c2w", pose},
                      {"cam2world", pose},
                      {"T_wc", pose},
                      {"worldFromCamera", pose},
                      {"T_w_cam", pose},
                      {"pose", pose},
                      {"matrixWorld", pose},
                      {"w2c", view},
                      {"T_cw", view},
                      {"T_ci", view},
                      {"(gdb) p T_cam_world", view},
                      {"p T_cam_world", view},
                      {"my T_cam_world", view},
                      {"p wTcam", pose},
                      {"T_cam_imu", view},
                      {"extrinsic", view},
                      {"viewMatrix", view},
                      {"velo_to_cam", view},
                      {"cameraFromWorld", view},
                      {"World to Camera", view},
                      {"R", rotation},
                      {"rot_mtx", rotation},
                      {"viewProj", viewProjection},
                      {"u_MVP", viewProjection},
                      {"world_to_clip", viewProjection},
                      {"clipFromView", projection},
                      {"body_T_cam0", pose},
                      {"world_T_cam", pose},
                      {"wTc", pose},
                      {"T_BS", pose},
                      {"T_SC", pose},
                      {"sensor2ego", pose},
                      {"cam_to_velo", pose},
                      {"g_mViewInv", pose},
                      {"UNITY_MATRIX_I_V", pose},
                      {"extrinsic_inv", pose},
                      {"camera.matrixWorldInverse", view},
                      {"cam_T_world", view},
                      {"cTw", view},
                      {"lidar2cam", view},
                      {"World2View", view},
                      {"gl_ModelViewMatrix", view},
                      {"camera.projectionMatrixInverse", projectionInverse},
                      {"clip_to_view", projectionInverse},
                      {"inverse of the projection", projectionInverse},
                      {"invViewProj", viewProjectionInverse},
                      {"UNITY_MATRIX_I_VP", viewProjectionInverse}};
  for (const Row& row : rows) {
    INFO(row.name);
    const KindHint hint =
        hintOf(findMatrices(std::string(row.name) + ":\n1 0 0 2\n0 1 0 3\n0 0 1 4\n0 0 0 1\n").matrices.front());
    CHECK(hint.kind == row.kind);
    const auto readings =
        readingsOf(findMatrices(std::string(row.name) + ":\n0 0 1 2\n1 0 0 3\n0 1 0 4\n0 0 0 1\n").matrices.front())
            .readings;
    CHECK(readings.size() == 6);  // a view and a pose, each of three kinds of axes
    if (row.kind == pose || row.kind == view) CHECK(readings.front().kind == row.kind);
  }
  for (const char* name : {"pointOfView", "viewport", "points", "colour"}) {
    INFO(name);
    CHECK_FALSE(
        hintOf(findMatrices(std::string(name) + ":\n1 0 0 2\n0 1 0 3\n0 0 1 4\n0 0 0 1\n").matrices.front()).kind);
  }
}

TEST_CASE("A view's axes are those of the programs that have its name, or OpenCV's beside a K") {
  const auto axesOf = [](const std::string& name, bool isBesideK = false, const std::string& row = "0 0 1 2") {
    const auto found = findMatrices(name + " =\n" + row + "\n1 0 0 3\n0 1 0 4\n0 0 0 1\n");
    return readingsOf(found.matrices.front(), isBesideK).readings.front().camera->convention.view;
  };
  for (const char* name : {"Tcw", "T_WC", "body_T_cam0", "T_cam_imu", "extrinsic", "Tr_velo_to_cam"})
    CHECK(axesOf(name) == ViewAxes::RDF);
  for (const char* name : {"D3DXMATRIX view", "XMMATRIX view"}) CHECK(axesOf(name) == ViewAxes::RUF);
  for (const char* name : {"view", "c2w", "matrixWorld"}) CHECK(axesOf(name) == ViewAxes::RUB);
  for (const char* name : {"w2c", "full_proj_transform", "world_view_transform"}) CHECK(axesOf(name) == ViewAxes::RDF);
  CHECK(axesOf("pose", true, "0 0 1 -2") == ViewAxes::RDF);
  CHECK(axesOf("po frame.camera.transform\nsimd_float4x4 pose", true, "0 0 1 -2") == ViewAxes::RUB);
  // But for one that would then be upside down, with the origin behind it.
  CHECK(axesOf("pose", true) == ViewAxes::RUB);
  // Beside a projection they are the projection's.
  for (const auto& [projection, axes] : {std::pair("1 0 0 0\n0 1.5 0 0\n0 0 -1.002 -0.2002\n0 0 -1 0\n", ViewAxes::RUB),
                                         std::pair("1 0 0 0\n0 1.5 0 0\n0 0 0 10\n0 0 1 0\n", ViewAxes::RUF)}) {
    auto view = readingsOf(findMatrices("view =\n0 0 1 2\n1 0 0 3\n0 1 0 4\n0 0 0 1\n").matrices.front()).readings;
    const std::size_t count = view.size();
    orderBeside(view, readingsOf(findMatrices(projection).matrices.front()).readings);
    CHECK(view.front().camera->convention.view == axes);
    CHECK(view.size() == count);
  }
}

TEST_CASE("The likeliest reading is first") {
  const auto first = [](const char* text) {
    const PastedMatrices found = findMatrices(text);
    REQUIRE(found.matrices.size() == 1);
    const MatrixReadings all = readingsOf(found.matrices.front());
    INFO(all.fault);
    REQUIRE(!all.readings.empty());
    return all.readings.front();
  };
  // near 0.1 in the range of OpenGL and 0.2 in Direct3D's.
  const Reading gl = first("[1, 0, 0, 0]\n[0, 1.5, 0, 0]\n[0, 0, -1.002002, -0.2002002]\n[0, 0, -1, 0]");
  CHECK(gl.camera->convention.ndcZ == NdcZ::minusOneToOne);
  const Reading d3d = first("[1, 0, 0, 0]\n[0, 1.5, 0, 0]\n[0, 0, 1.001001, 1]\n[0, 0, -0.1001001, 0]");
  CHECK(d3d.camera->convention.ndcZ == NdcZ::zeroToOne);
  CHECK(d3d.layout == MatrixLayout::transposed);
  // The inverse of a projection, with a name or without one; not where the matrix itself is usual.
  for (const char* name : {"inverseProjection", "M"}) {
    const Reading inverse =
        first((name + std::string(" = [1.0264 0 0 0; 0 0.57735 0 0; 0 0 0 -1; 0 0 -4.995 5.005]")).c_str());
    REQUIRE(inverse.kind == ReadingKind::projectionInverse);
    CHECK(inverse.camera->lens->zNear.value == Approx(0.1));
    CHECK(inverse.camera->lens->zFar.value == Approx(100));
    CHECK(inverse.layout == MatrixLayout::asWritten);
  }
  CHECK(gl.kind == ReadingKind::projection);
  // Signs of a K are axes.
  const Reading k = first("[880, 0, -320; 0, -870, -240; 0, 0, -1]");
  CHECK(k.kind == ReadingKind::k);
  CHECK(k.pixels->axes == "RUB");
  CHECK(k.pixels->cx == 320);
  CHECK(k.pixels->fy == 870);
  // An eye is the null vector of P, whatever the skew.
  const Reading p = first("1000 5 320 -3210\n0 900 240 -2520\n0 0 1 -1\n");
  REQUIRE(p.kind == ReadingKind::p);
  CHECK(p.pixels->skew == Approx(5));
  const Vec3 eye = *p.eye;
  CHECK(1000 * eye.x + 5 * eye.y + 320 * eye.z == Approx(3210));
  CHECK(900 * eye.y + 240 * eye.z == Approx(2520));
  CHECK(eye.z == Approx(1));
  // Turned and scaled: an object's, and seldom an orthographic camera's.
  const Reading scaled = first("0 0 2 1\n2 0 0 2\n0 2 0 3\n0 0 0 1\n");
  CHECK(scaled.kind == ReadingKind::pose);
  CHECK(scaled.scaledBy == Approx(2));
  // A view with two decimals.
  CHECK(first("0.85 -0.11 0.52 1.25\n0.00 0.98 0.21 0.50\n-0.53 -0.18 0.83 2.00\n0.00 0.00 0.00 1.00\n").camera->pose);
  // CSS: rows x, y, w are a camera of 500 pixels.
  const Reading css = first("matrix3d(1, 0, 0, 0, 0, 0.8, 0.6, -0.0012, 0, -0.6, 0.8, -0.0016, 0, 0, 0, 1)");
  CHECK(css.kind == ReadingKind::p);
  CHECK(css.pixels->fx == Approx(500));
  // Wholly a preset, where another is one but for its world.
  const Reading vulkan = first(
      "0.89907 0 0.59938 0\n-0.28479 -1.8511 0.42718 1.8511\n0.53631 -0.26816 -0.80447 11.029\n"
      "0.53452 -0.26726 -0.80178 11.49223\n");
  CHECK(vulkan.camera->convention.ndcY == NdcY::down);
  CHECK(vulkan.camera->convention.world == Handedness::right);
  // 3D Gaussian Splatting has its matrices transposed, of views with y down.
  const Reading splats = first(
      "full_proj_transform\ntensor([[ 2.3555, -0.3053, -0.5185, -0.5185],\n[ 0.0000,  2.7174, -0.2074, -0.2074],\n"
      "[ 1.4722,  0.4885,  0.8296,  0.8296],\n[ 0.0000,  0.0000,  4.8123,  4.8218]])");
  CHECK(splats.layout == MatrixLayout::transposed);
  CHECK(splats.camera->convention.ndcY == NdcY::down);
  // What stands level is likelier: a place of tf with z up, not a view that has its horizon upright.
  const Reading tf = first("0.000 -0.259 0.966 0.105\n-1.000 0.000 0.000 0.012\n0.000 -0.966 -0.259 0.285\n0 0 0 1\n");
  CHECK(tf.kind == ReadingKind::pose);
  CHECK(tf.camera->convention.view == ViewAxes::RDF);
  // And what does not hang: Direct3D's left-handed world, not Vulkan's right-handed one upside down.
  const Reading upright = first(
      "0.6917591 0 0.9882273 0\n-0.1945365 2.131319 0.1361756 -3.196979\n-0.8150091 -0.1108412 0.5705063 15.03374\n"
      "-0.814194 -0.1107304 0.5699358 15.5187\n");
  CHECK(upright.camera->convention.world == Handedness::left);
  // An entry that was typed wrong is named.
  const auto fault = readingsOf(findMatrices("0.6 0 0.8 1\n0 1 0 2\n-0.8 0 2.6 3\n0 0 0 1\n").matrices.front()).fault;
  CHECK(fault == "row 3 has 2.6 where 0.6 would make it a rotation");
  // diag(1, 1, 0.5) is no view, and a sheared matrix no camera.
  for (const Reading& r : readingsOf(findMatrices("1 0 0 0\n0 1 0 0\n0 0 0.5 0\n0 0 0 1\n").matrices.front()).readings)
    CHECK(r.kind != ReadingKind::view);
  CHECK(readingsOf(findMatrices("matrix3d(1, 0.2, 0, 0, 0.3, 1, 0, 0, 0, 0, 1, 0, 5.125, 0, 0, 1)").matrices.front())
            .readings.empty());
}

TEST_CASE("No interval misses the truth, however many digits are printed") {
  constexpr const char* kForms3[] = {"%.*f", "%.*e", "%.*g"};
  int read = 0, readInverses = 0, sure = 0;
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    Random random(trial);
    Convention c;
    c.ndcZ = random.coin() ? NdcZ::zeroToOne : NdcZ::minusOneToOne;
    c.reverseZ = random.oneIn(4);
    const double near = random.oneIn(2) ? 0.1 : random.logUniform(0.01, 2);
    const double far = random.oneIn(4) ? kInfiniteFar : near * random.logUniform(10, 20000);
    const double half = random.uniform(0.2, 1.5), aspect = random.uniform(0.5, 2);
    const Projection lens = perspectiveWindow(-half * aspect, half * aspect, -half, half, near, far);
    const Pose pose = lookAlong(random.vector(10), random.direction(), {0.1, 1, 0.2}, Handedness::right);
    const bool isProjection = random.oneIn(3), isInverse = trial % 4 == 3;
    Mat4 m = isInverse      ? isProjection ? viewFromClip(lens, c) : worldFromClip(pose, lens, c)
                  : isProjection ? clipFromView(lens, c)
                            : clipFromWorld(pose, lens, c);
    const bool isFloat = random.coin();
    const char* const form = random.oneOf(kForms3);
    const int digits = 3 + static_cast<int>(random.below(7));
    std::string text;
    for (auto& row : m.m)
      for (std::size_t j = 0; j < 4; ++j) {
        char out[64];
        if (isFloat) row[j] = double{static_cast<float>(row[j])};
        std::snprintf(out, sizeof out, form, digits, row[j]);
        text += std::string(out) + (j < 3 ? " " : "\n");
      }
    INFO("trial " << trial << "\n" << text);
    const PastedMatrices found = findMatrices(text);
    REQUIRE(found.matrices.size() == 1);
    for (const Reading& r : readingsOf(found.matrices.front()).readings) {
      const bool isIt = r.layout == MatrixLayout::asWritten && r.camera && r.camera->lens &&
                        !r.camera->lens->orthographic && r.camera->lens->depthFault.empty() &&
                        isInverse == (r.kind > ReadingKind::rotation) && r.camera->convention.ndcZ == c.ndcZ &&
                        r.camera->convention.reverseZ == c.reverseZ;
      if (!isIt) continue;
      const MatrixLens& l = *r.camera->lens;
      ++(isInverse ? readInverses : read);
      sure += std::isfinite(l.zFar.high) ? 1 : 0;
      CHECK(l.zNear.low <= near * (1 + 1e-15));
      CHECK(near <= l.zNear.high * (1 + 1e-15));
      if (!l.beyondInfinity) CHECK(l.zFar.low <= far);
      CHECK(far <= l.zFar.high * (1 + 1e-15));
      const double fov = (std::atan(l.top) - std::atan(l.bottom)) * 180 / 3.14159265358979324;
      CHECK(std::fabs(fov - lens.fov(Fov::vertical)) <= l.fovError.y + 1e-13);
      if (!r.camera->pose) continue;
      const Vec3 eye = r.camera->pose->eye(), truth = pose.eye();
      for (std::size_t i = 0; i < 3; ++i) CHECK(std::fabs(eye[i] - truth[i]) <= r.camera->eyeError[i]);
    }
  }
  CHECK(read > 675);
  CHECK(readInverses > 100);
  CHECK(sure > 300);
}

TEST_CASE("No interval of a K, a P, an axis or an edge misses the truth") {
  constexpr const char* kForms3[] = {"%.*f", "%.*e", "%.*g"};
  using enum ReadingKind;
  constexpr ReadingKind kKinds[] = {k, p, pose, view, viewProjection, projection, rotation};
  std::array<int, std::size(kKinds)> read{};
  for (std::uint64_t trial = 0; trial < 1400; ++trial) {
    Random random(trial);
    const ReadingKind kind = kKinds[trial % std::size(kKinds)];
    const Vec3 eye = random.vector(10);
    const Pose at = lookAlong(eye, random.direction(), {0.1, 1, 0.2}, Handedness::right);
    const double fx = random.uniform(300, 3000), fy = fx * random.uniform(0.9, 1.1);
    const double cx = random.uniform(200, 900), cy = random.uniform(200, 900);
    const double left = random.uniform(-2, -0.3), right = random.uniform(0.3, 2), low = -0.7, high = 0.9;
    const Projection lens = perspectiveWindow(left, right, low, high, 0.1, 50);
    const Mat4 cv = viewFromWorld(at, conventions::opencv);
    Mat4 m = kind == pose             ? worldFromView(at, conventions::opencv)
             : kind == view           ? cv
             : kind == rotation       ? cv
             : kind == viewProjection ? clipFromWorld(at, lens, conventions::opengl)
             : kind == projection     ? clipFromView(lens, conventions::opengl)
                                      : Mat4{{{{fx, 0, cx, 0}, {0, fy, cy, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}};
    const Mat4 calibration = m;
    if (kind == p)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          m[i][j] = 0;
          for (std::size_t n = 0; n < 3; ++n) m[i][j] += calibration[i][n] * cv[n][j];
        }
    const bool isSmall = kind == k || kind == rotation;
    const std::size_t rows = isSmall || kind == p ? 3 : 4, columns = isSmall ? 3 : 4;
    const char* const form = random.oneOf(kForms3);
    const int digits = 3 + static_cast<int>(random.below(7));
    std::string text;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        char out[64];
        std::snprintf(out, sizeof out, form, digits, m[i][j]);
        text += std::string(out) + (j + 1 < columns ? " " : "\n");
      }
    if (text.find('.') == std::string::npos) continue;  // whole numbers are exact
    INFO("trial " << trial << "\n" << text);
    const PastedMatrices found = findMatrices(text);
    REQUIRE(found.matrices.size() == 1);
    const auto minus = [](const Vec3& v) { return Vec3{-v.x, -v.y, -v.z}; };
    const auto isWithin = [](double value, double truth, double error) {
      CHECK(std::fabs(value - truth) <= error + 1e-13 * std::fabs(truth));
    };
    for (const Reading& r : readingsOf(found.matrices.front()).readings) {
      if (r.kind != kind || r.layout == MatrixLayout::transposed) continue;
      if (r.camera && !fits(r,
                            kind == viewProjection || kind == projection ? conventions::opengl.convention
                                                                         : conventions::opencv.convention,
                            false))
        continue;
      ++read[trial % std::size(kKinds)];
      if (r.pixels) {
        const double values[] = {r.pixels->fx, r.pixels->fy, r.pixels->cx, r.pixels->cy}, truths[] = {fx, fy, cx, cy};
        for (std::size_t i = 0; i < 4; ++i) isWithin(values[i], truths[i], r.pixels->errors[i]);
      }
      const Vec3 truths[] = {at.right(), minus(at.up()), at.forward()};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          if (kind == p || kind == rotation) isWithin(r.rows[i][j], truths[i][j], r.axesError);
          if (!r.camera || !r.camera->pose) continue;
          const Pose& own = *r.camera->pose;
          isWithin((i == 0 ? own.right() : i == 1 ? minus(own.up()) : own.forward())[j], truths[i][j], r.axesError);
        }
      if (kind != projection) continue;
      isWithin(r.camera->lens->left, left, r.edgeError.x);
      isWithin(r.camera->lens->right, right, r.edgeError.x);
      isWithin(r.camera->lens->bottom, low, r.edgeError.y);
      isWithin(r.camera->lens->top, high, r.edgeError.y);
    }
  }
  for (const int count : read) CHECK(count > 150);
}

TEST_CASE("Another convention's matrix is that of the same camera, and entries that do not change are copied") {
  int compared = 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    Random random(trial);
    const Projection lens = perspectiveWindow(-0.7, 0.9, -0.5, 0.4, 0.1, random.coin() ? kInfiniteFar : 50);
    for (const ConventionPreset& from : conventionPresets())
      for (const ConventionPreset& preset : conventionPresets()) {
        Convention to = preset.convention;
        to.world = from.convention.world;
        const Pose pose = lookAlong(random.vector(10), random.direction(), {0.1, 1, 0.2}, from.convention.world);
        const auto matrices = [&](const Convention& c) {
          return std::array{clipFromView(lens, c), viewFromWorld(pose, c), clipFromWorld(pose, lens, c),
                            viewFromClip(lens, c), worldFromClip(pose, lens, c)};
        };
        const auto given = matrices(from.convention), wanted = matrices(to);
        constexpr ReadingKind kKinds[] = {ReadingKind::projection, ReadingKind::view, ReadingKind::viewProjection,
                                          ReadingKind::projectionInverse, ReadingKind::viewProjectionInverse};
        for (std::size_t k = 0; k < 5; ++k) {
          Reading reading;
          reading.kind = kKinds[k];
          reading.camera.emplace().convention = from.convention;
          reading.camera->kind = k % 3 == 0 ? MatrixKind::projection : MatrixKind::viewProjection;
          reading.camera->lens.emplace();
          const Mat4 got = converted(reading, given[k], to);
          for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
              const double size = k > 2 && j > 1 ? 8e-16 * (std::fabs(given[k][i][2]) + std::fabs(given[k][i][3]))
                                  : i == 2 && k != 1 && k < 3
                                      ? 4e-16 * (std::fabs(given[k][2][j]) + std::fabs(given[k][3][j]))
                                      : 0;
              CHECK(std::fabs(got[i][j] - wanted[k][i][j]) <= size);
              ++compared;
            }
        }
      }
  }
  CHECK(compared > 100000);
}
