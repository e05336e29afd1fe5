#include "run/lab/lab_mesh.h"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/smoothing/dirichlet_energy.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "geometry/spectrum/stability.h"
#include "mesh/decimation.h"
#include "mesh/mesh_topology.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"

namespace meshfolio::run {

namespace {

constexpr int most_iterations = 200;   // of which the best are looked for, as many as the page's own slider has

/// Where the page shows the program's number beside its own: its presets, what its panels open with, and some between.
std::vector<LabSetting> reference_settings(const LabMesh& lab) {
    std::vector<LabSetting> settings;
    for (const LabPreset& preset : lab.presets) settings.push_back(preset.setting);
    for (const auto& [question, start] : lab.starts) settings.push_back(start);
    for (const int k : {60, 100}) settings.push_back({"projection", 0, k});
    settings.push_back({"explicit", 1.01, 40});
    settings.push_back({"implicit", 5, 10});
    for (const int t : {1, 2, 5, 10, 20, 50}) settings.push_back({"explicit", 0.25, t, 0.01});
    return settings;
}

Positions noisy(const LabMesh& lab, const LabSetting& setting) {
    if (setting.sigma == 0) return lab.mesh.X;
    return with_gaussian_noise(lab.mesh.X, Vector3::Constant(setting.sigma * lab.diagonal), setting.seed);
}

Positions step(const LabMesh& lab, const LabSetting& setting, const Positions& X) {
    const double lambda = setting.lambda * lab.critical();
    if (setting.scheme == "implicit") return implicit_step(lab.laplacian, lambda, X);
    const Positions smoothed = explicit_step(lab.laplacian, lambda, X);
    if (setting.scheme == "explicit") return smoothed;
    return explicit_step(lab.laplacian, taubin_mu_of(lab.laplacian, {.lambda = lambda}), smoothed);
}

/// What one step multiplies the modes of eigenvalues μ by.
Vector factors(const LabMesh& lab, const LabSetting& setting, const Vector& mu) {
    const double lambda = setting.lambda * lab.critical();
    if (setting.scheme == "implicit") return (1 + lambda * mu.array()).inverse();
    if (setting.scheme == "heat") return (-lambda * mu.array()).exp();
    if (setting.scheme == "explicit") return 1 - lambda * mu.array();
    return (1 - lambda * mu.array()) * (1 - taubin_mu_of(lab.laplacian, {.lambda = lambda}) * mu.array());
}

/// By the steps of `meshfolio smooth`; of the exact flow, which has none, by its modes.
Positions filtered(const LabMesh& lab, const Spectrum& spectrum, const LabSetting& setting) {
    Positions X = noisy(lab, setting);
    if (setting.scheme == "projection") return reconstruct(spectrum, lab.laplacian.M, X, setting.count);
    if (setting.scheme == "heat") {
        const Vector decay = factors(lab, setting, spectrum.eigenvalues).array().pow(setting.count);
        return spectrum.eigenvectors * (decay.asDiagonal() * spectral_coefficients(spectrum, lab.laplacian.M, X));
    }
    for (int t = 0; t < setting.count; ++t) X = step(lab, setting, X);
    return X;
}

double rms_to_clean(const LabMesh& lab, const Positions& X) {
    const Vector& M = lab.laplacian.M;
    return std::sqrt(M.dot((X - lab.mesh.X).rowwise().squaredNorm()) / M.sum());
}

int best_iterations(const LabMesh& lab, const LabSetting& setting) {
    Positions X = noisy(lab, setting);
    double least = rms_to_clean(lab, X);
    int best = 0;
    for (int t = 1; t <= most_iterations; ++t) {
        X = step(lab, setting, X);
        if (const double rms = rms_to_clean(lab, X); rms < least) least = rms, best = t;
    }
    return best;
}

double largest_factor(const LabMesh& lab, const LabSetting& setting) {
    if (setting.scheme == "projection") return 1;
    const double constant = 1e-9 * lab.largest_eigenvalue;   // modes of eigenvalue 0, but for rounding: one a component
    Vector mu = (lab.eigenvalues.array() > constant).select(lab.eigenvalues, lab.largest_eigenvalue);
    return factors(lab, setting, mu).lpNorm<Eigen::Infinity>();
}

void add_presets(LabMesh& lab) {
    for (LabPreset preset : lab_presets()) {
        if (preset.setting.scheme != "projection" && !lab.has_all_modes()) continue;
        if (preset.setting.count == best_count) preset.setting.count = best_iterations(lab, preset.setting);
        lab.presets.push_back(preset);
    }
}

void add_readings(LabMesh& lab, const Spectrum& spectrum) {
    for (const LabSetting& setting : reference_settings(lab)) {
        const bool projects = setting.scheme == "projection";
        if (projects ? setting.count > spectrum.eigenvalues.size() : !lab.has_all_modes()) continue;
        const Positions X = filtered(lab, spectrum, setting);
        const LabReading reading{setting, dirichlet_energy(lab.laplacian.C, X), signed_volume(moved_to(lab.mesh, X), Vector3::Zero()),
                                 rms_to_clean(lab, X), largest_factor(lab, setting)};
        if (std::isfinite(reading.energy) && std::isfinite(reading.volume)) lab.readings.push_back(reading);
    }
}

void quantise(LabMesh& lab, const Spectrum& spectrum) {
    lab.modes = quantised(spectrum.eigenvectors);
    Spectrum rounded = spectrum;
    rounded.eigenvectors = lab.modes.restored();
    const DenseMatrix shift = (rounded.eigenvectors - spectrum.eigenvectors) * lab.coefficients;
    lab.quantisation_shift = shift.rowwise().norm().maxCoeff() / lab.diagonal;
    lab.orthonormality_error = orthonormality_error(rounded, lab.laplacian.M);
}

template <class Number, class Values>
void append(std::string& bytes, const Values& values) {
    static_assert(std::endian::native == std::endian::little, "the page reads little endian");
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = values;
    bytes.append(reinterpret_cast<const char*>(rows.data()), static_cast<std::size_t>(rows.size()) * sizeof(Number));
}

/// As a state of the page (templates/viewer/lab_state.js), σ in percent.
nlohmann::json json_of(const LabSetting& setting) {
    nlohmann::json state = {{"scheme", setting.scheme}, {"sigma", 100 * setting.sigma}, {"seed", setting.seed}};
    state[setting.scheme == "projection" ? "k" : "t"] = setting.count;
    if (setting.lambda != 0) state["lambda"] = setting.lambda;
    return state;
}

nlohmann::json json_of(const LabReading& r) {
    return {{"state", json_of(r.setting)}, {"energy", r.energy}, {"volume", r.volume}, {"rms", r.rms}, {"factor", r.factor}};
}

nlohmann::json json_of(const LabPreset& preset) {
    nlohmann::json state = json_of(preset.setting);
    state["lines"] = preset.shows_drift;
    return {{"question", preset.question}, {"words", preset.words}, {"state", state}};
}

std::string header_of(const LabMesh& lab) {
    nlohmann::json readings = nlohmann::json::array(), presets = nlohmann::json::array(), starts;
    for (const LabReading& reading : lab.readings) readings.push_back(json_of(reading));
    for (const LabPreset& preset : lab.presets) presets.push_back(json_of(preset));
    for (const auto& [question, start] : lab.starts) starts[question] = json_of(start);
    const nlohmann::json header = {{"name", lab.name},
                                   {"sourceVertices", lab.source_vertices},
                                   {"isDecimated", lab.is_decimated},
                                   {"isClosed", lab.is_closed},
                                   {"vertices", lab.mesh.vertex_count()},
                                   {"triangles", lab.mesh.face_count()},
                                   {"modes", lab.eigenvalues.size()},
                                   {"diagonal", lab.diagonal},
                                   {"largestEigenvalue", lab.largest_eigenvalue},
                                   {"leftOut", lab.left_out},
                                   {"quantisationShift", lab.quantisation_shift},
                                   {"orthonormalityError", lab.orthonormality_error},
                                   {"starts", starts},
                                   {"presets", presets},
                                   {"readings", readings}};
    return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}   // namespace

LabMesh lab_mesh(const TriangleMesh& source, const std::string& name, const std::map<std::string, QuestionSettings>& questions,
                 const LabLimits& limits) {
    LabMesh lab;
    lab.name = name;
    lab.source_vertices = source.vertex_count();
    lab.mesh = without_unreferenced_vertices(source).mesh;
    lab.is_decimated = limits.vertices > 0 && lab.mesh.vertex_count() > limits.vertices;
    if (lab.is_decimated) lab.mesh = decimated(lab.mesh, limits.decimated_to);
    const Box box = bounding_box(lab.mesh);
    lab.mesh.X = lab.mesh.X.rowwise() - box.centre().transpose();
    lab.diagonal = box.diagonal();
    lab.is_closed = topology_of(lab.mesh).boundary_edge_count() == 0;
    lab.laplacian = laplace_beltrami(lab.mesh);

    const int n = lab.mesh.vertex_count();
    const bool all = n <= limits.all_modes;
    const Spectrum spectrum = smallest_eigenpairs(lab.laplacian, all ? n : limits.fewer_modes, {.dense_below = limits.all_modes});
    lab.eigenvalues = spectrum.eigenvalues;
    lab.largest_eigenvalue = largest_eigenvalue(lab.laplacian).value;
    lab.coefficients = spectral_coefficients(spectrum, lab.laplacian.M, lab.mesh.X);
    const Vector rms = reconstruction_rms(spectrum, lab.laplacian.M, lab.mesh.X);
    lab.left_out = rms[rms.size() - 1];
    quantise(lab, spectrum);
    for (const auto& [question, settings] : questions) lab.starts[question] = start_of(question, settings, lab.critical());
    add_presets(lab);
    add_readings(lab, spectrum);
    return lab;
}

std::string bytes_of(const LabMesh& lab) {
    std::string header = header_of(lab);
    header.resize((header.size() + 4 + 7) / 8 * 8 - 4, ' ');
    std::string bytes;
    append<std::uint32_t>(bytes, Eigen::Matrix<std::uint32_t, 1, 1>(static_cast<std::uint32_t>(header.size())));
    bytes += header;
    append<double>(bytes, lab.eigenvalues);
    append<double>(bytes, lab.laplacian.M);
    append<double>(bytes, lab.mesh.X);
    append<double>(bytes, lab.coefficients);
    append<double>(bytes, lab.modes.scale);
    append<std::int32_t>(bytes, lab.mesh.F);
    for (const int shift : {8, 0}) {
        for (const std::int16_t number : lab.modes.numbers) bytes += static_cast<char>(static_cast<std::uint16_t>(number) >> shift & 0xff);
    }
    return bytes;
}

}   // namespace meshfolio::run
