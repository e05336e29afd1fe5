#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/number_text.h"
#include "questions/bench/mesh_class.h"
#include "questions/bench/sentences.h"
#include "questions/core/study_list.h"
#include "questions/q6_implicit/parts.h"

namespace meshfolio::q6_implicit {

namespace {

using Names = std::vector<std::string>;

std::string matrix_of(const ImplicitStudy& study) { return id_of("q6", study.name(), "matrix"); }

/// "4.0", "0.25 to 4.0".
std::string span_of(const std::vector<double>& values, int digits = 2) {
    const auto [low, high] = std::ranges::minmax(values);
    const std::string from = readable(low, digits), to = readable(high, digits);
    return from == to ? from : words.line("span", "low"_a = from, "high"_a = to);
}

/// Only the implicit results lose less than their size.
bool loses_size(const ImplicitStudy& study) {
    return std::ranges::any_of(study.grid, [](const SmoothingCell& cell) { return cell.kept < size_to_keep; });
}

bool blows_up(const ImplicitStudy& study) {
    return std::ranges::any_of(study.grid, [](const SmoothingCell& cell) { return !cell.has_explicit(); });
}

/// What is recommended: "λt = 0.91 h̄² on plane".
report::Text recommendation(const Studies& studies) {
    Names told, none;
    for (const ImplicitStudy& study : studies) {
        const double h = study.subject.mean_edge;
        if (const SmoothingCell* good = study.good())
            told.push_back(words.line("recommended.mesh", "mesh"_a = study.name(), "time"_a = readable(good->time() / (h * h), 2)));
        else
            none.push_back(study.name());
    }
    return paragraph_of({said_of(told, words, "recommended"), said_of(none, words, "recommended.none")});
}

/// How far apart the two schemes end within the explicit limit, as a share of the motion: where most, and from which t on by little.
struct Gaps {
    static constexpr double little = 0.05;
    double worst = 0, last = 0;     // last: largest after the last number of iterations compared
    std::string mesh;               // of the worst
    int iterations = 0;             // of the worst
    int little_from = 0;            // 0: never
    std::set<std::string> limits;   // the steps compared, in λ_crit
};

std::optional<Gaps> gaps_within_the_limit(const Studies& studies) {
    std::map<int, double> largest;   // of each number of iterations
    Gaps gaps;
    for (const ImplicitStudy& study : studies) {
        for (const SmoothingCell& cell : study.grid) {
            const double moved = vertex_rms(study.subject.mesh().X, cell.implicit_X);
            if (!cell.has_explicit() || moved <= 0 || cell.lambda > study.subject.critical || cell.implicit_energy < 1e-3) continue;
            const double gap = vertex_rms(cell.implicit_X, cell.explicit_X) / moved;
            gaps.limits.insert(in_limits(study.subject, cell.lambda));
            largest[cell.iterations] = std::max(largest[cell.iterations], gap);
            if (gap > gaps.worst) gaps.worst = gap, gaps.mesh = study.name(), gaps.iterations = cell.iterations;
        }
    }
    if (gaps.mesh.empty()) return {};
    gaps.last = largest.rbegin()->second;
    for (auto entry = largest.rbegin(); entry != largest.rend() && entry->second <= Gaps::little; ++entry) gaps.little_from = entry->first;
    return gaps;
}

report::Facts facts_of(const Gaps& gaps) {
    return {"gap"_a = readable_percent(gaps.worst, 2),
            "mesh"_a = gaps.mesh,
            "t"_a = gaps.iterations,
            "little"_a = readable_percent(Gaps::little, 1),
            "from"_a = gaps.little_from,
            "limits"_a = listed({gaps.limits.begin(), gaps.limits.end()})};
}

/// "gap.fades" where it becomes little with t, "gap.little" where it always is, else "gap.stays".
std::string gap_key(const Gaps& gaps) {
    if (gaps.worst <= Gaps::little) return "little";
    return gaps.little_from > 0 ? "fades" : "stays";
}

/// Explicit over implicit arithmetic, of what is recommended or of what is far beyond.
std::vector<double> prices(const Studies& studies, bool recommended) {
    std::vector<double> ratios;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCost& cost : study.costs)
            if (cost.recommended == recommended && !std::isnan(cost.ratio())) ratios.push_back(cost.ratio());
    return ratios;
}

std::string price_key(const std::vector<double>& ratios) {
    const auto [low, high] = std::ranges::minmax(ratios);
    if (low > 1 / 1.2 && high < 1.2) return "alike";
    return low >= 1 ? "dearer" : high <= 1 ? "cheaper" : "either";
}

report::Text price_of(const std::vector<double>& ratios, const std::string& amount) {
    if (ratios.empty()) return {};
    return words.say("price." + amount + "." + price_key(ratios), "ratios"_a = span_of(ratios));
}

/// How much of the size is left where the price is told far beyond the limit.
report::Text left_far_beyond(const Studies& studies) {
    double least = INFINITY, most = 0;
    for (const ImplicitStudy& study : studies) {
        for (const SmoothingCost& cost : study.costs) {
            if (cost.recommended || std::isnan(cost.ratio())) continue;
            least = std::min(least, cost.cell.kept);
            most = std::max(most, cost.cell.kept);
        }
    }
    if (!(least < size_to_keep)) return {};
    const std::string from = readable_percent(least, 2), to = readable_percent(most, 2);
    return words.say("price.far.kept", "kept"_a = from == to ? from : words.line("span", "low"_a = from, "high"_a = to));
}

/// How many times as far as the others these vertices moved; NaN where all are alike, or more than half are of them.
double excess_of(const SmoothingSubject& subject, const Positions& X, const std::vector<char>& flags) {
    double sums[2] = {0, 0};
    int counts[2] = {0, 0};
    for (Eigen::Index v = 0; v < X.rows(); ++v) {
        const int flag = flags[static_cast<std::size_t>(v)] != 0 ? 1 : 0;
        sums[flag] += (X.row(v) - subject.mesh().X.row(v)).squaredNorm();
        ++counts[flag];
    }
    return counts[1] > 0 && counts[1] <= counts[0] && sums[0] > 0 ? std::sqrt(sums[1] / counts[1] / (sums[0] / counts[0])) : NAN;
}

/// Where the recommended result has moved most: at the boundary, at sharp edges, or nowhere in particular.
report::Text where_it_goes(const ImplicitStudy& study) {
    const SmoothingCell* good = study.good();
    if (good == nullptr) return {};
    const MeshTopology& topology = study.subject.source->prepared->topology;
    const TriangleMesh& mesh = study.subject.mesh();
    const double at_boundary = excess_of(study.subject, good->implicit_X, topology.on_boundary);
    const double at_edges = excess_of(study.subject, good->implicit_X, feature_vertices(mesh, topology));
    const bool boundary = at_boundary >= at_edges || std::isnan(at_edges);
    const double most = boundary ? at_boundary : at_edges;
    if (!(most > 1.5)) {
        const double before = mesh_character(mesh, topology).feature_share;
        const double after = mesh_character(moved_to(mesh, good->implicit_X), topology).feature_share;
        if (before < 0.01 || after > 0.5 * before) return {};
        return words.say("reading.sharp", "before"_a = readable_percent(before, 2), "after"_a = readable_percent(after, 2),
                         "limit"_a = readable(feature_angle, 2));
    }
    return words.say(boundary ? "reading.boundary" : "reading.edges", "mesh"_a = study.name(), "times"_a = readable(most, 2));
}

/// What the pictures of one mesh show.
report::Text reading(const ImplicitStudy& study) {
    const SmoothingCell* good = study.good();
    if (good == nullptr) return {};
    return paragraph_of(
        {words.say("reading.good", "mesh"_a = study.name(), "figure"_a = matrix_of(study), "cell"_a = title_of(study, *good)),
         where_it_goes(study),
         good->inverted_faces > 0
             ? words.say("reading.turned", "turned"_a = good->inverted_faces, "faces"_a = study.subject.mesh().face_count())
             : report::Text()});
}

report::Text too_much(const ImplicitStudy& study) {
    const SmoothingCell* much = study.too_much();
    if (much == nullptr) return {};
    return words.say("reading.much", "figure"_a = matrix_of(study), "cell"_a = title_of(study, *much),
                     "kept"_a = readable_percent(much->kept, 2));
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

/// The last explicit picture, where there is one, whose energy has risen far above that of the input.
report::Text spikes(const ImplicitStudy& study) {
    const auto blown = std::ranges::find(study.explicit_runs, true, [](const SmoothingRun& run) { return run.result.blew_up; });
    if (blown == study.explicit_runs.end()) return {};
    const SmoothingCell* risen = nullptr;
    for (std::size_t t = 0; t < study.iterations.size(); ++t)
        if (const SmoothingCell& cell = study.cell(static_cast<std::size_t>(blown - study.explicit_runs.begin()), t);
            cell.has_explicit() && cell.explicit_energy > 2 && fits_a_frame(study.subject, cell.explicit_X))
            risen = &cell;
    if (risen == nullptr) return {};
    return words.say("spikes", "figure"_a = matrix_of(study), "cell"_a = title_of(study, *risen),
                     "times"_a = readable(risen->explicit_energy, 2));
}

report::Text explicit_beside_implicit(const Studies& studies) {
    report::Text agreement;
    if (const auto gaps = gaps_within_the_limit(studies)) {
        report::Facts facts = facts_of(*gaps);
        facts.push_back("figure"_a = matrix_of(studies.back()));
        agreement = paragraph_of({words.say("agreement." + gap_key(*gaps), facts), words.say("agreement.why")});
    }
    return paragraph_of({agreement, said_of(explicit_ends(studies), words, "beyond"), spikes(studies.back())});
}

/// Two cells of equal λt: one step of 10 λ against ten of λ, say.
struct EqualTime {
    const SmoothingCell *few = nullptr, *many = nullptr;
    double share = NAN;   // distance of the results over the motion
};

EqualTime equal_time(const ImplicitStudy& study) {
    for (const SmoothingCell& a : study.grid) {
        for (const SmoothingCell& b : study.grid) {
            if (a.iterations >= b.iterations || std::abs(a.time() / b.time() - 1) > 1e-9) continue;
            return {&a, &b, vertex_rms(a.implicit_X, b.implicit_X) / vertex_rms(study.subject.mesh().X, b.implicit_X)};
        }
    }
    return {};
}

report::Text iterations_against_steps(const Studies& studies) {
    const ImplicitStudy* worst = nullptr;
    EqualTime most;
    for (const ImplicitStudy& study : studies) {
        const EqualTime pair = equal_time(study);
        if (!std::isfinite(pair.share) || (worst && pair.share <= most.share)) continue;
        worst = &study;
        most = pair;
    }
    if (worst == nullptr) return {};
    return paragraph_of(
        {words.say(most.share < 0.05  ? "equal_time.near"
                   : most.share < 0.4 ? "equal_time.rough"
                                      : "equal_time.far",
                   "figure"_a = matrix_of(*worst)),
         words.say("equal_time", "share"_a = readable_percent(most.share, 2), "mesh"_a = worst->name(), "many"_a = most.many->iterations,
                   "few"_a = most.few->iterations, "small"_a = in_limits(worst->subject, most.many->lambda),
                   "large"_a = in_limits(worst->subject, most.few->lambda)),
         words.say("equal_time.why")});
}

bool was_rough(const ImplicitStudy& study) { return median_face_angle(study.subject.mesh(), study.subject.source->prepared->topology) > 5; }

/// How smooth both schemes leave what is recommended, at the same energy: "plane_ns (1.0° and 0.9°)".
report::Text quality(const Studies& studies) {
    Names told;
    double least = INFINITY, most = 0;   // implicit over explicit
    for (const ImplicitStudy& study : studies) {
        for (const SmoothingCost& cost : study.costs) {
            if (!cost.recommended || !cost.reached() || !was_rough(study) || !(cost.explicit_roughness > 0)) continue;
            const double ratio = cost.roughness / cost.explicit_roughness;
            least = std::min(least, ratio);
            most = std::max(most, ratio);
            told.push_back(words.line("quality.mesh", "mesh"_a = study.name(), "implicit"_a = readable(cost.roughness, 2),
                                      "explicit"_a = readable(cost.explicit_roughness, 2)));
        }
    }
    return said_of(told, words, least > 0.9 && most < 1.1 ? "quality.alike" : least > 0.9 ? "quality.explicit" : "quality.differs");
}

/// What the one factorisation costs, in steps.
report::Text factorisation(const Studies& studies) {
    std::vector<double> steps;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCost& cost : study.costs)
            if (cost.factorisation > 0) steps.push_back(cost.factorisation);
    return steps.empty() ? report::Text() : words.say("price.factorisation", "steps"_a = span_of(steps));
}

report::Text price(const Studies& studies) {
    Names only;
    for (const ImplicitStudy& study : studies)
        if (!std::ranges::all_of(study.costs, &SmoothingCost::reached)) only.push_back(study.name());
    const std::vector<double> of_good = prices(studies, true), of_far = prices(studies, false);
    const bool always = !of_good.empty() && !of_far.empty() && price_key(of_good) == "dearer" && price_key(of_far) == "dearer";
    const report::Text good = price_of(of_good, "good"), far = always ? report::Text() : price_of(of_far, "far");
    const report::Text unreached = said_of(only, words, "price.only");
    if (good.empty() && far.empty() && unreached.empty()) return {};
    return paragraph_of(
        {words.say("price"), good, far, far.empty() ? report::Text() : left_far_beyond(studies), factorisation(studies), unreached});
}

}   // namespace

