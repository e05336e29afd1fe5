// What the planes of the section "maps" say.
#include "questions/maps/parts.h"

namespace meshfolio::maps {

namespace {

std::string cell_words(const SmoothingMaps& maps, std::size_t i) {
    return words.line("cell", "step"_a = readable(maps.relative(maps.step_of(i))), "iterations"_a = maps.iterations[maps.row_of(i)]);
}

report::Text about_limit(const Studies& studies) {
    const BlowUps found = blow_ups_of(studies);
    report::Text t =
        words.say(found.sharp() ? "limit.sharp" : "limit", "mesh"_a = studies.front().name(), "within"_a = found.within,
                  "within_lost"_a = none_or(found.within_lost), "beyond"_a = found.beyond, "beyond_lost"_a = none_or(found.beyond_lost),
                  "implicit"_a = found.within + found.beyond, "implicit_lost"_a = none_or(found.implicit_lost));
    if (found.beyond_lost > 0) go_on(t, words.say(found.off < 0.5 ? "limit.met" : "limit.missed", "off"_a = std::lround(found.off)));
    return t;
}

/// A symmetric mesh has none of its top mode: what its runs die of.
report::Text about_seed(const SmoothingMaps& maps) {
    const double height = maps.top.heights[0];
    if (height > 1e4 * maps.top.rounding) return {};
    return words.say(maps.all ? "seed.all" : "seed.top", "mesh"_a = maps.name(), "height"_a = readable(height / maps.subject.diagonal, 2));
}

report::Text about_agreement(const SmoothingMaps& maps) {
    double largest = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < maps.explicit_map.moved.size(); ++i) {
        if (maps.relative(maps.step_of(i)) >= 0.5) continue;
        const double difference = std::abs(maps.explicit_map.moved[i] / maps.implicit_map.moved[i] - 1);
        if (!(difference > largest)) continue;
        largest = difference;
        where = i;
    }
    if (largest == 0) return {};
    return words.say("agreement", "mesh"_a = maps.name(), "difference"_a = readable_percent(largest, 2),
                     "cell"_a = cell_words(maps, where));
}

report::Text about_equal_time(const SmoothingMaps& maps) {
    const EqualTime implicit = largest_difference_at_equal_time(maps, maps.implicit_map),
                    explicit_ = largest_difference_at_equal_time(maps, maps.explicit_map);
    if (implicit.few == implicit.many) return {};
    const auto percent = [](const EqualTime& pair) { return readable_percent(std::abs(pair.difference), 2); };
    return words.say(
        "equal_time", "mesh"_a = maps.name(), "implicit"_a = percent(implicit),
        "cells"_a = words.line(implicit.difference > 0 ? "equal_time.more" : "equal_time.less", "many"_a = cell_words(maps, implicit.many),
                               "few"_a = cell_words(maps, implicit.few)),
        "explicit"_a = explicit_.few == explicit_.many ? "" : words.line("equal_time.explicit", "difference"_a = percent(explicit_)));
}

/// Where a best cell is, and what limits its worth: a run that was about to end, or a plane that ends there.
std::string best_place(const SmoothingMaps& maps, const SchemeMap& map, std::size_t i) {
    const std::size_t step = maps.step_of(i), row = maps.row_of(i);
    Names caveats;
    if (map.scheme == SmoothingScheme::explicit_euler && maps.relative(step) > 1)
        caveats.push_back(words.line(map.blow_up[step] > 0 ? "best.before_blow_up" : "best.beyond"));
    if (step == 0 || step + 1 == maps.lambdas.size() || row == 0 || row + 1 == maps.iterations.size())
        caveats.push_back(words.line("best.edge"));
    return cell_words(maps, i) + (caveats.empty() ? "" : " (" + listed(caveats) + ")");
}

report::Text about_best(const SmoothingMaps& maps) {
    const auto by_explicit = maps.best(maps.explicit_map), by_implicit = maps.best(maps.implicit_map);
    if (!by_explicit || !by_implicit) return {};
    const double e = maps.explicit_map.error[*by_explicit], i = maps.implicit_map.error[*by_implicit], ratio = i / e;
    const std::string input = readable_percent(maps.input_error, 3);
    if (std::min(e, i) >= maps.input_error) return words.say("best.nowhere", "mesh"_a = maps.name(), "input"_a = input);
    const std::string verdict = ratio < 0.98   ? words.line("best.implicit", "gain"_a = readable_percent(1 - ratio, 2))
                                : ratio > 1.02 ? words.line("best.explicit", "gain"_a = readable_percent(1 - 1 / ratio, 2))
                                               : words.line("best.alike");
    return words.say("best", "mesh"_a = maps.name(), "input"_a = input, "explicit"_a = readable_percent(e, 3),
                     "explicit_at"_a = best_place(maps, maps.explicit_map, *by_explicit), "implicit"_a = readable_percent(i, 3),
                     "implicit_at"_a = best_place(maps, maps.implicit_map, *by_implicit), "verdict"_a = verdict);
}

/// "Triangles turn over in 96 of the 113 measurable cells of the explicit plane, at most 61.7 % of them."
report::Text about_turned(const SmoothingMaps& maps, const SchemeMap& map) {
    int measured = 0, turned = 0;
    double most = 0;
    for (const double share : map.inverted) {
        if (std::isnan(share)) continue;
        ++measured;
        turned += share > 0 ? 1 : 0;
        most = std::max(most, share);
    }
    const bool all = measured == static_cast<int>(map.inverted.size());
    return words.say(all ? "turned.in" : "turned.in_measured", "mesh"_a = maps.name(), "turned"_a = none_or(turned), "cells"_a = measured,
                     "scheme"_a = map.name(), "most"_a = turned == 0 ? "" : words.line("turned.most", "share"_a = readable_percent(most)));
}

report::Text about_health(const SmoothingMaps& maps) {
    double least = infinity;
    for (const double size : maps.implicit_map.size) least = std::min(least, size);   // NaN is left out
    return paragraph_of({about_turned(maps, maps.explicit_map), about_turned(maps, maps.implicit_map),
                         words.say(maps.closed ? "kept.volume" : "kept.area",
                                   "least"_a = least < 1e-6 ? words.line("nothing") : readable_percent(least, 2))});
}

}   // namespace

BlowUps blow_ups_of(const Studies& studies) {
    BlowUps found;
    for (const SmoothingMaps& maps : studies) {
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const int measured = maps.explicit_map.blow_up[step], lost = measured > 0 ? 1 : 0;
            const bool stable = maps.lambdas[step] <= maps.subject.critical;
            (stable ? found.within : found.beyond) += 1;
            (stable ? found.within_lost : found.beyond_lost) += lost;
            found.implicit_lost += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
            const double predicted = maps.known_modes().blow_up(maps.lambdas[step]);
            if (lost > 0 && predicted > 0) found.off = std::max(found.off, std::abs(measured - std::ceil(predicted)));
        }
    }
    return found;
}

std::string none_or(int count) { return count == 0 ? words.line("none") : std::to_string(count); }

void add_discussion(report::Section& section, const Studies& studies) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_limit(studies)});
    for (const SmoothingMaps& maps : studies)
        add_paragraphs(section, {about_seed(maps), about_agreement(maps), about_equal_time(maps), about_best(maps), about_health(maps)});
}

}   // namespace meshfolio::maps
