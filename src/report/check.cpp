#include "report/check.h"

#include <cmath>
#include <utility>

#include "base/number_text.h"

namespace meshfolio::report {

namespace {

// Every comparison below fails for NaN.
Check::Status status_of(bool within) { return within ? Check::Status::passed : Check::Status::failed; }

std::string number_or_dash(double x, int digits = 6) { return std::isnan(x) ? "–" : plain_text(x, digits); }

}   // namespace

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
