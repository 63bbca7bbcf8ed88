/// The record that lets a result be made again: inputs, settings, versions, machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/finding.h"

namespace tenku {

/// A named value of the manifest. Numbers stay numbers, lists become lists.
struct ManifestEntry {
  std::string name;
  std::variant<std::string, double, std::int64_t, bool, std::vector<double>> value;
};

struct ManifestInput {
  std::string path;    ///< as the user named it
  std::string sha256;  ///< of the bytes of the file
  std::uintmax_t bytes = 0;
};

struct ManifestStage {
  std::string name;
  double seconds = 0.0;
};

/// What computed. Nothing that names the owner or the network.
struct Machine {
  std::string system;     ///< operating system and its release
  std::string processor;  ///< model name; empty if the system does not tell
  unsigned cores = 0;     ///< logical processors
  double memory_gib = 0.0;
};

struct Manifest {
  std::string command;  ///< the command line or the study
  std::vector<ManifestInput> inputs;
  std::vector<ManifestEntry> settings;  ///< all, defaults too
  std::vector<ManifestEntry> versions;  ///< of the libraries
  std::vector<ManifestEntry> results;   ///< key figures: sensors, rays, error_mean, ...
  std::vector<std::string> files;       ///< written beside the manifest
  std::vector<ManifestStage> stages;
  std::vector<Finding> diagnostics;
  Machine machine;
  unsigned threads = 0;
  std::uint64_t seed = 0;
  std::string written;  ///< UTC, ISO 8601; empty to leave it out
};

/// Path, hash and size of an input file.
/// @throws InputError if it cannot be read
ManifestInput manifest_input(const std::filesystem::path& path);

/// This machine.
Machine this_machine();

/// Versions of the libraries that this module uses.
std::vector<ManifestEntry> output_library_versions();

/// The manifest as JSON, keys in a fixed order, two spaces of indent, a line break at the end.
/// Text that is not UTF-8 has its broken bytes replaced.
std::string manifest_json(const Manifest& manifest);

/// @throws InputError, ResourceError as write_whole_file does
void write_manifest(const std::filesystem::path& path, const Manifest& manifest);

}  // namespace tenku
