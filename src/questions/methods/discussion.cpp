#include <cmath>

#include "questions/methods/parts.h"

namespace meshfolio::methods {

namespace {

/// Every noisy mesh: its clean one as `whole`, itself as `part`.
auto all_trials(const DenoisingLaboratory& laboratory) { return parts_within(laboratory.meshes, &DenoisingTrials::trials); }

report::Text about_winner(const ClassResult& c) {
    const int best = c.best(), by_angle = c.best_by_angle();
    if (best < 0) return words.say("winner.none", "meshes"_a = listed(c.meshes), "class"_a = c.title);
    std::string normals = words.line("winner.in_shape_alone");
    if (by_angle >= 0) {
        const std::string method = method_title(by_angle), gain = readable(c.angle_gain[by_angle]);
        if (ties(c.angle_gain[best], c.angle_gain[by_angle]))
            normals = words.line("winner.in_both", "gain"_a = gain);
        else if (std::isfinite(c.angle_gain[best]))
            normals = words.line("winner.other_compared", "method"_a = method, "gain"_a = gain, "best"_a = method_title(best),
                                 "best_gain"_a = readable(c.angle_gain[best]));
        else
            normals = words.line("winner.other", "method"_a = method, "gain"_a = gain);
    }
    return words.say("winner", "meshes"_a = listed(c.meshes), "class"_a = c.title, "method"_a = method_title(best),
                     "gain"_a = readable(c.gain[best]), "trials"_a = c.trials, "normals"_a = normals);
}

/// How often filters of normals win, on meshes with sharp edges and on the others; and whether both measures agree.
report::Text about_winners(const DenoisingLaboratory& laboratory) {
    struct Tally {
        int trials = 0, by_shape = 0, by_angle = 0;
    } sharp, other;
    int differ = 0, compared = 0;
    const auto filters = [](const SearchResult* r) { return r != nullptr && filters_normals(r->method) ? 1 : 0; };
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        Tally& tally = mesh.subject.character.kind() == MeshClass::sharp_edged ? sharp : other;
        const SearchResult *shape = winner(trial, &SearchResult::gain), *angle = winner(trial, &SearchResult::angle_gain);
        ++tally.trials;
        tally.by_shape += filters(shape);
        tally.by_angle += filters(angle);
        if (shape == nullptr || angle == nullptr) continue;
        ++compared;
        differ += ties(shape->angle_gain(), angle->angle_gain()) ? 0 : 1;
    }
    report::Text t;
    const auto count = [&](const char* key, const Tally& tally) {
        if (tally.trials == 0) return;
        go_on(t, words.say(key, "shape"_a = tally.by_shape, "normals"_a = tally.by_angle, "trials"_a = tally.trials));
    };
    count("filters.sharp", sharp);
    count(sharp.trials > 0 ? "filters.other" : "filters.other_alone", other);
    const char* verdict = 3 * differ > compared ? "agreement.rare" : differ > 0 ? "agreement.frequent" : "agreement.always";
    if (compared > 0)
        go_on(t, words.say("agreement", "differ"_a = differ, "compared"_a = compared, "mesh"_a = laboratory.meshes.front().name(),
                           "verdict"_a = words.line(verdict)));
    return t;
}

/// The largest gains in places and in shape against Gaussian noise below half a mean edge.
report::Text about_places(const DenoisingLaboratory& laboratory) {
    double places = 0, shape = 0;
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        if (trial.kind != NoiseKind::gaussian || trial.edges > 0.5) continue;
        for (const SearchResult& r : trial.results) {
            if (std::isfinite(r.rms_gain())) places = std::max(places, r.rms_gain());
            if (std::isfinite(r.gain())) shape = std::max(shape, r.gain());
        }
    }
    if (places == 0 || shape == 0) return {};
    return words.say(shape > 1.5 * places ? "places.less" : "places", "places"_a = readable(places), "shape"_a = readable(shape));
}

