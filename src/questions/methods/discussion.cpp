// The checks and the record of the section "methods", and its facts; templates/words/methods.md chooses among them.
#include "geometry/denoising/component_size.h"
#include "geometry/measures/mesh_facts.h"
#include "questions/methods/study.h"

namespace meshfolio::methods {

namespace {

/// Returns the standard deviation of Σ|displacement|²/(3σ²n) about its mean 1: √2 over the root of the effective number of squares.
double strength_deviation(const DenoisingTrials& mesh, const NoiseTrial& trial) {
    const double n = mesh.subject.mesh.vertex_count();
    if (trial.kind == NoiseKind::gaussian) return std::sqrt(2 / (3 * n));
    if (trial.kind == NoiseKind::impulsive) return std::sqrt(2 / (3 * std::max(1.0, std::round(impulsive_share * n))));
    return std::sqrt(2 / n);   // box: as if one axis had it all
}

/// Lists every noisy mesh as `part`, with its clean mesh as `whole`.
auto all_trials(const DenoisingLaboratory& laboratory) { return parts_within(laboratory.meshes, &DenoisingTrials::trials); }

double best_gain(const NoiseTrial& trial, Gain gain) {
    const SearchResult* best = winner(trial, gain);
    return best ? (best->*gain)() : 1;
}

/// Counts how often filters of normals win, on meshes with sharp edges and on others, and how often the two measures disagree. Finds the
/// largest gains in places and in shape against Gaussian noise up to half a mean edge.
report::Facts winner_facts(const DenoisingLaboratory& laboratory) {
    struct Tally {
        int trials = 0, by_shape = 0, by_angle = 0;
    } sharp, other;
    int differ = 0, compared = 0;
    double places_gain = 1, shape_gain = 1;
    const auto filters = [](const SearchResult* r) { return r != nullptr && filters_normals(r->method) ? 1 : 0; };
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        Tally& tally = mesh.subject.character.kind() == MeshClass::sharp_edged ? sharp : other;
        const SearchResult *shape = winner(trial, &SearchResult::gain), *angle = winner(trial, &SearchResult::angle_gain);
        ++tally.trials;
        tally.by_shape += filters(shape);
        tally.by_angle += filters(angle);
        if (shape != nullptr && angle != nullptr) {
            ++compared;
            // Methods that differ in a scale alone turn the normals alike, but for rounding.
            differ += shape->angle_gain() >= angle->angle_gain() * (1 - 1e-9) ? 0 : 1;
        }
        if (trial.kind != NoiseKind::gaussian || trial.edges > 0.5) continue;
        places_gain = std::max(places_gain, best_gain(trial, &SearchResult::rms_gain));
        shape_gain = std::max(shape_gain, best_gain(trial, &SearchResult::gain));
    }
    return list_of("sharp"_a = sharp.trials, "sharp_shape"_a = sharp.by_shape, "sharp_normals"_a = sharp.by_angle, "other"_a = other.trials,
                   "other_shape"_a = other.by_shape, "other_normals"_a = other.by_angle, "differ"_a = differ, "compared"_a = compared,
                   "places_stay"_a = shape_gain > 1.5 * places_gain, "places"_a = readable(places_gain, 2),
                   "shape"_a = readable(shape_gain, 2));
}

/// Compares the kinds of noise at the level of the pictures by their best gains, geometric means over the meshes.
report::Facts kind_facts(const DenoisingLaboratory& laboratory) {
    std::map<std::string_view, double> gains;
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        if (trial.edges != mesh.pictured_trial().edges) continue;
        auto [gain, is_new] = gains.try_emplace(noise_entry(trial.kind).title, 1);
        gain->second *= std::pow(best_gain(trial, &SearchResult::gain), 1 / static_cast<double>(laboratory.meshes.size()));
    }
    const auto [hardest, easiest] = std::ranges::minmax_element(gains, {}, [](const auto& entry) { return entry.second; });
    return list_of("kinds"_a = easiest->second > 1.1 * hardest->second,
                   "level"_a = readable(laboratory.meshes.front().pictured_trial().edges, 2), "easiest"_a = easiest->first,
                   "easiest_gain"_a = readable(easiest->second, 2), "hardest"_a = hardest->first,
                   "hardest_gain"_a = readable(hardest->second, 2));
}

