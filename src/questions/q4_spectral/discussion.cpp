#include "geometry/measures/hausdorff.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

constexpr double clear_ratio = 1.5;   // less is no difference that one explains

// ---- what the pictures show

/// One reconstruction in words: how much of the volume is left, and how far the normals are off.
report::Text picture_of(const SpectralStudy& study, const Reconstruction& r) {
    const bool closed = study.preflight().encloses_volume() && std::isfinite(r.difference.volume_ratio);
    const double volume = closed ? r.difference.volume_ratio : 1;
    const double rms = r.difference.area_weighted_rms, angle = r.difference.mean_normal_angle * 180 / pi;
    constexpr double rough = 5;   // [°]
    const char* key = is_exact(study, r.k)           ? "picture.exact"
                      : rms < 0.005 * study.diagonal ? angle < rough ? "picture.close" : "picture.close_but_rough"
                      : volume < 0.01                ? "picture.nothing"
                      : volume < 0.3                 ? "picture.collapsed"
                      : !closed                      ? "picture.open"
                      : volume < 0.9                 ? "picture.rounded"
                                                     : "picture.whole";
    return words.say(key, "k"_a = r.k, "mesh"_a = study.name(), "rms"_a = percent_of_box(study, rms), "angle"_a = readable(angle, 2),
                     "volume"_a = readable_percent(volume, 2), "largest"_a = percent_of_box(study, r.difference.max));
}

/// The parts of the body, on the one mesh that these words were written before: the assignment's.
report::Text shape_of(const SpectralStudy& study, int k) {
    if (study.name() != "armadillo" || study.vertices() != 361) return {};
    return k == 5     ? words.say("shape.armadillo.5")
           : k == 15  ? words.say("shape.armadillo.15")
           : k == 150 ? words.say("shape.armadillo.150")
                      : report::Text();
}

/// What is still seen of the error: how much less it is than at the first k, and where.
report::Text where_the_error_sits(const Subject& subject) {
    const SpectralStudy& study = subject.study;
    const auto& all = study.reconstructions;
    const Reconstruction* it = last_erring(study);
    if (!it) return {};
    const double first = share_seen(study, all.front()), last = share_seen(study, *it), remoteness = remoteness_of_worst(study, *it);
    const auto row = std::ranges::find(subject.limbs.errors, it->k, &LimbErrors::k);
    const double on_thin = row != subject.limbs.errors.end() ? row->seen_on_thin : 0;   // of half the area
    const auto if_so = [&](bool holds, const char* key) {
        if (!holds) return report::Text();
        return words.say(key, "k"_a = it->k, "last"_a = readable_percent(last, 2), "from"_a = all.front().k,
                         "first"_a = readable_percent(first, 2), "limit"_a = readable_percent(seen_error, 1),
                         "thin"_a = readable_percent(on_thin, 2), "remoteness"_a = readable(remoteness, 2),
                         "largest"_a = readable(it->difference.max / it->difference.area_weighted_rms, 2));
    };
    const bool shrinks = it->k > all.front().k && first > last;
    return paragraph_of({if_so(shrinks, last > 0 ? "seen.less" : "seen.nothing"), if_so(last > 0 && on_thin > 0.6, "seen.thin"),
                         if_so(remoteness >= clear_ratio, "worst.outside")});
}

// ---- the rate

/// How many times as many modes halve the error.
std::string times_to_halve(const PowerLaw& law) { return readable(std::pow(2, 1 / law.power), 2); }

report::Text rate(const SpectralStudy& study) {
    const auto law = fall_of_the_error(study);
    if (!law || law->deviation > 1.5) return {};
    const report::Text told = words.say("rate", "power"_a = readable(law->power, 2), "first"_a = law->first, "last"_a = law->last,
                                        "deviation"_a = readable_percent(law->deviation - 1, 2), "mesh"_a = study.name());
    // Twice as far on, the error would be 2^−power of that at the end of the law.
    const int beyond = std::min(study.modes(), 2 * law->last);
    const bool knee = beyond > law->last && study.rms[beyond] < 0.5 * law->at(beyond);
    return paragraph_of({told, knee
                                   ? words.say(study.modes() == study.vertices() ? "rate.knee.all" : "rate.knee", "modes"_a = study.modes())
                                   : report::Text()});
}

