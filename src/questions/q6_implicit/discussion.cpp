#include <map>
#include <set>

#include "questions/bench/mesh_class.h"
#include "questions/q6_implicit/parts.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

namespace {

// ---- one mesh

bool is_counted(const ImplicitStudy& study) { return study.prices.counted(); }

/// Returns the share of the size left where implicit steps begin to pay; 0 if they never pay or prices are unknown.
double kept_where_paying(const ImplicitStudy& study) {
    const std::optional<BreakEven> even = study.break_even();
    return even ? even->kept : 0;
}
bool pays(const ImplicitStudy& study) { return study.break_even().has_value(); }
bool pays_gently(const ImplicitStudy& study) { return kept_where_paying(study) >= size_to_keep; }
bool pays_too_far(const ImplicitStudy& study) { return pays(study) && kept_where_paying(study) < too_little; }
bool pays_strongly(const ImplicitStudy& study) { return pays(study) && !pays_gently(study) && !pays_too_far(study); }

/// Returns the rms motion of the flagged vertices over that of the others; NaN if none or more than half are flagged.
double excess_of(const ImplicitStudy& study, const std::vector<char>& flags) {
    const Positions motion = study.good()->implicit_X - study.subject.mesh().X;
    const FlaggedMeans squares = flagged_means(motion.rowwise().squaredNorm(), flags);
    const bool few = squares.count > 0 && squares.count <= squares.others;
    return few && squares.elsewhere > 0 ? std::sqrt(squares.there / squares.elsewhere) : NAN;
}
double boundary_excess(const ImplicitStudy& study) { return study.good() ? excess_of(study, study.subject.topology().on_boundary) : NAN; }
double edge_excess(const ImplicitStudy& study) {
    return study.good() ? excess_of(study, feature_vertices(study.subject.mesh(), study.subject.topology())) : NAN;
}
constexpr double farther = 1.5;   // ratio of the motions
bool boundary_shrinks(const ImplicitStudy& study) { return boundary_excess(study) > farther; }
bool edges_give_way(const ImplicitStudy& study) { return edge_excess(study) > farther && !(boundary_excess(study) > edge_excess(study)); }

/// Returns the first state of the smallest explicit step that blew up; null if none did, or it blew up before.
const SmoothingCell* first_too_large(const ImplicitStudy& study) {
    const std::optional<std::size_t> blown = study.first_blown();
    return blown && study.cell(*blown, 0).has_explicit() ? &study.cell(*blown, 0) : nullptr;
}

/// True if most convex vertices of sharp edges are concave at first_too_large(): the step pulled them inside.
bool edges_go_inside(const ImplicitStudy& study) {
    const TriangleMesh& mesh = study.subject.mesh();
    const SmoothingCell* first = first_too_large(study);
    if (!first || mesh_character(mesh, study.subject.topology()).kind() != MeshClass::sharp_edged) return false;
    const std::vector<char> sharp = feature_vertices(mesh, study.subject.topology());
    const Vector before = curvature_colours(study.subject, mesh.X), after = curvature_colours(study.subject, first->explicit_X);
    int convex = 0, inside = 0;
    for (Eigen::Index v = 0; v < before.size(); ++v) {
        convex += sharp[v] != 0 && before[v] > 0 ? 1 : 0;
        inside += sharp[v] != 0 && before[v] > 0 && after[v] < 0 ? 1 : 0;
    }
    return 2 * inside > convex;
}
/// True if first_too_large() has more energy than the input.
bool is_roughened(const ImplicitStudy& study) {
    const SmoothingCell* first = first_too_large(study);
    return first && first->explicit_energy > 1;
}
constexpr double rough = 5;   // median face angle [°]; smaller ones measure the shape, not roughness
/// True if first_too_large() leaves a rough mesh smoother than the implicit step.
bool looks_better(const ImplicitStudy& study) {
    const SmoothingCell* first = first_too_large(study);
    if (!first || study.roughness <= rough || first->explicit_energy > 1 || edges_go_inside(study)) return false;
    const auto angle = [&](const Positions& X) { return median_face_angle(moved_to(study.subject.mesh(), X), study.subject.topology()); };
    return angle(first->explicit_X) < 0.95 * angle(first->implicit_X);
}

/// Returns the face angle of a rough mesh at the same energy, implicit over explicit; NaN if they cannot be compared.
double angle_ratio(const ImplicitStudy& study) {
    const bool comparable = study.cost && study.cost->reached() && study.roughness > rough && study.cost->explicit_roughness > 0;
    return comparable ? study.cost->roughness / study.cost->explicit_roughness : NAN;
}
constexpr double alike = 1.05;

// ---- all meshes

/// Returns the range of some values as text: "0.25 to 4.0"; empty without values.
std::string span_of(const std::vector<double>& values) {
    if (values.empty()) return "";
    const auto [low, high] = std::ranges::minmax(values);
    return meshfolio::span_of(readable(low, 2), readable(high, 2));
}

/// Facts about costs, and about the λ that can pay: by (1 − h)ᵏ ≤ 1/(1 + kh), 2λ/λ_crit explicit steps of half of λ_crit damp every mode
/// at least as much as one implicit step.
void add_prices(report::Facts& facts, const Studies& studies) {
    std::vector<double> factorisations, steps, least, kept;
    for (const ImplicitStudy& study : studies) {
        if (pays_strongly(study)) kept.push_back(100 * kept_where_paying(study));
        if (!is_counted(study)) continue;
        factorisations.push_back(study.prices.factorisation / study.prices.implicit_step);
        steps.push_back(study.prices.implicit_step / study.prices.explicit_step);
        least.push_back(steps.back() / 2);
    }
    const Names gently = names_where(studies, pays_gently), strongly = names_where(studies, pays_strongly);
    const auto at_no_amount = [](const ImplicitStudy& study) { return is_counted(study) && !pays(study); };
    facts.insert(
        facts.end(),
        {"counted"_a = !steps.empty(), "step"_a = span_of(steps), "least"_a = span_of(least), "factorisation"_a = span_of(factorisations),
         "gently"_a = listed(gently), "only_strong"_a = !strongly.empty() && gently.empty(),
         "stronger"_a = gently.empty() ? "" : listed(strongly), "kept"_a = span_of(kept), "no_pay"_a = strongly.empty() && gently.empty(),
         "too_far"_a = listed(names_where(studies, pays_too_far)), "never"_a = listed(names_where(studies, at_no_amount))});
}

/// Facts about the explicit runs that blow up, and their first states.
void add_blow_ups(report::Facts& facts, const Studies& studies) {
    std::set<std::string> blown;
    int last = 0;
    for (const ImplicitStudy& study : studies) {
        const std::optional<std::size_t> l = study.first_blown();
        if (!l) continue;
        blown.insert(in_limits(study.subject, study.lambdas[*l]));
        last = std::max(last, study.explicit_runs[*l].result.blow_up_iteration);
    }
    const Names inside = names_where(studies, edges_go_inside), roughened = names_where(studies, is_roughened);
    facts.insert(facts.end(),
                 {"blown"_a = listed({blown.begin(), blown.end()}), "last"_a = last, "first"_a = studies.front().iterations.front(),
                  "seen"_a = !inside.empty() || !roughened.empty(), "inside"_a = listed(inside), "roughened"_a = listed(roughened),
                  "deceiving"_a = listed(names_where(studies, looks_better))});
}

/// Facts about the gap at equal λ within the limit: the largest, and the t from which on it is small on all meshes.
void add_gaps(report::Facts& facts, const Studies& studies) {
    constexpr double little = 0.05;   // of the distance moved
    std::map<int, double> largest;    // of each number of iterations
    std::set<std::string> limits;
    for (const ImplicitStudy& study : studies) {
        for (const SchemeGap& gap : study.gaps()) {
            limits.insert(in_limits(study.subject, study.lambdas[*study.within_limit()]));
            largest[gap.iterations] = std::max(largest[gap.iterations], gap.share);
        }
    }
    int from = 0;
    for (auto entry = largest.rbegin(); entry != largest.rend() && entry->second <= little; ++entry) from = entry->first;
    const double worst = largest_of(largest, [](const auto& entry) { return entry.second; });
    facts.insert(facts.end(),
                 {"agree"_a = !largest.empty() && worst <= little, "fade"_a = worst > little && from > 0,
                  "differ"_a = worst > little && from == 0, "gap"_a = readable_percent(worst, 2), "little"_a = readable_percent(little, 1),
                  "from"_a = from, "limits"_a = listed({limits.begin(), limits.end()})});
}

/// Facts about many implicit steps and few larger ones of equal λt, where the results are farthest apart.
void add_equal_times(report::Facts& facts, const Studies& studies) {
    const ImplicitStudy* on = nullptr;
    const SmoothingCell* most = nullptr;
    for (const ImplicitStudy& study : studies)
        for (const SmoothingCell& cell : study.grid)
            if (cell.fewer_steps > 0 && (!most || cell.apart > most->apart)) most = &cell, on = &study;
    facts.insert(facts.end(), {"equal_times"_a = most != nullptr, "near"_a = most && most->apart < 0.05,
                               "similar"_a = most && most->apart >= 0.05 && most->apart < 0.4, "far"_a = most && most->apart >= 0.4});
    const double larger = most ? most->time() / most->fewer_steps : 0;
    // λμ of the top mode is twice λ/λ_crit
    const auto damping = [&](double lambda, int steps) { return readable(std::pow(1 + 2 * lambda / on->subject.critical, steps), 2); };
    facts.insert(
        facts.end(),
        {"apart"_a = most ? readable_percent(most->apart, 2) : "", "on"_a = most ? on->name() : "", "many"_a = most ? most->iterations : 0,
         "few"_a = most ? most->fewer_steps : 0, "small"_a = most ? in_limits(on->subject, most->lambda) : "",
         "large"_a = most ? in_limits(on->subject, larger) : "", "by_many"_a = most ? damping(most->lambda, most->iterations) : "",
         "by_few"_a = most ? damping(larger, most->fewer_steps) : ""});
}

}   // namespace

