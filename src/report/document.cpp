#include "report/document.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string_view>

#include "base/lower_case.h"
#include "base/number_text.h"

namespace meshfolio::report {

namespace {

// Every comparison below fails for NaN.
Check::Status status_of(bool within) { return within ? Check::Status::passed : Check::Status::failed; }

std::string number_or_dash(double x, int digits = 6) { return std::isnan(x) ? "–" : plain_text(x, digits); }

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
            if (is_alphanumeric(c)) stem += std::string(in_word ? "" : "-") + lower_case(c);
            in_word = is_alphanumeric(c);
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

std::string words_of(const Check& check) {
    const std::string relation = check.kind == Check::Kind::at_most ? "at most " : check.kind == Check::Kind::at_least ? "at least " : "";
    return "measured " + number_or_dash(check.measured) + ", expected " + (std::isnan(check.expected) ? "" : relation) +
           number_or_dash(check.expected) + (check.tolerance > 0 ? ", tolerance " + plain_text(check.tolerance, 3) : "");
}

Check check_near(std::string name, double expected, double measured, double tolerance, std::string note) {
    const bool within = std::abs(measured - expected) <= tolerance;
    return {std::move(name), expected, measured, tolerance, status_of(within), Check::Kind::near, std::move(note)};
}

Check check_at_most(std::string name, double limit, double measured, double tolerance, std::string note) {
    const bool within = measured <= limit + tolerance;
    return {std::move(name), limit, measured, tolerance, status_of(within), Check::Kind::at_most, std::move(note)};
}

Check check_at_least(std::string name, double limit, double measured, double tolerance, std::string note) {
    const bool within = measured >= limit - tolerance;
    return {std::move(name), limit, measured, tolerance, status_of(within), Check::Kind::at_least, std::move(note)};
}

Check undecided(Check check, std::string why) {
    check.status = Check::Status::undecided;
    check.note = check.note.empty() ? std::move(why) : std::move(why) + "; " + check.note;
    return check;
}

Check within_rounding(Check check, double rounding) {
    const double over = check.measured - check.expected;
    const double off = check.kind == Check::Kind::near ? std::abs(over) : check.kind == Check::Kind::at_most ? over : -over;
    if (!check.failed() || !(off - check.tolerance <= rounding)) return check;
    return undecided(std::move(check), "rounding alone may move it by " + plain_text(rounding, 2));
}

bool cites_source(const Document& document) {
    return std::ranges::any_of(document.sections, [](const Section& section) {
        return std::ranges::any_of(section.code, [](const CodeReference& code) { return code.line > 0; });
    });
}

Score& Score::operator+=(const Score& other) {
    passed += other.passed;
    failed += other.failed;
    undecided += other.undecided;
    return *this;
}

Score score_of(const std::vector<Check>& checks) {
    Score score;
    for (const Check& check : checks) ++(check.passed() ? score.passed : check.failed() ? score.failed : score.undecided);
    return score;
}

std::string words_of(const Score& score) {
    return std::to_string(score.passed) + " of " + std::to_string(score.total()) + " checks passed" +
           (score.failed > 0 ? ", " + std::to_string(score.failed) + " failed" : "") +
           (score.undecided > 0 ? ", " + std::to_string(score.undecided) + " undecided" : "");
}

}   // namespace meshfolio::report
