#include "core/plugin.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"

namespace tenku {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  const char* chosen = std::getenv("TENKU_PLUGINS");
  if (chosen != nullptr && *chosen != '\0') folders.emplace_back(chosen);
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    folders.push_back(program.parent_path());
    folders.push_back(program.parent_path().parent_path() / "lib/tenku");
  }
  folders.emplace_back(TENKU_PLUGIN_FOLDER);  // test programs stand elsewhere
  return folders;
}

fs::path plugin_path(std::string_view name) {
  const std::string file = std::string(name) + "-" TENKU_VERSION ".so";
  std::string searched;
  for (const fs::path& folder : plugin_folders()) {
    std::error_code ignored;
    if (fs::exists(folder / file, ignored)) return folder / file;
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  throw ResourceError("cannot load " + file + ", a part of tenku: it is in none of " + searched +
                      "; TENKU_PLUGINS may name its folder");
}

[[noreturn]] void fail(const fs::path& path) {
  const char* reason = dlerror();
  throw ResourceError("cannot load " + path.string() +
                      ", a part of tenku: " + (reason != nullptr ? reason : "unknown reason"));
}

}  // namespace

const Plugin& load_plugin(std::string_view name) {
  const fs::path path = plugin_path(name);
  // Never closed: the packages behind keep threads and tables until the program ends.
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(path);
  const auto entry = reinterpret_cast<decltype(&tenku_plugin)>(dlsym(library, "tenku_plugin"));
  if (entry == nullptr) fail(path);
  return *entry();
}

}  // namespace tenku