/// The methods whose gain in shape is as large in a trial: "no method", "explicit and guided normals"; and as how many the verb takes them.
struct Those {
    std::string named;
    std::size_t count = 1;
};
Those those_with(const NoiseTrial& trial, double gain) {
    Names titles;
    for (const SearchResult& r : trial.results)
        if (r.gain() >= gain) titles.push_back(method_title(r));
    if (titles.empty()) return {words.line("limits.none")};
    if (std::ranges::ssize(titles) == std::ranges::count_if(trial.results, &SearchResult::defined)) return {words.line("limits.every")};
    return {listed(titles), titles.size()};
}

/// Says from which noise and up to which noise methods help, on one mesh.
report::Text about_limits(const DenoisingTrials& mesh) {
    const auto levels = mesh.of_kind(NoiseKind::gaussian);
    const NoiseTrial &low = *levels.front(), &high = *levels.back();
    const std::string edges = readable(low.edges, 2);
    const Those lowering = those_with(low, helps), halving = those_with(high, works);
    if (levels.size() == 1)
        return words.say("limits.one_level", "mesh"_a = mesh.name(), "low"_a = edges, "lowering"_a = lowering.named,
                         "count"_a = lowering.count);
    report::Text t = words.say("limits", "mesh"_a = mesh.name(), "low"_a = edges, "lowering"_a = lowering.named, "count"_a = lowering.count,
                               "high"_a = readable(high.edges, 2), "halving"_a = halving.named, "halving_count"_a = halving.count);
    const SearchResult* best = winner(high, &SearchResult::gain);
    const double angle = best == nullptr ? 0 : degrees * best->difference.mean_normal_angle;
    go_on(t, best == nullptr
                 ? words.say("limits.leave_alone")
                 : words.say(std::isnan(angle) ? "limits.best_flat"
                             : angle > 30      ? "limits.best_fails"
                                               : "limits.best",
                             "method"_a = method_title(*best), "error"_a = readable(best->by_shape.shape / mesh.subject.mean_edge, 2),
                             "angle"_a = readable(angle, 2)));
    return t;
}

/// "between 20 % and 27 %", or "20 %" where both are told alike.
std::string range_of(const std::vector<double>& values, const auto& told) {
    const auto [least, most] = std::ranges::minmax(values);
    const std::string low = told(least), high = told(most);
    return low == high ? low : words.line("range", "low"_a = low, "high"_a = high);
}

/// What the noise of the pictures does to the limit of explicit steps and to the area, and what follows.
report::Text about_spoilt_triangles(const DenoisingLaboratory& laboratory) {
    std::vector<double> limits, areas;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        const NoiseTrial& trial = mesh.pictured_trial();
        limits.push_back(mesh.subject.largest_eigenvalue / trial.largest_eigenvalue);
        areas.push_back(trial.spoilt.area_ratio);
    }
    return report::text(words.say(std::ranges::max(limits) < 1 ? "spoilt.limit_lower" : "spoilt.limit",
                                  "limits"_a = range_of(limits, [](double x) { return readable_percent(x, 2); })),
                        " ",
                        words.say(std::ranges::min(areas) > 1.02 ? "spoilt.area_larger" : "spoilt.area",
                                  "areas"_a = range_of(areas, [](double x) { return readable(x, 3); })));
}

/// Which kind of noise of the level of the picture is easily removed, and which hardly.
report::Text about_kinds(const DenoisingTrials& mesh) {
    const double edges = mesh.pictured_trial().edges;
    int kinds = 0;
    double least_gain = infinity, most_gain = 0;
    std::string_view least, most;
    for (const NoiseTrial& trial : mesh.trials) {
        if (trial.edges != edges) continue;
        ++kinds;
        const std::string_view title = noise_entry(trial.kind).title;
        const SearchResult* best = winner(trial, &SearchResult::gain);
        const double gain = best != nullptr ? best->gain() : 1;
        if (gain < least_gain) least_gain = gain, least = title;
        if (gain > most_gain) most_gain = gain, most = title;
    }
    if (kinds < 2) return {};
    return words.say(most_gain > 1.1 * least_gain ? "kinds.differ" : "kinds.alike", "edges"_a = readable(edges, 2), "mesh"_a = mesh.name(),
                     "most"_a = most, "most_gain"_a = readable(most_gain, 2), "least"_a = least, "least_gain"_a = readable(least_gain, 2));
}

