#include <set>

#include "questions/bench/mesh_class.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

// ---- the answer: prices of the two schemes, and how smooth both leave a mesh

/// "0.25 to 4.0".
std::string span_of(const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return meshfolio::span_of(readable(low, 2), readable(high, 2));
}

/// Explicit over implicit arithmetic of what is recommended, where it is known.
std::vector<double> prices(const Studies& studies) {
    std::vector<double> ratios;
    for (const ImplicitStudy& study : studies)
        if (study.cost && !std::isnan(study.cost->ratio)) ratios.push_back(study.cost->ratio);
    return ratios;
}

/// "alike" within a fifth; else "dearer" or "cheaper", where explicit smoothing is so on all meshes, or "either".
std::string price_key(const std::vector<double>& ratios) {
    const auto [low, high] = std::ranges::minmax(ratios);
    if (low > 1 / 1.2 && high < 1.2) return "alike";
    return low >= 1 ? "dearer" : high <= 1 ? "cheaper" : "either";
}

/// Which scheme is cheaper for what is recommended.
report::Text price_of_recommended(const Studies& studies) {
    const std::vector<double> ratios = prices(studies);
    return ratios.empty() ? report::Text() : words.say("answer.good." + price_key(ratios), "ratios"_a = span_of(ratios));
}

/// Says from which amount and step on implicit steps pay and what size is left; names meshes where they never pay.
report::Text pays_from(const Studies& studies) {
    Names paying, never;
    std::vector<double> kept;
    bool large = true;   // only steps beyond the explicit limit pay
    for (const ImplicitStudy& study : studies) {
        if (!study.prices.counted()) continue;
        const std::optional<BreakEven> even = study.break_even();
        if (!even) {
            never.push_back(study.name());
            continue;
        }
        for (std::size_t l = 0; l < study.lambdas.size() && study.lambdas[l] <= study.subject.critical; ++l)
            large = large && !study.break_even(l);
        paying.push_back(words.line("answer.even.mesh", "mesh"_a = study.name(), "time"_a = readable(in_edges(study, even->time()), 2),
                                    "limits"_a = in_limits(study.subject, even->lambda)));
        kept.push_back(100 * even->kept);
    }
    const report::Text left = kept.empty() ? report::Text() : words.say("answer.even.kept", "kept"_a = span_of(kept));
    return paragraph_of(
        {said_of(paying, words, large ? "answer.even.large" : "answer.even"), left, said_of(never, words, "answer.even.never")});
}

/// Whether the explicit runs blew up, and the last of them within how many steps, where one λ blew up first on all meshes.
report::Text stability_of(const Studies& studies) {
    double largest = 0;
    std::set<std::string> blown;
    int last = 0;
    bool all = true;
    for (const ImplicitStudy& study : studies) {
        largest = std::max(largest, study.lambdas.back() / study.subject.critical);
        const std::optional<std::size_t> l = study.first_blown();
        all = all && l.has_value();
        if (!l) continue;
        blown.insert(in_limits(study.subject, study.lambdas[*l]));
        last = std::max(last, study.explicit_runs[*l].result.blow_up_iteration);
    }
    const char* key = blown.empty() ? "answer.alike" : all && blown.size() == 1 ? "answer.blown" : "answer";
    return words.say(key, "limits"_a = readable(largest, 2), "blown"_a = blown.empty() ? "" : *blown.begin(), "last"_a = last);
}

/// Meshes on which the angle grows from almost none: it measures how round the shape has become.
report::Text roundness(const Studies& studies) {
    report::Text told;
    for (const ImplicitStudy& study : studies) {
        if (study.roughness > rough || !study.cost || !study.cost->reached()) continue;
        const SmoothingCost& cost = *study.cost;
        if (!(cost.roughness > 1.1 * study.roughness + 0.01)) continue;
        go_on(told, words.say("quality.round", "mesh"_a = study.name(), "input"_a = readable(study.roughness, 2),
                              "implicit"_a = readable(cost.roughness, 2), "explicit"_a = readable(cost.explicit_roughness, 2)));
    }
    return told;
}

