#include "visibility/caster_map.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <string>

#include "core/error.h"

namespace tenku {
namespace {

constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in uint number;
flat out uint caster;
uniform vec4 row[3];
void main() {
  vec4 p = vec4(position, 1.0);
  caster = number;
  gl_Position = vec4(dot(row[0], p), dot(row[1], p), dot(row[2], p), 1.0);
})";

constexpr const char* kFragmentShader = R"(#version 330 core
flat in uint caster;
out uint nearest;
void main() { nearest = caster; })";

}  // namespace

/// The OpenGL functions in use and the objects made with them.
struct CasterMap::Gl {
  explicit Gl(const GlContext& context) : context_(context) {}

 private:
  // First in the class: the members below are initialised from it.
  const GlContext& context_;

  /// Becomes a function of the type that is asked for.
  struct Address {
    GlContext::Entry entry;
    template <class Function>
    operator Function*() const {
      return reinterpret_cast<Function*>(entry);
    }
  };
  Address load(const char* name) const { return {context_.entry(name)}; }

 public:
  decltype(&::glAttachShader) AttachShader = load("glAttachShader");
  decltype(&::glBindBuffer) BindBuffer = load("glBindBuffer");
  decltype(&::glBindFramebuffer) BindFramebuffer = load("glBindFramebuffer");
  decltype(&::glBindRenderbuffer) BindRenderbuffer = load("glBindRenderbuffer");
  decltype(&::glBindVertexArray) BindVertexArray = load("glBindVertexArray");
  decltype(&::glBufferData) BufferData = load("glBufferData");
  decltype(&::glCheckFramebufferStatus) CheckFramebufferStatus = load("glCheckFramebufferStatus");
  decltype(&::glClearBufferfv) ClearBufferfv = load("glClearBufferfv");
  decltype(&::glClearBufferuiv) ClearBufferuiv = load("glClearBufferuiv");
  decltype(&::glCompileShader) CompileShader = load("glCompileShader");
  decltype(&::glCreateProgram) CreateProgram = load("glCreateProgram");
  decltype(&::glCreateShader) CreateShader = load("glCreateShader");
  decltype(&::glDeleteShader) DeleteShader = load("glDeleteShader");
  decltype(&::glEnable) Enable = load("glEnable");
  decltype(&::glEnableVertexAttribArray) EnableVertexAttribArray =
      load("glEnableVertexAttribArray");
  decltype(&::glFramebufferRenderbuffer) FramebufferRenderbuffer =
      load("glFramebufferRenderbuffer");
  decltype(&::glGenBuffers) GenBuffers = load("glGenBuffers");
  decltype(&::glGenFramebuffers) GenFramebuffers = load("glGenFramebuffers");
  decltype(&::glGenRenderbuffers) GenRenderbuffers = load("glGenRenderbuffers");
  decltype(&::glGenVertexArrays) GenVertexArrays = load("glGenVertexArrays");
  decltype(&::glGetError) GetError = load("glGetError");
  decltype(&::glGetProgramiv) GetProgramiv = load("glGetProgramiv");
  decltype(&::glGetUniformLocation) GetUniformLocation = load("glGetUniformLocation");
  decltype(&::glLinkProgram) LinkProgram = load("glLinkProgram");
  decltype(&::glMultiDrawArrays) MultiDrawArrays = load("glMultiDrawArrays");
  decltype(&::glReadPixels) ReadPixels = load("glReadPixels");
  decltype(&::glRenderbufferStorage) RenderbufferStorage = load("glRenderbufferStorage");
  decltype(&::glShaderSource) ShaderSource = load("glShaderSource");
  decltype(&::glUniform4fv) Uniform4fv = load("glUniform4fv");
  decltype(&::glUseProgram) UseProgram = load("glUseProgram");
  decltype(&::glVertexAttribIPointer) VertexAttribIPointer = load("glVertexAttribIPointer");
  decltype(&::glVertexAttribPointer) VertexAttribPointer = load("glVertexAttribPointer");
  decltype(&::glViewport) Viewport = load("glViewport");

  GLuint buffer = 0;
  GLuint texels = 0, depth = 0;  // renderbuffers
  GLint row = -1;
  int width = 0, height = 0;

