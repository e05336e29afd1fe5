#include "report/text.h"

namespace meshfolio::report {

std::string plain(const Text& text) {
    std::string joined;
    for (const Run& run : text) joined += run.content;
    return joined;
}

}   // namespace meshfolio::report
