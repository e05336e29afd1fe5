/// @file
/// The claims of four earlier reports on the same coursework, S0 to S3, and of the papers they rest on.
#pragma once

#include <vector>

#include "questions/claims/claim.h"

namespace meshfolio::claims {

// By subject; each file states a rule for every claim before anything is measured.
const std::vector<Claim>& curvature_claims();
const std::vector<Claim>& operator_claims();
const std::vector<Claim>& spectral_claims();
const std::vector<Claim>& explicit_claims();
const std::vector<Claim>& limit_claims();
const std::vector<Claim>& implicit_claims();
const std::vector<Claim>& denoising_claims();
const std::vector<Claim>& noise_claims();
const std::vector<Claim>& fandisk_claims();
const std::vector<Claim>& paper_claims();

/// All of them: by question, then in the order of the sources.
const std::vector<Claim>& claim_list();

/// Measures a claim and applies its rule. What cannot be measured on a mesh, or not in this run, is not decidable there, and says why.
JudgedClaim judged(const Claim& claim, ClaimBench& bench);

}   // namespace meshfolio::claims
