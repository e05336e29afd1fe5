// The panel of question 7 in the live laboratory: a noisy mesh, denoised as well as the question's search can.
#include "base/parallel_tasks.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/lab_offer.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// Returns the noise to show: 1 % of the box diagonal, else the lowest level; null where no level was tried.
const BestDenoising* shown_noise(const std::vector<BestDenoising>& denoised) {
    const auto one_percent = std::ranges::find(denoised, 0.01, &BestDenoising::sigma);
    return one_percent != denoised.end() ? &*one_percent : denoised.empty() ? nullptr : &denoised.front();
}

std::vector<LabPreset> presets_of(const std::vector<BestDenoising>& denoised) {
    const BestDenoising* noise = shown_noise(denoised);
    if (noise == nullptr) return {};
    const LabSetting best = noise->at(noise->found.by_shape);
    LabSetting noisy = best, longer = best;
    noisy.count = 0;
    longer.count *= 4;
    return {{words.line("preset.noisy"), noisy},
            {words.line("preset.surface"), best},
            {words.line("preset.places"), noise->at(noise->found.by_rms)},
            {words.line("preset.longer"), longer},
            {words.line("preset.drift"), best, true}};
}

std::vector<BestDenoising> denoised_at_each_level(const TriangleMesh& clean, double mean_edge, double diagonal,
                                                  const QuestionSettings& settings) {
    const DenoisingTries tries = tries_of(settings, mean_edge);
    const MeshTopology topology = topology_of(clean);
    const Positions normals = face_normals(clean);
    std::vector<BestDenoising> all(tries.noise.size());
    for_each_task(all.size(), [&](std::size_t i) {
        BestDenoising& best = all[i];
        best.sigma = tries.noise[i];
        best.seed = settings.seed;
        const TriangleMesh noisy = moved_to(clean, with_gaussian_noise(clean.X, Vector3::Constant(best.sigma * diagonal), settings.seed));
        best.found = search_for_best({clean, normals, {noisy, topology}, mean_edge}, tries.lambdas, tries.iterations);
        for (const Measure& measure : measures) {   // the noisy mesh itself is that of any λ
            SearchState& state = best.found.*measure.best;
            if (state.step == 0) state.value = tries.lambdas[tries.lambdas.size() / 2];
        }
    });
    return all;
}

}   // namespace

const LabOffer lab{
    .role = "cube",
    .presets = presets_of,
    .reported =
        [](const QuestionSettings&, const LabScale&, const std::vector<BestDenoising>& denoised) {
            std::vector<LabSetting> all;
            for (const BestDenoising& best : denoised)
                for (const Measure& measure : measures) all.push_back(best.at(best.found.*measure.best));
            return all;
        },
    .start =
        [](const QuestionSettings& settings, const LabScale& scale, const std::vector<BestDenoising>& denoised) {
            const BestDenoising* noise = shown_noise(denoised);
            return noise != nullptr ? noise->at(noise->found.by_shape) : coarse_projection(settings, scale);
        },
    .denoised = denoised_at_each_level,
};

}   // namespace meshfolio::q7_denoising
