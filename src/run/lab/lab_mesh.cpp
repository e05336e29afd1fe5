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

/// Settings at which the page shows the program's number beside its own: those of its presets, and some between.
std::vector<LabSetting> reference_settings() {
    std::vector<LabSetting> settings;
    for (const int k : {5, 15, 30, 60, 100}) settings.push_back({"projection", 0, k, 0});
    for (const auto& [lambda, t] : {std::pair{0.5, 10}, {0.99, 40}, {1.01, 40}, {1.05, 40}, {2.0, 5}, {2.0, 6}})
        settings.push_back({"explicit", lambda, t, 0});
    for (const auto& [lambda, t] : {std::pair{2.0, 1}, {5.0, 10}, {100.0, 1}}) settings.push_back({"implicit", lambda, t, 0});
    settings.push_back({"taubin", 0.5, 20, 0});
    for (const int t : {0, 1, 2, 5, 10, 20, 50, 200}) settings.push_back({"explicit", 0.25, t, 0.01});
    return settings;
}

Positions noisy(const LabMesh& lab, const LabSetting& setting) {
    if (setting.sigma == 0) return lab.mesh.X;
    return with_gaussian_noise(lab.mesh.X, Vector3::Constant(setting.sigma * lab.diagonal), setting.seed);
}

/// By the steps of `meshfolio smooth`, not by modes.
Positions smoothed(const LabMesh& lab, const LabSetting& setting) {
    const double lambda = setting.lambda * lab.critical();
    const double back = setting.scheme == "taubin" ? taubin_mu_of(lab.laplacian, {.lambda = lambda}) : 0;
    Positions X = noisy(lab, setting);
    for (int t = 0; t < setting.count; ++t) {
        X = setting.scheme == "implicit" ? implicit_step(lab.laplacian, lambda, X) : explicit_step(lab.laplacian, lambda, X);
        if (setting.scheme == "taubin") X = explicit_step(lab.laplacian, back, X);
    }
    return X;
}

LabReading reading_of(const LabMesh& lab, const LabSetting& setting, const Positions& X) {
    const Vector& M = lab.laplacian.M;
    return {setting, dirichlet_energy(lab.laplacian.C, X), signed_volume(moved_to(lab.mesh, X), Vector3::Zero()),
            std::sqrt(M.dot((X - lab.mesh.X).rowwise().squaredNorm()) / M.sum())};
}

void add_readings(LabMesh& lab, const Spectrum& spectrum) {
    for (const LabSetting& setting : reference_settings()) {
        const bool projects = setting.scheme == "projection";
        if (projects ? setting.count > spectrum.eigenvalues.size() : !lab.has_all_modes()) continue;
        const Positions X = projects ? reconstruct(spectrum, lab.laplacian.M, lab.mesh.X, setting.count) : smoothed(lab, setting);
        const LabReading reading = reading_of(lab, setting, X);
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

nlohmann::json json_of(const LabReading& r) {
    return {{"scheme", r.setting.scheme}, {"lambda", r.setting.lambda}, {"count", r.setting.count}, {"sigma", r.setting.sigma},
            {"seed", r.setting.seed},     {"energy", r.energy},         {"volume", r.volume},       {"rms", r.rms}};
}

std::string header_of(const LabMesh& lab) {
    nlohmann::json readings = nlohmann::json::array();
    for (const LabReading& reading : lab.readings) readings.push_back(json_of(reading));
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
                                   {"readings", readings}};
    return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}   // namespace

LabMesh lab_mesh(const TriangleMesh& source, const std::string& name, const LabLimits& limits) {
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
