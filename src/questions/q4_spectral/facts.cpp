#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

constexpr double clear_ratio = 1.5;   // less is no difference that one explains

std::string percent(double share) { return readable_percent(share, 2); }

/// What one reconstruction looks like: one of exact, fine, collapsed and blurred, with the number that shows it; and, of the assignment's
/// armadillo, what was seen of it when these words were written.
report::Facts picture_facts(const SpectralStudy& study, const Reconstruction& r) {
    const bool closed = study.preflight().encloses_volume() && std::isfinite(r.difference.volume_ratio);
    const bool exact = is_exact(study, r.k), fine = !exact && r.difference.area_weighted_rms < 0.005 * study.diagonal;
    const bool collapsed = !exact && !fine && closed && r.difference.volume_ratio < 0.3;
    const double degrees = r.difference.mean_normal_angle * 180 / pi;
    return {"k"_a = r.k,
            "exact"_a = exact,
            "fine"_a = fine,
            "collapsed"_a = collapsed,
            "blurred"_a = !exact && !fine && !collapsed,
            "volume"_a = r.difference.volume_ratio < 1e-3 ? "" : percent(r.difference.volume_ratio),
            "angle"_a = degrees < 1 ? "" : readable(degrees, 2),
            "rms"_a = percent_of_box(study, r.difference.area_weighted_rms),
            "largest"_a = percent_of_box(study, r.difference.max)};
}

/// The step from one k to the next that takes most vertices farther from their places.
struct WorstStep {
    double share = 0;
    int from = 0, to = 0;
};
WorstStep worst_step(const SpectralStudy& study) {
    const std::vector<Reconstruction>& all = study.reconstructions;
    WorstStep worst;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (const double share = share_made_worse(study, all[i - 1], all[i]); share > worst.share) worst = {share, all[i - 1].k, all[i].k};
    return worst;
}

bool hausdorff_falls(const std::vector<HausdorffDistance>& all) {
    return all.size() > 1 && std::ranges::is_sorted(all, [](auto& later, auto& earlier) { return later.distance > earlier.bound; });
}

/// Twice as far on as the law was fitted, is the error less than half of what it says?
bool has_knee(const SpectralStudy& study, const PowerLaw& law) {
    const int beyond = std::min(study.modes(), 2 * law.last);
    return beyond > law.last && study.rms[beyond] < 0.5 * law.at(beyond);
}

report::Facts answer_facts(const SpectralStudy& study) {
    const auto told = told_reconstructions(study);
    const Reconstruction *first = told.front(), *last = last_erring(study);
    const auto error = [&](const Reconstruction* r) {
        return r && !is_exact(study, r->k) ? percent_of_box(study, r->difference.area_weighted_rms) : "";
    };
    const int enough = smallest_k_below(study, 0.01);
    return {"k"_a = first->k,
            "error"_a = error(first),
            "last"_a = last ? last->k : 0,
            "last_error"_a = last == first ? "" : error(last),
            "enough"_a = enough < study.vertices() ? enough : 0,
            "vertices"_a = study.vertices()};
}

report::Facts rate_facts(const SpectralStudy& study) {
    const auto law = fall_of_the_error(study);
    const bool fits = law && law->deviation <= 1.5, knee = fits && has_knee(study, *law);
    const double weyl = distance_from_weyl(study), edges = wavelength(study, study.modes()) / study.preflight().mean_edge;
    return {"power"_a = fits ? readable(law->power, 2) : "",
            "law_first"_a = law ? law->first : 0,
            "law_last"_a = law ? law->last : 0,
            "times"_a = fits ? readable(std::pow(2, 1 / law->power), 2) : "",   // as many modes halve the error
            "deviation"_a = law ? percent(law->deviation - 1) : "",
            "knee"_a = knee && study.modes() < study.vertices(),
            "knee_at_all"_a = knee && study.modes() == study.vertices(),
            "modes"_a = study.modes(),
            "weyl"_a = std::isfinite(weyl) ? percent(weyl) : "",
            "unresolved"_a = std::isfinite(weyl) && edges < 2 ? readable(edges, 2) : ""};
}

