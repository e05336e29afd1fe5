#include <algorithm>

#include "questions/bench/sentences.h"
#include "questions/core/section_tools.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

report::Text answer_to_larger_k(const SpectralStudy& study) {
    const Reconstruction &first = study.reconstructions.front(), &last = study.reconstructions.back();
    if (study.reconstructions.size() == 1)
        return words.say("larger_k.one", "mesh"_a = study.name(), "k"_a = first.k,
                         "error"_a = percent_of_box(study, first.difference.rms, 2));
    report::Text t =
        words.say("larger_k", "mesh"_a = study.name(), "first_error"_a = percent_of_box(study, study.rms[first.k], 2), "first"_a = first.k,
                  "last_error"_a = study.rms[last.k] < 1e-9 * study.diagonal ? "rounding" : percent_of_box(study, study.rms[last.k], 2),
                  "last"_a = last.k);
    std::vector<std::string> steps, beyond;
    for (const double share : target_shares) {
        const int k = smallest_k_below(study, share);
        if (k > 0)
            steps.push_back(words.line("larger_k.step", "k"_a = k, "share"_a = readable_percent(share, 1)));
        else
            beyond.push_back(readable_percent(share, 1));
    }
    if (!steps.empty()) report::extend(t, " ", words.say("larger_k.reached", "steps"_a = listed(steps)));
    if (!beyond.empty()) report::extend(t, " ", words.say("larger_k.beyond", "shares"_a = listed(beyond), "modes"_a = study.modes()));
    return t;
}

/// The error falls like k^−p between two k: the gain that doubling k still brings.
report::Text diminishing_returns(const SpectralStudy& study) {
    const int end = study.modes();
    const int low = std::max(2, study.reconstructions.front().k), middle = std::max(low + 1, end / 8), high = std::max(middle + 1, end / 2);
    if (high > end || !(study.rms[high] > 1e-12 * study.diagonal)) return {};
    const double early = falling_power(study, low, middle), late = falling_power(study, middle, high);
    const std::string fall = study.rms[end] < 1e-9 * study.diagonal
                                 ? words.line("returns.to_rounding")
                                 : words.line("returns.by_factor", "factor"_a = readable(study.rms[high] / study.rms[end], 2));
    return words.say("returns", "low"_a = low, "middle"_a = middle, "high"_a = high, "end"_a = end, "early"_a = readable(early, 2),
                     "late"_a = readable(late, 2), "gain"_a = readable(std::pow(2, late), 2), "fall"_a = fall);
}

/// Two mean edges are the shortest wave that the triangulation can carry.
report::Text detail_of_modes(const SpectralStudy& study) {
    const double mean_edge = study.source->prepared->preflight.mean_edge, shortest = wavelength(study, study.modes());
    if (shortest >= 2 * mean_edge)
        return words.say("returns.wavelength", "wavelength"_a = readable(shortest), "edges"_a = readable(shortest / mean_edge, 2));
    int resolved = study.modes();
    std::vector<double> supports;   // of the modes beyond
    for (; resolved > 0 && wavelength(study, resolved) < 2 * mean_edge; --resolved) supports.push_back(support_of_mode(study, resolved));
    std::ranges::nth_element(supports, supports.begin() + static_cast<std::ptrdiff_t>(supports.size() / 2));
    return words.say("returns.unresolved", "resolved"_a = resolved, "beyond"_a = supports.size(),
                     "support"_a = readable(supports[supports.size() / 2], 2), "vertices"_a = study.vertices());
}

report::Text where_the_error_sits(const SpectralStudy& study) {
    const auto is_informative = [&](const Reconstruction& r) { return r.difference.rms > 1e-3 * study.diagonal; };
    const auto it = std::find_if(study.reconstructions.rbegin(), study.reconstructions.rend(), is_informative);
    if (it == study.reconstructions.rend()) return {};
    const double remoteness = remoteness_of_worst(study, *it);
    const MeshDifference& d = it->difference;
    const char* where = remoteness > 1.15 ? "worst.outside" : remoteness < 0.85 ? "worst.inside" : "worst.anywhere";
    report::Text t = words.say(where, "k"_a = it->k, "remoteness"_a = readable(remoteness, 2), "largest"_a = readable(d.max / d.rms, 2));
    if (std::isfinite(d.volume_ratio) && study.source->prepared->preflight.closed())
        report::extend(t, " ", words.say("worst.volume", "share"_a = readable_percent(d.volume_ratio)));
    return t;
}

/// "3.2 Mflop", "1.5 Gflop".
std::string work(double operations) {
    return operations < 1e9 ? readable(1e-6 * operations) + "\u202fMflop" : readable(1e-9 * operations) + "\u202fGflop";
}

}   // namespace

report::Text cost_of_large_k(const SpectralStudy& study, const SpectralUses& uses) {
    const ModeCost cost = mode_cost(study.reconstructions.back().k, study.vertices(), uses.factor_entries);
    report::Text t = words.say("large_k", "k"_a = cost.k, "megabytes"_a = readable(cost.megabytes), "mesh"_a = study.name(),
                               "work"_a = work(cost.rebuild_operations));
    if (study.spectrum.dense) {
        report::extend(t, " ", words.say("large_k.dense", "work"_a = work(4.0 / 3 * std::pow(study.vertices(), 3))));
    } else {
        const double crossing = 2 * uses.factor_entries / study.vertices();
        report::extend(t, " ",
                       words.say("large_k.lanczos", "solves"_a = work(cost.solve_operations),
                                 "orthogonalisation"_a = work(cost.orthogonalise_operations),
                                 "crossing"_a = static_cast<int>(std::ceil(crossing)), "mesh"_a = study.name()));
    }
    return t;
}

