/// @file
/// What claims are measured with. Meshes, operators, runs and spectra are computed once and shared.
#pragma once

#include <tuple>

#include "geometry/smoothing/laplacian_smoothing.h"
#include "questions/bench/cotangent_study.h"
#include "questions/bench/curvature_bench.h"
#include "questions/bench/smoothing_study.h"
#include "questions/bench/spectral_study.h"
#include "questions/claims/claim.h"
#include "questions/core/experiment.h"
#include "questions/core/stand_ins.h"

namespace meshfolio::claims {

/// What may be measured of what a claim is about.
struct Measurable {
    MeshNames meshes;
    std::string why_not;   // empty where it can be measured
};

/// A smoothing run from the mesh itself.
struct RunKey {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;   // [length²], or none for the uniform operator
    int iterations = 1;
    OperatorKind laplacian = OperatorKind::cotan;

    auto operator<=>(const RunKey&) const = default;
};

/// Seeded Gaussian noise on a mesh, smoothed again.
struct NoisyKey {
    Vector3 sigma = Vector3::Zero();   // of each axis [length]
    double lambda = 0;                 // as in RunKey
    int iterations = 1;
    SmoothingScheme scheme = SmoothingScheme::implicit_euler;
    OperatorKind laplacian = OperatorKind::cotan;   // of the noisy mesh
    bool rebuild = false;

    auto tied() const { return std::tuple(sigma[0], sigma[1], sigma[2], lambda, iterations, scheme, laplacian, rebuild); }
};

class ClaimBench {
public:
    ClaimBench(const MeshLibrary& library, const QuestionSettings& settings) : library_(library), settings_(settings) {}

    const QuestionSettings& settings() const { return settings_; }

    /// @throws MeshError where the mesh has more vertices than this run has time for
    const ReportMesh& mesh(std::string_view name);
    /// "bunny and creature in place of cow.off": for texts.
    std::string called(const MeshNames& names);
    /// Whether the named mesh itself is there, and no stand-in: by its counts, mean edge and λ_crit to 10⁻⁴ where those are known, else by
    /// the assignment's file in a data folder.
    bool is_itself(std::string_view name);
    bool has(std::string_view name, Property property);
    /// Chooses the meshes by the rule in claim.h.
    Measurable measurable(const About& about);
    /// The positions without noise, which are known of the bundled noisy meshes only.
    std::optional<Positions> clean_form(std::string_view noisy);

    const SmoothingSubject& subject(std::string_view name);
    /// λ_crit of the uniform operator.
    double uniform_limit(std::string_view name);

    /// A step that a report took on the original mesh; on a stand-in, the same multiple of the largest stable step.
    double raw_step(std::string_view name, double lambda);
    /// The same for a length or, with power 2, an area: the same multiple of the mean edge.
    double raw_length(std::string_view name, double length, int power = 1);

    const Smoothed& run(std::string_view name, const RunKey& key);
    /// rms distance of the result of a run from the mesh [length].
    double motion(std::string_view name, const RunKey& key);
    /// rms error against the mesh itself after t = 0, 1, … iterations, up to the collapse of a rebuilt run. [length]
    const std::vector<double>& denoised(std::string_view name, const NoisyKey& key);

    /// Computes 150 modes, fewer on smaller meshes.
    const SpectralStudy& spectrum(std::string_view name);

    /// Estimates of curvature on a surface with a closed form, between two levels of 3 to 5.
    BenchRun curvature(const std::string& surface, MeshKind kind, int coarse, int fine) const;
    /// A flat square of irregular triangles.
    const PlaneTest& plane();

    /// The meshes measured so far, as inputs, and what is wrong with them.
    std::vector<report::Input> inputs() const;
    Names warnings() const;

    std::vector<report::Plot> plots;   // that claims refer to, in the order they were made

private:
    bool in_scope(std::string_view name, About::Scope scope);

    const MeshLibrary& library_;
    const QuestionSettings& settings_;
    std::map<std::string, ReportMesh> meshes_;
    std::map<const LibraryMesh*, SmoothingSubject> subjects_;
    std::map<const LibraryMesh*, double> uniform_limits_;
    std::map<const LibraryMesh*, SpectralStudy> spectra_;
    std::map<const LibraryMesh*, ImplicitSolver> solvers_;
    std::map<std::pair<const LibraryMesh*, RunKey>, Smoothed> runs_;
    std::map<std::pair<const LibraryMesh*, decltype(NoisyKey().tied())>, std::vector<double>> noisy_runs_;
    std::unique_ptr<PlaneTest> plane_;
};

/// √(Σ A_i|(Lx)_i|²), four times the integral of H²: how bent the surface is, zigzags above all. [1]
double roughness(const SmoothingSubject& subject, const Positions& X);

/// Multiply–adds of so many implicit steps, with a lower bound nnz²/n of the factorisation; and of explicit ones.
double implicit_operations(const Smoothed& run, int steps);
double explicit_operations(const SmoothingSubject& subject, int steps);

/// Index of the smallest value: the best iteration.
int best_of(const std::vector<double>& errors);

}   // namespace meshfolio::claims
