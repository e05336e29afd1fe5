// What the planes of the section "maps" say.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/maps/parts.h"

namespace meshfolio::maps {

namespace {

using report::math;
using report::ref;

std::string cell_words(const SmoothingMaps& maps, std::size_t i) {
    return "λ = " + readable(maps.relative(i % maps.lambdas.size())) +
           "\u202fλ_crit, t = " + std::to_string(maps.iterations[i / maps.lambdas.size()]);
}

/// What limits the worth of a best cell: a run that was about to end, or a plane that ends there.
std::string caveat_of(const SmoothingMaps& maps, const SchemeMap& map, std::size_t i) {
    const std::size_t step = i % maps.lambdas.size(), row = i / maps.lambdas.size();
    std::vector<std::string> caveats;
    if (map.scheme == SmoothingScheme::explicit_euler && maps.relative(step) > 1)
        caveats.emplace_back(map.blow_up[step] > 0 ? "beyond the limit, before the run blows up" : "beyond the limit");
    if (step == 0 || step + 1 == maps.lambdas.size() || row == 0 || row + 1 == maps.iterations.size())
        caveats.emplace_back("at the edge of the plane");
    return caveats.empty() ? "" : " (" + listed(caveats) + ")";
}

report::Text limit_words(const std::vector<SmoothingMaps>& studies) {
    int below = 0, beyond = 0, below_lost = 0, beyond_lost = 0, implicit_lost = 0, implicit_steps = 0;
    double widest = 0;   // of measured over predicted from the best prediction at hand, where both are there
    for (const SmoothingMaps& maps : studies) {
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const bool within = maps.lambdas[step] <= maps.subject.critical, lost = maps.explicit_map.blow_up[step] > 0;
            (within ? below : beyond) += 1;
            (within ? below_lost : beyond_lost) += lost ? 1 : 0;
            implicit_lost += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
            ++implicit_steps;
            const double predicted = (maps.all ? *maps.all : maps.top).blow_up(maps.lambdas[step]);
            if (lost && predicted > 0) widest = std::max(widest, std::abs(maps.explicit_map.blow_up[step] - std::ceil(predicted)));
        }
    }
    report::Text t = report::text(
        "The vertical line is the whole story of explicit stability: of ", counted(below, "explicit run"), " within the limit ",
        below_lost == 0 ? std::string("none") : std::to_string(below_lost), " blew up, of ", std::to_string(beyond), " beyond it ",
        beyond_lost == beyond && beyond > 0 ? std::string("all") : std::to_string(beyond_lost), " did; of ",
        counted(implicit_steps, "implicit run"), " ", implicit_lost == 0 ? std::string("none") : std::to_string(implicit_lost), ". ");
    if (beyond_lost > 0) {
        report::extend(t, "When a run ends follows from the modes of the input (", ref("maps_blow_up"),
                       "): from all of them where they are known and from the top mode elsewhere, it was met to ",
                       widest < 0.5 ? std::string("the iteration") : counted(static_cast<int>(std::lround(widest)), "iteration"),
                       widest < 0.5 ? " in every run." : " at worst.");
    }
    return t;
}

/// A symmetric mesh has none of its top mode: what its runs die of.
report::Text seed_words(const SmoothingMaps& maps) {
    const double height = maps.top.heights[0];
    if (height > 1e4 * maps.top.rounding) return {};
    report::Text t =
        report::text("On ", maps.name(), " the input has no more of the top mode than rounding puts there (",
                     readable(height / maps.subject.diagonal, 2),
                     " of the box diagonal), as symmetry can make it. The prediction from the top mode alone is therefore late");
    report::extend(t, maps.all ? ", and the modes below the top, of which there is more, end the run first." : ".");
    return t;
}

report::Text agreement_words(const SmoothingMaps& maps) {
    double largest = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < maps.explicit_map.moved.size(); ++i) {
        if (maps.relative(i % maps.lambdas.size()) >= 0.5) continue;
        const double difference = std::abs(maps.explicit_map.moved[i] / maps.implicit_map.moved[i] - 1);
        if (difference > largest) {
            largest = difference;
            where = i;
        }
    }
    if (largest == 0) return {};
    return report::text("Below half the limit the rms motions of the two schemes on ", maps.name(), " are within ",
                        readable_percent(largest, 2), " of each other; they are farthest apart at ", cell_words(maps, where), ".");
}

