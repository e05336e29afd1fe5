#include "base/number_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace meshfolio {

namespace {

template <class... Format> std::string chars_of(double x, Format... format) {
    std::array<char, 512> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x, format...);
    return {buffer.data(), end.ptr};
}

struct Scientific {
    std::string mantissa;
    int exponent;
};

/// Splits `x`, rounded to `digits` significant digits, into mantissa and exponent: "1.23" and -7.
Scientific scientific(double x, int digits) {
    const std::string s = chars_of(x, std::chars_format::scientific, digits - 1);
    const std::size_t e = s.find('e');   // "…e+05": from_chars() takes no plus
    int exponent = 0;
    std::from_chars(s.data() + e + (s[e + 1] == '+' ? 2 : 1), s.data() + s.size(), exponent);
    return {s.substr(0, e), exponent};
}

bool is_plain(int exponent, int digits) { return exponent >= -4 && exponent < std::max(6, digits); }

/// Returns the number of decimals that show `digits` significant digits of a number with this exponent.
int decimals(int exponent, int digits) { return std::max(0, digits - 1 - exponent); }

std::string with_typographic_minus(std::string s) {
    if (!s.empty() && s.front() == '-') s.replace(0, 1, "\u2212");
    return s;
}

/// Returns the number with five or more digits before the point grouped by three: "43243" becomes "43 243", with U+202F.
std::string grouped(const std::string& number) {
    const std::size_t begin = number.front() == '-' ? 1 : 0;
    const std::size_t whole = std::min(number.find('.'), number.size()) - begin;
    if (whole < 5) return number;
    std::string s = number.substr(0, begin);
    for (std::size_t i = 0; i < whole; ++i) {
        if (i > 0 && (whole - i) % 3 == 0) s += "\u202f";
        s += number[begin + i];
    }
    return s + number.substr(begin + whole);
}

/// Removes a leading plus, which from_chars does not know. Returns false if nothing or another sign follows.
bool remove_plus(std::string_view& text) {
    if (!text.starts_with('+')) return !text.empty();
    text.remove_prefix(1);
    return !text.empty() && text.front() != '+' && text.front() != '-';
}

std::string without_trailing_zeros(std::string s) {   // after the point
    if (s.find('.') == std::string::npos) return s;
    s.erase(s.find_last_not_of('0') + 1);
    if (s.back() == '.') s.pop_back();
    return s;
}

}   // namespace

double rounded(double x, int digits) {
    if (x == 0 || !std::isfinite(x)) return x;
    return std::strtod(chars_of(x, std::chars_format::scientific, digits - 1).c_str(), nullptr);
}

double rounded_down(double x, int digits) {
    const double y = rounded(x, digits);
    // The last digit of x itself: rounding turns 0.99996 into 1.000, with a last digit worth ten times as much.
    return !(y > x) ? y : rounded(y - std::pow(10.0, scientific(x, 17).exponent - digits + 1), digits);
}

double rounded_up(double x, int digits) { return -rounded_down(-x, digits); }

std::string exact_text(double x) { return std::isfinite(x) ? chars_of(x) : ""; }

std::string readable(double x, int digits) {
    if (std::isnan(x)) return "–";
    if (std::isinf(x)) return x > 0 ? "∞" : "\u2212∞";
    if (x == 0) return "0";
    const int exponent = scientific(x, digits).exponent;
    if (!is_plain(exponent, digits)) return scientific_text(x, digits);
    return with_typographic_minus(grouped(chars_of(x, std::chars_format::fixed, decimals(exponent, digits))));
}

std::string readable_count(long long n) { return with_typographic_minus(grouped(std::to_string(n))); }

std::string readable_integer(double x) { return std::isfinite(x) ? readable_count(std::llround(x)) : readable(x); }

std::string brief_text(double x, int most) {
    const std::string wanted = plain_text(x, most);   // without trailing zeros
    for (int digits = 1; digits < most; ++digits)
        if (plain_text(x, digits) == wanted) return readable(x, digits);
    return readable(x, most);
}

std::string scientific_text(double x, int digits) {
    if (!std::isfinite(x) || x == 0) return readable(x, digits);
    const Scientific s = scientific(x, digits);
    return with_typographic_minus(s.mantissa) + "\u202f×\u202f" + power_of_ten(s.exponent);
}

std::string power_of_ten(int exponent) {
    static constexpr const char* superscript[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string power = exponent < 0 ? "10⁻" : "10";
    for (const char digit : std::to_string(std::abs(exponent))) power += superscript[digit - '0'];
    return power;
}

std::string plain_text(double x, int digits) {
    if (!std::isfinite(x)) return std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
    if (x == 0) return "0";
    const Scientific s = scientific(x, digits);
    if (is_plain(s.exponent, digits)) return without_trailing_zeros(chars_of(x, std::chars_format::fixed, decimals(s.exponent, digits)));
    return without_trailing_zeros(s.mantissa) + "e" + std::to_string(s.exponent);
}

std::string readable_percent(double fraction, int digits) {
    return std::isfinite(fraction) ? readable(100 * fraction, digits) + "\u202f%" : "–";
}

std::optional<double> parse_number(std::string_view text) {
    if (!remove_plus(text)) return {};
    // from_chars accepts "nan" and "inf"; a decimal number begins with a digit or a point, perhaps after a minus.
    const std::size_t first = text.front() == '-' ? 1 : 0;
    if (first >= text.size() || !((text[first] >= '0' && text[first] <= '9') || text[first] == '.')) return {};
    double x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (end != text.data() + text.size()) return {};
    if (error == std::errc::result_out_of_range) {
        x = std::strtod(std::string(text).c_str(), nullptr);   // 0 or a denormal after an underflow, infinity after an overflow
        return std::isfinite(x) ? std::optional(x) : std::nullopt;
    }
    return error == std::errc() ? std::optional(x) : std::nullopt;
}

std::optional<long long> parse_integer(std::string_view text) {
    if (!remove_plus(text)) return {};
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

}   // namespace meshfolio
