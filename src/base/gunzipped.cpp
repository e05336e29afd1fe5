#include "base/gunzipped.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>

#include "base/errors.h"
#include "base/file_bytes.h"

namespace meshfolio {

std::string gunzipped(std::string_view bytes, const std::string& file) {
    const std::size_t most = std::min<std::size_t>(largest_file, 25 * bytes.size() + (1 << 20));
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(libdeflate_alloc_decompressor(),
                                                                                                     &libdeflate_free_decompressor);
    std::string text;
    std::size_t have = 0, room = 0;
    // The last four bytes are the size of the last member, a guess for the others.
    for (std::size_t i = 1; i <= 4 && i <= bytes.size(); ++i) room = room << 8 | static_cast<unsigned char>(bytes[bytes.size() - i]);
    ++room;
    while (!bytes.empty()) {
        room = std::min(room, most - have);
        text.resize(have + room);
        std::size_t taken = 0, made = 0;
        const libdeflate_result result =
            libdeflate_gzip_decompress_ex(unpacker.get(), bytes.data(), bytes.size(), text.data() + have, room, &taken, &made);
        if (result == LIBDEFLATE_SUCCESS) {
            have += made;
            bytes.remove_prefix(taken);
        } else if (result != LIBDEFLATE_INSUFFICIENT_SPACE) {
            throw InputError({file, 0}, "damaged gzip data", "the file may be cut off");
        } else if (have + room == most) {
            throw InputError({file, 0}, "the gzip data unpack to more than " + std::to_string(most) + " bytes",
                             "unpack it with gunzip first, if you trust it");
        } else {
            room = 2 * room + 64;
        }
    }
    text.resize(have);
    return text;
}

}   // namespace meshfolio
