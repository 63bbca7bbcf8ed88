/// Off-screen OpenGL: a context on the graphics card where there is one, else in software.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tenku {

/// Who draws: `--gl auto|osmesa|egl`.
enum class GlPlatform { Auto, OsMesa, Egl };

/// @throws InputError for a name that is not `auto`, `osmesa` or `egl`
GlPlatform gl_platform_named(std::string_view name);

/// Names under which the libraries are looked for at run time, the first one found wins.
struct GlLibraries {
  std::vector<std::string> osmesa{"libOSMesa.so.8", "libOSMesa.so.6"};
  std::vector<std::string> egl{"libEGL.so.1"};
};

/// An OpenGL 3.3 core context without a window.
///
/// `Auto` takes EGL when it offers a device that is no software renderer, else OSMesa; `Egl` also
/// takes a software renderer. Neither library is linked: both are opened at run time, and every
/// entry point comes from the library that made the context.
///
/// Threads  one thread at a time, the one that holds a `Current`; different contexts may be current
///          on different threads.
class GlContext {
 public:
  /// @throws ResourceError if the platform, or with `Auto` both, cannot give a context; the message
  ///                       says why
  explicit GlContext(GlPlatform platform, const GlLibraries& libraries = {});
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Makes the context the calling thread's own while it lives.
  class Current {
   public:
    /// @throws ResourceError if the driver refuses
    explicit Current(GlContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    GlContext& context_;
  };

  /// Address of an OpenGL function. Cast it to the function's own type.
  /// @throws ResourceError if the driver lacks it
  using Entry = void (*)();
  Entry entry(const char* name) const;

  /// `OsMesa` or `Egl`.
  GlPlatform platform() const;
  /// Platform, version and renderer as the driver names them.
  const std::string& description() const { return description_; }

  /// What a platform has to offer.
  class Backend;

 private:
  std::unique_ptr<Backend> backend_;
  std::string description_;
};

}  // namespace tenku
