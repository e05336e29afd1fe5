/// @file
/// Claims of earlier reports and papers as data: what each is about, the rule that makes it true, its measurement, and the verdict; and the
/// bench that measures them.
/// The words of a claim are messages: "<id>.said" is the claim, "<id>.case…" and "<id>.remark…" describe what was measured.
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

/// "✓ holds", "◐ holds with condition", "✗ refuted", "? not decidable here".
std::string label_of(Verdict verdict);

/// The condition under which a claim is true: a quantity on the right side of a threshold, in every case.
struct Rule {
    std::string_view quantity;   // "apart": the message "quantity.apart" names it
    std::string_view unit;       // "%"; empty: a pure number
    enum class Relation { at_most, at_least } relation = Relation::at_most;
    double threshold = 0;   // in that unit

    bool satisfied_by(double value) const { return relation == Relation::at_most ? value <= threshold : value >= threshold; }
};
/// "≤ 5 %".
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

/// Measures a claim on those of its meshes that may be measured: each another mesh, at least as many as are compared.
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

/// "0.35 %", "0.35": a value with the unit of the rule.
std::string with_unit(double value, const Rule& rule);
/// "Required: Dirichlet energy left, over that of the input, ≤ 2 %."
report::Text rule_text(const JudgedClaim& judged);
/// The verdict, the deciding numbers, the remark, and the meshes measured.
report::Text verdict_text(const JudgedClaim& judged);

extern const std::vector<Claim> curvature_claims, spectral_claims, explicit_claims, implicit_claims, denoising_claims;
/// The claims of four earlier reports on the same coursework, S0 to S3, and of the papers they rest on: by question, then by subject.
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

/// Index of the smallest value: the best iteration.
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

    /// @throws MeshError if the mesh has more vertices than this run has time for
    const ReportMesh& mesh(std::string_view name);
    /// True if the named mesh itself is there, and no stand-in: by its counts, mean edge and λ_crit to 10⁻⁴ if those are known, else by the
    /// assignment's file in a data folder.
    bool is_itself(std::string_view name);
    bool has(std::string_view name, Property property);
    /// Chooses the meshes by the scope and the properties of the claim.
    Measurable measurable(const About& about);
    /// The positions without noise, which are known of the bundled noisy meshes only.
    std::optional<Positions> clean_form(std::string_view noisy);

    const SmoothingSubject& subject(std::string_view name);
    /// λ_crit of the uniform operator.
    double uniform_limit(std::string_view name);

    /// Carries a step over from the original mesh: on a stand-in, the same multiple of the largest stable step. [length²]
    double raw_step(std::string_view name, double lambda);
    /// Carries a length (or with power 2 an area) over from the original mesh: on a stand-in, the same multiple of the mean edge.
    double raw_length(std::string_view name, double length, int power = 1);

    /// The result of a run without noise.
    const Smoothed& run(std::string_view name, const RunKey& key);
    /// rms distance of the result of a run from the mesh [length].
    double motion(std::string_view name, const RunKey& key);
    /// rms error of a run with noise against the mesh itself, after t = 0, 1, … iterations, up to the collapse of a rebuilt run. [length]
    const std::vector<double>& denoised(std::string_view name, const RunKey& key);

    /// The errors left on a noisy mesh, with a known clean form, by runs that differ in λ alone; on the plane only heights count.
    Sweep sweep(std::string_view noisy, RunKey key, std::vector<double> lambdas);

    /// Computes 150 modes, fewer on smaller meshes.
    const SpectralStudy& spectrum(std::string_view name);

    /// Estimates of curvature on a surface with a closed form, between two levels of 3 to 5.
    BenchRun curvature(const std::string& surface, MeshKind kind, int coarse, int fine) const;
    /// A flat square of irregular triangles.
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

/// Measures a case for each of these values.
inline Measure at_each(std::vector<double> values, Case (*case_at)(ClaimBench& bench, double value)) {
    return [=](ClaimBench& bench, const MeshNames&) {
        return Measurement{.cases = each_of(values, [&](double value) { return case_at(bench, value); })};
    };
}
/// Adds the message "<id>.remark" to the measurement.
inline Measure remarked(const Measure& measure) {
    return [=](ClaimBench& bench, const MeshNames& meshes) {
        Measurement m = measure(bench, meshes);
        m.remarked = true;
        return m;
    };
}

/// √(Σ A_i|(Lx)_i|²), the root of four times the integral of H²; zigzags dominate it. [1]
double roughness(const SmoothingSubject& subject, const Positions& X);

/// Multiply–adds of `steps` implicit steps and of their factorisation, which counts with its lower bound nnz²/n.
double implicit_operations(const Smoothed& run, int steps);
/// Multiply–adds of `steps` explicit steps.
double explicit_operations(const SmoothingSubject& subject, int steps);

/// "random triangles on the torus".
inline std::string sampled(MeshKind kind, std::string_view surface) {
    return words.line("case.sampling", "triangles"_a = name_of(kind), "surface"_a = surface);
}

}   // namespace meshfolio::claims
