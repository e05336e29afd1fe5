// What the numbers of question 5 say: one theme a paragraph, all meshes side by side in it.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

using report::math;
using report::ref;

using Studies = std::vector<ExplicitStudy>;

int vertices_of(const ExplicitStudy& study) { return study.subject.source->prepared->preflight.vertices_in_use; }

double in_squared_edges(const ExplicitStudy& study) { return study.subject.critical / (study.subject.mean_edge * study.subject.mean_edge); }

std::string in_limits(const ExplicitStudy& study, double lambda) { return plain_text(lambda / study.subject.critical, 3) + "\u202fλ_crit"; }

// ---- how large may it be ------------------------------------------------------------------------------------------------

/// What holds the top mode: the whole triangulation, a region, or a single spot.
enum class Extent { spot, region, whole };

Extent extent_of_top_mode(const ExplicitStudy& study) {
    const double support = study.subject.top.support;
    const int vertices = vertices_of(study);
    if (support < 10 && support < 0.5 * vertices) return Extent::spot;
    return support < 0.05 * vertices ? Extent::region : Extent::whole;
}

/// "cube (about 93 of 602 vertices)", with the vertex where there is one to name.
std::string where_the_top_mode_is(const ExplicitStudy& study) {
    std::string place = study.name() + " (about " + readable(std::max(1.0, study.subject.top.support), 2) + " of " +
                        std::to_string(vertices_of(study)) + " vertices";
    if (extent_of_top_mode(study) != Extent::whole) place += ", around vertex " + std::to_string(study.subject.top.vertex);
    return place + ")";
}

report::Text what_sets_the_limit(const Studies& studies) {
    const auto places = [&](Extent extent) {
        std::vector<std::string> list;
        for (const ExplicitStudy& study : studies) {
            if (extent_of_top_mode(study) == extent) list.push_back(where_the_top_mode_is(study));
        }
        return listed(list);
    };
    report::Text t;
    if (const std::string whole = places(Extent::whole); !whole.empty())
        report::extend(t, " The top mode spreads over the triangulation as a whole on ", whole, ", where no single vertex is to blame.");
    if (const std::string region = places(Extent::region); !region.empty())
        report::extend(t, " A small region sets the limit on ", region, ".");
    if (const std::string spot = places(Extent::spot); !spot.empty())
        report::extend(t, " A single spot with small areas or large cotangents sets it for all other vertices on ", spot, ".");
    return t;
}

report::Text how_large(const Studies& studies) {
    std::vector<std::string> limits;
    double lowest = INFINITY;
    for (const ExplicitStudy& study : studies) {
        limits.push_back(readable(study.subject.critical, 4) + " on " + study.name() + " (" + readable(in_squared_edges(study), 2) +
                         " squared mean edges)");
        lowest = std::min(lowest, in_squared_edges(study));
    }
    // Right triangles of two sides s allow s²/4, and their mean edge is (2 + √2)s/3.
    static const double grid = 0.25 / std::pow((2 + std::sqrt(2.0)) / 3, 2);
    report::Text t =
        report::text("Explicit smoothing is stable up to ", math("λ_crit = 2/μ_max"), ": ", listed(limits), " (", ref("q5_limits"),
                     "). A regular grid of right triangles allows ", readable(grid, 2), " squared mean edges, equilateral ones a third");
    report::extend(t, lowest < 0.5 * grid ? ", so the worst of these meshes pays " + readable(grid / lowest, 2) +
                                                "-fold for its triangles, against the grid."
                                          : "; these allow at least half of what the grid does.");
    report::extend(t, what_sets_the_limit(studies));
    return t;
}

// ---- which one to take --------------------------------------------------------------------------------------------------