report::Text answer_of(const Studies& studies) {
    const bool blown = std::ranges::any_of(studies, blows_up), lost = std::ranges::any_of(studies, loses_size);
    double largest = 0;
    for (const ImplicitStudy& study : studies) largest = std::max(largest, study.lambdas.back() / study.subject.critical);
    return words.say(blown ? "answer" : "answer.alike", "limits"_a = readable(largest, 2),
                     "lost"_a = lost ? words.line("answer.lost") : "");
}

report::Text summary_of(const Studies& studies) {
    const std::optional<Gaps> gaps = gaps_within_the_limit(studies);
    return paragraph_of({recommendation(studies), gaps ? words.say("summary." + gap_key(*gaps), facts_of(*gaps)) : report::Text(),
                         price_of(prices(studies, false), "summary")});
}

void add_discussion(report::Section& section, const Studies& studies) {
    const bool pictured = std::ranges::any_of(studies, [](const ImplicitStudy& study) { return study.good() != nullptr; });
    report::Text seen =
        paragraph_of({words.say("reading", "figure"_a = matrix_of(studies.back())), pictured ? words.say("reading.rule") : report::Text()});
    for (const ImplicitStudy& study : studies) seen = paragraph_of({seen, reading(study)});
    add_paragraphs(section, {paragraph_of({seen, too_much(studies.back())}), explicit_beside_implicit(studies),
                             iterations_against_steps(studies), quality(studies), price(studies)});
}

}   // namespace meshfolio::q6_implicit
