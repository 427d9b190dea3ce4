#include "checker/document/sha256.hpp"

#include <nettle/sha2.h>

#include <array>
#include <cstdint>

namespace veritrack::checker {

std::string sha256(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += kDigits[byte / 16U];
    text += kDigits[byte % 16U];
  }
  return text;
}

}  // namespace veritrack::checker
