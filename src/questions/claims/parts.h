/// @file
/// The bench that measures claims, and what the files of the chapter share.
#pragma once

#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"
#include "questions/bench/smoothing_study.h"
#include "questions/bench/spectral_study.h"
#include "questions/claims/claim.h"
#include "questions/core/stand_ins.h"

namespace meshfolio::claims {

inline constexpr report::Words words("claims");

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
    /// Chooses the meshes by the rule in claim.h.
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
