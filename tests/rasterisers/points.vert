#version 450
// A point by the matrices as the tool printed them; STORAGE and ROW_VECTORS say in which convention.
layout(binding = 0, std140, STORAGE) uniform Matrices {
  mat4 view;
  mat4 projection;
};

layout(location = 0) in vec3 position;
layout(location = 0) flat out uint id;

void main() {
  id = uint(gl_VertexID) + 1u;
  vec4 point = vec4(position, 1.0);
#ifdef ROW_VECTORS
  gl_Position = point * view * projection;
#else
  gl_Position = projection * (view * point);
#endif
  gl_PointSize = 1.0;
}