// ---- what the pictures show, and why

std::string matrix_of(const ImplicitStudy& study) { return id_of("q6", study.name(), "matrix"); }

/// The largest difference of the two schemes within the explicit limit, and the t from which it is small.
struct Gaps {
    static constexpr double little = 0.05;   // of the distance moved
    double worst = 0;
    std::string mesh;               // of the worst
    int iterations = 0;             // of the worst
    int little_from = 0;            // 0: never
    std::set<std::string> limits;   // the steps compared, in λ_crit
};

std::optional<Gaps> gaps_within_the_limit(const Studies& studies) {
    std::map<int, double> largest;   // of each number of iterations
    Gaps gaps;
    for (const ImplicitStudy& study : studies) {
        for (const SchemeGap& gap : study.gaps()) {
            gaps.limits.insert(in_limits(study.subject, study.lambdas[*study.within_limit()]));
            largest[gap.iterations] = std::max(largest[gap.iterations], gap.share);
            if (gap.share > gaps.worst) gaps.worst = gap.share, gaps.mesh = study.name(), gaps.iterations = gap.iterations;
        }
    }
    if (gaps.mesh.empty()) return {};
    for (auto entry = largest.rbegin(); entry != largest.rend() && entry->second <= Gaps::little; ++entry) gaps.little_from = entry->first;
    return gaps;
}

/// "fades" where it becomes little with t, "little" where it always is, else "stays".
report::Text agreement(const Gaps& gaps) {
    const std::string key = gaps.worst <= Gaps::little ? "little" : gaps.little_from > 0 ? "fades" : "stays";
    return words.say("agreement." + key, "gap"_a = readable_percent(gaps.worst, 2), "mesh"_a = gaps.mesh, "t"_a = gaps.iterations,
                     "little"_a = readable_percent(Gaps::little, 1), "from"_a = gaps.little_from,
                     "limits"_a = listed({gaps.limits.begin(), gaps.limits.end()}));
}

/// How many times as far as the others these vertices moved; NaN where all are alike, or more than half are of them.
double excess_of(const SmoothingSubject& subject, const Positions& X, const std::vector<char>& flags) {
    const FlaggedMeans squares = flagged_means((X - subject.mesh().X).rowwise().squaredNorm(), flags);
    const bool few = squares.count > 0 && squares.count <= squares.others;
    return few && squares.elsewhere > 0 ? std::sqrt(squares.there / squares.elsewhere) : NAN;
}

/// Says where the recommended result moved most: at the boundary, at sharp edges, or nowhere in particular.
report::Text where_it_goes(const ImplicitStudy& study, const SmoothingCell& good) {
    const MeshTopology& topology = study.subject.topology();
    const TriangleMesh& mesh = study.subject.mesh();
    const double at_boundary = excess_of(study.subject, good.implicit_X, topology.on_boundary);
    const double at_edges = excess_of(study.subject, good.implicit_X, feature_vertices(mesh, topology));
    const bool boundary = at_boundary >= at_edges || std::isnan(at_edges);
    const double most = boundary ? at_boundary : at_edges;
    if (!(most > 1.5)) {
        const double before = mesh_character(mesh, topology).feature_share;
        const double after = mesh_character(moved_to(mesh, good.implicit_X), topology).feature_share;
        if (before < 0.01 || after > 0.5 * before) return {};
        return words.say("reading.sharp", "before"_a = readable_percent(before, 2), "after"_a = readable_percent(after, 2),
                         "limit"_a = readable(feature_angle, 2));
    }
    return words.say(boundary ? "reading.boundary" : "reading.edges", "times"_a = readable(most, 2));
}