  void check(const char* what) const {
    if (const GLenum error = GetError(); error != GL_NO_ERROR) {
      throw ResourceError(std::string("OpenGL fails to ") + what + ": error " +
                          std::to_string(error));
    }
  }

  void add_shader(GLuint program, GLenum kind, const char* text) const {
    const GLuint shader = CreateShader(kind);
    ShaderSource(shader, 1, &text, nullptr);
    CompileShader(shader);
    AttachShader(program, shader);
    DeleteShader(shader);
  }

  void make_program() {
    const GLuint program = CreateProgram();
    add_shader(program, GL_VERTEX_SHADER, kVertexShader);
    add_shader(program, GL_FRAGMENT_SHADER, kFragmentShader);
    LinkProgram(program);
    GLint linked = GL_FALSE;
    GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) throw ResourceError("OpenGL refuses the program of the shadow maps");
    UseProgram(program);
    row = GetUniformLocation(program, "row");
  }

  void make_buffers() {
    GLuint vertices = 0, frame = 0;
    GenVertexArrays(1, &vertices);
    BindVertexArray(vertices);
    GenBuffers(1, &buffer);
    BindBuffer(GL_ARRAY_BUFFER, buffer);
    constexpr GLsizei kStride = sizeof(CasterVertex);
    VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, nullptr);
    VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, kStride,
                         reinterpret_cast<const void*>(offsetof(CasterVertex, id)));
    EnableVertexAttribArray(0);
    EnableVertexAttribArray(1);
    GenFramebuffers(1, &frame);
    BindFramebuffer(GL_FRAMEBUFFER, frame);
    GenRenderbuffers(1, &texels);
    GenRenderbuffers(1, &depth);
  }
};

// The objects of a context go with it; they need no release of their own.
CasterMap::CasterMap(GlPlatform platform, const GlLibraries& libraries)
    : context_(platform, libraries) {
  const GlContext::Current current(context_);
  gl_ = std::make_unique<Gl>(context_);
  gl_->make_program();
  gl_->make_buffers();
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Enable(GL_DEPTH_CLAMP);
  gl_->check("set up");
}

CasterMap::~CasterMap() = default;

void CasterMap::upload(std::span<const CasterVertex> vertices) {
  const GlContext::Current current(context_);
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
                  GL_STATIC_DRAW);
  gl_->check("take the triangles");
}

void CasterMap::resize(int width, int height) {
  if (gl_->width == width && gl_->height == height) return;
  const auto attach = [&](GLuint buffer, GLenum format, GLenum place) {
    gl_->BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl_->RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer);
  };
  attach(gl_->texels, GL_R32UI, GL_COLOR_ATTACHMENT0);
  attach(gl_->depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
  if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw ResourceError("OpenGL has no map of " + std::to_string(width) + " x " +
                        std::to_string(height) + " texels");
  }
  gl_->Viewport(0, 0, width, height);
  gl_->width = width;
  gl_->height = height;
}

void CasterMap::draw(const MapFrame& frame, std::span<const CasterRange> casters,
                     std::vector<std::uint32_t>& id) {
  const GlContext::Current current(context_);
  resize(frame.width, frame.height);
  gl_->Uniform4fv(gl_->row, 3, frame.row[0].data());
  constexpr std::array<GLuint, 4> kClear{kNothing, 0, 0, 0};
  constexpr GLfloat kFar = 1.0F;
  gl_->ClearBufferuiv(GL_COLOR, 0, kClear.data());
  gl_->ClearBufferfv(GL_DEPTH, 0, &kFar);
  std::vector<GLint> first;
  std::vector<GLsizei> count;
  for (const CasterRange& range : casters) {
    first.push_back(static_cast<GLint>(3 * range.first));
    count.push_back(static_cast<GLsizei>(3 * range.count));
  }
  gl_->MultiDrawArrays(GL_TRIANGLES, first.data(), count.data(),
                       static_cast<GLsizei>(first.size()));
  id.resize(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
  gl_->ReadPixels(0, 0, frame.width, frame.height, GL_RED_INTEGER, GL_UNSIGNED_INT, id.data());
  gl_->check("draw a shadow map");
}

}  // namespace tenku