report::Text equal_time_words(const SmoothingMaps& maps) {
    const EqualTime implicit = largest_difference_at_equal_time(maps, maps.implicit_map),
                    explicit_ = largest_difference_at_equal_time(maps, maps.explicit_map);
    if (implicit.few == implicit.many) return {};
    report::Text t = report::text(
        "More iterations are not quite a larger step. Ten times the iterations at a tenth of the step reach the "
        "same diffusion time ",
        math("λt"), ", and on ", maps.name(), " the implicit motion differs by ", readable_percent(std::abs(implicit.difference), 2),
        " at most (", cell_words(maps, implicit.many), " moves ", implicit.difference > 0 ? "more" : "less", " than ",
        cell_words(maps, implicit.few), ")");
    if (explicit_.few != explicit_.many)
        report::extend(t, "; the explicit one, within its limit, by ", readable_percent(std::abs(explicit_.difference), 2));
    report::extend(t, ".");
    return t;
}

report::Text best_words(const SmoothingMaps& maps) {
    const auto by_explicit = maps.best(maps.explicit_map), by_implicit = maps.best(maps.implicit_map);
    if (!by_explicit || !by_implicit) return {};
    const double e = maps.explicit_map.error[*by_explicit], i = maps.implicit_map.error[*by_implicit];
    if (std::min(e, i) >= maps.input_error) {
        return report::text("Nowhere on the plane of ", maps.name(), " does smoothing bring the noisy mesh nearer to the clean one, ",
                            readable_percent(maps.input_error, 3), " of the box away.");
    }
    report::Text t = report::text("The noisy ", maps.name(), " begins ", readable_percent(maps.input_error, 3),
                                  " of the box away from the clean mesh. Explicit smoothing brings it to ", readable_percent(e, 3), " at ",
                                  cell_words(maps, *by_explicit), caveat_of(maps, maps.explicit_map, *by_explicit),
                                  ", implicit smoothing to ", readable_percent(i, 3), " at ", cell_words(maps, *by_implicit),
                                  caveat_of(maps, maps.implicit_map, *by_implicit), ": ");
    const double ratio = i / e;
    report::extend(t, ratio < 0.98   ? "the implicit scheme gets nearer, by " + readable_percent(1 - ratio, 2) + "."
                      : ratio > 1.02 ? "the explicit scheme gets nearer, by " + readable_percent(1 - 1 / ratio, 2) + "."
                                     : std::string("there is no difference that matters."));
    return t;
}

/// "in 96 of the 113 cells of the explicit plane that can be measured, at most 61.7 % of the triangles": what had blown up or shrunk to
/// nothing is in neither number.
std::string turned_words(const SchemeMap& map) {
    int measured = 0, turned = 0;
    double most = 0;
    for (const double share : map.inverted) {
        if (std::isnan(share)) continue;
        ++measured;
        turned += share > 0 ? 1 : 0;
        most = std::max(most, share);
    }
    const bool all = measured == static_cast<int>(map.inverted.size());
    return "in " + (turned == 0 ? std::string("none") : std::to_string(turned)) + " of the " + counted(measured, "cell") + " of the " +
           map.name() + " plane" + (all ? "" : " that can be measured") +
           (turned == 0 ? "" : ", at most " + readable_percent(most) + " of the triangles");
}

report::Text health_words(const SmoothingMaps& maps) {
    const auto smallest = [](const PlaneValues& values) {
        double least = INFINITY;
        for (const double x : values) {
            if (x < least) least = x;
        }
        return least;
    };
    report::Text t = report::text("Triangles of ", maps.name(), " turn over ", turned_words(maps.explicit_map), ", and ",
                                  turned_words(maps.implicit_map), ". ");
    const double least = smallest(maps.implicit_map.size);
    report::extend(t, "Stability is not fidelity: where it keeps least, the implicit plane keeps ",
                   least < 1e-6 ? std::string("nothing") : readable_percent(least, 2), " of the ", maps.closed ? "volume." : "area.");
    return t;
}

}   // namespace

void add_discussion(report::Section& section, const std::vector<SmoothingMaps>& studies) {
    add_heading(section, "Discussion");
    add_paragraphs(section, {limit_words(studies)});
    for (const SmoothingMaps& maps : studies)
        add_paragraphs(section, {seed_words(maps), agreement_words(maps), equal_time_words(maps), best_words(maps), health_words(maps)});
}

}   // namespace meshfolio::maps
