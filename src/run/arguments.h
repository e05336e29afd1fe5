/// @file
/// Arguments of the command line as values. A wrong one is a UsageError that names the option and its possible values.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scene/sight.h"

namespace meshfolio::run {

bool contains(const std::vector<std::string>& words, const std::string& word);

/// Requires that `word` is one of the choices. @throws UsageError otherwise, with the nearest choice and all of them
void require_choice(const std::string& option, const std::string& word, const std::vector<std::string>& choices);

/// Returns a variable of the environment; empty if it is not set.
std::string environment(const std::string& name);

/// Returns the parts of a text between the separators, also empty parts; none for an empty text.
std::vector<std::string> split(std::string_view text, char separator);

/// Parses an integer from `low` to `high`. @throws UsageError for any other text
long long integer_between(const std::string& option, std::string_view text, long long low, long long high);

/// Parses integers from `low` to `high` with commas between them, "5,15,30"; returns none for an empty text.
/// @throws UsageError for any other text
std::vector<int> integers_between(const std::string& option, std::string_view text, int low, int high);

/// Parses a finite decimal number: not "nan", "inf" or hexadecimal. @throws UsageError for any other text
double finite_number(const std::string& option, std::string_view text);
/// Parse a finite decimal number from `low` to `high`, ≥ 0 or > 0. @throws UsageError for any other text
double number_between(const std::string& option, std::string_view text, double low, double high);
double number_not_negative(const std::string& option, std::string_view text);
double number_above_zero(const std::string& option, std::string_view text);

inline constexpr long long largest_seed = std::numeric_limits<std::int64_t>::max();   // TOML's integers
/// Parses the value of --seed. @throws UsageError unless it is an integer from 0 to largest_seed
std::uint64_t seed_of(std::string_view text);

/// The options --camera, --up and --zoom as they are given; empty: not given.
struct SightFlags {
    std::string camera = {}, up = {}, zoom = {};
};
inline constexpr double largest_turn = 360, largest_elevation = 90;   // degrees to either side; of azimuth and roll the turn
inline constexpr double smallest_zoom = 0.01, largest_zoom = 100;

std::vector<std::string> axis_names();   // of --up

/// Parses an azimuth, an elevation from -90 to 90 and perhaps a roll with commas between them ("35,22"), one of x, y, z, and a factor.
/// @throws UsageError for any other text
render::Sight sight_of(const SightFlags& flags);

}   // namespace meshfolio::run
