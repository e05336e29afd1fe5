/// @file
/// What a section checks: named numbers against what they should be.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace meshfolio::report {

/// passed ⇔ |measured − expected| ≤ tolerance, for kind `near`; measured ≤ expected + tolerance, for `at_most`; and so on.
/// undecided: the number says nothing about what is checked (rounding is larger than the margin, or it was measured on something else);
/// the note says why. It is no failure.
struct Check {
    enum class Kind { near, at_most, at_least };
    enum class Status { passed, failed, undecided };
    std::string name;   // "Gauss–Bonnet: Σ deficit / 2π on sphere"
    double expected = 0;
    double measured = 0;
    double tolerance = 0;
    Status status = Status::failed;
    Kind kind = Kind::near;
    std::string note = {};   // why a failure is expected, why nothing is decided, or what is compared
    bool passed() const { return status == Status::passed; }
    bool failed() const { return status == Status::failed; }
    bool operator==(const Check&) const = default;
};
/// "measured 2.31, expected 2, tolerance 0.2"; "measured 3, expected at most 1"; "measured –" where there is no number.
std::string words_of(const Check& check);
Check check_near(std::string name, double expected, double measured, double tolerance, std::string note = "");
Check check_at_most(std::string name, double limit, double measured, double tolerance = 0, std::string note = "");
Check check_at_least(std::string name, double limit, double measured, double tolerance = 0, std::string note = "");
/// The same check, which decides nothing, for a reason.
Check undecided(Check check, std::string why);

/// A check that failed, but by no more than rounding may have moved its number, decides nothing. The others stay as they are.
Check within_rounding(Check check, double rounding);

/// How many checks passed, failed, and decided nothing.
struct Score {
    std::size_t passed = 0, failed = 0, undecided = 0;
    std::size_t total() const { return passed + failed + undecided; }
    Score& operator+=(const Score& other);
};
Score score_of(const std::vector<Check>& checks);
/// "456 of 458 checks passed, 1 failed, 1 undecided".
std::string words_of(const Score& score);

}   // namespace meshfolio::report
