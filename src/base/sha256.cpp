#include "base/sha256.h"

#include <nettle/sha2.h>

#include <cstdint>

#include "base/file_bytes.h"

namespace meshfolio {

namespace {

class Sha256 {
public:
    Sha256() { sha256_init(&context_); }
    void add(std::string_view bytes) { sha256_update(&context_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data())); }
    std::string bytes() {
        std::string digest(SHA256_DIGEST_SIZE, '\0');
        sha256_digest(&context_, digest.size(), reinterpret_cast<std::uint8_t*>(digest.data()));
        return digest;
    }
    std::string digits() {
        constexpr char digits[] = "0123456789abcdef";
        std::string text;
        for (const char byte : bytes()) {
            const auto value = static_cast<unsigned char>(byte);
            text += {digits[value >> 4], digits[value & 15]};
        }
        return text;
    }

private:
    sha256_ctx context_{};
};

}   // namespace

std::string sha256_bytes(std::string_view bytes) {
    Sha256 sum;
    sum.add(bytes);
    return sum.bytes();
}

std::string sha256(std::string_view bytes) {
    Sha256 sum;
    sum.add(bytes);
    return sum.digits();
}

std::string sha256_of_file(const std::filesystem::path& path) {
    Sha256 sum;
    read_in_pieces(path, [&](std::string_view piece) { sum.add(piece); });
    return sum.digits();
}

}   // namespace meshfolio
