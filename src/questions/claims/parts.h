/// @file
/// The section "claims": the ledger as a table, every verdict explained, and what they come to.
#pragma once

#include <vector>

#include "questions/claims/claim.h"
#include "questions/core/chapter.h"

namespace meshfolio::claims {

report::Table ledger_table(const std::vector<JudgedClaim>& judged);
/// Every case of every claim: what the verdicts follow from.
report::Table measurement_table(const std::vector<JudgedClaim>& judged);
report::EntryList ledger_entries(const std::vector<JudgedClaim>& judged);

int count_of(const std::vector<JudgedClaim>& judged, Verdict verdict);
/// The verdicts of the table counted again and held against the claims, and the rule applied again to the table of measurements.
std::vector<report::Check> ledger_checks(const std::vector<JudgedClaim>& judged);
report::Text ledger_summary(const std::vector<JudgedClaim>& judged);

}   // namespace meshfolio::claims