report::Facts limb_facts(const SpectralStudy& study, const LimbStudy& limbs) {
    if (!limbs.measured()) return {"limbs"_a = false};
    const LimbErrors& row = limbs.errors[limbs.errors.size() > 1 ? 1 : 0];
    const LimbErrors& last = limbs.errors.back();
    const double ratio = row.thin / row.thick, lengths = wavelength(study, row.k) / limbs.thin_diameter;
    const bool one_body = zero_modes(study) == 1;   // else the small components may be the thin parts
    return {"limbs"_a = true,
            "clear"_a = ratio >= clear_ratio,
            "limb_k"_a = row.k,
            "ratio"_a = readable(ratio, 2),
            "limb_last"_a = last.k,
            "later"_a = last.k > row.k ? readable(last.thin / last.thick, 2) : "",
            "lengths"_a = ratio >= clear_ratio && one_body && lengths > pi ? readable(lengths, 2) : "",
            "remaining"_a = last.seen_on_thin > 0.6 ? percent(last.seen_on_thin) : ""};   // of half the area
}

void append(report::Facts& facts, const report::Facts& more) { facts.insert(facts.end(), more.begin(), more.end()); }

}   // namespace

report::Facts facts_of(const Subjects& subjects, std::size_t which) {
    const Subject& subject = subjects[which];
    const SpectralStudy& study = subject.study;
    const Reconstruction& large = subject.study.reconstructions.back();
    const Reconstruction* erring = last_erring(study);
    const bool all = large.k == study.vertices() && erring;
    const WorstStep worst = worst_step(study);
    const std::vector<int> drawn = drawn_modes(study);
    const double first_seen = share_seen(study, study.reconstructions.front()), last_seen = erring ? share_seen(study, *erring) : 0;
    const auto told_before = [&](auto has) { return std::any_of(subjects.begin(), subjects.begin() + which, has); };
    report::FactList pictures, solved;
    for (const Reconstruction* r : told_reconstructions(study)) pictures.push_back(picture_facts(study, *r));
    for (const Subject& s : subjects)
        solved.push_back(
            {"mesh"_a = s.name(), "dense"_a = s.study.spectrum.dense, "modes"_a = s.study.modes(), "vertices"_a = s.study.vertices()});
    report::Facts facts{
        "mesh"_a = study.name(),
        "first_mesh"_a = which == 0,
        "defines_thickness"_a = !told_before([](const Subject& s) { return s.limbs.measured(); }),
        "explains_weyl"_a = !told_before([](const Subject& s) { return std::isfinite(distance_from_weyl(s.study)); }),
        "limit"_a = readable_percent(seen_error, 1),
        "solved"_a = solved,
        "iterated"_a = std::ranges::any_of(subjects, [](const Subject& s) { return !s.study.spectrum.dense; }),
        "pictures"_a = pictures,
        "worse"_a = worst.share > 0 ? percent(worst.share) : "",
        "from"_a = worst.from,
        "to"_a = worst.to,
        "hausdorff"_a = hausdorff_falls(subject.hausdorff),
        "seen"_a = erring && erring->k > study.reconstructions.front().k && first_seen > last_seen ? percent(first_seen) : "",
        "last_seen"_a = percent(last_seen),
        "drawn"_a = !drawn.empty(),
        "spectrum"_a = study.modes() > zero_modes(study) + 1,
        "wave_k"_a = drawn.size() > 1 ? drawn[1] : 0,
        "zeros"_a = zero_modes(study),
        "components"_a = zero_modes(study) > 1,
        "large"_a = subject.chosen_k ? (all ? erring->k : large.k) : 0,
        "large_share"_a = percent(static_cast<double>(all ? erring->k : large.k) / study.vertices()),
        "all"_a = all ? large.k : 0,
    };
    append(facts, answer_facts(study));
    append(facts, rate_facts(study));
    append(facts, limb_facts(study, subject.limbs));
    return facts;
}

}   // namespace meshfolio::q4_spectral
