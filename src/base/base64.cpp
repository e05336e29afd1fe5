#include "base/base64.h"

#include <nettle/base64.h>

#include <algorithm>
#include <cstdint>

namespace meshfolio {

std::string base64(std::string_view bytes) {
    std::string encoded(BASE64_ENCODE_RAW_LENGTH(bytes.size()), '\0');
    base64_encode_raw(encoded.data(), bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    return encoded;
}

std::string from_base64(std::string_view text) {
    base64_decode_ctx context;
    base64_decode_init(&context);
    std::string bytes(BASE64_DECODE_LENGTH(text.size()), '\0');
    std::size_t size = bytes.size();
    const bool good = base64_decode_update(&context, &size, reinterpret_cast<std::uint8_t*>(bytes.data()), text.size(), text.data()) == 1 &&
                      base64_decode_final(&context) == 1;
    bytes.resize(good ? size : 0);
    return bytes;
}

std::string from_base64_parts(std::string_view text, std::size_t count) {
    base64_decode_ctx context;
    base64_decode_init(&context);
    std::string bytes;
    bytes.reserve(std::min(count, text.size()));
    for (const char c : text) {
        if (bytes.size() == count) break;
        const bool part_ended = context.padding > 0 && context.bits == 0;
        if (part_ended && c != '=') base64_decode_init(&context);
        std::uint8_t byte = 0;
        const int found = base64_decode_single(&context, &byte, c);
        if (found < 0) break;
        if (found > 0) bytes += static_cast<char>(byte);
    }
    return bytes;
}

}   // namespace meshfolio