/// Formats a range: "20 % to 27 %", or "20 %" if both ends read alike.
std::string range_text(const std::vector<double>& values, const auto& format) {
    if (values.empty()) return "";
    const auto [least, most] = std::ranges::minmax(values);
    return span_of(format(least), format(most));
}

/// Measures the effect of the pictured noise on the limit of explicit steps and on the area, the best result against 20 % of the box, and
/// the angle of normals that the best method leaves of the strongest Gaussian noise.
report::Facts strength_facts(const DenoisingLaboratory& laboratory) {
    std::vector<double> limits, areas, gains, angles;
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        if (&trial == &mesh.pictured_trial()) {
            limits.push_back(mesh.subject.largest_eigenvalue / trial.largest_eigenvalue);
            areas.push_back(trial.damage.area_ratio);
        }
        const SearchResult* best = trial.s1_level ? winner(trial, &SearchResult::gain) : nullptr;
        if (best == nullptr || std::isnan(best->difference.mean_normal_angle)) continue;
        gains.push_back(best->gain());
        angles.push_back(degrees * best->difference.mean_normal_angle);
    }
    const double left = largest_of(laboratory.meshes, [](const DenoisingTrials& mesh) {
        const SearchResult* best = winner(*mesh.of_kind(NoiseKind::gaussian).back(), &SearchResult::gain);
        return best ? best->difference.mean_normal_angle : undefined;
    });
    const auto plain = [](double x) { return readable(x, 2); };
    return list_of("lower"_a = std::ranges::max(limits) < 1,
                   "limits"_a = range_text(limits, [](double x) { return readable_percent(x, 2); }),
                   "areas"_a = std::ranges::min(areas) > 1.02 ? range_text(areas, plain) : "", "box_gains"_a = range_text(gains, plain),
                   "box_angles"_a = range_text(angles, [](double x) { return readable(x, 2) + "°"; }), "spoilt"_a = left > pi / 18,
                   "strongest"_a = readable(laboratory.meshes.front().of_kind(NoiseKind::gaussian).back()->edges, 2),
                   "angle"_a = readable(degrees * left, 2));
}

/// Finds the methods that keep the least and the most volume of the first mesh that has one.
report::Facts volume_facts(const DenoisingLaboratory& laboratory) {
    const auto mesh = std::ranges::find_if(laboratory.meshes, [](const DenoisingTrials& m) { return m.subject.has_volume_to_keep; });
    std::vector<const SearchResult*> kept;
    if (mesh != laboratory.meshes.end())
        for (const SearchResult& r : mesh->pictured_trial().results)
            if (r.defined && std::isfinite(r.difference.volume_ratio)) kept.push_back(&r);
    if (kept.empty()) return {"volume_of"_a = "", "least_method"_a = "", "least"_a = "", "most_method"_a = "", "most"_a = ""};
    const auto volume = [](const SearchResult* r) { return r->difference.volume_ratio; };
    const auto [least, most] = std::ranges::minmax(kept, {}, volume);
    const auto percent = [&](const SearchResult* r) { return readable_percent(std::abs(volume(r)) < 1e-9 ? 0 : volume(r)); };
    return {"volume_of"_a = mesh->name(), "least_method"_a = method_title(*least), "least"_a = percent(least),
            "most_method"_a = method_title(*most), "most"_a = percent(most)};
}

