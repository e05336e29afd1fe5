/// @file
/// Claims of earlier reports and papers as data: subject, rule, measurement and verdict of each.
/// The words of a claim are messages: "<id>.said" is the claim, "<id>.case…" and "<id>.remark…" describe its measurement.
///
/// Which meshes decide a claim follows from its scope (About), before anything is measured:
///   - without meshes: a claim about formulas, or about surfaces that the program makes; it is always measured
///   - any_mesh: the meshes that its author used, or any mesh in their places
///   - its_kind ("the noisy plane"): the mesh itself, or the bundled mesh made for its role; not the user's, because its kind is not known
///   - itself: that mesh alone, because a step or a number of iterations or modes belongs to its triangles
/// A mesh without a property that the claim needs is left out, and a mesh in two places counts once. A claim with too few meshes left is
/// not decidable here.
#pragma once

#include <functional>

#include "questions/core/section_tools.h"

namespace meshfolio::claims {

inline constexpr report::Words words("claims");

enum class Verdict { holds, conditional, refuted, undecidable };

/// Returns "✓ holds", "◐ holds with condition", "✗ refuted" or "? not decidable here".
std::string label_of(Verdict verdict);

/// The condition under which a claim is true: a quantity on the right side of a threshold, in every case.
struct Rule {
    std::string_view quantity;   // "apart": the message "quantity.apart" names it
    std::string_view unit;       // "%"; empty: a pure number
    enum class Relation { at_most, at_least } relation = Relation::at_most;
    double threshold = 0;   // in that unit

    bool satisfied_by(double value) const { return relation == Relation::at_most ? value <= threshold : value >= threshold; }
};
/// Returns the threshold in words: "≤ 5 %".
std::string bound_of(const Rule& rule);

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
    flat_with_edges,       // MeshClass::sharp_edged, with an angle below 2° between the faces at half of the other edges
    negative_weights,      // some cotangent weight is below 0
    unequal_areas,         // the areas of the vertices differ by 1 % or more
    clean_known,           // the surface under the noise is known, vertex by vertex
    above_1500_vertices,   // 150 modes are then a small share
};

/// The meshes that a claim is about.
struct About {
    enum class Scope { any_mesh, its_kind, itself };
    MeshNames meshes = {};
    std::vector<Property> properties = {};   // that every mesh must have
    Scope scope = Scope::any_mesh;
    std::size_t compared = 1;   // how many different meshes the claim compares
};

struct Measurement {
    std::vector<Case> cases = {};
    std::string undecidable = {};   // the reason why nothing can be decided here: then the cases do not count
    report::Text remark = {};       // explains the numbers
    bool remarked = false;          // the remark is the message "<id>.remark", which states no facts
    std::string meshes = {};        // measured on: "bunny and creature in place of cow.off"; empty: none of the library
    std::string figure = {};        // id of the plot that shows it; empty: none
};

/// The verdict that follows from the rule and the numbers alone.
struct Decision {
    Verdict verdict = Verdict::undecidable;
    std::vector<std::size_t> within, beyond;   // cases that satisfy the rule, and that do not
    std::size_t deciding = 0;                  // the case nearest to the threshold among those that turn the scale
    std::string why;                           // the reason, if the claim is undecidable
};
/// Decides that a claim holds if all cases satisfy the rule, is refuted if none does, else is conditional. Cases without a finite value
/// decide nothing.
Decision decide(const Rule& rule, const Measurement& measurement);

class ClaimBench;

/// Measures a claim. @param meshes  those of the claim that are measurable(): different meshes, at least as many as are compared
struct Measure : std::function<Measurement(ClaimBench& bench, const MeshNames& meshes)> {
    using function::function;
    Measure(Case (*case_on)(ClaimBench& bench, std::string_view mesh));   // a case for each mesh
};

/// The author of a claim.
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
    Measure measure = {};
    enum class Effort { quick, full } effort = Effort::quick;   // the least run in which it is measured

    std::string said() const;   // the claim, paraphrased
    const Source& source() const;
};

/// A claim with its measurement and the decision that follows.
struct JudgedClaim {
    const Claim* claim = nullptr;
    Measurement measurement;
    Decision decision;

    double deciding_value() const { return measurement.cases[decision.deciding].value; }   // of a decided claim
};
/// Measures a claim and applies its rule. A claim that cannot be measured here is undecidable, with the reason.
JudgedClaim judged(const Claim& claim, ClaimBench& bench);

/// Returns the value with the unit of the rule, three digits or as many as tell it from the threshold: "0.35 %", "0.35".
std::string with_unit(double value, const Rule& rule);
/// Returns "Required: Dirichlet energy left, over that of the input, ≤ 2 %."
report::Text rule_text(const JudgedClaim& judged);
/// Returns a paragraph of the verdict, the values of the cases, the remark, and the meshes measured; or the reason if undecidable.
report::Text verdict_text(const JudgedClaim& judged);

extern const std::vector<Claim> curvature_claims, spectral_claims, explicit_claims, implicit_claims, denoising_claims;
/// Returns the claims of four earlier reports, S0 to S3, and of the papers they rest on, by question.
const std::vector<Claim>& claim_list();

/// Judges every claim of the list, and enters the meshes measured into the section. @param plots  receives those that claims refer to
std::vector<JudgedClaim> judged_claims(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress,
                                       report::Section& section, std::vector<report::Plot>& plots);

}   // namespace meshfolio::claims
