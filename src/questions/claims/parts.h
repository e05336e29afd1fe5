/// @file
/// What the files of the chapter share: its words, cases, and the ledger as tables and sentences.
#pragma once

#include "questions/claims/claim_bench.h"

namespace meshfolio::claims {

inline constexpr report::Words words("claims");

using enum Rule::Relation;
using enum Property;
using enum Effort;
using enum About::Scope;
using enum SmoothingScheme;

/// The error left by each of several steps.
struct Sweep {
    std::vector<double> steps, errors;   // errors: rms [length]
    double noisy = 0;                    // before smoothing [length]
    double best_step() const { return steps[best_of(errors)]; }
    double least() const { return std::ranges::min(errors); }
    double at(double step) const { return errors[std::ranges::find(steps, step) - steps.begin()]; }
};
/// "random triangles on the torus".
inline std::string sampled(MeshKind kind, std::string_view surface) {
    return words.line("case.sampling", "triangles"_a = name_of(kind), "surface"_a = surface);
}

/// "✓ holds".
std::string shown(Verdict verdict);

/// The rules applied again, case by case.
report::Check ledger_check(const std::vector<JudgedClaim>& judged);
report::Text ledger_summary(const std::vector<JudgedClaim>& judged);

}   // namespace meshfolio::claims
