// Claims about explicit smoothing: good steps, the largest stable step, and steps beyond it.
#include <Eigen/Dense>

#include "geometry/measures/mesh_laws.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

/// The step of the report over the limits of the operators with and without ½; without ½ the limit is half as large.
Measurement bunny_limit(ClaimBench& bench, const MeshNames&) {
    const double critical = bench.subject("bunny").critical, share = 2e-7 / critical;
    return {.cases = {{words.line("claims_s0_bunny_limit.case.half"), share}, {words.line("claims_s0_bunny_limit.case.whole"), 2 * share}},
            .remark = words.say("claims_s0_bunny_limit.remark", "limit"_a = readable(critical))};
}

Measurement bunny_zigzag(ClaimBench& bench, const MeshNames&) {
    const double lambda = bench.raw_step("bunny", 1e-7), share = lambda / bench.subject("bunny").critical;
    // Fifty steps are enough: a run that crosses the limit does so early. Every step needs an eigenvalue.
    const int steps = bench.settings().laboratory ? 100 : 50;
    const Smoothed flow =
        smooth(bench.mesh("bunny").mesh->mesh(), {.lambda = lambda, .iterations = steps, .rebuild = true, .monitor = true});
    Measurement m{.cases = {{words.line("claims_s0_bunny_zigzag.case.half"), share},
                            {words.line("claims_s0_bunny_zigzag.case.whole"), 2 * share},
                            {words.line("claims_s0_bunny_zigzag.case.rebuilt"), largest_product(flow) / 2}}};
    if (const int step = flow.crossing_iteration; step > 0) m.remark = words.say("claims_s0_bunny_zigzag.remark", "step"_a = step);
    return m;
}

/// Largest distance from the centre in the last finite positions of 100 steps, in box diagonals of the mesh.
Case bunny_reach(ClaimBench& bench, double lambda) {
    const double step = bench.raw_step("bunny", lambda);
    const Box box = bounding_box(bench.mesh("bunny").mesh->mesh());
    const Positions& X = bench.run("bunny", {explicit_euler, step, 100}).X;
    return {words.line("claims_s0_bunny_too_large.case", "lambda"_a = readable(lambda, 1),
                       "limits"_a = readable(step / bench.subject("bunny").critical)),
            (X.rowwise() - box.centre().transpose()).rowwise().norm().maxCoeff() / box.diagonal()};
}
const Measure bunny_too_large = remarked(at_each({8e-7, 3e-6, 1e-5, 1e-4}, bunny_reach));

/// Roughness left by ten steps of λ, over that left by a hundred of λ/10.
double coarse_over_fine(ClaimBench& bench, double lambda, OperatorKind kind = OperatorKind::cotan) {
    const SmoothingSubject& s = bench.subject("bunny");
    return roughness(s, bench.run("bunny", {explicit_euler, lambda, 10, kind}).X) /
           roughness(s, bench.run("bunny", {explicit_euler, lambda / 10, 100, kind}).X);
}

Measurement small_steps(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    double below = 0;
    for (const double share : {0.25, 0.5, 0.9, 1.5}) {
        m.cases.push_back({"λ = " + plain_text(share) + " λ_crit", coarse_over_fine(bench, share * bench.subject("bunny").critical)});
        if (share < 1) below = std::max(below, std::abs(m.cases.back().value - 1));
    }
    m.remark = words.say("claims_s0_small_steps.remark", "change"_a = readable_percent(below, 2));
    return m;
}

Case uniform_steps(ClaimBench& bench, double lambda) {
    return {"uniform, λ = " + plain_text(lambda), coarse_over_fine(bench, lambda, OperatorKind::uniform)};
}
const Measure small_uniform_steps = remarked(at_each({0.05, 0.5, 1}, uniform_steps));

/// rms distance of the cube's vertices from their mean after `iterations` steps of 10⁻³, over that of the input.
double size_left(ClaimBench& bench, int iterations) {
    const auto size = [](const Positions& X) { return std::sqrt((X.rowwise() - X.colwise().mean()).squaredNorm() / double(X.rows())); };
    const RunKey key{explicit_euler, bench.raw_step("cube", 1e-3), iterations};
    return size(bench.run("cube", key).X) / size(bench.mesh("cube").mesh->mesh().X);
}

Measurement cube_too_large(ClaimBench& bench, const MeshNames&) {
    return {.cases = {{"λ = 10⁻³", 100 * bench.raw_step("cube", 1e-3) / bench.subject("cube").critical}},
            .remark = words.say("claims_s0_cube_too_large.remark", "size"_a = readable_percent(size_left(bench, 100)))};
}

Case cube_shrunk(ClaimBench& bench, double t) {
    return {counted(static_cast<int>(t), "iteration"), 100 * (1 - size_left(bench, static_cast<int>(t)))};
}
const Measure cube_deforms = remarked(at_each({1, 10, 100}, cube_shrunk));

