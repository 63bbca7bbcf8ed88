#include "visibility/gl_context.h"

#define EGL_NO_X11  // no window, no X headers
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <mutex>
#include <string_view>

#include "core/error.h"

namespace tenku {

class GlContext::Backend {
 public:
  virtual ~Backend() = default;
  virtual GlPlatform platform() const = 0;
  virtual bool make_current() = 0;
  virtual void release() = 0;
  virtual Entry entry(const char* name) const = 0;

  std::string string(unsigned name) const {
    const auto get = reinterpret_cast<decltype(&glGetString)>(entry("glGetString"));
    const GLubyte* text = get == nullptr ? nullptr : get(name);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
  }
};

namespace {

using Backend = GlContext::Backend;

/// A library opened at run time. It stays open: drivers leave code behind that runs at the end of
/// threads and of the program.
class Library {
 public:
  explicit Library(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (handle_ != nullptr) return;
    }
    throw ResourceError("cannot open " + (names.empty() ? "a library without a name" : names[0]));
  }

  template <class Function>
  Function* function(const char* name) const {
    auto* address = reinterpret_cast<Function*>(dlsym(handle_, name));
    if (address == nullptr) throw ResourceError(std::string("the library lacks ") + name);
    return address;
  }

 private:
  void* handle_ = nullptr;
};

class OsMesaBackend : public Backend {
 public:
  explicit OsMesaBackend(const std::vector<std::string>& names)
      : library_(names),
        make_current_(library_.function<decltype(OSMesaMakeCurrent)>("OSMesaMakeCurrent")),
        destroy_(library_.function<decltype(OSMesaDestroyContext)>("OSMesaDestroyContext")),
        entry_(library_.function<decltype(OSMesaGetProcAddress)>("OSMesaGetProcAddress")) {
    constexpr std::array<int, 11> kAttributes{OSMESA_FORMAT,
                                              OSMESA_RGBA,
                                              OSMESA_PROFILE,
                                              OSMESA_CORE_PROFILE,
                                              OSMESA_CONTEXT_MAJOR_VERSION,
                                              3,
                                              OSMESA_CONTEXT_MINOR_VERSION,
                                              3,
                                              0,
                                              0,
                                              0};
    const auto create =
        library_.function<decltype(OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    context_ = create(kAttributes.data(), nullptr);
    if (context_ == nullptr) throw ResourceError("OSMesa gives no OpenGL 3.3 context");
  }
  ~OsMesaBackend() override { destroy_(context_); }
  OsMesaBackend(const OsMesaBackend&) = delete;
  OsMesaBackend& operator=(const OsMesaBackend&) = delete;

  GlPlatform platform() const override { return GlPlatform::OsMesa; }
  bool make_current() override {
    return make_current_(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_TRUE;
  }
  void release() override { make_current_(nullptr, nullptr, 0, 0, 0); }
  GlContext::Entry entry(const char* name) const override { return entry_(name); }

 private:
  static constexpr int kSide = 8;

  Library library_;
  decltype(&OSMesaMakeCurrent) make_current_;
  decltype(&OSMesaDestroyContext) destroy_;
  decltype(&OSMesaGetProcAddress) entry_;
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * kSide * kSide> window_{};  // OSMesa asks for one; nothing is drawn
};

/// The functions of EGL.
struct Egl {
  Library library;
  PFNEGLGETPROCADDRESSPROC get_proc_address;

  explicit Egl(const std::vector<std::string>& names)
      : library(names),
        get_proc_address(library.function<decltype(eglGetProcAddress)>("eglGetProcAddress")) {}

  template <class Function>
  Function function(const char* name) const {
    const auto address = reinterpret_cast<Function>(get_proc_address(name));
    if (address == nullptr) throw ResourceError(std::string("EGL lacks ") + name);
    return address;
  }
  template <class Function>
  Function* core(const char* name) const {
    return library.function<Function>(name);
  }

  /// Displays without a window: one a device, and with `software` also Mesa's own.
  std::vector<EGLDisplay> displays(bool software) const {
    const auto query = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto text = function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    const auto open = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query(devices.size(), devices.data(), &count) != EGL_TRUE) count = 0;
    std::vector<EGLDisplay> found;
    for (EGLint i = 0; i < count; ++i) {
      const char* traits = text(devices[static_cast<std::size_t>(i)], EGL_EXTENSIONS);
      const bool is_software =
          traits != nullptr &&
          std::string_view(traits).find("EGL_MESA_device_software") != std::string_view::npos;
      if (is_software && !software) continue;
      found.push_back(open(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    }
    if (software)
      found.push_back(open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return found;
  }
};

/// The display is shared by all contexts of the process, so it is never closed.
class EglBackend : public Backend {
 public:
  EglBackend(const Egl& egl, EGLDisplay display)
      : egl_(egl),
        display_(display),
        bind_api_(egl.core<decltype(eglBindAPI)>("eglBindAPI")),
        make_current_(egl.core<decltype(eglMakeCurrent)>("eglMakeCurrent")),
        destroy_(egl.core<decltype(eglDestroyContext)>("eglDestroyContext")) {
    const auto initialize = egl.core<decltype(eglInitialize)>("eglInitialize");
    const auto choose = egl.core<decltype(eglChooseConfig)>("eglChooseConfig");
    const auto create = egl.core<decltype(eglCreateContext)>("eglCreateContext");
    constexpr std::array<EGLint, 5> kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array<EGLint, 7> kContext{EGL_CONTEXT_MAJOR_VERSION,
                                             3,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (display == EGL_NO_DISPLAY || initialize(display, nullptr, nullptr) != EGL_TRUE ||
        bind_api_(EGL_OPENGL_API) != EGL_TRUE ||
        choose(display, kConfig.data(), &config, 1, &count) != EGL_TRUE || count < 1) {
      throw ResourceError("EGL has no display for OpenGL");
    }
    context_ = create(display, config, EGL_NO_CONTEXT, kContext.data());
    if (context_ == EGL_NO_CONTEXT) throw ResourceError("EGL gives no OpenGL 3.3 context");
  }
  ~EglBackend() override { destroy_(display_, context_); }
  EglBackend(const EglBackend&) = delete;
  EglBackend& operator=(const EglBackend&) = delete;

  GlPlatform platform() const override { return GlPlatform::Egl; }
  bool make_current() override {
    return bind_api_(EGL_OPENGL_API) == EGL_TRUE &&
           make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }
  void release() override {
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  GlContext::Entry entry(const char* name) const override { return egl_.get_proc_address(name); }

 private:
  Egl egl_;
  EGLDisplay display_;
  decltype(&eglBindAPI) bind_api_;
  decltype(&eglMakeCurrent) make_current_;
  decltype(&eglDestroyContext) destroy_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::string renderer_of(Backend& backend) {
  if (!backend.make_current()) throw ResourceError("the context cannot be made current");
  const std::string version = backend.string(GL_VERSION), renderer = backend.string(GL_RENDERER);
  backend.release();
  // Two OpenGL libraries in one process can give a context that draws nothing.
  if (version.empty()) throw ResourceError("the context does not tell its OpenGL version");
  return version + ", " + renderer;
}

std::unique_ptr<Backend> open_egl(const GlLibraries& libraries, bool software) {
  const Egl egl(libraries.egl);
  std::string why = "EGL finds no graphics device";
  for (EGLDisplay display : egl.displays(software)) {
    try {
      auto backend = std::make_unique<EglBackend>(egl, display);
      if (software || renderer_of(*backend).find("llvmpipe") == std::string::npos) return backend;
      why = "EGL offers a software renderer only";
    } catch (const ResourceError& error) {
      why = error.what();
    }
  }
  throw ResourceError(why);
}

std::unique_ptr<Backend> open_backend(GlPlatform platform, const GlLibraries& libraries) {
  if (platform == GlPlatform::Egl) return open_egl(libraries, true);
  if (platform == GlPlatform::OsMesa) return std::make_unique<OsMesaBackend>(libraries.osmesa);
  std::string why;
  try {
    return open_egl(libraries, false);
  } catch (const ResourceError& error) {
    why = error.what();
  }
  try {
    return std::make_unique<OsMesaBackend>(libraries.osmesa);
  } catch (const ResourceError& error) {
    throw ResourceError("there is no OpenGL: " + why + "; " + error.what());
  }
}

/// Drivers set themselves up when the first context is made, and not all of them lock.
std::mutex& opening() {
  static std::mutex one;
  return one;
}

}  // namespace

GlPlatform gl_platform_named(std::string_view name) {
  if (name == "auto") return GlPlatform::Auto;
  if (name == "osmesa") return GlPlatform::OsMesa;
  if (name == "egl") return GlPlatform::Egl;
  throw InputError("there is no OpenGL platform '" + std::string(name) +
                   "'; there are auto, osmesa and egl");
}

GlContext::GlContext(GlPlatform platform, const GlLibraries& libraries) {
  const std::lock_guard<std::mutex> lock(opening());
  backend_ = open_backend(platform, libraries);
  const bool is_egl = backend_->platform() == GlPlatform::Egl;
  description_ = (is_egl ? "EGL, OpenGL " : "OSMesa, OpenGL ") + renderer_of(*backend_);
}

GlContext::~GlContext() {
  const std::lock_guard<std::mutex> lock(opening());
  backend_.reset();
}

GlContext::Current::Current(GlContext& context) : context_(context) {
  if (!context.backend_->make_current()) {
    throw ResourceError("the OpenGL context cannot be made current");
  }
}

GlContext::Current::~Current() { context_.backend_->release(); }

GlContext::Entry GlContext::entry(const char* name) const {
  const Entry found = backend_->entry(name);
  if (found == nullptr) throw ResourceError(std::string("OpenGL lacks ") + name);
  return found;
}

GlPlatform GlContext::platform() const { return backend_->platform(); }

}  // namespace tenku