/// Says that single vertices may get worse while the mesh gets better.
report::Text single_vertices(const SpectralStudy& study) {
    const std::vector<Reconstruction>& all = study.reconstructions;
    const report::Text whole = words.say("never_worse");
    double most = 0;
    std::size_t at = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (const double share = share_made_worse(study, all[i - 1], all[i]); share > most) most = share, at = i;
    if (at == 0) return whole;
    const auto hausdorff = [&](const Reconstruction& r) { return hausdorff_distance(study.mesh(), r.mesh); };
    const auto farther = [](const HausdorffDistance& later, const HausdorffDistance& earlier) { return later.distance > earlier.bound; };
    const bool nearer = std::ranges::is_sorted(each_of(all, hausdorff), farther);
    return paragraph_of({whole,
                         words.say("vertices_worse", "share"_a = readable_percent(most, 2), "from"_a = all[at - 1].k, "to"_a = all[at].k,
                                   "mesh"_a = study.name()),
                         nearer ? words.say("hausdorff") : report::Text()});
}

/// The k for the errors that are told, and the first that no k computed reaches.
report::Text targets(const SpectralStudy& study) {
    std::vector<int> counts;
    Names steps;
    std::string beyond;
    for (const double share : target_shares) {
        const int k = smallest_k_below(study, share);
        if (k > 0) {
            counts.push_back(k);
            steps.push_back(words.line("targets.step", "k"_a = k, "share"_a = readable_percent(share, 1)));
        } else if (beyond.empty()) {
            beyond = readable_percent(share, 1);
        }
    }
    const bool differ = counts.size() == 1 || (!counts.empty() && counts.front() < counts.back());
    return paragraph_of({differ ? words.say("targets", "steps"_a = listed(steps)) : report::Text(),
                         beyond.empty() ? report::Text() : words.say("targets.beyond", "share"_a = beyond, "modes"_a = study.modes())});
}

/// Compares the wavelengths with Weyl's law: they shrink like 1/√k.
report::Text wavelengths(const SpectralStudy& study) {
    const int end = study.modes(), quarter = end / 4;
    const auto law = fall_of_the_error(study);
    if (!law || quarter <= zero_modes(study) + 4) return {};
    const double edge = study.preflight().mean_edge, shortest = wavelength(study, end);
    return words.say(shortest >= 2 * edge ? "wavelengths" : "wavelengths.unresolved", "end"_a = end,
                     "shorter"_a = percent_of_box(study, shortest), "edges"_a = readable(shortest / edge, 2));
}

}   // namespace

report::Text thin_parts(const SpectralStudy& study, const LimbStudy& limbs) {
    if (!limbs.measured()) return {};
    const LimbErrors& row = limbs.errors[limbs.errors.size() > 1 ? 1 : 0];
    const LimbErrors& last = limbs.errors.back();
    const double ratio = row.thin / row.thick, later = last.thin / last.thick, lengths = wavelength(study, row.k) / limbs.thin_diameter,
                 last_lengths = wavelength(study, last.k) / limbs.thin_diameter;
    const auto told = [&](const char* key) {
        return words.say(key, "k"_a = row.k, "ratio"_a = readable(ratio, 2), "mesh"_a = study.name(), "times"_a = readable(lengths, 2),
                         "last"_a = last.k, "later"_a = readable(later, 2), "last_times"_a = readable(last_lengths, 2),
                         "thick_times"_a = readable(wavelength(study, row.k) / limbs.thick_diameter, 2));
    };
    if (ratio < clear_ratio) return told("thin.alike");
    report::Text t = told("thin");
    if (zero_modes(study) > 1) return t;   // where the small components are the thin parts
    const LimbErrors& first = limbs.errors.front();
    if (first.k < row.k && first.thin < first.thick)
        go_on(t, words.say("thin.not_at_first", "k"_a = first.k, "ratio"_a = readable(first.thin / first.thick, 2)));
    if (last.k > row.k) go_on(t, told(later < clear_ratio ? "thin.later_alike" : "thin.later"));
    if (lengths > pi) {   // not once round
        go_on(t, told("thin.wavelength"));
        if (last.k > row.k && later >= clear_ratio && last_lengths > 1) go_on(t, told("thin.wavelength.still"));
    }
    return t;
}