/// What smoothing with the recommended step does to energy, place, volume and faces.
report::Text effect_of(const ExplicitStudy& study, const SmoothingRun& run) {
    report::Text t =
        report::text(" On ", study.name(), " λ = ", step_label(study.subject, run.lambda), " lowers the Dirichlet energy ",
                     energy_fall(run.energy.back()), " in ", counted(run.result.iterations, "iteration"), " and moves the vertices by ",
                     readable_percent(run.moved.rms / study.subject.diagonal), " of the box diagonal (rms)");
    if (const int kept = iterations_keeping_volume(run, 0.95); kept >= 0) {
        report::extend(t, ", but leaves only ", readable_percent(run.volume_ratio, 4), " of the volume: for 95\u202f% of it stop after ",
                       counted(kept, "iteration"));
    } else if (std::isfinite(run.volume_ratio)) {
        report::extend(t, ", with ", readable_percent(run.volume_ratio, 4), " of the volume");
    }
    if (run.moved.inverted_faces > 0) {
        report::extend(t, "; ", counted(run.moved.inverted_faces, "face"), " of ", std::to_string(study.subject.mesh().face_count()), " ",
                       run.moved.inverted_faces == 1 ? "ends" : "end", " turned against the input");
    }
    report::extend(t, ".");
    return t;
}

report::Text good_step(const Studies& studies) {
    std::vector<std::string> none;
    report::Text effects;
    bool all_keep_signs = true, any = false;
    for (const ExplicitStudy& study : studies) {
        if (study.best < 0) {
            none.push_back(study.name());
            continue;
        }
        const SmoothingRun& best = study.runs[static_cast<std::size_t>(study.best)];
        any = true;
        all_keep_signs = all_keep_signs && keeps_signs(study.subject, best.lambda);
        report::extend(effects, effect_of(study, best));
    }
    report::Text t;
    if (any && all_keep_signs) {
        report::extend(t, "Of the steps tried the one to use is that which smooths most while no mode changes its sign (", math("λμ ≤ 1"),
                       ", half the limit at most). A larger one that is still stable may leave less roughness after as many iterations (",
                       ref("claims_s1_largest_stable"), "), but turns the highest modes over at every step (", ref("modes_damping"), ").");
    } else if (any) {
        report::extend(t, "Of the steps tried the best are stable, though the highest modes change sign from step to step where ",
                       math("λμ > 1"), ".");
    }
    report::extend(t, effects);
    if (!none.empty()) {
        report::extend(t, any ? " On " : "On ", listed(none),
                       " none of the steps tried lies below the limit, so none can be recommended there.");
    }
    return t;
}

// ---- and beyond -----------------------------------------------------------------------------------------------------------

/// The first run beyond the limit; −1: there is none.
int first_beyond(const ExplicitStudy& study) {
    for (std::size_t i = 0; i < study.runs.size(); ++i) {
        if (!study.stable(i)) return static_cast<int>(i);
    }
    return -1;
}

report::Text growth_of_the_top_mode(const std::vector<const ExplicitStudy*>& beyond) {
    std::vector<Observed> grown;
    for (const ExplicitStudy* study : beyond) {
        const auto i = static_cast<std::size_t>(first_beyond(*study));
        const double lambda = study->runs[i].lambda;
        grown.push_back({readable(study->amplification[i].measured, 3) + "-fold on " + study->name(),
                         readable(study->amplification[i].predicted, 3) + "-fold by prediction, from " +
                             readable(1 - lambda * study->subject.top.value, 3) + " a step at " + in_limits(*study, lambda)});
    }
    return report::text("Too large a step amplifies what it should remove: the top mode is multiplied by ", math("1 − λμ_max"),
                        ", flips at every step and grows. In 20 steps it grew ", listed_observed(grown), ".");
}