/// The share of the sharp convex vertices that are concave on X: an explicit step has pulled them inside.
double share_pulled_inside(const ImplicitStudy& study, const Positions& X) {
    const TriangleMesh& mesh = study.subject.mesh();
    if (mesh_character(mesh, study.subject.topology()).kind() != MeshClass::sharp_edged) return 0;
    const std::vector<char> sharp = feature_vertices(mesh, study.subject.topology());
    const Vector before = curvature_colours(study.subject, mesh.X), after = curvature_colours(study.subject, X);
    int convex = 0, inside = 0;
    for (Eigen::Index v = 0; v < before.size(); ++v) {
        if (sharp[v] == 0 || !(before[v] > 0)) continue;
        ++convex;
        inside += after[v] < 0 ? 1 : 0;
    }
    return convex > 0 ? double(inside) / convex : 0;
}

/// The last explicit picture, where there is one, whose energy has risen far above that of the input.
const SmoothingCell* with_spikes(const ImplicitStudy& study, std::size_t blown) {
    const SmoothingCell* risen = nullptr;
    for (std::size_t t = 1; t < study.iterations.size(); ++t)   // the first is told apart
        if (const SmoothingCell& cell = study.cell(blown, t);
            cell.has_explicit() && cell.explicit_energy > 2 && fits_a_frame(study.subject, cell.explicit_X))
            risen = &cell;
    return risen;
}

/// What explicit steps too large do: the first pulls edges in, amplifies noise, or looks well as yet; then spikes grow and the run ends.
report::Text too_large(const ImplicitStudy& study) {
    const std::optional<std::size_t> blown = study.first_blown();
    if (!blown || !study.cell(*blown, 0).has_explicit()) return {};
    const SmoothingCell &first = study.cell(*blown, 0), *risen = with_spikes(study, *blown);
    const double inside = share_pulled_inside(study, first.explicit_X);
    const auto angle = [&](const Positions& X) { return median_face_angle(moved_to(study.subject.mesh(), X), study.subject.topology()); };
    const double by_explicit = angle(first.explicit_X), by_implicit = angle(first.implicit_X);
    const auto told = [&](const char* key) {
        return words.say(key, "limits"_a = in_limits(study.subject, first.lambda), "t"_a = first.iterations,
                         "inside"_a = readable_percent(inside, 2), "energy"_a = readable_percent(first.explicit_energy, 2),
                         "explicit"_a = readable(by_explicit, 2), "implicit"_a = readable(by_implicit, 2),
                         "iteration"_a = study.explicit_runs[*blown].result.blow_up_iteration, "later"_a = risen ? risen->iterations : 0,
                         "times"_a = risen ? readable(risen->explicit_energy, 2) : "");
    };
    const bool pulled_in = inside > 0.5, amplified = first.explicit_energy > 1;
    const bool looks_best = !pulled_in && !amplified && study.roughness > rough && by_explicit < 0.95 * by_implicit;
    return paragraph_of({pulled_in    ? told("first.inside")
                         : amplified  ? told("first.amplified")
                         : looks_best ? told("first.smoother")
                                      : report::Text(),
                         risen        ? told("spikes")
                         : looks_best ? told("first.ends")
                                      : report::Text()});
}

/// Says if steps beyond the explicit limit have left speckles on a mesh without sharp edges: the most curved hundredth of the vertices is
/// then far more curved than the median.
report::Text speckles(const ImplicitStudy& study, const SmoothingCell& good) {
    constexpr double bell = 3.8;   // times the median, of normally distributed values
    if (!(good.lambda > study.subject.critical)) return {};
    const TriangleMesh mesh = moved_to(study.subject.mesh(), good.implicit_X);
    const std::vector<double> sizes = sorted_finite(curvature_colours(study.subject, good.implicit_X).cwiseAbs());
    if (sizes.size() < 100 || mesh_character(mesh, study.subject.topology()).feature_share > 0) return {};
    const double median = sizes[sizes.size() / 2], hundredth = sizes[sizes.size() - sizes.size() / 100 - 1];
    return median > 0 && hundredth > 1.2 * bell * median ? words.say("reading.speckles", "t"_a = good.iterations) : report::Text();
}