Measurement limits_differ(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m{.remarked = true};
    const auto limit = [&](std::string_view name) {   // [squared mean edges]
        const SmoothingSubject& subject = bench.subject(name);
        return subject.critical / (subject.mean_edge * subject.mean_edge);
    };
    const double first = limit(meshes.front());
    for (std::size_t i = 1; i < meshes.size(); ++i) {
        const double other = limit(meshes[i]);
        m.cases.push_back({listed({bench.mesh(meshes.front()).mesh->name, bench.mesh(meshes[i]).mesh->name}),
                           std::max(first, other) / std::min(first, other)});
    }
    return m;
}

Measurement largest_stable_is_best(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m{.remarked = true, .figure = "claims_steps"};
    report::Plot plot{.id = m.figure, .x_label = "λ/λ_crit", .y_label = "roughness left, of the input", .log_y = true};
    for (const std::string_view name : meshes) {
        const SmoothingSubject& s = bench.subject(name);
        const double start = roughness(s, s.mesh().X);
        for (const int t : {10, 100}) {
            report::Series series{.name = s.name(), .style = report::Series::Style::line_and_points, .panel = counted(t, "iteration")};
            for (const double share : {0.25, 0.5, 0.75, 0.9, 0.99})
                add_point(series, share, roughness(s, bench.run(name, {explicit_euler, share * s.critical, t}).X) / start);
            m.cases.push_back({series.name + ", " + series.panel, series.y.back() / std::ranges::min(series.y)});
            plot.series.push_back(std::move(series));
        }
    }
    const bool falls =
        std::ranges::all_of(plot.series, [](const report::Series& s) { return std::ranges::is_sorted(s.y, std::ranges::greater()); });
    plot.caption = words.line(falls ? "plot.steps.falls" : "plot.steps.rises");
    bench.plots.push_back(std::move(plot));
    return m;
}

/// Second singular value over the first, of the positions about their mean, after 100 steps beyond the limit.
Measurement collapses_to_a_line(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m{.remarked = true};
    for (const std::string_view name : meshes) {
        const SmoothingSubject& s = bench.subject(name);
        for (const double share : {1.5, 4.0}) {
            // The claim is about the final shape: the run must not stop early.
            const SmoothingOptions options{.lambda = share * s.critical, .iterations = 100, .blow_up_at = 1e100};
            const Positions X = smooth(s.mesh(), options).X, centred = X.rowwise() - X.colwise().mean();
            const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred).eigenvalues();
            m.cases.push_back({s.name() + ", " + plain_text(share) + " λ_crit", 100 * std::sqrt(std::max(0.0, squares[1]) / squares[2])});
        }
    }
    return m;
}

Measurement unstable_at_15(ClaimBench& bench, const MeshNames&) {
    const double limit = bench.uniform_limit("bunny");
    Measurement m{.cases = {{"uniform operator", 1.5 / limit}},
                  .remark = words.say("claims_s2_unstable.remark", "limit"_a = readable(limit, 4))};
    if (bench.is_itself("bunny"))   // a step in absolute units says nothing of another mesh
        m.cases.push_back({words.line("claims_s2_unstable.case.cotangent"), 1.5 / bench.subject("bunny").critical});
    return m;
}

Measurement good_at_0005(ClaimBench& bench, const MeshNames&) {
    return {.cases = {{"the uniform operator", 0.005 / bench.uniform_limit("bunny")},
                      {"the cotangent operator", 0.005 / bench.subject("bunny").critical}},
            .remarked = true};
}

Measurement distorts_beyond_one(ClaimBench& bench, const MeshNames&) {
    const double limit = bench.uniform_limit("fandisk_ns");
    Measurement m{.remark = words.say("claims_s3_beyond_one.remark", "limit"_a = readable(limit, 4))};
    for (const double lambda : {1.05, 1.2, 1.5, 2.0}) m.cases.push_back({"λ = " + plain_text(lambda), lambda / limit});
    return m;
}

/// Measures the error left by ten steps of this λ, over that of the best of five λ, for either scheme.
Measure good_step(double lambda) {
    return [=](ClaimBench& bench, const MeshNames& meshes) {
        const auto with = [&](SmoothingScheme scheme) {
            return bench.sweep(meshes.front(), {scheme, 0, 10, OperatorKind::uniform}, {0.1, 0.25, 0.5, 0.75, 1.0});
        };
        const Sweep by_explicit = with(explicit_euler), by_implicit = with(implicit_euler);
        Measurement m;
        m.cases = {{"explicit", by_explicit.at(lambda) / by_explicit.least()}, {"implicit", by_implicit.at(lambda) / by_implicit.least()}};
        m.remark =
            words.say("best_steps", "explicit"_a = plain_text(by_explicit.best_step()), "implicit"_a = plain_text(by_implicit.best_step()));
        return m;
    };
}

