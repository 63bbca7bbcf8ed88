#include "output/sha256.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include "core/error.h"
#include "core/handle.h"

namespace tenku {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new()) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw ResourceError("the cryptographic library offers no SHA-256");
    }
  }

  void add(const char* bytes, std::size_t count) {
    expects(EVP_DigestUpdate(context_.get(), bytes, count) == 1, "a digest takes bytes");
  }

  std::string digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
    unsigned size = 0;
    expects(EVP_DigestFinal_ex(context_.get(), hash.data(), &size) == 1, "a digest ends");
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += "0123456789abcdef"[hash[i] >> 4U];
      text += "0123456789abcdef"[hash[i] & 15U];
    }
    return text;
  }

 private:
  Handle<EVP_MD_CTX, &EVP_MD_CTX_free> context_;
};

}  // namespace

std::string sha256_of(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes.data(), bytes.size());
  return hash.digits();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot read " + path.string());
  Sha256 hash;
  std::vector<char> block(1U << 20U);
  do {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add(block.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (file.bad() || std::filesystem::is_directory(path)) {
    throw InputError("cannot read " + path.string());
  }
  return hash.digits();
}

std::string sha256_of_input(const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return sha256_of_file(path);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::string lines;
  for (const auto& file : files) {
    lines += sha256_of_file(file) + "  " + file.lexically_relative(path).string() + "\n";
  }
  return sha256_of(lines);
}

}  // namespace tenku