/// Where the largest step tried ends, and whether it breaks at the vertex that sets the limit.
report::Text where_it_breaks(const std::vector<const ExplicitStudy*>& beyond) {
    std::vector<Observed> blown, turned;
    std::vector<std::string> at_top;
    for (const ExplicitStudy* study : beyond) {
        const SmoothingRun& last = study->runs.back();
        const std::string step = "at " + in_limits(*study, last.lambda);
        if (last.result.blew_up) {
            blown.push_back({"in iteration " + std::to_string(last.result.blow_up_iteration) + " on " + study->name() + " (vertex " +
                                 std::to_string(last.result.blow_up_vertex) + ")",
                             step});
            if (last.result.blow_up_vertex == study->subject.top.vertex) at_top.push_back(study->name());
        } else if (last.moved.inverted_faces > 0) {
            turned.push_back({counted(last.moved.inverted_faces, "face") + " of " + std::to_string(study->subject.mesh().face_count()) +
                                  " on " + study->name(),
                              step + " in " + counted(last.result.iterations, "iteration")});
        }
    }
    report::Text t;
    if (!blown.empty()) report::extend(t, " The first vertex is a thousand box diagonals away ", listed_observed(blown), ".");
    if (!at_top.empty()) report::extend(t, " On ", listed(at_top), " it is the very vertex where the top mode is largest.");
    if (!turned.empty()) report::extend(t, " The largest step turns over ", listed_observed(turned), ".");
    return t;
}

report::Text what_energy_hides(const std::vector<const ExplicitStudy*>& beyond) {
    std::vector<Observed> hidden;
    for (const ExplicitStudy* study : beyond) {
        const SmoothingRun& run = study->runs[static_cast<std::size_t>(first_beyond(*study))];
        if (run.energy.back() >= run.energy.front()) continue;
        hidden.push_back({energy_fall(run.energy.back()) + " on " + study->name(),
                          "at " + in_limits(*study, run.lambda) + " in " + counted(run.result.iterations, "iteration")});
    }
    if (hidden.empty()) return {};
    return report::text(" Just beyond the limit nothing may show at first, for the energy still falls ", listed_observed(hidden), ".");
}

report::Text too_large(const Studies& studies) {
    std::vector<const ExplicitStudy*> beyond;
    std::vector<std::string> within;
    for (const ExplicitStudy& study : studies) {
        if (first_beyond(study) >= 0) {
            beyond.push_back(&study);
        } else {
            within.push_back(study.name());
        }
    }
    report::Text t;
    if (!beyond.empty()) report::extend(t, growth_of_the_top_mode(beyond), where_it_breaks(beyond), what_energy_hides(beyond));
    if (!within.empty()) report::extend(t, beyond.empty() ? "" : " ", "No step tried on ", listed(within), " exceeds the limit.");
    return t;
}

// ---- what a number for λ means ----------------------------------------------------------------------------------------------

report::Text units_of_lambda(const Studies& studies) {
    double low = INFINITY, high = 0, uniform_low = INFINITY, uniform_high = 0;
    for (const ExplicitStudy& study : studies) {
        low = std::min(low, study.subject.critical);
        high = std::max(high, study.subject.critical);
        uniform_low = std::min(uniform_low, study.uniform.critical);
        uniform_high = std::max(uniform_high, study.uniform.critical);
    }
    report::Text t = report::text("λ is an area: it scales with the square of the mesh");
    if (studies.size() > 1)
        report::extend(t, ", and from mesh to mesh the limit varies ", readable(high / low, 2), "-fold (", ref("q5_limits"), ")");
    report::extend(t, ". A λ quoted without its mesh says nothing. The uniform operator has no unit; its limit is ",
                   readable(uniform_low, 3));
    if (studies.size() > 1) report::extend(t, " to ", readable(uniform_high, 3));
    report::extend(t, uniform_low > 1 && uniform_high < 1.5 ? " here, which is why λ = 1 is stable there and λ = 1.5 is not." : " here.");
    report::extend(t, " That the limits are what they are is proved in ", ref("stability"), ".");
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<ExplicitStudy>& studies) {
    add_heading(section, "Discussion: what is a good λ, and what if it is too large?");
    add_paragraphs(section, {how_large(studies), good_step(studies), too_large(studies), units_of_lambda(studies)});
}

}   // namespace meshfolio::q5_explicit