Measurement taubin_keeps_volume(ClaimBench& bench, const MeshNames& meshes) {
    constexpr double lambda = 0.6307, mu = -0.6732;   // Taubin's example for the uniform operator: pass-band 1/λ + 1/μ = 0.1
    Measurement m;
    double shrunk = 0;
    for (const std::string_view name : meshes) {
        const LibraryMesh& source = *bench.mesh(name).mesh;
        const SmoothingOptions options{
            .scheme = taubin, .laplacian = OperatorKind::uniform, .lambda = lambda, .taubin_mu = mu, .iterations = 50};
        const double before = signed_volume(source.mesh());
        const auto lost = [&](const Positions& X) { return 1 - signed_volume(moved_to(source.mesh(), X)) / before; };
        m.cases.push_back({source.name + ", 50 double steps", 100 * lost(smooth(source.mesh(), options).X)});
        shrunk = std::max(shrunk, lost(bench.run(name, {explicit_euler, lambda, 50, OperatorKind::uniform}).X));
    }
    m.remark = words.say("claims_taubin_volume.remark", "shrunk"_a = readable_percent(shrunk, 2));
    return m;
}

/// λ_crit with the stiffness of the intrinsic Delaunay triangulation and the areas of the mesh, over that of the mesh.
Case delaunay_over_own(ClaimBench& bench, std::string_view name) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const LaplaceBeltrami delaunay = laplace_operator(source.mesh(), OperatorKind::idt_original_mass);
    return {source.name, largest_stable_step(largest_eigenvalue(delaunay)) / bench.subject(name).critical};
}
const Measure delaunay_limit = remarked(delaunay_over_own);

}   // namespace

extern const std::vector<Claim> explicit_claims{
    {"claims_s0_bunny_limit", "q5", {{"bunny"}, {}, itself}, {"step_over_limit.bunny", "", at_most, 1.05}, bunny_limit},
    {"claims_s0_bunny_zigzag", "q5", {{"bunny"}, {}, itself}, {"step_over_limit.in_use", "", at_least, 1}, bunny_zigzag, full},
    {"claims_s0_bunny_too_large", "q5", {{"bunny"}, {}, itself}, {"reach", "× the box diagonal", at_least, 1}, bunny_too_large},
    {"claims_s0_small_steps", "q5", {{"bunny"}}, {"large_over_small", "", at_least, 1.05}, small_steps},
    {"claims_s0_cube_too_large", "q5", {{"cube"}, {}, itself}, {"step_over_limit", "%", at_least, 100}, cube_too_large},
    {"claims_s0_cube_deforms", "q5", {{"cube"}, {}, itself}, {"shrinkage", "%", at_least, 10}, cube_deforms},
    {"claims_s0_limits_differ", "q5", {{"bunny", "cube", "cow"}, {}, any_mesh, 2}, {"limits", "", at_least, 2}, limits_differ},
    {"claims_s2_small_steps", "q5", {{"bunny"}}, {"large_over_small", "", at_least, 1.05}, small_uniform_steps, full},
    {"claims_s1_largest_stable", "q5", {{"bunny", "cow", "plane_ns"}}, {"over_least_roughness", "", at_most, 1.05}, largest_stable_is_best},
    {"claims_s1_line", "q5", {{"bunny", "cow"}}, {"second_extent", "%", at_most, 5}, collapses_to_a_line},
    {"claims_s2_unstable", "q5", {{"bunny"}}, {"step_over_limit", "", at_least, 1}, unstable_at_15, full},
    {"claims_s2_good_step", "q5", {{"bunny"}, {}, itself}, {"step_over_limit", "", at_most, 1}, good_at_0005},
    {"claims_s3_beyond_one", "q5", {{"fandisk_ns"}}, {"step_over_limit", "", at_least, 1}, distorts_beyond_one, full},
    {"claims_s3_plane_step", "q5", {{"plane_ns"}, {clean_known}, its_kind}, {"over_best_step", "", at_most, 1.1}, good_step(1)},
    {"claims_s3_fandisk_step", "q5", {{"fandisk_ns"}, {clean_known}, itself}, {"over_best_step", "", at_most, 1.1}, good_step(0.5), full},
    {"claims_rippa_delaunay", "q5", {{"bunny", "lilium", "plane_ns"}}, {"delaunay_limit", "", at_least, 1 - 1e-9}, delaunay_limit, full},
    {"claims_taubin_volume", "q5", {{"bunny", "bumpy_cube"}, {closed}}, {"volume_lost", "%", at_most, 1}, taubin_keeps_volume, full}};

}   // namespace meshfolio::claims
