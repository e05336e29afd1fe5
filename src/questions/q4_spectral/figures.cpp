#include "mesh/triangle_measures.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/six_view_figure.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

/// Small multiples: one mesh in several states, from one view.
void add_multiples(Answer& answer, output::FigureRequest request, const std::string& caption) {
    request.layout = output::Layout::one_frame;
    request.frame_panel = -1;   // what is blown up shall be seen whole
    add(answer.section, report::Figure{request.id, caption, caption});
    answer.figures.push_back(std::move(request));
}

output::FigureRequest request_for(const SpectralStudy& study, const std::string& what, std::string title) {
    output::FigureRequest request;
    request.id = id_of(study, what);
    request.title = std::move(title);
    request.subtitle = subtitle_of(*study.source);
    return request;
}

/// Distances begin at 0. @param high  0: as far as nearly all values reach; others beyond it are counted as clipped
output::ColorRange distance_range(const std::vector<output::Panel>& panels, const std::string& colormap, double high = 0) {
    output::ColorRange range = output::robust_range(panels, colormap, "distance to the original", words.line("of_the_diagonal"), 0.1);
    range.low = range.clipped_below = 0;
    if (high == 0) return range;
    range.high = high;
    double all = 0, above = 0;
    for (const output::Panel& panel : panels) {
        all += static_cast<double>(panel.values.size());
        above += static_cast<double>((panel.values.array() > high).count());
    }
    range.clipped_above = above / all;
    return range;
}

output::Panel panel_of(const SpectralStudy& study, const std::string& what, const EqualisedMesh& state) {
    return panel_of(state.mesh, id_of(study, what + "_" + state.id), state.label, percent_of(study) * state.distance);
}

output::Panel original(const SpectralStudy& study, const std::string& name) {
    return panel_of(*study.source, id_of(study, name), "original");
}

/// The mesh brought to the size and the place of the original, and by how much it had to shrink for that.
struct Shrunk {
    TriangleMesh mesh;
    double factor = 1;
};
Shrunk shrunk_to(const TriangleMesh& original, const TriangleMesh& mesh) {
    const Box box = bounding_box(original), other = bounding_box(mesh);
    Shrunk result{mesh, other.diagonal() / box.diagonal()};
    result.mesh.X = ((mesh.X.rowwise() - other.centre().transpose()) / result.factor).rowwise() + box.centre().transpose();
    return result;
}

}   // namespace

void add_reconstruction_figure(Answer& answer, const SpectralStudy& study) {
    SixViewFigure figure{.id = id_of(study, "reconstructions"),
                         .title = words.line("reconstructions.title", "mesh"_a = study.name()),
                         .subtitle = subtitle_of(*study.source),
                         .caption = words.line("reconstructions.caption")};
    for (const Reconstruction& r : study.reconstructions) {
        const std::string k = std::to_string(r.k);
        figure.panels.push_back(panel_of(r.mesh, id_of(study, "k" + k), "k = " + k, percent_of(study) * r.distance));
    }
    // The first k would use up the whole range, the last has only rounding: the range is that of all panels together.
    figure.range = distance_range(figure.panels, "viridis");
    figure.panels.insert(figure.panels.begin(), original(study, "original"));
    add_figure(answer, std::move(figure));
}

void add_before_after(Answer& answer, const SpectralStudy& study, const std::string& colormap) {
    const Reconstruction& r = study.reconstructions[study.reconstructions.size() / 2];
    const std::string id = id_of(study, "before_after");
    add_comparison(
        answer,
        {.id = id,
         .title = words.line("before_after.title", "mesh"_a = study.name(), "k"_a = r.k),
         .subtitle = words.line("before_after.subtitle", "file"_a = study.source->input.file, "k"_a = r.k, "vertices"_a = study.vertices()),
         .caption = words.line("before_after.caption", "mesh"_a = study.name(), "k"_a = r.k, "vertices"_a = study.vertices(),
                               "hausdorff"_a = percent_of_box(study, r.difference.hausdorff),
                               "angle"_a = readable(r.difference.mean_normal_angle * 180 / pi)),
         .before = panel_of(*study.source, id + "_original", "original"),
         .after = panel_of(r.mesh, id + "_rebuilt", "rebuilt, k = " + std::to_string(r.k)),
         .diagonal = study.diagonal,
         .colormap = colormap});
}

