/// @file
/// Numbers as text and back, independent of the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace meshfolio {

/// Returns the shortest decimal text that reads back as exactly `x`, for files; "" for NaN and infinities.
std::string exact_text(double x);

/// Returns `x` with `digits` significant digits, for people: 0.0123, −5.00, 43 243 (digits before the point are never lost), and with a
/// power below 10⁻⁴ and from 10⁶ on: 1.23 × 10⁻⁷. Zero gives "0", NaN "–", infinity "∞".
std::string readable(double x, int digits = 3);

/// Returns a whole number with all its digits, for people: 5120, 40 962. Thin spaces group five digits and more.
std::string readable_count(long long n);

/// Returns x rounded to a whole number, with all its digits, for people: 40 962. "–" for NaN, "∞" for infinity.
std::string readable_integer(double x);

/// Returns readable(x, d) with the least number of digits d ≤ most that says the same as `most` digits: "2", not "2.000"; "0.01".
/// For limits and tolerances, which are exact.
std::string brief_text(double x, int most);

/// Returns `x` with `digits` significant digits and always with a power of ten: 3.59 × 10⁻⁵, 1.2 × 10³.
std::string scientific_text(double x, int digits);

/// Returns "10⁻⁴" for −4.
std::string power_of_ten(int exponent);

/// Returns `x` with up to `digits` significant digits without typography and without trailing zeros, for CSV, logs and axes: -0.5, 1.25e-9.
/// NaN gives "nan", infinities "inf" and "-inf".
std::string plain_text(double x, int digits = 6);

/// Returns the decimal number of `digits` significant digits nearest to x: 0.123 for 0.12345 and 3. 0, NaN and infinities stay.
double rounded(double x, int digits);
/// Returns the largest number of `digits` significant digits not above x, for printing a lower bound.
double rounded_down(double x, int digits);
/// Returns the smallest number of `digits` significant digits not below x, for printing an upper bound.
double rounded_up(double x, int digits);

/// Returns `fraction` in percent with `digits` significant digits: "12.3 %" for 0.1234; "–" unless it is finite.
std::string readable_percent(double fraction, int digits = 3);

/// Reads all of `text` as a finite decimal number ("1", "-.5", "1e-3", "+2."). Returns nothing for other text ("1 ", "0x1", "nan").
std::optional<double> parse_number(std::string_view text);

/// Reads all of `text` as a decimal integer ("12", "-3", "+4"). Returns nothing for other text and for numbers beyond 64 bits.
std::optional<long long> parse_integer(std::string_view text);

}   // namespace meshfolio