report::Text what_modes_look_like(const SpectralStudy& study) {
    const std::vector<int> drawn = drawn_modes(study);
    if (drawn.size() < 2) return {};
    const int zeros = zero_modes(study);
    const auto first_four = std::ranges::count_if(drawn, [&](int mode) { return mode <= zeros + 4; });
    const auto outside = std::ranges::count_if(drawn, [&](int mode) { return mode <= zeros + 4 && remoteness_of_peak(study, mode) >= 90; });
    const report::Facts facts{"mesh"_a = study.name(), "first"_a = drawn.front(), "last"_a = zeros + static_cast<int>(first_four),
                              "zeros"_a = zeros};
    report::Text t = words.say(zeros == 1 ? "modes.constant" : "modes.components", facts);
    go_on(t, words.say(first_four > 1 && outside == first_four ? "modes.outside" : "modes.waves", facts));
    if (drawn.back() > zeros + 4) go_on(t, words.say("modes.later", "last"_a = drawn.back()));
    return t;
}

report::Text answer_in_short(const std::vector<Subject>& subjects) {
    const SpectralStudy& study = subjects.front().study;
    Names errors;
    for (const Reconstruction* r : told_reconstructions(study))
        if (!is_exact(study, r->k))
            errors.push_back(words.line(errors.empty() ? "answer.first" : "answer.next", "k"_a = r->k,
                                        "error"_a = percent_of_box(study, r->difference.area_weighted_rms)));
    if (errors.empty()) return words.say("answer.exact", "k"_a = study.reconstructions.back().k, "mesh"_a = study.name());
    report::Text t = words.say("answer", "mesh"_a = study.name(), "errors"_a = listed(errors));
    if (const int k = smallest_k_below(study, 0.01); k > 0)
        go_on(t, words.say("answer.enough", "k"_a = k, "vertices"_a = study.vertices()));
    return t;
}

report::Text lead(const std::vector<Subject>& subjects) {
    const Subject& subject = subjects.front();
    const SpectralStudy& study = subject.study;
    report::Text thin;
    if (subject.limbs.errors.size() > 1) {
        const LimbErrors& row = subject.limbs.errors[1];
        if (row.thin >= clear_ratio * row.thick)
            thin = words.say("lead.thin", "k"_a = row.k, "ratio"_a = readable(row.thin / row.thick, 2));
    }
    const auto law = fall_of_the_error(study);
    return paragraph_of(
        {std::move(thin),
         law ? words.say("lead.price", "first"_a = law->first, "last"_a = law->last, "times"_a = times_to_halve(*law)) : report::Text()});
}

report::Text solvers(const std::vector<Subject>& subjects) {
    report::Text told;
    for (const auto& [study, limbs, entries, chosen] : subjects)
        go_on(told, words.say(study.spectrum.dense ? "solver.dense" : "solver.krylov", "mesh"_a = study.name(),
                              "vertices"_a = study.vertices(), "modes"_a = study.modes()));
    return told;
}

report::Text what_is_seen(const Subject& subject) {
    const SpectralStudy& study = subject.study;
    report::Text t = words.say("pictures", "mesh"_a = study.name());
    for (const Reconstruction* r : told_reconstructions(study)) t = paragraph_of({t, picture_of(study, *r), shape_of(study, r->k)});
    return paragraph_of({t, where_the_error_sits(subject)});
}

report::Text better_or_not(const SpectralStudy& study) { return paragraph_of({single_vertices(study), targets(study)}); }

report::Text how_fast(const SpectralStudy& study) { return paragraph_of({rate(study), wavelengths(study)}); }

report::Text the_large_k(const Subject& subject) {
    if (!subject.chosen_k) return {};
    const SpectralStudy& study = subject.study;
    const Reconstruction& last = study.reconstructions.back();
    const Reconstruction* erring = last_erring(study);
    const bool all = last.k == study.vertices() && erring;
    const Reconstruction& large = all ? *erring : last;
    return words.say(all ? "large.all" : "large.some", "k"_a = large.k, "mesh"_a = study.name(), "all"_a = last.k,
                     "share"_a = readable_percent(static_cast<double>(large.k) / study.vertices(), 2),
                     "error"_a = percent_of_box(study, large.difference.area_weighted_rms));
}

}   // namespace meshfolio::q4_spectral
