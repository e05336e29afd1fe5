#include "questions/core/comparison_figure.h"

#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

namespace {

constexpr report::Words comparison_words("smoothing");

struct Displacement {
    double rms = 0, largest = 0;   // of the finite values
};

Displacement displacement_of(const Vector& percent) {
    Displacement d;
    double squares = 0;
    int count = 0;
    for (const double value : percent) {
        if (!std::isfinite(value)) continue;
        squares += value * value;
        d.largest = std::max(d.largest, value);
        ++count;
    }
    if (count > 0) d.rms = std::sqrt(squares / count);
    return d;
}

}   // namespace

Vector displacement_percent(const Positions& before, const Positions& after, double diagonal) {
    Vector percent = (after - before).rowwise().norm() * (100 / diagonal);
    for (double& value : percent)
        if (!std::isfinite(value)) value = std::nan("");
    return percent;
}

void add_comparison(Answer& answer, ComparisonFigure figure) {
    output::FigureRequest request;
    request.id = figure.id;
    request.title = figure.title;
    request.subtitle = figure.subtitle;
    request.layout = output::Layout::comparison;
    request.turnable = true;
    request.frame_panel = figure.frame_panel;
    output::Panel moved{figure.id + "_moved", comparison_words.line("comparison.moved"), figure.after.mesh,
                        displacement_percent(figure.before.mesh->X, figure.after.mesh->X, figure.diagonal)};
    request.range = output::robust_range({moved}, figure.colormap, "displacement", "% of the box diagonal", 0.01);
    request.range->low = request.range->clipped_below = 0;   // a distance begins at 0

    const Displacement d = displacement_of(moved.values);
    const report::Facts facts{
        "caption"_a = figure.caption, "title"_a = figure.title, "before"_a = figure.before.label, "after"_a = figure.after.label,
        "measured"_a = comparison_words.line("comparison.measured", "rms"_a = readable(d.rms), "largest"_a = readable(d.largest))};
    add(answer.section,
        report::Figure{figure.id, comparison_words.line("comparison.caption", facts), comparison_words.line("comparison.alt", facts)});
    request.panels = {std::move(figure.before), std::move(figure.after), std::move(moved)};
    answer.figures.push_back(std::move(request));
}

}   // namespace meshfolio
