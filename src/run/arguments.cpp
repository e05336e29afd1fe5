#include "run/arguments.h"

#include <algorithm>
#include <cstdlib>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"

namespace meshfolio::run {

namespace {

[[noreturn]] void refuse(const std::string& option, std::string_view text, const std::string& wanted) {
    throw UsageError(option + " " + in_quotes(text) + " is not " + wanted);
}

template <class Condition>
double number_where(const std::string& option, std::string_view text, const Condition& is_right, const std::string& wanted) {
    const auto value = parse_number(text);
    if (!value || !is_right(*value)) refuse(option, text, wanted);
    return *value;
}

}   // namespace

bool contains(const std::vector<std::string>& words, const std::string& word) { return std::ranges::find(words, word) != words.end(); }

void require_choice(const std::string& option, const std::string& word, const std::vector<std::string>& choices) {
    if (!contains(choices, word))
        throw UsageError("unknown " + option + " " + in_quotes(word), suggestion(word, choices) + "it takes " + joined(choices, ", "));
}

std::string environment(const std::string& name) {
    const char* value = std::getenv(name.c_str());
    return value != nullptr ? value : "";
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    if (text.empty()) return parts;
    for (std::size_t end = text.find(separator); end != std::string_view::npos; end = text.find(separator)) {
        parts.emplace_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    parts.emplace_back(text);
    return parts;
}

long long integer_between(const std::string& option, std::string_view text, long long low, long long high) {
    const auto value = parse_integer(text);
    if (!value || *value < low || *value > high)
        refuse(option, text, "an integer from " + std::to_string(low) + " to " + std::to_string(high));
    return *value;
}

std::vector<int> integers_between(const std::string& option, std::string_view text, int low, int high) {
    std::vector<int> values;
    for (const std::string& part : split(text, ',')) values.push_back(static_cast<int>(integer_between(option, part, low, high)));
    return values;
}

std::uint64_t seed_of(std::string_view text) { return static_cast<std::uint64_t>(integer_between("--seed", text, 0, largest_seed)); }

double finite_number(const std::string& option, std::string_view text) {
    return number_where(
        option, text, [](double) { return true; }, "a finite number");
}

double number_between(const std::string& option, std::string_view text, double low, double high) {
    return number_where(
        option, text, [=](double x) { return x >= low && x <= high; }, "a number from " + plain_text(low) + " to " + plain_text(high));
}

double number_not_negative(const std::string& option, std::string_view text) {
    return number_where(
        option, text, [](double x) { return x >= 0; }, "a finite number ≥ 0");
}

double number_above_zero(const std::string& option, std::string_view text) {
    return number_where(
        option, text, [](double x) { return x > 0; }, "a finite number > 0");
}

std::vector<std::string> axis_names() { return {"x", "y", "z"}; }

render::Sight sight_of(const SightFlags& flags) {
    render::Sight sight;
    if (!flags.camera.empty()) {
        const std::vector<std::string> angles = split(flags.camera, ',');
        if (angles.size() < 2 || angles.size() > 3)
            refuse("--camera", flags.camera, "AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,ROLL, such as 35,22");
        sight.camera = {number_between("the azimuth of --camera", angles[0], -largest_turn, largest_turn),
                        number_between("the elevation of --camera", angles[1], -largest_elevation, largest_elevation),
                        angles.size() == 3 ? number_between("the roll of --camera", angles[2], -largest_turn, largest_turn) : 0};
    }
    if (!flags.up.empty()) {
        require_choice("--up", flags.up, axis_names());
        sight.up = static_cast<render::Up>(flags.up[0] - 'x');
    }
    if (!flags.zoom.empty()) sight.zoom = number_between("--zoom", flags.zoom, smallest_zoom, largest_zoom);
    return sight;
}

}   // namespace meshfolio::run
