// Claims about how much noise diffusion takes, given as a share of the box, axis by axis.
#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/claims/claim_bench.h"
#include "questions/claims/claim_list.h"
#include "questions/core/section_tools.h"

namespace meshfolio::claims {

namespace {

constexpr int box_iterations = 10;   // S1 took 200 of steps it does not name; ten of larger ones reach as far

/// The last error of each step, from 0.01 to 1000 squared mean edges, with noise of `percent` % of the box in each axis.
struct StepSweep {
    std::vector<double> multiples, errors;   // λ over the squared mean edge; rms after `box_iterations` [length]
    double noisy = 0;                        // rms before [length]
    int best() const { return best_of(errors); }
};
StepSweep step_sweep(ClaimBench& bench, std::string_view name, double percent) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const double edge = source.prepared->preflight.mean_edge;
    StepSweep sweep;
    for (const double multiple : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0}) {
        NoisyKey key;
        key.sigma = 0.01 * percent * bounding_box(source.mesh()).extent();
        key.lambda = multiple * edge * edge;
        key.iterations = box_iterations;
        const std::vector<double> errors = bench.denoised(name, key);
        sweep.multiples.push_back(multiple);
        sweep.errors.push_back(errors.back());
        sweep.noisy = errors.front();
    }
    return sweep;
}

Measurement more_noise_larger_step(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const StepSweep low = step_sweep(bench, "bunny", 1), high = step_sweep(bench, "bunny", 5);
    const double a = low.multiples[static_cast<std::size_t>(low.best())], b = high.multiples[static_cast<std::size_t>(high.best())];
    m.cases = {{"5 % noise beside 1 %", b / a}};
    m.remark = report::text("The best of the steps tried is ", readable(a, 2), " squared mean edges for 1 %, ", readable(b, 2),
                            " for 5 %, at ", std::to_string(box_iterations), " iterations.");
    return m;
}

Measurement more_noise_worse_result(ClaimBench& bench, const MeshNames&) {
    Measurement m;
    const StepSweep low = step_sweep(bench, "bunny", 1), high = step_sweep(bench, "bunny", 5);
    const auto best = static_cast<std::size_t>(low.best());
    m.cases = {{"the step that is best for 1 % noise", high.errors[best] / low.errors[best]},
               {"each with its own best step", high.errors[static_cast<std::size_t>(high.best())] / low.errors[best]}};
    return m;
}

Measurement low_noise_works(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    for (const std::string_view name : meshes) {
        const StepSweep sweep = step_sweep(bench, name, 1);
        m.cases.push_back(
            {bench.mesh(name).mesh->name + ", 1 % noise", sweep.noisy / sweep.errors[static_cast<std::size_t>(sweep.best())]});
    }
    m.remark = report::text("The unit of the report's level 1.0 is not given: taken as per cent of the box in each axis.");
    return m;
}

Measurement hopeless_noise(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    std::vector<std::string> gains;
    for (const std::string_view name : meshes) {
        const StepSweep sweep = step_sweep(bench, name, 20);
        const double left = sweep.errors[static_cast<std::size_t>(sweep.best())];
        m.cases.push_back({bench.mesh(name).mesh->name, left / bench.mesh(name).mesh->prepared->preflight.mean_edge});
        gains.push_back(readable_percent(1 - left / sweep.noisy, 2));
    }
    m.remark = report::text("Smoothing takes away ", listed(gains),
                            " of the noise, but what counts is what is left: an error of a mean edge or more is as coarse as the "
                            "triangles that draw the shape.");
    return m;
}

}   // namespace

const std::vector<Claim>& noise_claims() {
    using enum Rule::Relation;
    using enum About::Scope;
    static const std::vector<Claim> claims{
        {"claims_s1_low_noise",
         "S1",
         "",
         "q7",
         "At a low noise level denoising is effective.",
         {{"bunny", "cow"}, any_mesh, {Property::not_flat}},
         {"the rms error before over that after, at the best step tried", "", at_least, 1.2},
         Effort::full,
         low_noise_works},
        {"claims_s1_larger_step",
         "S1",
         "",
         "q7",
         "More noise can be handled by a larger step.",
         {{"bunny"}, any_mesh, {Property::not_flat}},
         {"the best step for much noise over that for little", "", at_least, 2},
         Effort::full,
         more_noise_larger_step},
        {"claims_s1_worse",
         "S1",
         "",
         "q7",
         "With more noise the result becomes a lot worse.",
         {{"bunny"}, any_mesh, {Property::not_flat}},
         {"the rms error with 5 % noise over that with 1 %", "", at_least, 1.5},
         Effort::full,
         more_noise_worse_result},
        {"claims_s1_hopeless",
         "S1",
         "",
         "q7",
         "At noise level 20 even a very large step recovers nothing of the shape.",
         {{"bunny", "cow"}, any_mesh, {Property::not_flat}},
         {"the rms error left by the best step tried", "mean edges", at_least, 1},
         Effort::full,
         hopeless_noise},
    };
    return claims;
}

}   // namespace meshfolio::claims
