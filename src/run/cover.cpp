#include "run/cover.h"

#include "geometry/curvature/curvature.h"
#include "mesh/mesh_topology.h"

namespace meshfolio::run {

namespace {

/// Sum of the magnitudes of the angle deficits [rad]: 4π for what is closed and convex, 0 for what is flat, more the more there is to be
/// seen.
double bending(const TriangleMesh& mesh) { return angle_deficit(mesh, topology_of(mesh)).cwiseAbs().sum(); }

CoverOffer offer_with(const output::FigureRequest& figure) {
    const std::string mesh = figure.subtitle.empty() ? "a surface" : figure.subtitle;
    return {figure.turnable, 1 + bending(*figure.panels.front().mesh),
            figure.range->quantity + " on " + mesh + ", seen from the right front and above"};
}

/// The figure of an answer that is best on the first page; null: none will do.
const output::FigureRequest* best_figure(const Answer& answer) {
    const output::FigureRequest* best = nullptr;
    CoverOffer most;
    for (const output::FigureRequest& figure : answer.figures) {
        const bool has_values = figure.panels.size() == 1 && figure.panels.front().values.size() > 0 && figure.range;
        if (!has_values) continue;
        const CoverOffer offer = offer_with(figure);
        if (offer.beats(most)) best = &figure, most = offer;
    }
    return best;
}

output::FigureRequest cover_of(output::FigureRequest figure) {
    figure.id = figure.panels.front().name = "cover";
    figure.title.clear();
    figure.subtitle.clear();
    figure.layout = output::Layout::multiples;
    figure.turnable = false;
    return figure;
}

CoverOffer offered_by(const QuestionResult& result) { return result.stored ? result.stored->cover : offer_of(result.answer); }

}   // namespace

CoverOffer offer_of(const Answer& answer) {
    const output::FigureRequest* figure = best_figure(answer);
    return figure == nullptr ? CoverOffer{} : offer_with(*figure);
}

report::Cover Cover::figure(const std::vector<QuestionResult>& results) const {
    return {{"cover", "", offer.alt}, results[result].section().id, offer.turnable, offer.worth};
}

std::optional<Cover> chosen_cover(std::vector<QuestionResult>& results,
                                  const std::function<QuestionResult(const std::string& id)>& answer_again) {
    Cover cover;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const CoverOffer offer = offered_by(results[i]);
        if (offer.beats(cover.offer)) cover.offer = offer, cover.result = i;
    }
    if (cover.offer.worth == 0) return {};
    QuestionResult& best = results[cover.result];
    if (best.stored) {
        cover.stored = best.stored->find_cover();
        if (cover.stored) return cover;
        best = answer_again(best.section().id);
        if (best.section().status != report::Status::ok) return {};
    }
    if (const output::FigureRequest* figure = best_figure(best.answer)) cover.request = cover_of(*figure);
    return cover.request ? std::optional(cover) : std::nullopt;
}

}   // namespace meshfolio::run