void add_eigenfunction_gallery(Answer& answer, const SpectralStudy& study, bool quick) {
    const int shown = std::min(study.modes(), quick ? 12 : 24);
    output::FigureRequest request =
        request_for(study, "eigenfunctions", words.line("eigenfunctions.title", "shown"_a = shown, "mesh"_a = study.name()));
    for (int i = 1; i <= shown; ++i) {
        const Vector phi = study.spectrum.eigenvectors.col(i - 1);
        const std::string number = std::to_string(i);
        request.panels.push_back(panel_of(*study.source, id_of(study, "phi" + number),
                                          "φ" + number + ", μ = " + readable(study.spectrum.eigenvalues[i - 1]),
                                          phi / phi.cwiseAbs().maxCoeff()));
    }
    request.range = output::robust_range(request.panels, "diverging", "φ / max |φ|", "", 1);
    request.range->low = -1;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    request.isoline_spacing = 2;   // of values between −1 and 1 only 0 is a multiple
    add_multiples(answer, std::move(request),
                  words.line("eigenfunctions.caption", "shown"_a = shown, "mesh"_a = study.name(),
                             "wavelength"_a = readable(wavelength(study, shown)), "diagonal"_a = readable(study.diagonal)));
}

void add_band_figure(Answer& answer, const SpectralStudy& study, const BandStudy& bands, const std::string& colormap) {
    if (bands.meshes.empty()) return;
    output::FigureRequest request = request_for(study, "bands", words.line("bands.title", "mesh"_a = study.name()));
    for (const EqualisedMesh& state : bands.meshes) request.panels.push_back(panel_of(study, "bands", state));
    request.range = distance_range(request.panels, colormap);
    request.panels.insert(request.panels.begin(), original(study, "bands_original"));
    std::string told;
    for (const Band& band : bands.bands)
        told += (told.empty() ? "" : " ") +
                words.line("bands.caption.band", "band"_a = band.name, "first"_a = band.first, "last"_a = band.last);
    add_multiples(answer, std::move(request),
                  words.line("bands.caption", "mesh"_a = study.name(), "bands"_a = told, "modes"_a = study.modes()));
}

void add_mistake_figure(Answer& answer, const SpectralStudy& study, const MistakeStudy& mistakes, const std::string& colormap) {
    output::FigureRequest request = request_for(study, "mistakes", words.line("mistakes.title", "k"_a = mistakes.pictured));
    std::string caption = words.line("mistakes.caption", "mesh"_a = study.name(), "k"_a = mistakes.pictured);
    bool resized = false;
    double high = 0;
    for (const EqualisedMesh& state : mistakes.meshes) {
        output::Panel panel = panel_of(study, "mistakes", state);
        Shrunk shrunk = shrunk_to(study.mesh(), state.mesh);
        if (state.id == "right") high = 2 * panel.values.maxCoeff();
        if (shrunk.factor > 2 || shrunk.factor < 0.1) {
            panel.label +=
                shrunk.factor > 1 ? ", shrunk " + readable(shrunk.factor, 2) + "×" : ", enlarged " + readable(1 / shrunk.factor, 2) + "×";
            panel.mesh = std::make_shared<const TriangleMesh>(std::move(shrunk.mesh));
            resized = true;
        }
        request.panels.push_back(std::move(panel));
    }
    if (resized) caption += " " + words.line("mistakes.caption.resized");
    request.range = distance_range(request.panels, colormap, high);
    request.panels.insert(request.panels.begin(), original(study, "mistakes_original"));
    add_multiples(answer, std::move(request), caption);
}

}   // namespace meshfolio::q4_spectral
