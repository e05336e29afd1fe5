/// @file
/// Words of the command line as values. Everything wrong is a UsageError that names the option and what it may be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace meshfolio::run {

bool contains(const std::vector<std::string>& words, const std::string& word);

/// @throws UsageError for another word than one of these, with the nearest of them
void require_choice(const std::string& option, const std::string& word, const std::vector<std::string>& choices);

/// A variable of the environment; empty where it is not set.
std::string environment(const std::string& name);

/// The parts between separators, empty ones too; none of an empty text.
std::vector<std::string> split(std::string_view text, char separator);

long long integer_between(const std::string& option, std::string_view text, long long low, long long high);

/// "5,15,30", each between the limits; empty when `text` is.
std::vector<int> integers_between(const std::string& option, std::string_view text, int low, int high);

/// Decimal and finite; neither "nan", "inf" nor hexadecimal.
double finite_number(const std::string& option, std::string_view text);
/// The same, between the limits, ≥ 0 or > 0.
double number_between(const std::string& option, std::string_view text, double low, double high);
double number_not_negative(const std::string& option, std::string_view text);
double number_above_zero(const std::string& option, std::string_view text);

}   // namespace meshfolio::run
