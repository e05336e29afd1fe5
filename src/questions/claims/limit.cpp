// Claims about the largest stable step of explicit smoothing, and about what lies beyond it.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"

namespace meshfolio::claims {

namespace {

using enum SmoothingScheme;

Measurement largest_stable_is_best(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    report::Plot plot;
    plot.id = "claims_steps";
    plot.x_label = "λ/λ_crit";
    plot.y_label = "roughness left, of the input";
    plot.log_y = true;
    for (const std::string_view name : meshes) {
        const SmoothingSubject& s = bench.subject(name);
        const double start = roughness(s, s.mesh().X);
        for (const int t : {10, 100}) {
            report::Series series;
            series.name = s.name() + ", " + std::to_string(t) + " iterations";
            series.style = report::Series::Style::line_and_points;
            for (const double share : {0.25, 0.5, 0.75, 0.9, 0.99}) {
                series.x.push_back(share);
                series.y.push_back(roughness(s, bench.run(name, {explicit_euler, share * s.critical, t}).X) / start);
            }
            m.cases.push_back({series.name, series.y.back() / *std::min_element(series.y.begin(), series.y.end())});
            plot.series.push_back(std::move(series));
        }
    }
    bool falls = true;
    for (const report::Series& series : plot.series) falls = falls && std::is_sorted(series.y.rbegin(), series.y.rend());
    plot.caption = std::string("Roughness left after equally many explicit steps of different size, below the limit. ") +
                   (falls ? "Every curve falls to the right: the largest stable step leaves least."
                          : "Where a curve rises to the right, the largest stable step is not the best.");
    plot.alt = plot.caption;
    bench.plots.push_back(plot);
    m.figure = plot.id;
    m.remark = report::text("At 0.99 λ_crit the fastest mode is multiplied by −0.98 in every step: where a mesh has much of it, it stays.");
    return m;
}

/// Second singular value over the first, of the positions about their mean.
double second_extent(const Positions& X) {
    const Positions centred = X.rowwise() - X.colwise().mean();
    const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred).eigenvalues();
    return std::sqrt(std::max(0.0, squares[1]) / squares[2]);
}

Measurement collapses_to_a_line(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
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
    m.remark = report::text(
        "In the end the fastest mode outgrows all others, and one mode times one direction is a line; 100 iterations are not the end where "
        "a second one grows nearly as fast.");
    return m;
}

Measurement unstable_at_15(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {{"uniform operator", 1.5 / bench.uniform_limit("bunny")}};
    if (bench.is_itself("bunny"))   // an area means nothing on another mesh
        m.cases.push_back({"cotangent operator, λ in the mesh's own unit", 1.5 / bench.subject("bunny").critical});
    m.remark = report::text("The uniform limit is ", readable(bench.uniform_limit("bunny"), 4), ".");
    return m;
}

Measurement good_at_0005(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    m.cases = {{"the uniform operator", 0.005 / bench.uniform_limit("bunny")},
               {"the cotangent operator", 0.005 / bench.subject("bunny").critical}};
    m.remark = report::text(
        "So the report's explicit runs can only have used the uniform operator, while its implicit λ = 5 × 10⁻⁸ has the "
        "size of a cotangent one: the two are not the same quantity.");
    return m;
}

Measurement distorts_beyond_one(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const double limit = bench.uniform_limit("fandisk_ns");
    for (const double lambda : {1.05, 1.2, 1.5, 2.0}) m.cases.push_back({"λ = " + plain_text(lambda), lambda / limit});
    m.remark = report::text("The uniform limit here is ", readable(limit, 4), ". From 1 to there modes overshoot, but decay.");
    return m;
}

}   // namespace

const std::vector<Claim>& limit_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    static const std::vector<Claim> claims{
        {"claims_s1_largest_stable",
         "S1",
         "",
         "q5",
         "The best explicit step is the largest that is still stable.",
         {{"bunny", "cow", "plane_ns"}},
         {"the roughness left by 0.99 λ_crit over the least left by any smaller step tried, after equally many iterations", "", at_most,
          1.05},
         Effort::quick,
         largest_stable_is_best},
        {"claims_s1_line",
         "S1",
         "",
         "q5",
         "Beyond the limit 100 iterations collapse the mesh to a line.",
         {{"bunny", "cow"}},
         {"the second extent of the positions over the first, after 100 iterations", "%", at_most, 1},
         Effort::quick,
         collapses_to_a_line},
        {"claims_s2_unstable",
         "S2",
         "",
         "q5",
         "λ = 1.5 is unstable.",
         {{"bunny"}},
         {"λ over the largest stable λ", "", at_least, 1},
         Effort::full,
         unstable_at_15},
        {"claims_s2_good_step",
         "S2",
         "",
         "q5",
         "On the bunny, λ = 0.005 is a good explicit step.",
         {{"bunny"}, itself},
         {"λ over the largest stable λ", "", at_most, 1},
         Effort::quick,
         good_at_0005},
        {"claims_s3_beyond_one",
         "S3",
         "",
         "q5",
         "With the uniform operator, λ above 1 distorts the mesh.",
         {{"fandisk_ns"}},
         {"λ over the largest stable λ", "", at_least, 1},
         Effort::full,
         distorts_beyond_one},
    };
    return claims;
}

}   // namespace meshfolio::claims
