#include "questions/claims/claim_list.h"

#include "base/errors.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

const std::vector<Claim>& claim_list() {
    static const std::vector<Claim> all = [] {
        std::vector<Claim> claims;
        for (const auto* part : {&curvature_claims, &operator_claims, &spectral_claims, &explicit_claims, &limit_claims, &implicit_claims,
                                 &denoising_claims, &noise_claims, &fandisk_claims, &paper_claims})
            claims.insert(claims.end(), part->begin(), part->end());
        std::ranges::stable_sort(claims, {}, &Claim::question);
        return claims;
    }();
    return all;
}

JudgedClaim judged(const Claim& claim, ClaimBench& bench) {
    JudgedClaim result{&claim, {}, {}};
    const auto unmeasured = [](const Error& error) { return Measurement{.undecidable = words.line("unmeasured", "why"_a = error.what())}; };
    if (claim.effort == Effort::full && bench.settings().quick) {
        result.measurement.undecidable = words.line("not_in_quick_run");
    } else {
        try {
            const Measurable about = bench.measurable(claim.about);
            if (about.why_not.empty()) {
                result.measurement = claim.measure(bench, about.meshes);
                result.measurement.meshes = bench.called(about.meshes);
            } else {
                result.measurement.undecidable = about.why_not;
            }
        } catch (const MeshError& error) {   // too large, without an operator
            result.measurement = unmeasured(error);
        } catch (const SolverError& error) {
            result.measurement = unmeasured(error);
        }
    }
    result.decision = decide(claim.rule, result.measurement);
    return result;
}

}   // namespace meshfolio::claims