/// What is recommended, by either scheme where explicit steps get as far.
report::Text recommended(const ImplicitStudy& study) {
    const SmoothingCell* good = study.good();
    if (good == nullptr) return {};
    const bool either = study.cost && study.cost->reached();
    report::Text turned;
    if (const int faces = study.subject.mesh().face_count(); good->inverted_faces > 0)
        turned = words.say("reading.turned", "turned"_a = good->inverted_faces, "faces"_a = faces,
                           "share"_a = readable_percent(double(good->inverted_faces) / faces, 2));
    return paragraph_of({words.say(either ? "reading.either" : "reading.good", "cell"_a = title_of(study, *good),
                                   "steps"_a = either ? study.cost->explicit_steps : 0),
                         where_it_goes(study, *good), turned, speckles(study, *good)});
}

/// Says from where on implicit steps pay.
report::Text pays(const ImplicitStudy& study) {
    const std::optional<BreakEven> even = study.break_even();
    if (!even) return {};
    const std::string cell = words.line("cell", "limits"_a = in_limits(study.subject, even->lambda), "iterations"_a = even->iterations);
    return words.say("reading.even", "cell"_a = cell, "kept"_a = readable_percent(even->kept, 2));
}

report::Text too_much(const ImplicitStudy& study) {
    const SmoothingCell* much = study.too_much();
    if (much == nullptr) return {};
    return words.say("reading.much", "cell"_a = title_of(study, *much), "kept"_a = readable_percent(much->kept, 2));
}

/// Lists the iterations where explicit runs end at the smallest step that blew up: "6 (cube and plane)".
report::Text explicit_ends(const Studies& studies) {
    std::map<std::string, std::map<int, Names>> ended;   // by step and iteration
    for (const ImplicitStudy& study : studies)
        if (const std::optional<std::size_t> blown = study.first_blown())
            ended[in_limits(study.subject, study.lambdas[*blown])][study.explicit_runs[*blown].result.blow_up_iteration].push_back(
                study.name());
    report::Text told;
    for (const auto& [limits, iterations] : ended) {
        Names ends;
        for (const auto& [iteration, meshes] : iterations)
            ends.push_back(words.line("beyond.end", "iteration"_a = iteration, "meshes"_a = listed(meshes)));
        go_on(told, words.say("beyond", "limits"_a = limits, "ends"_a = listed(ends)));
    }
    return told;
}

}   // namespace

std::string smoothness_key(const ImplicitStudy& study) {
    if (!study.cost || !study.cost->reached() || study.roughness <= rough || !(study.cost->explicit_roughness > 0)) return "";
    const double ratio = study.cost->roughness / study.cost->explicit_roughness;
    return ratio > 1.05 ? "smoother" : ratio < 1 / 1.05 ? "rougher" : "alike";
}

report::Text answer_of(const Studies& studies) {
    return paragraph_of({stability_of(studies), price_of_recommended(studies), pays_from(studies)});
}

/// What is recommended: "λt = 0.91 h̄² on plane".
report::Text summary_of(const Studies& studies) {
    Names told;
    for (const ImplicitStudy& study : studies)
        if (const SmoothingCell* good = study.good())
            told.push_back(words.line("recommended.mesh", "mesh"_a = study.name(), "time"_a = readable(in_edges(study, good->time()), 2)));
    const Names none = names_where(studies, [](const ImplicitStudy& study) { return !study.good(); });
    return paragraph_of({said_of(told, words, "recommended"), said_of(none, words, "recommended.none")});
}

/// How smooth both schemes leave what is recommended, at the same energy; on smooth meshes the angle tells something else.
report::Text quality_of(const Studies& studies) {
    report::Text told;
    for (const ImplicitStudy& study : studies) {
        const std::string key = smoothness_key(study);
        if (key.empty()) continue;
        go_on(told, words.say("quality." + key, "mesh"_a = study.name(), "implicit"_a = readable(study.cost->roughness, 2),
                              "explicit"_a = readable(study.cost->explicit_roughness, 2)));
    }
    if (!told.empty()) told = paragraph_of({words.say("quality"), told});
    return paragraph_of({told, roundness(studies)});
}

