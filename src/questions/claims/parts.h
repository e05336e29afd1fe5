/// @file
/// The bench that measures claims.
#pragma once

#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"
#include "questions/bench/smoothing_study.h"
#include "questions/bench/spectral_study.h"
#include "questions/claims/claim.h"
#include "questions/core/stand_ins.h"

namespace meshfolio::claims {

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