/// What 20 % of the box leaves.
report::Text about_box_level(const DenoisingLaboratory& laboratory) {
    std::vector<double> gains, angles;
    Names helpless;
    for (const auto& [mesh, trial] : all_trials(laboratory)) {
        if (!trial.s1_level) continue;
        const SearchResult* best = winner(trial, &SearchResult::gain);
        if (best == nullptr) {
            helpless.push_back(mesh.name());
            continue;
        }
        gains.push_back(best->gain());
        if (const double angle = best->difference.mean_normal_angle; std::isfinite(angle)) angles.push_back(degrees * angle);
    }
    report::Text t = said_of(helpless, words, "box.nothing");
    if (!angles.empty())
        go_on(t, words.say("box", "gain"_a = range_of(gains, [](double x) { return readable(x, 2); }),
                           "angle"_a = range_of(angles, [](double x) { return readable(x, 2) + "°"; }),
                           "mesh"_a = laboratory.meshes.front().name()));
    return t;
}

/// The share of the volume that is kept; a rounding error counts as 0 %.
std::string share_kept(const SearchResult& result) {
    const double kept = result.difference.volume_ratio;
    return readable_percent(std::abs(kept) < 1e-9 ? 0 : kept);
}

/// Names the methods that keep the least and the most volume of each closed mesh.
report::Text about_volumes(const DenoisingLaboratory& laboratory) {
    report::Text t;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        if (!mesh.subject.has_volume_to_keep) continue;
        const SearchResult *least = nullptr, *most = nullptr;
        for (const SearchResult& r : mesh.pictured_trial().results) {
            const double kept = r.difference.volume_ratio;
            if (!r.defined || !std::isfinite(kept)) continue;
            if (least == nullptr || kept < least->difference.volume_ratio) least = &r;
            if (most == nullptr || kept > most->difference.volume_ratio) most = &r;
        }
        if (least == nullptr) continue;
        go_on(t, words.say("volumes.mesh", "mesh"_a = mesh.name(), "least_method"_a = method_title(*least), "least"_a = share_kept(*least),
                           "most_method"_a = method_title(*most), "most"_a = share_kept(*most)));
    }
    return t;
}

report::Text about_failures(const DenoisingLaboratory& laboratory) {
    Names told;
    for (std::size_t i = 0; i < denoising_list().size(); ++i) {
        int failed = 0;
        for (const auto& [mesh, trial] : all_trials(laboratory)) failed += trial.results[i].failed;
        if (failed > 0) told.push_back(words.line("failures.runs", "runs"_a = failed, "method"_a = method_title(i)));
    }
    return told.empty() ? report::Text() : words.say("failures", "runs"_a = listed(told));
}

report::Text about_patches(const DenoisingLaboratory& laboratory) {
    Names told;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        const DenoisingSubject& s = mesh.subject;
        if (s.is_patch())
            told.push_back(
                words.line("patches.mesh", "mesh"_a = s.name, "vertices"_a = s.mesh.vertex_count(), "whole"_a = s.whole_vertices));
    }
    return told.empty() ? report::Text() : words.say("patches", "meshes"_a = listed(told));
}

}   // namespace

void add_discussion(report::Section& section, const DenoisingLaboratory& laboratory) {
    add_words(section, words, "discussion");
    for (const ClassResult& c : class_results(laboratory)) add_paragraphs(section, {about_winner(c)});
    add_paragraphs(section, {about_winners(laboratory), about_places(laboratory)});
    for (const DenoisingTrials& mesh : laboratory.meshes) add_paragraphs(section, {about_limits(mesh), about_kinds(mesh)});
    add_paragraphs(section, {about_spoilt_triangles(laboratory), about_box_level(laboratory), about_volumes(laboratory),
                             about_failures(laboratory), about_patches(laboratory)});
}

}   // namespace meshfolio::methods
