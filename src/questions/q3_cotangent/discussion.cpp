#include <set>

#include "questions/bench/estimators.h"
#include "questions/bench/one_ring.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

/// A triangle with a smaller angle is called thin [rad].
constexpr double thin = 5 * pi / 180;
/// Curvature × mean edge below this is rounding.
constexpr double rounding = 1e-9;

double cotangent_error(const BenchRun& run, AreaForm form = areas_used) { return run.finest().error(H_with(form)).l2; }
double uniform_error(const BenchRun& run) { return run.finest().error("H.uniform").l2; }
double gain(const BenchRun& run) { return uniform_error(run) / cotangent_error(run); }
bool wins(const BenchRun& run) { return gain(run) > 1; }
bool converges(const BenchRun& run) { return run.errors(H_with(areas_used)).order().converges(); }

/// Returns the largest L2 error of cotangent H on the finest meshes of a kind.
double worst_error(const BenchRuns& runs, MeshKind kind) {
    return largest_of(of_kind(runs, kind), [](const BenchRun& run) { return cotangent_error(run); });
}

/// Counts the jittered surfaces where cotangent H converges, and all jittered surfaces.
std::pair<std::ptrdiff_t, std::ptrdiff_t> converging_of_jittered(const BenchRuns& runs) {
    const auto jittered = of_kind(runs, MeshKind::jittered);
    return {std::ranges::count_if(jittered, converges), std::ssize(jittered)};
}

/// Returns the L2 error of an estimator on random points of the ellipsoid, on the finest mesh.
double on_random_points(const BenchRuns& panel, const std::string& estimator) {
    return run_on(panel, "ellipsoid", MeshKind::random).finest().error(estimator).l2;
}

/// Returns a value with the name of its mesh, as text: "3 % on cube".
std::string on_mesh(const CotangentComparison& c, const std::string& value) {
    return words.line("value_on", "value"_a = value, "mesh"_a = c.name());
}
std::string share_on(const CotangentComparison& c, double share) { return on_mesh(c, readable_percent(share, 2)); }

// ---- pictures

void add_curved_mesh_facts(report::Facts& facts, const Comparisons& meshes, const Disagreements& with_jets) {
    Names beyond, rough, bumps, opposite, jet, jet_uniform;
    report::FactList outliers;
    bool curved = false;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const CotangentComparison& c = meshes[m];
        if (!is_curved(c) || summary_of(c.difference).count == 0) continue;
        curved = true;
        if (const double share = share_beyond(c.subject.mean_edge * c.uniform, cotangent_range(c)); share > 0)
            beyond.push_back(share_on(c, share));
        const double ratio = roughness(c.uniform, c.subject.topology()) / roughness(c.cotangent, c.subject.topology());
        if (ratio > 1.2 && std::isfinite(ratio))
            rough.push_back(words.line("times_on", "ratio"_a = readable(ratio, 2), "mesh"_a = c.name()));
        const Vector H = (c.subject.mean_edge * c.cotangent.array().abs() > rounding).select(c.cotangent, 0 * c.cotangent);
        if (const SignsByDistance seen = signs_by_distance(c.subject, H); seen.caps_outside()) bumps.push_back(c.name());
        if (c.sign_change > 0.005) opposite.push_back(share_on(c, c.sign_change));
        if (const Disagreement& d = with_jets[m]; d.rms > 0) {
            jet.push_back(share_on(c, d.rms));
            jet_uniform.push_back(share_on(c, d.rms_uniform));
        }
        // A vertex with a thin triangle and a value far beyond all others.
        Eigen::Index vertex = 0;
        const double largest = c.cotangent.array().isFinite().select(c.cotangent.array().abs(), 0).maxCoeff(&vertex) * c.subject.mean_edge;
        const double times = largest / cotangent_range(c);
        const double angle = smallest_angle_around(c.subject.mesh(), c.subject.topology(), static_cast<int>(vertex));
        if (times > 10 && angle < thin)
            outliers.push_back({"mesh"_a = c.name(), "times"_a = readable(times, 2), "angle"_a = readable(angle * 180 / pi, 2)});
    }
    facts.insert(facts.end(),
                 {"curved"_a = curved, "beyond"_a = listed(beyond), "rough"_a = listed(rough), "bumps"_a = listed(bumps),
                  "opposite"_a = listed(opposite), "jet"_a = listed(jet), "jet_uniform"_a = listed(jet_uniform), "outliers"_a = outliers,
                  "nothing"_a = listed(names_where(meshes, [](auto& c) { return summary_of(c.difference).count == 0; }))});
}

