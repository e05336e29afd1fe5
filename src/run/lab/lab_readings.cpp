#include "run/lab/lab_mesh.h"

#include <cmath>

#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio::run {

namespace {

Positions noisy(const LabMesh& lab, const LabSetting& setting) {
    if (setting.sigma == 0) return lab.mesh.X;
    return with_gaussian_noise(lab.mesh.X, Vector3::Constant(setting.sigma * lab.diagonal), setting.seed);
}

/// Returns the factor by which one step multiplies each mode of eigenvalue μ.
Vector factors(const LabMesh& lab, const LabSetting& setting, const Vector& mu) {
    const double lambda = setting.lambda * lab.critical();
    if (setting.scheme == "implicit") return (1 + lambda * mu.array()).inverse();
    if (setting.scheme == "heat") return (-lambda * mu.array()).exp();
    if (setting.scheme == "explicit") return 1 - lambda * mu.array();
    return (1 - lambda * mu.array()) * (1 - taubin_mu_of(lab.laplacian, {.lambda = lambda}) * mu.array());
}

/// Returns the filtered positions: by `meshfolio smooth`, with the operator of the initial positions; the exact flow by its modes.
Positions filtered(const LabMesh& lab, const Spectrum& spectrum, const LabSetting& setting, Positions X) {
    if (setting.scheme == "projection") return reconstruct(spectrum, lab.laplacian.M, X, setting.count);
    if (setting.scheme == "heat") {
        const Vector decay = factors(lab, setting, spectrum.eigenvalues).array().pow(setting.count);
        const Positions flowed = spectrum.eigenvectors * (decay.asDiagonal() * spectral_coefficients(spectrum, lab.laplacian.M, X));
        return (lab.laplacian.M.array() > 0).replicate(1, 3).select(flowed, X);   // a vertex without area is in no mode and stays
    }
    const bool denoises = setting.scheme == "denoising";
    const double unit = denoises ? lab.mean_edge * lab.mean_edge : lab.critical();
    Smoothed run = smooth(moved_to(lab.mesh, std::move(X)), {.scheme = smoothing_scheme_named(denoises ? "implicit" : setting.scheme),
                                                             .lambda = setting.lambda * unit,
                                                             .iterations = setting.count});
    if (run.blew_up) run.X.setConstant(NAN);
    return std::move(run.X);
}

/// Returns the rms distance over the vertices, as in questions 5 to 7; of projections weighted by area, as in question 4. [length]
double rms_of(const LabMesh& lab, const LabSetting& setting, const Positions& X) {
    if (setting.scheme != "projection") return vertex_rms(lab.mesh.X, X);
    const Vector& M = lab.laplacian.M;
    return std::sqrt(M.dot((X - lab.mesh.X).rowwise().squaredNorm()) / M.sum());
}

double finest_factor(const LabMesh& lab, const LabSetting& setting) {
    const bool has_own_modes = setting.scheme != "projection" && setting.scheme != "denoising";
    return has_own_modes ? factors(lab, setting, Vector::Constant(1, lab.largest_eigenvalue))[0] : NAN;
}

/// Returns the three errors of some positions as a state of the denoising search.
SearchState judged(const LabMesh& lab, const Positions& normals, const Positions& X) {
    return {.shape = shape_rms(lab.mesh, X),
            .rms = vertex_rms(lab.mesh.X, X),
            .angle = mean_normal_angle(normals, face_normals(moved_to(lab.mesh, X)))};
}

LabReading reading_of(const LabMesh& lab, const LabSetting& setting, const Positions& before, const Positions& X) {
    LabReading reading{setting, dirichlet_energy(lab.laplacian.C, X), signed_volume(moved_to(lab.mesh, X), Vector3::Zero()),
                       rms_of(lab, setting, X), finest_factor(lab, setting)};
    if (setting.sigma == 0) return reading;
    const Positions normals = face_normals(lab.mesh);
    SearchResult result;
    result.noisy = judged(lab, normals, before);
    result.by_shape = result.by_rms = result.by_angle = judged(lab, normals, X);
    for (const Measure& measure : measures) reading.gains.push_back((result.*measure.gain)());
    return reading;
}

}   // namespace

std::vector<LabReading> readings_at(const LabMesh& lab, const Spectrum& spectrum, const std::vector<LabSetting>& settings) {
    std::vector<LabReading> readings;
    for (const LabSetting& setting : settings) {
        const Positions before = noisy(lab, setting), X = filtered(lab, spectrum, setting, before);
        if (!X.allFinite()) continue;
        const LabReading reading = reading_of(lab, setting, before, X);
        if (std::isfinite(reading.energy) && std::isfinite(reading.volume)) readings.push_back(reading);
    }
    return readings;
}

}   // namespace meshfolio::run
