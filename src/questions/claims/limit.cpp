// Claims about the largest stable step of explicit smoothing, and about what lies beyond it.
#include <Eigen/Dense>

#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

Measurement largest_stable_is_best(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m{.remark = words.say("claims_s1_largest_stable.remark"), .figure = "claims_steps"};
    report::Plot plot{.id = m.figure, .x_label = "λ/λ_crit", .y_label = "roughness left, of the input", .log_y = true};
    for (const std::string_view name : meshes) {
        const SmoothingSubject& s = bench.subject(name);
        const double start = roughness(s, s.mesh().X);
        for (const int t : {10, 100}) {
            report::Series series{.name = s.name() + ", " + counted(t, "iteration"), .style = report::Series::Style::line_and_points};
            for (const double share : {0.25, 0.5, 0.75, 0.9, 0.99}) {
                series.x.push_back(share);
                series.y.push_back(roughness(s, bench.run(name, {explicit_euler, share * s.critical, t}).X) / start);
            }
            m.cases.push_back({series.name, series.y.back() / std::ranges::min(series.y)});
            plot.series.push_back(std::move(series));
        }
    }
    const bool falls =
        std::ranges::all_of(plot.series, [](const report::Series& s) { return std::ranges::is_sorted(s.y, std::ranges::greater()); });
    plot.caption = plot.alt = words.line(falls ? "plot.steps.falls" : "plot.steps.rises");
    bench.plots.push_back(std::move(plot));
    return m;
}

/// Second singular value over the first, of the positions about their mean.
double second_extent(const Positions& X) {
    const Positions centred = X.rowwise() - X.colwise().mean();
    const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred).eigenvalues();
    return std::sqrt(std::max(0.0, squares[1]) / squares[2]);
}

Measurement collapses_to_a_line(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m{.remark = words.say("claims_s1_line.remark")};
    for (const std::string_view name : meshes) {
        const SmoothingSubject& s = bench.subject(name);
        for (const double share : {1.5, 4.0}) {
            SmoothingOptions options;
            options.lambda = share * s.critical;
            options.iterations = 100;
            options.blow_up_at = 1e100;   // far beyond any picture: it is the end that the claim is about
            m.cases.push_back({s.name() + ", " + plain_text(share) + " λ_crit", 100 * second_extent(smooth(s.mesh(), options).X)});
        }
    }
    return m;
}

Measurement unstable_at_15(ClaimBench& bench, const MeshNames&) {
    const double limit = bench.uniform_limit("bunny");
    Measurement m{.cases = {{"uniform operator", 1.5 / limit}},
                  .remark = words.say("claims_s2_unstable.remark", "limit"_a = readable(limit, 4))};
    if (bench.is_itself("bunny"))   // an area means nothing on another mesh
        m.cases.push_back({words.line("claims_s2_unstable.case.cotangent"), 1.5 / bench.subject("bunny").critical});
    return m;
}

Measurement good_at_0005(ClaimBench& bench, const MeshNames&) {
    return {.cases = {{"the uniform operator", 0.005 / bench.uniform_limit("bunny")},
                      {"the cotangent operator", 0.005 / bench.subject("bunny").critical}},
            .remark = words.say("claims_s2_good_step.remark")};
}

Measurement distorts_beyond_one(ClaimBench& bench, const MeshNames&) {
    const double limit = bench.uniform_limit("fandisk_ns");
    return {.cases = each(std::array{1.05, 1.2, 1.5, 2.0},
                          [&](double lambda) {
                              return Case{"λ = " + plain_text(lambda), lambda / limit};
                          }),
            .remark = words.say("claims_s3_beyond_one.remark", "limit"_a = readable(limit, 4))};
}

}   // namespace

extern const std::vector<Claim> limit_claims{
    {"claims_s1_largest_stable", "q5", {{"bunny", "cow", "plane_ns"}}, {"over_least_roughness", "", at_most, 1.05}, largest_stable_is_best},
    {"claims_s1_line", "q5", {{"bunny", "cow"}}, {"second_extent", "%", at_most, 1}, collapses_to_a_line},
    {"claims_s2_unstable", "q5", {{"bunny"}}, {"step_over_limit", "", at_least, 1}, unstable_at_15, full},
    {"claims_s2_good_step", "q5", {{"bunny"}, {}, itself}, {"step_over_limit", "", at_most, 1}, good_at_0005},
    {"claims_s3_beyond_one", "q5", {{"fandisk_ns"}}, {"step_over_limit", "", at_least, 1}, distorts_beyond_one, full}};

}   // namespace meshfolio::claims