void add_flat_mesh_facts(report::Facts& facts, const Comparisons& meshes, const PlaneTest& square) {
    Names symmetric;
    report::FactList improved, as_bad;
    double most = 0;
    bool rounded = false;
    for (const CotangentComparison& c : meshes) {
        if (is_curved(c) || c.subject.interior == 0) continue;
        if (std::max(c.drift, c.precision) < 1e-4) {   // rounding of coordinates with six digits
            symmetric.push_back(c.name());
            most = std::max({most, c.drift, c.precision});
            const double pull = largest_magnitude(0.5 * c.subject.uniform.rowwise().norm(), [&](int i) { return c.subject.inside(i); });
            rounded = rounded || (c.drift > 10 * c.precision && c.subject.is_rounding(pull));
        } else {
            (c.drift > 10 * c.precision ? improved : as_bad)
                .push_back({"mesh"_a = c.name(), "drift"_a = readable(c.drift, 2), "precision"_a = readable(c.precision, 2)});
        }
    }
    facts.insert(facts.end(), {"symmetric"_a = listed(symmetric), "precise"_a = most > 0 ? readable(most, 2) : "", "rounded"_a = rounded,
                               "improved"_a = improved, "as_bad"_a = as_bad, "square_uniform"_a = readable(square.uniform, 2),
                               "square_cotangent"_a = readable(square.cotangent, 2)});
}

// ---- errors

void add_error_facts(report::Facts& facts, const BenchRuns& runs) {
    const BenchRun& least = *std::ranges::min_element(runs, {}, gain);
    const auto [converging, surfaces] = converging_of_jittered(runs);
    const auto mixed = [](const BenchRun& run) { return cotangent_error(run) - cotangent_error(run, AreaForm::mixed); };
    const BenchRun& sphere = run_on(runs, "sphere", MeshKind::jittered);
    const double special = cotangent_error(sphere, AreaForm::voronoi);
    facts.insert(facts.end(), {"least"_a = std::string(name_of(least.kind)) + " " + least.surface,
                               "least_error"_a = readable_percent(cotangent_error(least), 2),
                               "least_uniform"_a = readable_percent(uniform_error(least), 2), "stalls"_a = converging < surfaces,
                               "some"_a = converging, "surfaces"_a = surfaces,
                               "mixed"_a = std::ranges::count_if(
                                   runs, [&](const BenchRun& run) { return mixed(run) > 0; }),
                               "runs"_a = runs.size(), "gain"_a = readable(rounded_up(100 * largest_of(runs, mixed), 2), 2),
                               "special"_a = special < 0.1 * cotangent_error(sphere) ? readable_percent(special, 2) : ""});
}

/// Counts of the runs of the ground-truth panel where cotangent H is better than uniform H.
void add_panel_facts(report::Facts& facts, const BenchRuns& panel) {
    std::set<MeshKind> lost;
    double least = infinity;   // least error of uniform H where cotangent H is not better
    for (const BenchRun& run : panel) {
        if (wins(run)) continue;
        lost.insert(run.kind);
        least = std::min(least, uniform_error(run));
    }
    const bool noisy = lost == std::set{MeshKind::noisy};
    facts.insert(facts.end(), {"panel"_a = panel.size(), "better"_a = std::ranges::count_if(panel, wins), "lost_noisy"_a = noisy,
                               "lost_error"_a = readable_percent(rounded_down(least, 2), 2),
                               "lost"_a = noisy ? "" : listed(each_of(lost, [](MeshKind kind) { return std::string(name_of(kind)); }))});
}

