// SPDX-License-Identifier: Apache-2.0
#include "tools/benchmarks/peers/gl_splatter.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>

#include <stdexcept>
#include <vector>

#include "golden/splat/projection.hpp"
#include "scene/splats.hpp"

namespace fastsplat::bench {
namespace {

constexpr int kTexels = 128;

/// Per-quad input of GL.
struct Quad {
  float x, y, reach;  ///< pixels
  float colour[4] = {};
};

constexpr const char* kVertex = R"(#version 320 es
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 colour_in;
uniform vec2 size;
out vec2 texel;
flat out vec4 colour;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  texel = corner * 0.5 + 0.5;
  colour = colour_in;
  // Centres of pixels are at integers here, and at halves there.
  gl_Position = vec4((place.xy + 0.5 + corner * place.z) / size * 2.0 - 1.0, 0.0, 1.0);
}
)";

constexpr const char* kFragment = R"(#version 320 es
precision highp float;
uniform highp sampler2D footprint;
in vec2 texel;
flat in vec4 colour;
out vec4 result;
void main() { result = colour * texture(footprint, texel).r; }
)";

void require(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("OpenGL: ") + what);
}

GLuint compiled(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  require(good != 0, "a shader was refused");
  return shader;
}

std::vector<Quad> quads_of(const scene::Scene& scene) {
  std::vector<Quad> quads;
  const golden::Projector project(scene);
  scene::for_each_splat(scene, [&](const scene::Splat& splat) {
    const golden::ProjectedSplat seen = project(splat);
    Quad quad{
        .x = static_cast<float>(seen.x), .y = static_cast<float>(seen.y), .reach = static_cast<float>(seen.reach_x)};
    for (std::size_t c = 0; c < 4; ++c) quad.colour[c] = static_cast<float>(scene.xray_scale * seen.value[c]);
    quads.push_back(quad);
  });
  return quads;
}

/// The footprint on its square, 0 outside its disc.
std::vector<float> footprint_of(const scene::Kernel& kernel) {
  std::vector<float> texels;
  for (int j = 0; j < kTexels; ++j) {
    for (int i = 0; i < kTexels; ++i) {
      const double x = ((i + 0.5) / kTexels * 2.0 - 1.0) * kernel.radius();
      const double y = ((j + 0.5) / kTexels * 2.0 - 1.0) * kernel.radius();
      texels.push_back(static_cast<float>(kernel.footprint(x * x + y * y)));
    }
  }
  return texels;
}

}  // namespace

struct GlSplatter::Context {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  int width = 0, height = 0;
  std::size_t quads = 0;

  Context() {
    display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE, "no display");
    eglBindAPI(EGL_OPENGL_ES_API);
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2, EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    require(context != EGL_NO_CONTEXT, "no context");
    make_current();
  }
  void make_current() const {
    require(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE, "the context is of no use");
  }
  ~Context() {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    // The display is shared by all contexts and stays open.
    eglDestroyContext(display, context);
  }
};

GlSplatter::GlSplatter(const scene::Scene& scene, Sums sums) : context_(std::make_unique<Context>()) {
  Context& c = *context_;
  c.width = scene.camera.width();
  c.height = scene.camera.height();

  GLuint picture = 0, target = 0, texture = 0, buffer = 0;
  glGenTextures(1, &picture);
  glBindTexture(GL_TEXTURE_2D, picture);
  glTexStorage2D(GL_TEXTURE_2D, 1, sums == Sums::Half ? GL_RGBA16F : GL_RGBA32F, c.width, c.height);
  glGenFramebuffers(1, &target);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
  require(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "no pictures of floats");
  glViewport(0, 0, c.width, c.height);

  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  const std::vector<float> texels = footprint_of(scene.kernel);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R16F, kTexels, kTexels, 0, GL_RED, GL_FLOAT, texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, kVertex));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, kFragment));
  glLinkProgram(program);
  glUseProgram(program);
  glUniform2f(glGetUniformLocation(program, "size"), static_cast<float>(c.width), static_cast<float>(c.height));

  const std::vector<Quad> quads = quads_of(scene);
  c.quads = quads.size();
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(quads.size() * sizeof(Quad)), quads.data(), GL_STATIC_DRAW);
  const auto attribute = [](GLuint number, int words, std::size_t offset) {
    glEnableVertexAttribArray(number);
    glVertexAttribPointer(number, words, GL_FLOAT, GL_FALSE, sizeof(Quad), reinterpret_cast<const void*>(offset));
    glVertexAttribDivisor(number, 1);
  };
  attribute(0, 3, offsetof(Quad, x));
  attribute(1, 4, offsetof(Quad, colour));
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  require(glGetError() == GL_NO_ERROR, "it is not set up");
}

GlSplatter::~GlSplatter() = default;

void GlSplatter::draw() {
  context_->make_current();
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(context_->quads));
  glFinish();  // llvmpipe draws here
}

Image GlSplatter::picture() const {
  context_->make_current();
  // The picture's first row is at the bottom, where glReadPixels begins.
  Image out(context_->width, context_->height);
  glReadPixels(0, 0, out.width, out.height, GL_RGBA, GL_FLOAT, out.data.data());
  require(glGetError() == GL_NO_ERROR, "the picture cannot be read");
  return out;
}

std::string GlSplatter::renderer() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }
std::size_t GlSplatter::quads() const { return context_->quads; }

}  // namespace fastsplat::bench
