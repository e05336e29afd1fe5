#include "report/pdf/draft_picture.h"

namespace meshfolio::report {

std::string draft_of_jpeg(const std::string& jpeg) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(jpeg[at]); };
    if (!jpeg.starts_with("\xff\xd8")) return jpeg;
    for (std::size_t at = 2; at + 4 <= jpeg.size() && byte(at) == 0xff;) {
        const bool scan = byte(at + 1) == 0xda;
        at += 2 + (byte(at + 2) << 8 | byte(at + 3));
        if (scan && at <= jpeg.size()) return jpeg.substr(0, at) + "\xff\xd9";
        if (scan) break;
    }
    return jpeg;
}

}   // namespace meshfolio::report
