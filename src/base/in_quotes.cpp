#include "base/in_quotes.h"

#include "base/errors.h"

namespace meshfolio {

std::string in_quotes(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return "'" + printable(std::string(text)) + "'";
    const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0u) == 0x80u; };
    std::size_t end = longest;
    while (end > 0 && end + 4 > longest && continues(end)) --end;   // not within a character of up to four bytes
    return "'" + printable(std::string(text.substr(0, end))) + "…'";
}

}   // namespace meshfolio
