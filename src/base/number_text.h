/// @file
/// Numbers to text and back, independent of any locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meshfolio {

/// The shortest decimal text that reads back as exactly `x` (for files). NaN and infinities give "".
std::string exact_text(double x);

/// `x` with `digits` significant digits, for people: 0.0123, 1.23e-07, 43 200; plain between 1e-4 and 1e6.
/// Minus is U+2212 and powers are written ×10⁻⁷. NaN gives "–".
std::string readable(double x, int digits = 3);

/// A whole number with all its digits, for people: 5120, 40 962. Four digits stay together, five and more are parted by thin spaces.
std::string readable_count(long long n);

/// 3.59 × 10⁻⁵ whatever the size; for a column in which some numbers need the power.
std::string scientific_text(double x, int digits);

/// "10⁻⁴".
std::string power_of_ten(int exponent);

/// As readable() without typography: -1.23e-07. For axis labels that programs read, CSV and plain logs.
std::string plain_text(double x, int digits = 6);

/// The number of `digits` significant digits nearest to x.
double rounded(double x, int digits);
/// Those that are not above, or not below it: what a bound may be printed as without
/// claiming too much.
double rounded_down(double x, int digits);
double rounded_up(double x, int digits);

/// A percentage of `fraction` with `digits` significant digits: readable_percent(0.1234) = "12.3 %".
std::string readable_percent(double fraction, int digits = 3);

/// All of `text` as a finite decimal number ("1", "-.5", "1e-3", "+2."), or nothing. Hexadecimal, "nan" and "inf" are refused.
std::optional<double> parse_number(std::string_view text);

/// All of `text` as an integer, or nothing; out of range gives nothing too.
std::optional<long long> parse_integer(std::string_view text);

}   // namespace meshfolio