/// Lists the methods with failed runs, and the meshes cut to a patch.
report::Facts remark_facts(const DenoisingLaboratory& laboratory) {
    Names failures, patches;
    for (std::size_t i = 0; i < denoising_list().size(); ++i) {
        int failed = 0;
        for (const auto& [mesh, trial] : all_trials(laboratory)) failed += trial.results[i].failed;
        if (failed > 0) failures.push_back(words.line("failures.runs", "runs"_a = failed, "method"_a = method_title(i)));
    }
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        const DenoisingSubject& s = mesh.subject;
        if (s.is_patch())
            patches.push_back(
                words.line("patches.mesh", "mesh"_a = s.name, "vertices"_a = s.mesh.vertex_count(), "whole"_a = s.whole_vertices));
    }
    return {"failures"_a = listed(failures), "patches"_a = listed(patches)};
}

}   // namespace

void add_checks(report::Section& section, const DenoisingLaboratory& laboratory) {
    double strength = 0, volume = 0, area = 0, unspent = 0, rounding = 0;
    bool any_volume = false;
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        const double ratio = trial.damage.rms / (std::sqrt(3) * trial.sigma);
        strength = std::max(strength, std::abs(ratio * ratio - 1) / strength_deviation(mesh, trial));
        rounding = std::max(rounding, coordinate_spacing(mesh.subject.mesh) / mesh.subject.mean_edge);
        for (const SearchResult& r : trial.results) {
            if (r.defined && r.failed == 0) unspent = std::max(unspent, std::abs(double(r.steps - laboratory.budget.total())));
            if (r.method == DenoisingMethod::conformal_flow)
                area = std::max(area, std::abs(r.difference.area_ratio / trial.damage.area_ratio - 1));
            if (r.method != DenoisingMethod::volume_rescaled || !r.defined || !mesh.subject.has_volume_to_keep) continue;
            // Noise as large as a component turns it inside out, and no scale undoes that.
            const auto volumes = [&subject = mesh.subject](const Positions& X) {
                return component_sizes(moved_to(subject.mesh, X), subject.topology).volume;
            };
            if ((volumes(trial.noisy).array() * volumes(r.X).array() <= 0).any()) continue;
            volume = std::max(volume, std::abs(r.difference.volume_ratio / trial.damage.volume_ratio - 1));
            any_volume = true;
        }
    }
    append_checks(section,
                  {check_at_most(words.line("check.strength"), 5, strength, 0), check_near(words.line("check.budget"), 0, unspent, 0)});
    if (any_volume) add(section, report::within_rounding(check_at_most(words.line("check.volume"), 0, volume, 1e-9), rounding));
    add(section, report::within_rounding(check_at_most(words.line("check.area"), 0, area, 1e-9), rounding));
}

void add_record(report::Section& section, const DenoisingLaboratory& laboratory, const QuestionSettings& settings) {
    const int steps = laboratory.budget.total();
    const std::string impulsive = words.line("parameter.impulsive", "share"_a = readable_percent(impulsive_share, 2));
    section.parameters = {
        {words.line("parameter.steps"), steps}, {"seed", settings.seed}, {"impulsive noise", {impulsive, impulsive_share, "share"}}};
    section.extent = words.line("extent", "methods"_a = denoising_list().size(), "trials"_a = all_trials(laboratory).size(),
                                "meshes"_a = listed(names_of(laboratory.meshes)), "steps"_a = steps);
}

report::Text answer_of(const DenoisingLaboratory& laboratory) {
    std::map<int, Names> won;   // classes by their best method
    for (const ClassResult& c : class_results(laboratory))
        if (c.best >= 0) won[c.best].push_back("“" + c.title + "”");
    Names winners;
    for (const auto& [method, titles] : won)
        winners.push_back(words.line("answer.winner", "method"_a = method_title(method), "classes"_a = listed(titles)));
    return winners.empty() ? words.say("answer.none") : words.say("answer", "winners"_a = listed(winners));
}

report::Facts facts_of(const DenoisingLaboratory& laboratory) {
    report::Facts facts;
    for (const report::Facts& more :
         {winner_facts(laboratory), kind_facts(laboratory), strength_facts(laboratory), volume_facts(laboratory), remark_facts(laboratory)})
        facts.insert(facts.end(), more.begin(), more.end());
    return facts;
}

}   // namespace meshfolio::methods
