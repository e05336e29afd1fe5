#include "run/stored_results.h"

#include "base/errors.h"
#include "questions/core/section_tools.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/provenance.h"
#include "run/question_cache.h"

namespace meshfolio::run {

namespace {

/// Stores complete answers only: the cause of a failure may be temporary.
bool is_worth_keeping(const QuestionResult& result) {
    return !result.stored && result.section().status == report::Status::ok && !lacks_a_mesh(result.section());
}

report::DrawnFigures figures_of(const Answer& answer, const report::DrawnFigures& all) {
    report::DrawnFigures figures;
    for (const output::FigureRequest& request : answer.figures) figures[request.id] = all.at(request.id);
    return figures;
}

}   // namespace

std::unique_ptr<output::ResultCache> cache_for_report() {
    return !environment("MESHFOLIO_FAIL").empty() || program_identity().empty() ? nullptr : usable_cache();
}

std::vector<const Answer*> answers_of(const std::vector<QuestionResult>& results) {
    std::vector<const Answer*> answers;
    for (const QuestionResult& result : results)
        if (!result.stored) answers.push_back(&result.answer);
    return answers;
}

std::set<std::string> stored_sections(const std::vector<QuestionResult>& results) {
    std::set<std::string> ids;
    for (const QuestionResult& result : results)
        if (result.stored) ids.insert(result.section().id);
    return ids;
}

void add_stored_figures(const std::vector<QuestionResult>& results, report::DrawnFigures& figures) {
    for (const QuestionResult& result : results)
        if (result.stored) figures.insert(result.stored->figures.begin(), result.stored->figures.end());
}

output::Publication::Digests stored_and_kept(const std::vector<QuestionResult>& results, const report::DrawnFigures& figures,
                                             output::ResultCache* store, const QuestionCache* cache) {
    output::Publication::Digests digests;
    const auto add = [&](const std::map<std::string, std::string>& some) { digests.insert(some.begin(), some.end()); };
    for (const QuestionResult& result : results)
        if (result.stored) add(result.stored->digests);
    if (store == nullptr) return digests;
    bool is_changed = false;
    try {
        for (const QuestionResult& result : results) {
            if (!is_worth_keeping(result)) continue;
            add(cache->keep(result.section(), figures_of(result.answer, figures), result.lookups));
            is_changed = true;
        }
        if (is_changed) store->trim();
    } catch (const Error& error) {
        warn("the cache could not be written: " + std::string(error.what()));
    }
    return digests;
}

}   // namespace meshfolio::run
