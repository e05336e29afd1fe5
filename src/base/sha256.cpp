#include "base/sha256.h"

#include <nettle/base16.h>
#include <nettle/sha2.h>

#include <cstdint>

#include "base/file_bytes.h"

namespace meshfolio {

namespace {

const std::uint8_t* octets(std::string_view bytes) { return reinterpret_cast<const std::uint8_t*>(bytes.data()); }

std::string digest_of(sha256_ctx& context) {
    std::string digest(SHA256_DIGEST_SIZE, '\0');
    sha256_digest(&context, digest.size(), reinterpret_cast<std::uint8_t*>(digest.data()));
    return digest;
}

std::string hexadecimal(std::string_view bytes) {
    std::string digits(BASE16_ENCODE_LENGTH(bytes.size()), '\0');
    base16_encode_update(digits.data(), bytes.size(), octets(bytes));
    return digits;
}

}   // namespace

std::string sha256_bytes(std::string_view bytes) {
    sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, bytes.size(), octets(bytes));
    return digest_of(context);
}

std::string sha256(std::string_view bytes) { return hexadecimal(sha256_bytes(bytes)); }

std::string sha256_of_file(const std::filesystem::path& path) {
    sha256_ctx context;
    sha256_init(&context);
    read_in_pieces(path, [&](std::string_view piece) { sha256_update(&context, piece.size(), octets(piece)); });
    return hexadecimal(digest_of(context));
}

}   // namespace meshfolio
