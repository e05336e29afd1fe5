#include <Eigen/Geometry>

#include "geometry/curvature/curvature.h"
#include "geometry/smoothing/stability_certificate.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/certificates/parts.h"
#include "questions/certificates/planted_faults.h"

namespace meshfolio::certificates {

namespace {

constexpr int modes = 12;

/// Checks the claim of complete_shift by the inertia.
report::Check claimed_count_check(const Specimen& s) try {
    const Inertia inertia = eigenvalues_below(s.laplacian, s.complete_shift);
    const report::Check check = check_near(law("claimed_count"), s.modes_known, inertia.below, 0);
    const double gap = (s.spectrum.eigenvalues.array() - s.complete_shift).abs().minCoeff();
    return inertia.delta < gap ? check : undecided(check, cannot_be_proved(inertia.delta, gap));
} catch (const SolverError&) {
    return undecided(check_near(law("claimed_count"), s.modes_known, undefined, 0), words.line("pivot_lost"));
}

// ---- the faults -------------------------------------------------------------------------------------------------------

/// Returns the triangle and the corner with the median cotangent, far from needles and right angles.
std::pair<Eigen::Index, int> typical_corner(const CornerValues& cotangents) {
    std::vector<double> sorted(cotangents.data(), cotangents.data() + cotangents.size());
    const auto middle = sorted.begin() + sorted.size() / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    Eigen::Index t = 0, k = 0;
    (cotangents.array() - *middle).abs().minCoeff(&t, &k);
    return {t, static_cast<int>(k)};
}

void turn_one_cotangent(Specimen& s) {
    CornerValues cotangents = corner_cotangents(s.mesh);
    const auto [t, k] = typical_corner(cotangents);
    cotangents(t, k) *= -1;
    s.laplacian.C = cotangent_stiffness(s.mesh.F, s.mesh.vertex_count(), cotangents);
}

void leave_out_a_triangle(Specimen& s) {
    CornerValues cotangents = corner_cotangents(s.mesh);
    cotangents.row(typical_corner(cotangents).first).setZero();
    s.laplacian.C = cotangent_stiffness(s.mesh.F, s.mesh.vertex_count(), cotangents);
}

void drop_a_mode(Specimen& s) {
    constexpr Eigen::Index dropped = modes / 2, rest = modes - dropped - 1;
    s.spectrum.eigenvalues.segment(dropped, rest) = s.spectrum.eigenvalues.tail(rest).eval();
    s.spectrum.eigenvectors.middleCols(dropped, rest) = s.spectrum.eigenvectors.rightCols(rest).eval();
    s.spectrum.eigenvalues.conservativeResize(modes - 1);
    s.spectrum.eigenvectors.conservativeResize(Eigen::NoChange, modes - 1);
}

/// Replaces φ by ψ = M^½φ, scaled to the length of φ: the eigenvector of M^−½CM^−½, mistaken for that of the mesh.
void forget_to_map_back(Specimen& s) {
    const Vector phi = s.spectrum.eigenvectors.col(5);
    const Vector psi = s.laplacian.M.cwiseSqrt().cwiseProduct(phi);
    s.spectrum.eigenvectors.col(5) = psi / std::sqrt(s.laplacian.M.dot(psi.cwiseAbs2()));
}

}   // namespace

std::vector<PlantedFault> planted_faults() {
    return {{words.line("fault.one_cotangent"), law("first_variation"), turn_one_cotangent},
            {words.line("fault.all_cotangents"), law("semidefinite"), [](Specimen& s) { s.laplacian.C *= -1; }},
            {words.line("fault.half"), law("energy"), [](Specimen& s) { s.laplacian.C *= 2; }},
            {words.line("fault.triangle"), law("energy"), leave_out_a_triangle},
            {words.line("fault.one_side"), law("symmetric"),
             [](Specimen& s) {
                 SparseMatrix::InnerIterator entry(s.laplacian.C, 0);
                 while (entry.row() == entry.col()) ++entry;
                 entry.valueRef() *= 2;
             }},
            {words.line("fault.diagonal"), law("row_sums"), [](Specimen& s) { s.laplacian.C.coeffRef(0, 0) *= 1.01; }},
            {words.line("fault.areas"), law("mass"), [](Specimen& s) { s.laplacian.M *= 2; }},
            {words.line("fault.vertex"), law("first_variation"), [](Specimen& s) { s.mesh.X.row(s.mesh.vertex_count() / 2) *= 1.001; }},
            {words.line("fault.face_reversed"), law("half_edges"), [](Specimen& s) { std::swap(s.mesh.F(0, 1), s.mesh.F(0, 2)); }},
            {words.line("fault.face_missing"), law("flux"), [](Specimen& s) { s.mesh.F.conservativeResize(s.mesh.F.rows() - 1, 3); }},
            {words.line("fault.inside_out"), law("outward"), [](Specimen& s) { s.mesh.F.col(1).swap(s.mesh.F.col(2)); }},
            {words.line("fault.angle"), law("gauss_bonnet"),
             [](Specimen& s) { s.angle_deficits[s.mesh.F(0, 0)] += corner_angles(s.mesh)(0, 0); }},
            {words.line("fault.mode"), law("complete"), drop_a_mode},
            {words.line("fault.eigenvector"), law("orthonormal"),
             [](Specimen& s) { s.spectrum.eigenvectors.col(5) = s.spectrum.eigenvectors.col(4); }},
            {words.line("fault.not_mapped_back"), law("residual"), forget_to_map_back},
            {words.line("fault.too_long"), law("parseval"), [](Specimen& s) { s.spectrum.eigenvectors.col(2) *= 1.001; }},
            {words.line("fault.zero"), law("zeros"), [](Specimen& s) { s.spectrum.eigenvalues[1] = 0; }},
            {words.line("fault.order"), law("ascending"),
             [](Specimen& s) {
                 std::swap(s.spectrum.eigenvalues[5], s.spectrum.eigenvalues[8]);
                 s.spectrum.eigenvectors.col(5).swap(s.spectrum.eigenvectors.col(8));
             }},
            {words.line("fault.shift_of_inertia"), law("claimed_count"),
             [](Specimen& s) { s.complete_shift = (1 - 1e-4) * s.spectrum.eigenvalues[modes - 1]; }},
            {words.line("fault.shift_of_limit"), law("stable"), [](Specimen& s) { s.stable_shift *= 1 - 1e-6; }}};
}

Specimen sound_specimen(const TriangleMesh& mesh) {
    Specimen s;
    s.mesh = mesh;
    const MeshTopology topology = topology_of(mesh);
    s.claims.euler_characteristic = mesh.vertex_count() - static_cast<int>(topology.edges.size()) + mesh.face_count();
    s.laplacian = laplace_beltrami(mesh);
    s.angle_deficits = angle_deficit(mesh, topology);
    s.spectrum = smallest_eigenpairs(s.laplacian, modes + 1, {.dense_below = 200});
    s.complete_shift = 0.5 * (s.spectrum.eigenvalues[modes - 1] + s.spectrum.eigenvalues[modes]);
    s.spectrum.eigenvalues.conservativeResize(modes);
    s.spectrum.eigenvectors.conservativeResize(Eigen::NoChange, modes);
    s.modes_known = modes;
    s.stable_shift = stability_certificate(s.laplacian, {.assembly = Assembly::triangles}).mu_high;
    return s;
}

Specimen ellipsoid_specimen() { return sound_specimen(ellipsoid_mesh(3, {1.7, 1.1, 0.6})); }

std::vector<report::Check> checks_of(const Specimen& s) {
    std::vector<report::Check> checks = operator_checks(s.mesh, s.laplacian, "");
    std::ranges::move(surface_checks(s.mesh, s.angle_deficits, s.claims, ""), std::back_inserter(checks));
    std::ranges::move(spectrum_checks(certify_spectrum(s.mesh, s.laplacian, s.spectrum), ""), std::back_inserter(checks));
    checks.push_back(claimed_count_check(s));
    checks.push_back(check_near(law("stable"), 1, is_positive_definite_at(s.laplacian, s.stable_shift) ? 1 : 0, 0));
    return checks;
}

FaultTrial trial_of(const Specimen& specimen, const std::vector<report::Check>& sound_checks, const PlantedFault& fault) {
    Specimen damaged = specimen;
    fault.plant(damaged);
    const std::vector<report::Check> faulty_checks = checks_of(damaged);
    FaultTrial trial;
    trial.fault = fault.name;
    bool named = false;
    for (std::size_t i = 0; i < sound_checks.size(); ++i) {
        const report::Check &sound = sound_checks[i], &faulty = faulty_checks[i];
        if (sound.name == fault.check) {
            trial.sound = sound;
            trial.faulty = faulty;
            named = true;
        } else if (sound.passed() && faulty.failed()) {
            trial.also_seen_by.push_back(sound.name);
        }
    }
    if (!named) throw std::logic_error("no check is named '" + fault.check + "'");
    return trial;
}

std::vector<FaultTrial> trials_of(const Specimen& specimen) {
    const std::vector<report::Check> sound_checks = checks_of(specimen);
    return each_of(planted_faults(), [&](const PlantedFault& fault) { return trial_of(specimen, sound_checks, fault); });
}

report::Check check_of(const FaultTrial& trial) {
    return check_near(
        words.line("check.fault", "fault"_a = trial.fault, "check"_a = trial.sound.name), 1, trial.caught() ? 1 : 0, 0,
        words.line("check.fault.note", "sound"_a = plain_text(trial.sound.measured, 5), "faulty"_a = plain_text(trial.faulty.measured, 5)));
}

}   // namespace meshfolio::certificates
