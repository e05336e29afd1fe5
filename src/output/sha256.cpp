#include "output/sha256.h"

#include <nettle/sha2.h>

#include <array>
#include <cstdint>

namespace meshfolio::output {

std::string sha256(std::string_view bytes) {
    sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
    sha256_digest(&context, digest.size(), digest.data());
    constexpr char hex[] = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) text += {hex[byte >> 4], hex[byte & 15]};
    return text;
}

}   // namespace meshfolio::output
