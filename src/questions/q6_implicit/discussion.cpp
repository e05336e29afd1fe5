#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/sentences.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

using Names = std::vector<std::string>;

/// "after 10 iterations at 0.5 λ_crit".
std::string run_of(const ImplicitStudy& study, const SmoothingCell& cell) {
    return words.line("run", "iterations"_a = cell.iterations, "at_step"_a = at_step(study.subject, cell.lambda));
}

/// How far to smooth each mesh.
report::Text good_time(const Studies& studies) {
    report::Text told;
    Names none;
    for (const ImplicitStudy& study : studies) {
        if (!study.recommended) {
            none.push_back(study.name());
            continue;
        }
        const Recommendation& good = *study.recommended;
        const double h = study.subject.mean_edge;
        told = paragraph_of({told.empty() ? words.say("good") : told,
                             words.say("good.mesh", "mesh"_a = study.name(), "time"_a = readable(good.time() / (h * h), 2),
                                       "step"_a = step_label(study.subject, good.lambda), "iterations"_a = good.iterations,
                                       "fall"_a = energy_fall(good.energy), "kept"_a = readable_percent(good.kept, 2),
                                       "turned"_a = good.turned > 0 ? words.line("good.turned", "turned"_a = good.turned) : "",
                                       "figure"_a = id_of("q6", study.name(), "before_after"))});
    }
    return paragraph_of({told, said_of(none, words, "good.none")});
}

/// How far apart the two schemes end within the explicit limit, as a share of the motion; NaN where there is nothing to compare.
double gap_within_the_limit(const ImplicitStudy& study) {
    const SmoothingCell& cell = study.middle_cell(0);
    const double moved = vertex_rms(study.subject.mesh().X, cell.implicit_X);
    if (!cell.has_explicit() || moved <= 0 || cell.lambda > study.subject.critical || cell.implicit_energy < 1e-3) return NAN;
    return vertex_rms(cell.implicit_X, cell.explicit_X) / moved;
}

report::Text agreement(const Studies& studies) {
    std::vector<Observed> gaps;
    for (const ImplicitStudy& study : studies) {
        const double gap = gap_within_the_limit(study);
        if (std::isnan(gap)) continue;
        gaps.push_back({words.line(gap < 0.05  ? "agreement.close"
                                   : gap < 0.3 ? "agreement.rough"
                                               : "agreement.bad",
                                   "mesh"_a = study.name(), "gap"_a = readable_percent(gap, 2)),
                        run_of(study, study.middle_cell(0))});
    }
    return said_of(gaps, words, "agreement");
}

/// Where the explicit runs end, one entry a mesh that has one: at the smallest step that blew up.
std::vector<Observed> explicit_ends(const Studies& studies) {
    std::vector<Observed> ends;
    for (const ImplicitStudy& study : studies) {
        // The grid ascends.
        const auto blown = std::ranges::find_if(study.grid, [](const SmoothingCell& cell) { return cell.explicit_blow_up > 0; });
        if (blown == study.grid.end()) continue;
        ends.push_back({words.line("beyond.mesh", "iteration"_a = blown->explicit_blow_up, "mesh"_a = study.name()),
                        at_step(study.subject, blown->lambda)});
    }
    return ends;
}

/// What the largest implicit step leaves of a mesh.
std::string remains_of(const ImplicitStudy& study, const SmoothingCell& far) {
    if (far.collapsed()) return words.line("remains.collapsed", "mesh"_a = study.name());
    const int faces = far.inverted_faces;
    return words.line(std::isfinite(far.volume_ratio) ? "remains.closed" : "remains.open", "mesh"_a = study.name(),
                      "energy"_a = readable_percent(far.implicit_energy, 2), "volume"_a = readable_percent(far.volume_ratio, 2),
                      "turned"_a = faces > 0 ? words.line("remains.turned", "faces"_a = faces) : "");
}

/// An open mesh has no volume; what it has lost shows in its energy.
bool has_lost_its_shape(const SmoothingCell& far) {
    return far.collapsed() || (std::isfinite(far.volume_ratio) ? far.volume_ratio < 0.5 : far.implicit_energy < 0.05);
}

