/// @file
/// Claims of earlier reports and papers as data: subject, rule, measurement and verdict of each, and the bench that measures them.
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

#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"
#include "questions/bench/smoothing_study.h"
#include "questions/bench/spectral_study.h"
#include "questions/core/stand_ins.h"
#include "report/text.h"

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

// ---- how they are measured ------------------------------------------------------------------------------------------------

using enum Rule::Relation;
using enum Property;
using enum Claim::Effort;
using enum About::Scope;
using enum SmoothingScheme;

/// The meshes of a claim that may be measured.
struct Measurable {
    MeshNames meshes;
    std::string why_not;   // empty if the claim can be measured
};

/// A smoothing run of a mesh, or of the mesh with noise.
struct RunKey {
    SmoothingScheme scheme = explicit_euler;
    double lambda = 0;   // [length²; none for the uniform operator]
    int iterations = 1;
    OperatorKind laplacian = OperatorKind::cotan;
    bool rebuild = false;
    std::array<double, 3> sigma{};   // of seeded Gaussian noise along each axis [length]

    auto operator<=>(const RunKey&) const = default;
};

/// Returns the index of the smallest error, the first of equals.
int best_of(const std::vector<double>& errors);

/// The error left by each of several steps.
struct Sweep {
    std::vector<double> steps, errors;   // errors: rms [length]
    double noisy = 0;                    // before smoothing [length]
    double best_step() const { return steps[best_of(errors)]; }
    double least() const { return std::ranges::min(errors); }
    double at(double step) const { return errors[std::ranges::find(steps, step) - steps.begin()]; }
};

/// Meshes, operators, runs and spectra, each computed once and shared by the claims.
class ClaimBench {
public:
    ClaimBench(const MeshLibrary& library, const QuestionSettings& settings) : library_(library), settings_(settings) {}

    const QuestionSettings& settings() const { return settings_; }

    /// Returns the mesh of this name. @throws MeshError if it has more than 12,000 vertices (quick: 7,000; laboratory: 200,000)
    const ReportMesh& mesh(std::string_view name);
    /// True if the mesh found for the name is the original, and no stand-in: by its counts, mean edge and λ_crit to 10⁻⁴ if they are known,
    /// else because the assignment's file is in a data folder.
    bool is_itself(std::string_view name);
    bool has(std::string_view name, Property property);   // true if the mesh of this name has the property
    /// Returns the meshes that the scope and the properties of the claim admit, each mesh once; with the reason if there are too few.
    Measurable measurable(const About& about);
    /// Returns the positions without noise of a bundled noisy mesh; nothing for other meshes.
    std::optional<Positions> clean_form(std::string_view noisy);

    const SmoothingSubject& subject(std::string_view name);   // of the mesh with the cotangent operator; computed once
    /// Returns λ_crit of the uniform operator on the mesh.
    double uniform_limit(std::string_view name);

    /// Returns λ on the original mesh; on a stand-in, λ / (λ_crit of the original) × λ_crit of the stand-in. [length²]
    double raw_step(std::string_view name, double lambda);
    /// Returns the length (with power 2: area) on the original mesh; on a stand-in, scaled by the ratio of the mean edges to that power.
    double raw_length(std::string_view name, double length, int power = 1);

    /// Smooths the mesh of this name, without noise; computed once.
    const Smoothed& run(std::string_view name, const RunKey& key);
    /// Returns the rms distance between the vertices of the mesh and of run(name, key). [length]
    double motion(std::string_view name, const RunKey& key);
    /// Returns the rms error of a run with noise against the mesh itself after t = 0, 1, … iterations, up to the collapse of a rebuilt run;
    /// computed once. [length]
    const std::vector<double>& denoised(std::string_view name, const RunKey& key);

    /// Returns the errors that run() with each λ leaves against clean_form() of a noisy mesh; on the plane only heights count.
    Sweep sweep(std::string_view noisy, RunKey key, std::vector<double> lambdas);

    /// Rebuilds the mesh of this name from 5, 10, 15, 30, 60 and 150 modes, or as many as it has; computed once.
    const SpectralStudy& spectrum(std::string_view name);

    /// Measures all estimators on a known surface at the refinement levels coarse, coarse + 1, … fine.
    BenchRun curvature(const std::string& surface, MeshKind kind, int coarse, int fine) const;
    /// Returns irregular_plane(), a flat square of irregular triangles; computed once.
    const PlaneTest& plane();

    /// Enters the meshes measured so far and the warnings of their preflight.
    void enter_inputs(report::Section& section) const;

    std::vector<report::Plot> plots;   // that claims refer to, in the order they were made

private:
    const MeshLibrary& library_;
    const QuestionSettings& settings_;
    std::map<std::string, ReportMesh> meshes_;
    std::map<const LibraryMesh*, SmoothingSubject> subjects_;
    std::map<const LibraryMesh*, SpectralStudy> spectra_;
    std::map<const LibraryMesh*, ImplicitSolver> solvers_;
    std::map<std::pair<const LibraryMesh*, RunKey>, Smoothed> runs_;
    std::map<std::pair<const LibraryMesh*, RunKey>, std::vector<double>> noisy_runs_;
    std::optional<PlaneTest> plane_;
};

/// Returns a measure with the case case_at(bench, value) for each value, on no mesh.
inline Measure at_each(std::vector<double> values, Case (*case_at)(ClaimBench& bench, double value)) {
    return [=](ClaimBench& bench, const MeshNames&) {
        return Measurement{.cases = each_of(values, [&](double value) { return case_at(bench, value); })};
    };
}
/// Returns the measure with the message "<id>.remark" added to its measurement.
inline Measure remarked(const Measure& measure) {
    return [=](ClaimBench& bench, const MeshNames& meshes) {
        Measurement m = measure(bench, meshes);
        m.remarked = true;
        return m;
    };
}

/// Computes √(Σ A_i|(Lx)_i|²) at X, the root of four times the integral of H²; zigzags dominate it. [1]
double roughness(const SmoothingSubject& subject, const Positions& X);

/// Returns the multiply–adds of `steps` implicit steps and of their factorisation, which counts with its lower bound nnz²/n.
double implicit_operations(const Smoothed& run, int steps);
/// Returns the multiply–adds of `steps` explicit steps, three for each entry of C.
double explicit_operations(const SmoothingSubject& subject, int steps);

/// Returns "random triangles on the torus".
inline std::string sampled(MeshKind kind, std::string_view surface) {
    return words.line("case.sampling", "triangles"_a = name_of(kind), "surface"_a = surface);
}

}   // namespace meshfolio::claims
