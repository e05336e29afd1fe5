#include "questions/claims/claim_list.h"

#include <algorithm>

#include "base/errors.h"
#include "questions/claims/claim_bench.h"

namespace meshfolio::claims {

const std::vector<Claim>& claim_list() {
    static const std::vector<Claim> all = [] {
        std::vector<Claim> claims;
        for (const auto* part : {&curvature_claims(), &operator_claims(), &spectral_claims(), &explicit_claims(), &limit_claims(),
                                 &implicit_claims(), &denoising_claims(), &noise_claims(), &fandisk_claims(), &paper_claims()}) {
            claims.insert(claims.end(), part->begin(), part->end());
        }
        std::stable_sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) { return a.question < b.question; });
        return claims;
    }();
    return all;
}

namespace {

Measurement unmeasured(const Error& error) {
    Measurement m;
    m.undecidable = std::string("on this mesh it cannot be measured (") + error.what() + ")";
    return m;
}

}   // namespace

JudgedClaim judged(const Claim& claim, ClaimBench& bench) {
    JudgedClaim result{&claim, {}, {}};
    if (claim.effort == Effort::full && bench.settings().quick) {
        result.measurement.undecidable = "a quick run does not measure it";
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
