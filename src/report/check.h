/// @file
/// Checks of a section: named numbers and the values they should have.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace meshfolio::report {

/// A check passes if |measured − expected| ≤ tolerance (kind `near`), measured ≤ expected + tolerance (`at_most`) or
/// measured ≥ expected − tolerance (`at_least`). It is undecided, and no failure, if the number is no evidence, for example because
/// rounding exceeds the margin; the note says why.
struct Check {
    enum class Kind { near, at_most, at_least };
    enum class Status { passed, failed, undecided };
    std::string name;   // "Gauss–Bonnet: Σ deficit / 2π on sphere"
    double expected = 0;
    double measured = 0;
    double tolerance = 0;
    Status status = Status::failed;
    Kind kind = Kind::near;
    std::string note = {};   // the comparison, or the reason of an expected failure or of no decision
    bool passed() const { return status == Status::passed; }
    bool failed() const { return status == Status::failed; }
    bool operator==(const Check&) const = default;
};
/// Returns "measured 2.31, expected 2, tolerance 0.2", "measured 3, expected at most 1" or the like; "–" stands for NaN.
std::string words_of(const Check& check);
/// Return checks of the three kinds, passed or failed. NaN fails.
Check check_near(std::string name, double expected, double measured, double tolerance, std::string note = "");
Check check_at_most(std::string name, double limit, double measured, double tolerance = 0, std::string note = "");
Check check_at_least(std::string name, double limit, double measured, double tolerance = 0, std::string note = "");
/// Returns the check as undecided, with the reason in its note.
Check undecided(Check check, std::string why);

/// Returns a check that failed by at most `rounding` as undecided, any other check unchanged.
Check within_rounding(Check check, double rounding);

/// Numbers of checks that passed, failed, and decided nothing.
struct Score {
    std::size_t passed = 0, failed = 0, undecided = 0;
    std::size_t total() const { return passed + failed + undecided; }
    Score& operator+=(const Score& other);
};
Score score_of(const std::vector<Check>& checks);
/// Returns "456 of 458 checks passed, 1 failed, 1 undecided".
std::string words_of(const Score& score);

}   // namespace meshfolio::report
