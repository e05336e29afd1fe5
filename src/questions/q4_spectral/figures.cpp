#include "questions/bench/curvature_subject.h"
#include "questions/q4_spectral/study.h"

namespace meshfolio::q4_spectral {

namespace {

/// Range of the error colours of all pictures [% of the box diagonal]. Errors never reach the darkest colour, which hides form.
constexpr double palest = 0.1, darkest = 100;

/// Adds a figure of the reconstructions with is_shown() equal to `shown`; if `shown`, the original is its first panel.
void add_reconstructions(Answer& answer, const SpectralStudy& study, bool shown) {
    const report::Fact mesh = "mesh"_a = study.name();
    output::FigureRequest figure{.id = id_of(study, shown ? "reconstructions" : "further"),
                                 .title = words.line("reconstructions.title", mesh),
                                 .subtitle = subtitle_of(*study.source),
                                 .view_files = true};
    std::string original = words.line("reconstructions.original"), exact;   // an exact one looks like the original
    for (const Reconstruction& r : study.reconstructions) {
        if (is_shown(study, r) != shown) continue;
        if (!is_exact(study, r.k)) {
            const std::string rms = percent_of_box(study, r.difference.area_weighted_rms);
            figure.panels.push_back(panel_of(r.mesh, id_of(study, "k" + std::to_string(r.k)),
                                             words.line("reconstructions.label", "k"_a = r.k, "rms"_a = rms),
                                             percent_of(study) * r.distance));
            continue;
        }
        original = words.line("reconstructions.exact", "k"_a = r.k);
        exact = " " + words.line("reconstructions.both", "k"_a = r.k);
    }
    if (!figure.panels.empty())
        figure.range = range_for({.colormap = "pale",
                                  .low = palest,
                                  .high = darkest,
                                  .quantity = words.line("reconstructions.quantity"),
                                  .unit = words.line("reconstructions.unit"),
                                  .logarithmic = true},
                                 figure.panels);
    std::string caption = words.line("further.caption", mesh);
    if (shown) {
        caption = words.line(figure.panels.empty() ? "reconstructions.caption.exact" : "reconstructions.caption", mesh, "exact"_a = exact,
                             "first"_a = std::to_string(study.reconstructions.front().k),
                             "last"_a = std::to_string(study.reconstructions.back().k));
        figure.panels.insert(figure.panels.begin(), panel_of(*study.source, id_of(study, "original"), original));
        figure.turnable = true;
    }
    add_figure(answer, std::move(figure), std::move(caption));
}

}   // namespace

void add_reconstruction_figure(Answer& answer, const SpectralStudy& study) { add_reconstructions(answer, study, true); }

void add_further_figures(Answer& answer, const Subjects& subjects) {
    for (const Subject& subject : subjects) {
        const SpectralStudy& study = subject.study;
        if (!std::ranges::all_of(study.reconstructions, [&](const Reconstruction& r) { return is_shown(study, r); }))
            add_reconstructions(answer, study, false);
    }
}

void add_eigenfunction_figure(Answer& answer, const SpectralStudy& study) {
    const std::vector<int> drawn = drawn_modes(study);
    if (drawn.empty()) return;
    output::FigureRequest request{.id = id_of(study, "eigenfunctions"),
                                  .title = words.line("eigenfunctions.title", "mesh"_a = study.name()),
                                  .subtitle = subtitle_of(*study.source),
                                  .layout = output::Layout::one_frame,
                                  .isoline_spacing = 2};   // draws the line of 0 alone, as values lie between −1 and 1
    for (const int mode : drawn) {
        const Vector phi = study.spectrum.eigenvectors.col(mode - 1);
        const std::string number = std::to_string(mode);
        request.panels.push_back(panel_of(*study.source, id_of(study, "phi" + number), "φ" + number, phi / phi.cwiseAbs().maxCoeff()));
        request.columns.push_back(words.line("eigenfunctions.column", "mode"_a = mode,
                                             "wave"_a = percent_of_box(study, wavelength(study, mode)),
                                             "edges"_a = readable(wavelength(study, mode) / study.preflight().mean_edge, 2)));
    }
    request.range = output::robust_range(request.panels, "diverging", "φ / max |φ|", "", 1);
    request.range->low = -1;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    const std::string caption = words.line("eigenfunctions.caption", "mesh"_a = study.name());
    add_figure(answer, std::move(request), caption, caption);
}

}   // namespace meshfolio::q4_spectral