/// Which scheme to use: for what is recommended, and for more.
report::Text verdict_of(const Studies& studies) {
    const std::vector<double> ratios = prices(studies);
    if (ratios.empty()) return {};
    const std::string price = price_key(ratios);
    const auto none_is = [&](const char* key) {
        return std::ranges::none_of(studies, [&](const ImplicitStudy& study) { return smoothness_key(study) == key; });
    };
    const Names cheaper = names_where(studies, [](const ImplicitStudy& study) { return study.cost && study.cost->ratio < 1; });
    const Names dearer = names_where(studies, [](const ImplicitStudy& study) { return study.cost && study.cost->ratio >= 1; });
    const std::string key = price == "cheaper"  ? none_is("rougher") ? "explicit.smooth" : "explicit"
                            : price == "dearer" ? none_is("smoother") ? "implicit.smooth" : "implicit"
                                                : price;
    const bool more = std::ranges::any_of(studies, [](const ImplicitStudy& study) { return study.break_even().has_value(); });
    return paragraph_of(
        {words.say("verdict." + key, "ratios"_a = span_of(ratios), "cheaper"_a = listed(cheaper), "dearer"_a = listed(dearer)),
         more && price != "dearer" ? words.say("verdict.more") : report::Text()});
}

/// What a step and a factorisation cost, and which λ can pay: by (1 − h)ᵏ ≤ 1/(1 + kh), 2λ/λ_crit explicit steps of half of λ_crit damp
/// every mode as much as one implicit step.
report::Text price_of(const Studies& studies) {
    std::vector<double> factorisations, steps, least;
    for (const ImplicitStudy& study : studies) {
        if (!study.prices.counted()) continue;
        factorisations.push_back(study.prices.factorisation / study.prices.implicit_step);
        steps.push_back(study.prices.implicit_step / study.prices.explicit_step);
        least.push_back(steps.back() / 2);
    }
    if (steps.empty()) return {};
    return words.say("price", "step"_a = span_of(steps), "least"_a = span_of(least), "factorisation"_a = span_of(factorisations));
}

report::Text rule_of(const Studies& studies) {
    const bool any = std::ranges::any_of(studies, [](const ImplicitStudy& study) { return study.good() != nullptr; });
    return paragraph_of({words.say("reading"), any ? words.say("reading.rule") : report::Text()});
}

report::Text reading_of(const ImplicitStudy& study) {
    const report::Text seen = paragraph_of({recommended(study), pays(study), too_much(study), too_large(study)});
    if (seen.empty()) return {};
    return paragraph_of({words.say("reading.mesh", "mesh"_a = study.name(), "figure"_a = matrix_of(study)), seen});
}

report::Text comparison_of(const Studies& studies) {
    report::Text agreed;
    if (const auto gaps = gaps_within_the_limit(studies)) agreed = paragraph_of({agreement(*gaps), words.say("agreement.why")});
    return paragraph_of({agreed, explicit_ends(studies)});
}

report::Text larger_steps_of(const Studies& studies) {
    const ImplicitStudy* worst = nullptr;
    const SmoothingCell* most = nullptr;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCell& cell : study.grid)
            if (cell.fewer_steps > 0 && (!most || cell.apart > most->apart)) most = &cell, worst = &study;
    if (most == nullptr) return {};
    const std::string key = most->apart < 0.05 ? "near" : most->apart < 0.4 ? "rough" : "far";
    const double larger = most->time() / most->fewer_steps;
    // λμ of the top mode is twice λ/λ_crit
    const auto damping = [&](double lambda, int steps) { return readable(std::pow(1 + 2 * lambda / worst->subject.critical, steps), 2); };
    return paragraph_of(
        {words.say("equal_time." + key),
         words.say("equal_time", "share"_a = readable_percent(most->apart, 2), "mesh"_a = worst->name(), "many"_a = most->iterations,
                   "few"_a = most->fewer_steps, "small"_a = in_limits(worst->subject, most->lambda),
                   "large"_a = in_limits(worst->subject, larger)),
         words.say("equal_time.why", "many"_a = damping(most->lambda, most->iterations), "few"_a = damping(larger, most->fewer_steps))});
}

}   // namespace meshfolio::q6_implicit
