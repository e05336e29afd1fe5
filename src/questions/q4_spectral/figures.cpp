// Pictures of question 4 from one view: small multiples of one mesh in several states.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "mesh/triangle_measures.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/study_list.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

void add_multiples(Answer& answer, output::FigureRequest request, const std::string& caption) {
    request.three_quarter = request.three_quarter_frame = true;
    request.frame_panel = -1;   // what is blown up shall be seen whole
    answer.section.blocks.push_back(report::Figure{request.id, caption, caption});
    answer.figures.push_back(std::move(request));
}

output::FigureRequest request_for(const SpectralStudy& study, const std::string& what, const std::string& title) {
    output::FigureRequest request;
    request.id = id_of("q4", study.name(), what);
    request.title = title;
    request.subtitle = study.source->input.file + ", " + std::to_string(study.mesh().vertex_count()) + " vertices";
    return request;
}

/// Distances begin at 0; values beyond `high` are counted as clipped.
output::ColorRange distance_range(const std::vector<output::Panel>& panels, const std::string& colormap, double high) {
    output::ColorRange range = output::robust_range(panels, colormap, "distance to the original", "% of the box diagonal", 0.1);
    range.low = range.clipped_below = 0;
    if (high > 0) range.high = high;
    double all = 0, above = 0;
    for (const output::Panel& panel : panels) {
        all += static_cast<double>(panel.values.size());
        above += static_cast<double>((panel.values.array() > range.high).count());
    }
    range.clipped_above = above / all;
    return range;
}

output::Panel panel_of(const SpectralStudy& study, const std::string& what, const EqualisedMesh& state) {
    return panel_of(state.mesh, id_of("q4", study.name(), what + "_" + state.id), state.label, 100 / study.diagonal * state.distance);
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

void add_eigenfunction_gallery(Answer& answer, const SpectralStudy& study, bool quick) {
    const int shown = std::min(study.modes(), quick ? 12 : 24);
    output::FigureRequest request =
        request_for(study, "eigenfunctions", "The first " + std::to_string(shown) + " eigenfunctions of " + study.name());
    for (int i = 1; i <= shown; ++i) {
        const Vector phi = study.spectrum.eigenvectors.col(i - 1);
        request.panels.push_back(panel_of(*study.source, id_of("q4", study.name(), "phi" + std::to_string(i)),
                                          "φ" + std::to_string(i) + ", μ = " + readable(study.spectrum.eigenvalues[i - 1]),
                                          phi / phi.cwiseAbs().maxCoeff()));
    }
    request.range = output::robust_range(request.panels, "diverging", "φ / max |φ|", "", 1);
    request.range->low = -1;
    request.range->high = 1;
    request.range->clipped_below = request.range->clipped_above = 0;
    request.isoline_spacing = 2;   // of values between −1 and 1 only 0 is a multiple
    add_multiples(answer, std::move(request),
                  "The " + std::to_string(shown) + " smoothest eigenfunctions of " + study.name() +
                      ", each over its largest magnitude, with their nodal lines φ = 0. The further along, the smaller the regions between "
                      "the lines: wavelength " +
                      readable(2 * M_PI / std::sqrt(study.spectrum.eigenvalues[shown - 1])) + " at the last, of a box diagonal of " +
                      readable(study.diagonal) + ".");
}

void add_band_figure(Answer& answer, const SpectralStudy& study, const BandStudy& bands, const std::string& colormap) {
    if (bands.meshes.empty()) return;
    output::FigureRequest request = request_for(study, "bands", "Frequency bands of " + study.name() + " amplified and removed");
    for (const EqualisedMesh& state : bands.meshes) request.panels.push_back(panel_of(study, "bands", state));
    request.range = distance_range(request.panels, colormap, 0);
    request.panels.insert(request.panels.begin(), panel_of(*study.source, id_of("q4", study.name(), "bands_original"), "original"));
    std::string caption = "Filters of " + study.name() + " in its own frequencies, coloured by how far each vertex moved.";
    for (const Band& band : bands.bands)
        caption += " The " + band.name + " band is modes " + std::to_string(band.first) + " to " + std::to_string(band.last) + ".";
    caption += " Gains pass from band to band over half an octave of wavelength; only the low-pass is sharp.";
    caption += " All but the low-pass carry the detail beyond mode " + std::to_string(study.modes()) + " along. One camera and scale.";
    add_multiples(answer, std::move(request), caption);
}

void add_mistake_figure(Answer& answer, const SpectralStudy& study, const MistakeStudy& mistakes, const std::string& colormap) {
    output::FigureRequest request =
        request_for(study, "mistakes", "Three mistakes beside the right reconstruction, k = " + std::to_string(mistakes.pictured));
    request.panels.push_back(panel_of(*study.source, id_of("q4", study.name(), "mistakes_original"), "original"));
    std::string resized;
    double high = 0;
    for (const EqualisedMesh& state : mistakes.meshes) {
        output::Panel panel = panel_of(study, "mistakes", state);
        Shrunk shrunk = shrunk_to(study.mesh(), state.mesh);
        if (state.id == "right") high = 2 * panel.values.maxCoeff();
        if (shrunk.factor > 2 || shrunk.factor < 0.1) {
            panel.label +=
                shrunk.factor > 1 ? ", shrunk " + readable(shrunk.factor, 2) + "×" : ", enlarged " + readable(1 / shrunk.factor, 2) + "×";
            panel.mesh = std::make_shared<const TriangleMesh>(std::move(shrunk.mesh));
            resized = " One that would not fit is resized, its colours are not.";
        }
        request.panels.push_back(std::move(panel));
    }
    const std::vector<output::Panel> coloured(request.panels.begin() + 1, request.panels.end());
    request.range = distance_range(coloured, colormap, high);
    add_multiples(
        answer, std::move(request),
        study.name() + " rebuilt from " + std::to_string(mistakes.pictured) +
            " modes: by the M-orthogonal projection, by ψ that are not mapped back, by plain products with M-normalised "
            "modes, and by the modes of the operator normalised per edge. Coloured by the distance to the original, up to twice the "
            "largest of the right way." +
            resized);
}

}   // namespace meshfolio::q4_spectral
