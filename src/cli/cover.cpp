#include "cli/cover.h"

namespace meshfolio::cli {

namespace {

long triangles_of(const output::FigureRequest& figure) { return static_cast<long>(figure.panels.front().mesh->F.rows()); }

/// The figure of an answer that is best on the first page; null: none will do.
const output::FigureRequest* best_figure(const Answer& answer) {
    const output::FigureRequest* best = nullptr;
    for (const output::FigureRequest& figure : answer.figures) {
        const bool has_values = figure.panels.size() == 1 && figure.panels.front().values.size() > 0 && figure.range;
        if (has_values && (best == nullptr || triangles_of(figure) > triangles_of(*best))) best = &figure;
    }
    return best;
}

output::FigureRequest cover_of(output::FigureRequest figure) {
    figure.id = figure.panels.front().name = "cover";
    figure.title.clear();
    figure.subtitle.clear();
    figure.three_quarter = true;
    return figure;
}

CoverOffer offered_by(const QuestionResult& result) { return result.stored ? result.stored->cover : offer_of(result.answer); }

}   // namespace

CoverOffer offer_of(const Answer& answer) {
    const output::FigureRequest* figure = best_figure(answer);
    if (figure == nullptr) return {};
    return {triangles_of(*figure), figure->range->quantity};
}

report::Figure Cover::figure() const { return {"cover", "", quantity + " on a surface seen from the right front and above"}; }

std::optional<Cover> chosen_cover(std::vector<QuestionResult>& results, const QuestionCache* cache,
                                  const std::function<QuestionResult(const std::string& id)>& answer_again) {
    Cover cover;
    long most = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
        const CoverOffer offer = offered_by(results[i]);
        if (offer.triangles <= most) continue;
        most = offer.triangles;
        cover.result = i;
        cover.quantity = offer.quantity;
    }
    if (most == 0) return {};
    QuestionResult& best = results[cover.result];
    if (best.stored) {
        cover.stored = cache->find_cover(best.stored->key);
        if (cover.stored) return cover;
        best = answer_again(best.section().id);
        if (best.section().status != report::Status::ok) return {};
    }
    if (const output::FigureRequest* figure = best_figure(best.answer)) cover.request = cover_of(*figure);
    return cover.request ? std::optional(cover) : std::nullopt;
}

}   // namespace meshfolio::cli