void add_clamping_facts(report::Facts& facts, const Comparisons& meshes, const PlaneTest& plane, const BenchRuns& runs) {
    const auto clamped = [](const BenchRun& run) { return run.finest().error("H.clamped").l2; };
    report::FactList regular;
    for (const BenchRun& run : of_kind(runs, MeshKind::regular))
        if (clamped(run) > 10 * cotangent_error(run))
            regular.push_back({"surface"_a = run.surface, "error"_a = readable_percent(clamped(run), 2),
                               "negative"_a = readable_percent(run.finest().negative_weights, 2)});
    Names negative_edges, change, none;
    for (const CotangentComparison& c : meshes) {
        if (!is_curved(c) || summary_of(c.difference).count == 0) continue;
        const int negative = c.variants[0].negative_inside + c.variants[0].negative_boundary;
        if (negative == 0) none.push_back(c.name());
        if (negative == 0) continue;
        negative_edges.push_back(
            words.line("edges_of", "negative"_a = negative, "edges"_a = c.subject.topology().edges.size(), "mesh"_a = c.name()));
        if (std::isfinite(c.variants[2].change)) change.push_back(share_on(c, c.variants[2].change));
    }
    facts.insert(facts.end(),
                 {"costs"_a = plane.clamped > 1e3 * plane.cotangent, "clamped"_a = readable(plane.clamped, 2),
                  "clamped_most"_a = readable_percent(largest_of(of_kind(runs, MeshKind::jittered), clamped), 2), "regular"_a = regular,
                  "negative_edges"_a = listed(negative_edges), "change"_a = listed(change), "none"_a = listed(none)});
}

}   // namespace

report::Text answer_of(const BenchRuns& runs) {
    const auto nearer = std::ranges::count_if(runs, wins);
    const double times = gain(*std::ranges::min_element(runs, {}, gain));
    const auto [converging, surfaces] = converging_of_jittered(runs);
    return words.say("answer", "mostly"_a = 2 * nearer > std::ssize(runs), "runs"_a = runs.size(), "nearer"_a = nearer,
                     "times"_a = times >= 2 ? readable(rounded_down(times, 1), 1) : "",
                     "stalls"_a = 2 * nearer > std::ssize(runs) && converging < surfaces);
}

report::Text lead_of(const BenchRuns& runs, const PlaneTest& plane, const BenchRuns& panel) {
    const double jittered = worst_error(runs, MeshKind::jittered), random = on_random_points(panel, H_with(areas_used));
    const double jet = on_random_points(panel, "H.jet");
    return words.say("lead", "regular"_a = readable_percent(worst_error(runs, MeshKind::regular), 2),
                     "jittered"_a = readable_percent(jittered, 2), "cotangent"_a = readable(plane.cotangent, 2),
                     "uniform"_a = readable(plane.uniform, 2), "mild"_a = random > 2 * jittered, "random"_a = readable_percent(random, 2),
                     "jet"_a = readable_percent(jet, 2), "better_jet"_a = 2 * jet < random);
}

void add_discussion(report::Section& section, const Comparisons& meshes, const Disagreements& with_jets, const BenchRuns& runs,
                    const PlaneTest& plane, const BenchRuns& panel) {
    report::Facts facts;
    add_curved_mesh_facts(facts, meshes, with_jets);
    add_flat_mesh_facts(facts, meshes, plane);
    add_error_facts(facts, runs);
    add_panel_facts(facts, panel);
    add_clamping_facts(facts, meshes, plane, runs);
    add_words(section, words, "discussion", facts);
}

void add_limits(report::Section& section, const Comparisons& meshes, const BenchRuns& runs) {
    const BenchRun& sphere = run_on(runs, "sphere", MeshKind::regular);
    const auto largest = [](const BenchLevel& level, const char* key) { return level.error(key).linf; };
    Names boundary;
    for (const CotangentComparison& c : meshes)
        if (!c.subject.preflight().closed()) boundary.push_back(on_mesh(c, readable(c.variants[0].boundary, 2)));
    add_words(section, words, "appendix", "coarse"_a = readable_percent(largest(sphere.levels.front(), "H.barycentric"), 4),
              "fine"_a = readable_percent(largest(sphere.finest(), "H.barycentric"), 4), "limit"_a = readable_percent(pentagon_excess(), 4),
              "mixed"_a = readable_percent(largest(sphere.finest(), "H.mixed"), 2), "boundary"_a = listed(boundary));
}

}   // namespace meshfolio::q3_cotangent
