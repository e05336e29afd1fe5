/// @file
/// The claims of four earlier reports on the same coursework, S0 to S3, and of the papers they rest on.
#pragma once

#include <vector>

#include "questions/claims/claim.h"

namespace meshfolio::claims {

// By subject; each file states a rule for every claim before anything is measured.
extern const std::vector<Claim> curvature_claims, operator_claims, spectral_claims, explicit_claims, limit_claims, implicit_claims,
    denoising_claims, noise_claims, fandisk_claims, paper_claims;

/// All of them: by question, then in the order of the sources.
const std::vector<Claim>& claim_list();

/// Measures a claim and applies its rule. What cannot be measured on a mesh, or not in this run, is not decidable there, and says why.
JudgedClaim judged(const Claim& claim, ClaimBench& bench);

}   // namespace meshfolio::claims