report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs) {
    if (!limbs.measured()) return {};
    const LimbErrors& row = limbs.errors[limbs.errors.size() > 1 ? 1 : 0];
    const LimbErrors& last = limbs.errors.back();
    const int needed = limbs.modes_needed;
    const double ratio = row.thin / row.thick, later = last.thin / last.thick;
    const auto told = [&](std::string_view key, int k, double times) { return words.say(key, "k"_a = k, "ratio"_a = readable(times, 2)); };
    report::Text t = words.say("thin", "k"_a = row.k, "thin"_a = percent_of_box(study, row.thin, 2),
                               "thick"_a = percent_of_box(study, row.thick, 2), "mesh"_a = study.name());
    report::extend(t, " ",
                   words.say(needed > 0 ? "thin.mode" : "thin.no_mode", "diameter"_a = readable(limbs.thin_diameter), "mode"_a = needed,
                             "vertices"_a = study.vertices(), "modes"_a = study.modes()));
    const bool missing = needed == 0 || needed > row.k;
    report::extend(t, " ", told(!missing ? "thin.in_use" : ratio > 1.1 ? "thin.ghosts" : "thin.no_ghosts", row.k, ratio));
    if (needed > 0 && last.k > std::max(row.k, needed))
        report::extend(t, " ", told(later > 1.1 ? "thin.later_no_shape" : "thin.later", last.k, later));
    report::extend(t, " ", words.say("thin.far", "k"_a = row.k, "share"_a = readable_percent(row.far_share)));
    return t;
}

report::Text what_bands_do(const SpectralStudy& study, const BandStudy& bands) {
    if (bands.bands.empty()) return {};
    const Band& largest = *std::ranges::max_element(bands.bands, {}, &Band::energy_share);
    std::vector<std::string> moves;
    for (const EqualisedMesh& state : bands.meshes)
        if (state.id.ends_with("_up"))
            moves.push_back(
                words.line("energy.move", "distance"_a = percent_of_box(study, state.measured_rms, 2), "filter"_a = state.label));
    return words.say("energy", "mesh"_a = study.name(), "share"_a = readable_percent(largest.energy_share), "band"_a = largest.name,
                     "first"_a = largest.first, "last"_a = largest.last, "moves"_a = listed(moves));
}

report::Text low_pass_without_modes(const SpectralStudy& study, const SpectralUses& uses) {
    const LowPassStudy& low_pass = uses.low_pass;
    if (low_pass.k == 0) return {};
    const auto& errors = low_pass.errors;
    const auto good = std::ranges::find_if(errors, [&](const LowPassError& row) { return row.smooth <= 1e-4 * study.diagonal; });
    const bool applied = good != errors.end();
    const LowPassError &last = errors.back(), &told = applied ? *good : last;
    report::Text t = words.say(applied ? "no_modes.applied" : "no_modes.still_off", "degree"_a = told.degree,
                               "work"_a = work(told.operations), "smooth"_a = percent_of_box(study, told.smooth, 2), "k"_a = low_pass.k,
                               "last"_a = last.degree, "step"_a = percent_of_box(study, last.ideal, 2), "mesh"_a = study.name());
    const auto worst = std::ranges::max_element(errors, {}, &LowPassError::ideal);
    if (worst != errors.begin()) report::extend(t, " ", words.say("no_modes.worst", "degree"_a = worst->degree));
    report::extend(t, " ", words.say("no_modes.limit", "ratio"_a = readable(low_pass.bound / low_pass.cutoff)));
    if (study.spectrum.dense) return t;
    const ModeCost cost = mode_cost(low_pass.k, study.vertices(), uses.factor_entries);
    const double ratio = told.operations / (cost.solve_operations + cost.orthogonalise_operations);
    report::extend(t, " ", words.say("no_modes.work", "degree"_a = told.degree, "ratio"_a = readable(ratio, 2), "k"_a = low_pass.k));
    return t;
}

report::Text cost_of_mistakes(const SpectralStudy& study, const MistakeStudy& mistakes) {
    const auto at = std::ranges::find(mistakes.errors, mistakes.pictured, &MistakeErrors::k);
    if (at == mistakes.errors.end()) return {};
    report::Text t =
        words.say("mistaken", "k"_a = at->k, "right"_a = percent_of_box(study, at->right, 2), "mesh"_a = study.name(),
                  "unmapped"_a = percent_of_box(study, at->unmapped, 2), "unweighted"_a = percent_of_box(study, at->unweighted, 2));
    if (std::isfinite(at->edge_normalised)) {
        double low = infinity, high = 0;   // times as far as the right way
        for (const MistakeErrors& row : mistakes.errors) {
            if (!std::isfinite(row.edge_normalised) || !(row.right > 1e-9 * study.diagonal)) continue;
            low = std::min(low, row.edge_normalised / row.right);
            high = std::max(high, row.edge_normalised / row.right);
        }
        if (high > 0)
            report::extend(t, " ",
                           words.say("mistaken.edge", "error"_a = percent_of_box(study, at->edge_normalised, 2), "low"_a = readable(low),
                                     "high"_a = readable(high)));
    }
    return t;
}

void add_discussion(report::Section& section, const std::vector<SpectralStudy>& studies, const std::vector<SpectralUses>& uses) {
    add_words(section, words, "discussion");
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const SpectralStudy& study = studies[i];
        add_paragraphs(section, {answer_to_larger_k(study), paragraph_of({diminishing_returns(study), detail_of_modes(study)}),
                                 where_the_error_sits(study), thin_parts(study, uses[i].limbs), cost_of_large_k(study, uses[i]),
                                 what_bands_do(study, uses[i].bands), low_pass_without_modes(study, uses[i]),
                                 cost_of_mistakes(study, uses[i].mistakes)});
    }
}

}   // namespace meshfolio::q4_spectral
