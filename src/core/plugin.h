/// Parts of the program that are loaded only when they are first used.
#pragma once

#include <string_view>

namespace tenku {

/// What a plug-in offers, behind an interface that derives from this class.
///
/// A plug-in is a library `<name>-<version>.so` that defines `tenku_plugin`. It uses headers of
/// ours and no compiled code, so that nothing exists twice; it may throw InputError and
/// ResourceError, which arrive as such. Made with `tenku_plugin` of cmake/tenku_module.cmake.
class Plugin {
 public:
  virtual ~Plugin() = default;
};

/// Loads the plug-in `name` from the first of these folders that has it: that of the environment
/// variable TENKU_PLUGINS, that of the program, `../lib/tenku` beside it, that of the build.
///
/// @return the same object at every call, valid until the program ends
/// @throws ResourceError  if no folder has the library or it cannot be loaded, saying why
const Plugin& load_plugin(std::string_view name);

}  // namespace tenku

/// The object that a plug-in offers; defined once in each.
extern "C" const tenku::Plugin* tenku_plugin();
