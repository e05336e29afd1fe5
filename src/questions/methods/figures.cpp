#include "geometry/measures/mesh_error.h"
#include "questions/methods/parts.h"

namespace meshfolio::methods {

void add_method_figure(Answer& answer, const DenoisingTrials& mesh, const NoiseTrial& trial) {
    const DenoisingSubject& subject = mesh.subject;
    const std::string base = id_of("methods", mesh.name(), trial.id());
    const auto coloured = [&](const Positions& X, const std::string& what, std::string label) {
        return panel_of(moved_to(subject.mesh, X), base + "_" + what, std::move(label),
                        shape_distances(subject.mesh, X) / subject.mean_edge);
    };
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy")};
    Names labels;
    for (const SearchResult& result : trial.results) {
        if (!result.defined) continue;
        labels.push_back(method_title(result) + ", gain " + readable(result.gain(), 2));
        panels.push_back(coloured(result.X, std::string(denoising_entry(result.method).name), labels.back()));
    }
    output::FigureRequest request{.id = base,
                                  .title = words.line("figure.title", "mesh"_a = mesh.name()),
                                  .subtitle = words.line("figure.subtitle", "noise"_a = trial.title()),
                                  .range = output::robust_range(panels, "pale", words.line("figure.quantity"), "mean edges", 0.01),
                                  .layout = output::Layout::one_frame};
    request.range->low = request.range->clipped_below = 0;   // a distance begins at 0
    panels.insert(panels.begin(), panel_of(subject.mesh, base + "_clean", "clean"));
    request.panels = std::move(panels);
    const std::string name = subject.is_patch() ? words.line("figure.patch", "mesh"_a = mesh.name()) : mesh.name();
    const double error = trial.results.front().noisy.shape / subject.mean_edge;
    add_figure(answer, std::move(request), words.line("figure.caption", "mesh"_a = name, "noise"_a = trial.title()),
               words.line("figure.alt", "mesh"_a = mesh.name(), "error"_a = readable(error, 2), "methods"_a = joined(labels)));
}

}   // namespace meshfolio::methods
