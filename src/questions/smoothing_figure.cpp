#include "questions/smoothing_figure.h"

namespace meshfolio {

output::Panel smoothing_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label) {
    return panel_of(moved_to(subject.mesh(), X), std::move(name), std::move(label), curvature_colours(subject, X));
}

void add_smoothing_figure(Answer& answer, const SmoothingSubject& subject, std::string before, SixViewFigure figure) {
    figure.panels.insert(figure.panels.begin(),
                         panel_of(*subject.source, std::move(before), "before", curvature_colours(subject, subject.mesh().X)));
    figure.range = output::robust_range({figure.panels.front()}, "diverging", "mean curvature × mean edge", "", 0.02);
    add_figure(answer, std::move(figure));
}

}   // namespace meshfolio
