/// @file
/// Arguments of the command line as values. A wrong one is a UsageError that names the option and its possible values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::run {

bool contains(const std::vector<std::string>& words, const std::string& word);

/// @throws UsageError unless `word` is one of the choices; the message names the nearest
void require_choice(const std::string& option, const std::string& word, const std::vector<std::string>& choices);

/// Returns a variable of the environment; empty if it is not set.
std::string environment(const std::string& name);

/// Returns the parts between the separators, also empty parts; an empty text has none.
std::vector<std::string> split(std::string_view text, char separator);

/// Reads an integer. @throws UsageError unless it is one between the limits
long long integer_between(const std::string& option, std::string_view text, long long low, long long high);

/// Reads a list such as "5,15,30", each between the limits; empty if `text` is.
std::vector<int> integers_between(const std::string& option, std::string_view text, int low, int high);

/// Reads a finite decimal number: not "nan", "inf" or hexadecimal.
double finite_number(const std::string& option, std::string_view text);
/// Read a finite decimal number between the limits, ≥ 0 or > 0.
double number_between(const std::string& option, std::string_view text, double low, double high);
double number_not_negative(const std::string& option, std::string_view text);
double number_above_zero(const std::string& option, std::string_view text);

}   // namespace meshfolio::run
