/// @file
/// A claim that someone made, as data: what it is about, the rule that would make it true, the measurement, and the verdict that follows
/// from all of them. Its words are messages: "<id>.said" of what is claimed, "<id>.case…" and "<id>.remark…" of what was measured.
///
/// What a claim is about (About) decides, before anything is measured, which meshes may be measured:
///   - A claim about formulas, or about surfaces that the program makes, names no mesh. It is always measured.
///   - A claim about any mesh names those that its author used. Any mesh in their places decides it.
///   - A claim about a kind of mesh ("the noisy plane") is decided by the mesh itself or by the bundled mesh made for its role. The user's
///     mesh never decides it, because its kind is not known.
///   - A claim about one mesh itself has a step or a number of iterations or modes that belongs to its triangles. Only that mesh decides
///     it. It is known by its counts, mean edge and λ_crit, or as the assignment's file in a data folder.
/// A mesh without a property that the claim needs is left out, and a mesh in two places counts once. A claim with too few meshes left is
/// not decidable here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/text.h"

namespace meshfolio::claims {

enum class Verdict { holds, conditional, refuted, undecidable };

std::string word_of(Verdict verdict);          // "holds", "holds with condition", "refuted", "not decidable here"
std::string_view symbol_of(Verdict verdict);   // "✓", "◐", "✗", "?"

/// What makes a claim true: one quantity on the right side of one threshold, in every case it is measured in.
struct Rule {
    std::string_view quantity;   // "apart": the message "quantity.apart" is what is measured
    std::string_view unit;       // "%"; empty: a pure number
    enum class Relation { at_most, at_least } relation = Relation::at_most;
    double threshold = 0;   // in that unit

    bool satisfied_by(double value) const { return relation == Relation::at_most ? value <= threshold : value >= threshold; }
};
/// "≤ 5 %".
std::string words_of(const Rule& rule);
std::string quantity_of(const Rule& rule);

/// The quantity under one condition that the claim does not exclude: a mesh, a step, a kind of triangles.
struct Case {
    std::string condition = {};   // "random triangles"
    double value = 0;             // in the unit of the rule; NaN: not defined there
};

/// Meshes by name: "bunny", or a role of the library.
using MeshNames = std::vector<std::string_view>;

/// A property that a mesh needs to decide a claim.
enum class Property {
    flat,                  // all vertices lie in one plane
    not_flat,              // else noise has no normal direction, and there are no features
    closed,                // no boundary: encloses a volume
    flat_with_edges,       // sharp-edged as MeshClass has it, and half of the other edges lie between faces that meet at less than 2°
    negative_weights,      // some cotangent weight is below 0
    unequal_areas,         // the areas of the vertices differ, by 1 % or more
    clean_known,           // the surface under the noise is known, vertex by vertex
    above_1500_vertices,   // 150 modes are then a small share
};

/// Which meshes a claim is about.
struct About {
    enum class Scope { any_mesh, its_kind, itself };
    MeshNames meshes = {};                   // none: formulas, or surfaces that the program makes
    std::vector<Property> properties = {};   // that every mesh must have
    Scope scope = Scope::any_mesh;
    std::size_t compared = 1;   // how many different meshes the claim compares
};

struct Measurement {
    std::vector<Case> cases = {};
    std::string undecidable = {};   // why nothing can be decided here: then the cases do not count
    report::Text remark = {};       // what explains the numbers
    std::string meshes = {};        // measured on: "creature, in place of bunny.off"; empty: none of the library
    std::string figure = {};        // id of the plot that shows it; empty: none
};

/// Follows from the rule and the numbers alone: holds where all cases satisfy the rule, refuted where none does, else conditional. Cases
/// without a finite value decide nothing.
struct Decision {
    Verdict verdict = Verdict::undecidable;
    std::vector<std::size_t> within, beyond;   // cases that satisfy the rule, and that do not
    std::size_t deciding = 0;                  // the case nearest to the threshold among those that turn the scale
    std::string why;                           // of undecidable
};
Decision decide(const Rule& rule, const Measurement& measurement);

class ClaimBench;

/// The least run in which a claim is measured.
enum class Effort { quick, full };

/// Who claims it.
struct Source {
    std::string_view key;             // "taubin"
    std::string_view name;            // "S0", "Taubin 1995"
    std::string_view citation = {};   // id of the work in the bibliography; empty for the reports
};

struct Claim {
    std::string_view id;         // "claims_s0_bunny_limit", unique; "claims_", the key of its source, its name
    std::string_view question;   // "q5"
    About about;
    Rule rule;
    /// @param meshes  of `about`, those that may be measured: each another mesh, at least as many as are compared
    Measurement (*measure)(ClaimBench& bench, const MeshNames& meshes) = nullptr;
    Effort effort = Effort::quick;

    /// The claim, paraphrased.
    std::string said() const;
    const Source& source() const;
};

/// A claim with what was measured and what follows.
struct JudgedClaim {
    const Claim* claim = nullptr;
    Measurement measurement;
    Decision decision;

    /// The deciding value of a decided claim.
    double deciding_value() const { return measurement.cases[decision.deciding].value; }
};

/// "0.35 %", "0.35": a value with the unit of the rule.
std::string with_unit(double value, const Rule& rule);

/// The rule, and on which meshes it was measured.
report::Text rule_text(const JudgedClaim& judged);
/// Verdict, deciding number and what explains it, generated from the numbers.
report::Text verdict_text(const JudgedClaim& judged);

// By subject; each file states a rule for every claim before anything is measured.
extern const std::vector<Claim> curvature_claims, spectral_claims, explicit_claims, implicit_claims, denoising_claims, fandisk_claims,
    paper_claims;
/// Those of four earlier reports on the same coursework, S0 to S3, and of the papers they rest on: by question, then by source.
const std::vector<Claim>& claim_list();

/// Measures a claim and applies its rule. What cannot be measured here is undecidable, with the reason.
JudgedClaim judged(const Claim& claim, ClaimBench& bench);

}   // namespace meshfolio::claims