report::Facts answer_facts(const Studies& studies) {
    const auto any = [&](const auto& holds) { return std::ranges::any_of(studies, holds); };
    const auto cheap = std::ranges::count_if(studies, pays_gently), all = std::ranges::ssize(studies);
    return {"limits"_a = readable(largest_of(studies, [](auto& s) { return s.lambdas.back() / s.subject.critical; }), 2),
            "always"_a = cheap == all,
            "sometimes"_a = cheap > 0 && cheap < all,
            "cheap"_a = cheap,
            "all"_a = all,
            "strong"_a = any(pays) && cheap == 0,
            "never"_a = !any(pays) && std::ranges::all_of(studies, is_counted)};
}

report::Facts discussion_facts(const Studies& studies) {
    const auto where = [&](const auto& holds) { return listed(names_where(studies, holds)); };
    const auto any = [&](const auto& holds) { return std::ranges::any_of(studies, holds); };
    const ImplicitStudy* widest = nullptr;   // with the largest gap of its recommended result
    for (const ImplicitStudy& study : studies)
        if (study.cost && study.cost->gap.size() > 0 && (!widest || study.cost->gap_share > widest->cost->gap_share)) widest = &study;
    const auto pictured = std::ranges::find_if(studies, has_pairs);
    report::Facts facts;
    facts.insert(
        facts.end(),
        {"pictured"_a = pictured != studies.end() ? id_of("q6", pictured->name(), "pairs") : "", "schemes"_a = any(compares_schemes),
         "times"_a = any(compares_equal_times), "recommends"_a = any([](auto& study) { return study.good() != nullptr; }),
         "several"_a = studies.size() > 1, "none"_a = where([](auto& study) { return !study.good(); }),
         "boundary"_a = where(boundary_shrinks), "edges"_a = where(edges_give_way), "widest"_a = widest ? widest->name() : "",
         "widest_gap"_a = widest ? readable_percent(widest->cost->gap_share, 2) : "",
         "by_explicit"_a = where([](auto& study) { return angle_ratio(study) > alike; }),
         "by_implicit"_a = where([](auto& study) { return angle_ratio(study) < 1 / alike; }),
         "tie"_a = where([](auto& study) { return angle_ratio(study) <= alike && angle_ratio(study) >= 1 / alike; })});
    add_blow_ups(facts, studies);
    add_prices(facts, studies);
    add_gaps(facts, studies);
    add_equal_times(facts, studies);
    return facts;
}

}   // namespace meshfolio::q6_implicit
