#include "report/document.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>

namespace meshfolio::report {

namespace {

/// Returns a name with its Greek letters as separate words: "λ" becomes " lambda ".
std::string spelled(const std::string& name) {
    constexpr std::pair<std::string_view, std::string_view> letters[] = {
        {"α", "alpha"}, {"β", "beta"}, {"γ", "gamma"}, {"δ", "delta"}, {"ε", "epsilon"}, {"θ", "theta"}, {"κ", "kappa"}, {"λ", "lambda"},
        {"μ", "mu"},    {"π", "pi"},   {"ρ", "rho"},   {"σ", "sigma"}, {"τ", "tau"},     {"χ", "chi"},   {"Δ", "delta"}, {"Σ", "sum"}};
    std::string words;
    for (std::size_t i = 0; i < name.size();) {
        const auto letter = std::ranges::find_if(letters, [&](auto& pair) { return name.compare(i, pair.first.size(), pair.first) == 0; });
        if (letter == std::end(letters)) {
            words += name[i++];
        } else {
            words += " " + std::string(letter->second) + " ";
            i += letter->first.size();
        }
    }
    return words;
}

/// Returns ids such as "whole-name-of-the-part", from letters and digits of the names; "…-2" for a second part of that name.
/// @param name     returns the name of a part
/// @param unnamed  stands for a name without letters and digits
template <class Parts, class NameOf>
std::vector<std::string> ids_from(const std::string& whole, const Parts& parts, NameOf name, const std::string& unnamed) {
    constexpr std::size_t longest = 100;
    std::vector<std::string> ids;
    std::set<std::string> taken;
    for (const auto& part : parts) {
        std::string stem = whole;
        bool in_word = false;
        for (const char c : spelled(std::invoke(name, part)).substr(0, longest)) {
            const bool is_upper = c >= 'A' && c <= 'Z', belongs = is_upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
            if (belongs) stem += std::string(in_word ? "" : "-") + static_cast<char>(is_upper ? c - 'A' + 'a' : c);
            in_word = belongs;
        }
        if (stem == whole) stem += "-" + unnamed;
        std::string id = stem;
        for (int number = 2; !taken.insert(id).second; ++number) id = stem + "-" + std::to_string(number);
        ids.push_back(std::move(id));
    }
    return ids;
}

}   // namespace

std::string plain(const Text& text) {
    std::string joined;
    for (const Run& run : text) joined += run.content;
    return joined;
}

std::map<std::string, std::string> texts_of(const Parameters& parameters) {
    std::map<std::string, std::string> texts;
    for (const auto& [name, parameter] : parameters) texts[name] = parameter.text;
    return texts;
}

std::vector<std::string> column_ids(const Table& table) { return ids_from(table.id, table.columns, &Column::name, "column"); }

std::vector<std::string> check_ids(const Section& section) { return ids_from(section.id, section.checks, &Check::name, "check"); }

std::vector<std::string> parameter_ids(const Section& section) {
    return ids_from(section.id + "-parameter", section.parameters, &Parameters::value_type::first, "value");
}

}   // namespace meshfolio::report
