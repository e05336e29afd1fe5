#include "geometry/measures/hausdorff.h"
#include "questions/q4_spectral/study.h"

namespace meshfolio::q4_spectral {

namespace {

constexpr double clear_ratio = 1.5;   // smaller differences between thin and thick parts are not explained

std::string percent(double share) { return readable_percent(share, 2); }

/// Describes one reconstruction: exact, fine, collapsed or blurred, with the numbers that show it.
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

void add_answer_facts(report::Facts& facts, const SpectralStudy& study) {
    const Reconstruction *first = &study.reconstructions.front(), *last = last_erring(study);
    const auto error = [&](const Reconstruction* r) {
        return r && !is_exact(study, r->k) ? percent_of_box(study, r->difference.area_weighted_rms) : "";
    };
    const int enough = smallest_k_below(study, 0.01);
    facts.insert(facts.end(), {"k"_a = first->k, "error"_a = error(first), "last"_a = last ? last->k : 0,
                               "last_error"_a = last == first ? "" : error(last), "enough"_a = enough < study.vertices() ? enough : 0,
                               "vertices"_a = study.vertices()});
}

void add_rate_facts(report::Facts& facts, const SpectralStudy& study) {
    const auto law = fall_of_the_error(study);
    const bool fits = law && law->deviation <= 1.5;
    // At twice the last k of the fit, the error is less than half of what the law says.
    const int beyond = fits ? std::min(study.modes(), 2 * law->last) : 0;
    const bool knee = fits && beyond > law->last && study.rms[beyond] < 0.5 * law->at(beyond);
    const double weyl = distance_from_weyl(study), edges = wavelength(study, study.modes()) / study.preflight().mean_edge;
    facts.insert(facts.end(),
                 {"power"_a = fits ? readable(law->power, 2) : "", "law_first"_a = law ? law->first : 0, "law_last"_a = law ? law->last : 0,
                  "times"_a = fits ? readable(std::pow(2, 1 / law->power), 2) : "", "deviation"_a = law ? percent(law->deviation - 1) : "",
                  "knee"_a = knee && study.modes() < study.vertices(), "knee_at_all"_a = knee && study.modes() == study.vertices(),
                  "modes"_a = study.modes(), "weyl"_a = std::isfinite(weyl) ? percent(weyl) : "",
                  "unresolved"_a = std::isfinite(weyl) && edges < 2 ? readable(edges, 2) : ""});
}

void add_limb_facts(report::Facts& facts, const SpectralStudy& study, const LimbStudy& limbs) {
    if (!limbs.measured()) return facts.push_back("limbs"_a = false);
    const LimbErrors& row = limbs.errors[limbs.errors.size() > 1 ? 1 : 0];
    const LimbErrors& last = limbs.errors.back();
    const double ratio = row.thin / row.thick, lengths = wavelength(study, row.k) / limbs.thin_diameter;
    const bool one_body = zero_modes(study) == 1;   // else the small components may be the thin parts
    facts.insert(facts.end(), {"limbs"_a = true, "clear"_a = ratio >= clear_ratio, "limb_k"_a = row.k, "ratio"_a = readable(ratio, 2),
                               "limb_last"_a = last.k, "later"_a = last.k > row.k ? readable(last.thin / last.thick, 2) : "",
                               "lengths"_a = ratio >= clear_ratio && one_body && lengths > pi ? readable(lengths, 2) : "",
                               "remaining"_a = last.seen_on_thin > 0.6 ? percent(last.seen_on_thin) : ""});
}

/// The fall of the errors with k, and the step from one k to the next that moves most vertices away from their places.
void add_fall_facts(report::Facts& facts, const Subject& subject) {
    const SpectralStudy& study = subject.study;
    const std::vector<Reconstruction>& all = study.reconstructions;
    const Reconstruction* erring = last_erring(study);
    double worst = 0;
    std::size_t step = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (const double share = share_made_worse(study, all[i - 1], all[i]); share > worst) worst = share, step = i;
    const double first_seen = share_seen(study, all.front()), last_seen = erring ? share_seen(study, *erring) : 0;
    facts.insert(facts.end(), {"worse"_a = worst > 0 ? percent(worst) : "", "from"_a = step > 0 ? all[step - 1].k : 0,
                               "to"_a = step > 0 ? all[step].k : 0, "hausdorff"_a = subject.hausdorff_falls,
                               "seen"_a = erring && erring->k > all.front().k && first_seen > last_seen ? percent(first_seen) : "",
                               "last_seen"_a = percent(last_seen)});
}

}   // namespace

Subject subject_of(SharedMesh mesh, const QuestionSettings& settings) {
    Subject subject{.study = spectral_study(std::move(mesh), settings), .chosen_k = settings.k.empty()};
    const SpectralStudy& study = subject.study;
    subject.limbs = limb_study(study);
    subject.hausdorff_falls = study.reconstructions.size() > 1;
    double bound = infinity;   // of the earlier distance
    for (const Reconstruction& r : study.reconstructions) {
        const HausdorffDistance hausdorff = hausdorff_distance(study.mesh(), r.mesh);
        subject.hausdorff_falls = subject.hausdorff_falls && hausdorff.distance <= bound;
        subject.hausdorff.push_back(hausdorff.distance);
        bound = hausdorff.bound;
    }
    return subject;
}

std::shared_ptr<const Subjects> spectral_subjects(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                  report::Section& section) {
    return std::make_shared<const Subjects>(studies_of(meshes, "eigenpairs", settings, progress, section, subject_of));
}

bool is_shown(const SpectralStudy& study, const Reconstruction& r) {
    const auto place = &r - study.reconstructions.data();
    return place < 2 || &r == last_erring(study) || &r == &study.reconstructions.back();
}

std::vector<int> drawn_modes(const SpectralStudy& study) {
    std::vector<int> drawn;
    for (const int mode : {zero_modes(study) + 1, 5, 15, 60})
        if (mode <= study.modes() && (drawn.empty() || mode > drawn.back())) drawn.push_back(mode);
    return drawn;
}

double share_seen(const SpectralStudy& study, const Reconstruction& r) {
    const Vector& M = study.laplacian.M;
    return (r.distance.array() > seen_error * study.diagonal).select(M, 0).sum() / M.sum();
}

const Reconstruction* last_erring(const SpectralStudy& study) {
    const Reconstruction* last = nullptr;
    for (const Reconstruction& r : study.reconstructions)
        if (!is_exact(study, r.k)) last = &r;
    return last;
}

bool is_exact(const SpectralStudy& study, int k) { return study.rms[k] < rounding * study.diagonal; }

double distance_from_weyl(const SpectralStudy& study) {
    int last = study.modes();
    while (last > 0 && wavelength(study, last) < 4 * study.preflight().mean_edge) --last;
    if (last < 20) return undefined;
    double farthest = 0;
    for (int k = last / 2; k <= last; ++k)
        farthest = std::max(farthest, std::abs(study.spectrum.eigenvalues[k - 1] / weyl_eigenvalue(study, k) - 1));
    return farthest;
}

report::Facts facts_of(const Subjects& subjects, std::size_t which) {
    const Subject& subject = subjects[which];
    const SpectralStudy& study = subject.study;
    const int large = study.reconstructions.back().k;
    const Reconstruction* erring = last_erring(study);
    const bool all = large == study.vertices() && erring;
    const std::vector<int> drawn = drawn_modes(study);
    const auto said_before = [&](auto has) { return std::any_of(subjects.begin(), subjects.begin() + which, has); };
    report::FactList pictures, solved;
    for (const Reconstruction& r : study.reconstructions)
        if (is_shown(study, r)) pictures.push_back(picture_facts(study, r));
    for (const Subject& s : subjects)
        solved.push_back(
            {"mesh"_a = s.name(), "dense"_a = s.study.spectrum.dense, "modes"_a = s.study.modes(), "vertices"_a = s.study.vertices()});
    report::Facts facts;
    facts.insert(facts.end(),
                 {"mesh"_a = study.name(), "first_mesh"_a = which == 0,
                  "defines_thickness"_a = !said_before([](const Subject& s) { return s.limbs.measured(); }),
                  "explains_weyl"_a = !said_before([](const Subject& s) { return std::isfinite(distance_from_weyl(s.study)); }),
                  "limit"_a = readable_percent(seen_error, 1), "solved"_a = solved,
                  "iterated"_a = std::ranges::any_of(subjects, [](const Subject& s) { return !s.study.spectrum.dense; }),
                  "pictures"_a = pictures, "drawn"_a = !drawn.empty(), "spectrum"_a = study.modes() > zero_modes(study) + 1,
                  "wave_k"_a = drawn.size() > 1 ? drawn[1] : 0, "zeros"_a = zero_modes(study), "components"_a = zero_modes(study) > 1,
                  "large"_a = subject.chosen_k ? (all ? erring->k : large) : 0,
                  "large_share"_a = percent(static_cast<double>(all ? erring->k : large) / study.vertices()), "all"_a = all ? large : 0});
    add_answer_facts(facts, study);
    add_fall_facts(facts, subject);
    add_rate_facts(facts, study);
    add_limb_facts(facts, study, subject.limbs);
    return facts;
}

}   // namespace meshfolio::q4_spectral
