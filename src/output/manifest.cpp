#include "output/manifest.h"

#include <openssl/opensslv.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/atomic_file.h"
#include "core/version.h"
#include "output/field_writer.h"
#include "output/sha256.h"
#include "pictures/picture_codec.h"

namespace tenku {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::vector<ManifestEntry>& entries) {
  Json object = Json::object();
  for (const ManifestEntry& entry : entries) {
    std::visit([&](const auto& value) { object[entry.name] = value; }, entry.value);
  }
  return object;
}

Json json_of(const Finding& finding) {
  return {{"code", finding.code},     {"severity", name_of(finding.severity)},
          {"object", finding.object}, {"where", finding.where},
          {"what", finding.what},     {"repair", finding.repair},
          {"count", finding.count}};
}

Json json_of(const Machine& machine) {
  return {{"system", machine.system},
          {"processor", machine.processor},
          {"cores", machine.cores},
          {"memory_gib", std::round(machine.memory_gib * 100.0) / 100.0}};
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

}  // namespace

ManifestInput manifest_input(const std::filesystem::path& path) {
  std::string hash = sha256_of_input(path);
  std::uintmax_t bytes = 0;
  if (!std::filesystem::is_directory(path)) {
    bytes = std::filesystem::file_size(path);
  } else {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
      if (entry.is_regular_file()) bytes += entry.file_size();
    }
  }
  return {path.string(), std::move(hash), bytes};
}

Machine this_machine() {
  Machine machine;
  utsname name{};
  if (uname(&name) == 0) machine.system = std::string(name.sysname) + " " + name.release;
  machine.processor = processor_name();
  machine.cores = std::thread::hardware_concurrency();
  machine.memory_gib = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0 * 1024.0);
  return machine;
}

std::vector<ManifestEntry> output_library_versions() {
  return {{"OpenImageIO", std::string(openimageio_version())},
          {"VTK", std::string(vtk_version())},
          {"OpenSSL", std::string(OPENSSL_VERSION_STR)}};
}

std::string manifest_json(const Manifest& manifest) {
  Json json;
  json["software"] = software_name();
  if (!manifest.written.empty()) json["written"] = manifest.written;
  json["command"] = manifest.command;
  json["inputs"] = Json::array();
  for (const ManifestInput& input : manifest.inputs) {
    json["inputs"].push_back(
        {{"path", input.path}, {"sha256", input.sha256}, {"bytes", input.bytes}});
  }
  json["settings"] = json_of(manifest.settings);
  json["seed"] = manifest.seed;
  json["threads"] = manifest.threads;
  json["machine"] = json_of(manifest.machine);
  json["versions"] = json_of(manifest.versions);
  json["stages"] = Json::array();
  for (const ManifestStage& stage : manifest.stages) {
    json["stages"].push_back({{"name", stage.name}, {"seconds", stage.seconds}});
  }
  json["results"] = json_of(manifest.results);
  json["files"] = manifest.files;
  json["diagnostics"] = Json::array();
  for (const Finding& finding : manifest.diagnostics)
    json["diagnostics"].push_back(json_of(finding));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_manifest(const std::filesystem::path& path, const Manifest& manifest) {
  write_whole_file(path, manifest_json(manifest));
}

}  // namespace tenku