report::Text beyond_the_limit(const Studies& studies) {
    std::vector<Observed> lost, kept;
    for (const ImplicitStudy& study : studies) {
        const SmoothingCell& far = study.middle_cell(study.lambdas.size() - 1);
        (has_lost_its_shape(far) ? lost : kept).push_back({remains_of(study, far), run_of(study, far)});
    }
    return paragraph_of({said_of(explicit_ends(studies), words, "beyond"), said_of(lost, words, "remains.lost"),
                         said_of(kept, words, lost.empty() ? "remains.all_kept" : "remains.kept")});
}

/// Two cells of equal λt: one step of 10 λ against ten of λ, say.
struct EqualTime {
    const SmoothingCell *few = nullptr, *many = nullptr;
    double share = NAN;   // distance of the results over the motion
};

EqualTime equal_time(const ImplicitStudy& study) {
    for (const SmoothingCell& a : study.grid) {
        for (const SmoothingCell& b : study.grid) {
            if (a.iterations >= b.iterations || std::abs(a.lambda * a.iterations / (b.lambda * b.iterations) - 1) > 1e-9) continue;
            return {&a, &b, vertex_rms(a.implicit_X, b.implicit_X) / vertex_rms(study.subject.mesh().X, b.implicit_X)};
        }
    }
    return {};
}

report::Text iterations_against_steps(const Studies& studies) {
    std::vector<Observed> compared;
    double worst = 0;
    for (const ImplicitStudy& study : studies) {
        const EqualTime pair = equal_time(study);
        if (!std::isfinite(pair.share)) continue;
        worst = std::max(worst, pair.share);
        compared.push_back(
            {words.line("equal_time.mesh", "share"_a = readable_percent(pair.share, 2), "mesh"_a = study.name()),
             words.line("equal_time.steps", "many"_a = pair.many->iterations, "few"_a = pair.few->iterations,
                        "small"_a = in_limits(study.subject, pair.many->lambda), "large"_a = in_limits(study.subject, pair.few->lambda))});
    }
    if (compared.empty()) return {};
    return paragraph_of({words.say(worst < 0.05  ? "equal_time.near"
                                   : worst < 0.4 ? "equal_time.rough"
                                                 : "equal_time.far"),
                         said_of(compared, words, "equal_time")});
}

report::Text price(const Studies& studies) {
    Names prices, step_ratios, ratios, no_speed, only;
    for (const ImplicitStudy& study : studies) {
        const SmoothingCost& cost = study.cost;
        prices.push_back(words.line(prices.empty() ? "price.first" : "price.other", "mesh"_a = study.name(),
                                    "energy"_a = readable_percent(cost.energy), "implicit"_a = cost.implicit_steps,
                                    "explicit"_a = cost.reached() ? std::to_string(cost.explicit_steps) : words.line("price.unreached")));
        if (!cost.reached()) {
            only.push_back(study.name());
            continue;
        }
        step_ratios.push_back(readable(2.0 * double(cost.factor_nonzeros) / double(cost.operator_nonzeros), 2));
        ratios.push_back(readable(cost.explicit_operations / cost.implicit_operations, 2));
        if (cost.explicit_operations <= cost.implicit_operations) no_speed.push_back(study.name());
    }
    const report::Text times =
        ratios.empty() ? report::Text() : words.say("price.ratios", "steps"_a = listed(step_ratios), "ratios"_a = listed(ratios));
    return paragraph_of(
        {said_of(prices, words, "price"), times, said_of(no_speed, words, "price.no_speed"), said_of(only, words, "price.only")});
}

}   // namespace

void add_discussion(report::Section& section, const Studies& studies) {
    add_words(section, words, "discussion");
    add_paragraphs(section,
                   {good_time(studies), agreement(studies), beyond_the_limit(studies), iterations_against_steps(studies), price(studies)});
}

}   // namespace meshfolio::q6_implicit
