#include "report/brief_number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "number_text.h"

namespace meshfolio::report {

std::string readable_integer(double x) {
    constexpr int all_digits = 10;
    const std::string text = readable(x, all_digits);
    return text.substr(0, text.find('.'));
}

std::string brief(double x, int most) {
    const std::string wanted = plain_text(x, most);   // without trailing zeros
    for (int digits = 1; digits < most; ++digits) {
        if (plain_text(x, digits) == wanted) return readable(x, digits);
    }
    return readable(x, most);
}

std::string scientific(double x, int digits) {
    if (!std::isfinite(x) || x == 0) return readable(x, digits);
    std::array<char, 64> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(x), std::chars_format::scientific, digits - 1).ptr;
    const std::string text(buffer.data(), end);
    const std::size_t e = text.find('e');
    return (x < 0 ? "\u2212" : "") + text.substr(0, e) + "\u202f×\u202f" + power_of_ten(std::atoi(text.c_str() + e + 1));
}

std::string power_of_ten(int exponent) {
    constexpr std::array<const char*, 10> superscript{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string power = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) power += superscript[static_cast<std::size_t>(digit - '0')];
    return power;
}

}   // namespace meshfolio::report
