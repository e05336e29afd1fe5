#include "output/publish/file_sums.h"

#include <algorithm>
#include <string_view>

#include "base/errors.h"

namespace meshfolio::output {

std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file) {
    constexpr std::size_t digits = 64, gap = 2;
    const auto is_digest = [](std::string_view word) { return word.find_first_not_of("0123456789abcdef") == std::string_view::npos; };
    std::map<std::string, FileSum> sums;
    long number = 0;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
        end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        ++number;
        if (line.size() <= digits + gap || line.compare(digits, gap, "  ") != 0 || !is_digest(std::string_view(line).substr(0, digits)))
            throw InputError({file.string(), number}, "is no line of sha256sum", "make the report again with meshfolio report");
        sums[line.substr(digits + gap)] = {line.substr(0, digits), number};
    }
    return sums;
}

}   // namespace meshfolio::output
