// OpenGL 4.5 core without a window: EGL's surfaceless platform, Mesa's software rasteriser.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <cstdlib>
#include <stdexcept>

#include "rasteriser.hpp"
#include "shader_text.hpp"

namespace rasterisers {
namespace {

struct Context {
  std::string trouble = start();

  static std::string start() {
    // A graphics card's driver need not follow IEEE 754, on which the bounds rest.
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    const auto getDisplay =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!getDisplay) return "EGL has no platforms";
    const EGLDisplay display = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return "EGL has no surfaceless display";
    if (!eglBindAPI(EGL_OPENGL_API)) return "EGL has no OpenGL";
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
      return "EGL gives no context of OpenGL 4.5";
    return "";
  }
};

const Context& context() {
  static const Context made;
  return made;
}

GLuint compile(GLenum stage, const std::string& text, const std::string& defines) {
  const GLuint shader = glCreateShader(stage);
  const std::size_t versionEnd = text.find('\n') + 1;
  const std::string whole = text.substr(0, versionEnd) + defines + text.substr(versionEnd);
  const char* source = whole.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    char log[2000] = "";
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw std::runtime_error(log);
  }
  return shader;
}

GLuint program(bool rowVectors, bool rowMajor) {
  static GLuint made[2][2] = {};
  GLuint& p = made[rowVectors][rowMajor];
  if (p) return p;
  const std::string defines = std::string("#define STORAGE ") + (rowMajor ? "row_major\n" : "column_major\n") +
                              (rowVectors ? "#define ROW_VECTORS\n" : "");
  p = glCreateProgram();
  glAttachShader(p, compile(GL_VERTEX_SHADER, kVertexShader, defines));
  glAttachShader(p, compile(GL_FRAGMENT_SHADER, kFragmentShader, ""));
  glLinkProgram(p);
  GLint good = 0;
  glGetProgramiv(p, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error("the shaders do not link");
  return p;
}

GLenum internalFormat(DepthFormat format) {
  if (format == DepthFormat::f32) return GL_DEPTH_COMPONENT32F;
  return format == DepthFormat::d24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT16;
}

/// Depths in the buffer's own numbers.
std::vector<double> readDepths(const Draw& draw) {
  const std::size_t count = static_cast<std::size_t>(draw.width) * static_cast<std::size_t>(draw.height);
  std::vector<double> depths(count);
  if (draw.format == DepthFormat::f32) {
    std::vector<GLfloat> raw(count);
    glReadPixels(0, 0, draw.width, draw.height, GL_DEPTH_COMPONENT, GL_FLOAT, raw.data());
    for (std::size_t i = 0; i < count; ++i) depths[i] = static_cast<double>(raw[i]);
  } else if (draw.format == DepthFormat::d24) {
    // 24 bits come as the upper ones of 32.
    std::vector<GLuint> raw(count);
    glReadPixels(0, 0, draw.width, draw.height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, raw.data());
    for (std::size_t i = 0; i < count; ++i) depths[i] = (raw[i] >> 8) / 16777215.0;
  } else {
    std::vector<GLushort> raw(count);
    glReadPixels(0, 0, draw.width, draw.height, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, raw.data());
    for (std::size_t i = 0; i < count; ++i) depths[i] = raw[i] / 65535.0;
  }
  return depths;
}

}  // namespace

std::string driver() {
  context();
  const auto text = [&](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  return "OpenGL " + text(GL_VERSION) + ", " + text(GL_RENDERER);
}

std::string unavailable() { return context().trouble; }

Picture render(const Draw& draw) {
  GLuint textures[2], framebuffer, vertexArray, buffers[2];
  glGenTextures(2, textures);
  glBindTexture(GL_TEXTURE_2D, textures[0]);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32UI, draw.width, draw.height);
  glBindTexture(GL_TEXTURE_2D, textures[1]);
  glTexStorage2D(GL_TEXTURE_2D, 1, internalFormat(draw.format), draw.width, draw.height);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[0], 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, textures[1], 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL has no such framebuffer");

  glGenVertexArrays(1, &vertexArray);
  glBindVertexArray(vertexArray);
  glGenBuffers(2, buffers);
  glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(draw.points.size() * sizeof(Vertex)), draw.points.data(),
               GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  glEnableVertexAttribArray(0);
  const Matrix matrices[] = {draw.view, draw.projection};
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffers[1]);
  glBufferData(GL_UNIFORM_BUFFER, sizeof matrices, matrices, GL_STATIC_DRAW);

  const GLuint nothing[4] = {};
  const GLfloat clearDepth = 0;
  glClearBufferuiv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_DEPTH, 0, &clearDepth);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glClipControl(draw.mirrored ? GL_UPPER_LEFT : GL_LOWER_LEFT,
                draw.zeroToOne ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  glViewportIndexedf(0, static_cast<float>(draw.x), static_cast<float>(draw.y), static_cast<float>(draw.viewportWidth),
                     static_cast<float>(draw.viewportHeight));
  glDepthRange(draw.depthRange[0], draw.depthRange[1]);
  glUseProgram(program(draw.rowVectors, draw.rowMajor));
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(draw.points.size()));

  Picture picture;
  picture.ids.resize(static_cast<std::size_t>(draw.width) * static_cast<std::size_t>(draw.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, draw.width, draw.height, GL_RED_INTEGER, GL_UNSIGNED_INT, picture.ids.data());
  picture.depths = readDepths(draw);
  glDeleteFramebuffers(1, &framebuffer);
  glDeleteTextures(2, textures);
  glDeleteVertexArrays(1, &vertexArray);
  glDeleteBuffers(2, buffers);
  if (const GLenum error = glGetError()) throw std::runtime_error("OpenGL's error " + std::to_string(error));
  return picture;
}

}  // namespace rasterisers
