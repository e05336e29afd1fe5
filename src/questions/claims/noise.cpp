// Claims about how much noise diffusion takes, given as a share of the box, axis by axis.
#include "mesh/triangle_measures.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

constexpr int box_iterations = 10;   // S1 took 200 of steps it does not name; ten of larger ones reach as far

/// The last error of each step, from 0.01 to 1000 squared mean edges, with noise of `percent` % of the box in each axis.
struct StepSweep {
    std::vector<double> multiples, errors;   // λ over the squared mean edge; rms after `box_iterations` [length]
    double noisy = 0;                        // rms before [length]
    std::size_t best() const { return static_cast<std::size_t>(best_of(errors)); }
    double best_multiple() const { return multiples[best()]; }
    double least() const { return errors[best()]; }
};
StepSweep step_sweep(ClaimBench& bench, std::string_view name, double percent) {
    const LibraryMesh& source = *bench.mesh(name).mesh;
    const double edge = source.prepared->preflight.mean_edge;
    StepSweep sweep;
    for (const double multiple : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0}) {
        const NoisyKey key{
            .sigma = 0.01 * percent * bounding_box(source.mesh()).extent(), .lambda = multiple * edge * edge, .iterations = box_iterations};
        const std::vector<double> errors = bench.denoised(name, key);
        sweep.multiples.push_back(multiple);
        sweep.errors.push_back(errors.back());
        sweep.noisy = errors.front();
    }
    return sweep;
}

Measurement more_noise_larger_step(ClaimBench& bench, const MeshNames&) {
    const double low = step_sweep(bench, "bunny", 1).best_multiple(), high = step_sweep(bench, "bunny", 5).best_multiple();
    return {.cases = {{"5 % noise beside 1 %", high / low}},
            .remark = words.say("claims_s1_larger_step.remark", "low"_a = readable(low, 2), "high"_a = readable(high, 2),
                                "iterations"_a = box_iterations)};
}

Measurement more_noise_worse_result(ClaimBench& bench, const MeshNames&) {
    const StepSweep low = step_sweep(bench, "bunny", 1), high = step_sweep(bench, "bunny", 5);
    return {.cases = {{words.line("claims_s1_worse.case.same_step"), high.errors[low.best()] / low.least()},
                      {words.line("claims_s1_worse.case.best_steps"), high.least() / low.least()}}};
}

Measurement low_noise_works(ClaimBench& bench, const MeshNames& meshes) {
    const auto gained = [&](std::string_view name) {
        const StepSweep sweep = step_sweep(bench, name, 1);
        return Case{bench.mesh(name).mesh->name + ", 1 % noise", sweep.noisy / sweep.least()};
    };
    return {.cases = each(meshes, gained), .remark = words.say("claims_s1_low_noise.remark")};
}

Measurement hopeless_noise(ClaimBench& bench, const MeshNames& meshes) {
    Measurement m;
    std::vector<std::string> gains;
    for (const std::string_view name : meshes) {
        const StepSweep sweep = step_sweep(bench, name, 20);
        m.cases.push_back({bench.mesh(name).mesh->name, sweep.least() / bench.mesh(name).mesh->prepared->preflight.mean_edge});
        gains.push_back(readable_percent(1 - sweep.least() / sweep.noisy, 2));
    }
    m.remark = words.say("claims_s1_hopeless.remark", "gains"_a = listed(gains));
    return m;
}

}   // namespace

extern const std::vector<Claim> noise_claims{
    {"claims_s1_low_noise", "q7", {{"bunny", "cow"}, {not_flat}}, {"gain_of_step", "", at_least, 1.2}, low_noise_works, full},
    {"claims_s1_larger_step", "q7", {{"bunny"}, {not_flat}}, {"best_steps", "", at_least, 2}, more_noise_larger_step, full},
    {"claims_s1_worse", "q7", {{"bunny"}, {not_flat}}, {"five_over_one", "", at_least, 1.5}, more_noise_worse_result, full},
    {"claims_s1_hopeless", "q7", {{"bunny", "cow"}, {not_flat}}, {"left_by_step", "mean edges", at_least, 1}, hopeless_noise, full}};

}   // namespace meshfolio::claims
