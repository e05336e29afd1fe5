#include "report/document.h"

#include <cmath>
#include <utility>

#include "number_text.h"

namespace meshfolio::report {

// A NaN is never within a tolerance: every comparison below is written so that it fails.

std::string words_of(const Check& check) {
    const std::string relation = check.kind == Check::Kind::at_most ? "at most " : check.kind == Check::Kind::at_least ? "at least " : "";
    return "measured " + plain_text(check.measured) + ", expected " + relation + plain_text(check.expected) +
           (check.tolerance > 0 ? ", tolerance " + plain_text(check.tolerance, 3) : "");
}

Check check_near(std::string name, double expected, double measured, double tolerance, std::string note) {
    const bool passed = std::abs(measured - expected) <= tolerance;
    return {std::move(name), expected, measured, tolerance, passed, Check::Kind::near, std::move(note)};
}

Check check_at_most(std::string name, double limit, double measured, double tolerance, std::string note) {
    const bool passed = measured <= limit + tolerance;
    return {std::move(name), limit, measured, tolerance, passed, Check::Kind::at_most, std::move(note)};
}

Check check_at_least(std::string name, double limit, double measured, double tolerance, std::string note) {
    const bool passed = measured >= limit - tolerance;
    return {std::move(name), limit, measured, tolerance, passed, Check::Kind::at_least, std::move(note)};
}

}   // namespace meshfolio::report
