#include <set>

#include "questions/bench/one_ring.h"
#include "questions/q3_cotangent/parts.h"

namespace meshfolio::q3_cotangent {

namespace {

/// A triangle with a smaller angle is called thin [rad].
constexpr double thin = 5 * pi / 180;

double cotangent_error(const BenchRun& run, AreaForm form = areas_used) { return run.finest().error(H_with(form)).l2; }
double uniform_error(const BenchRun& run) { return run.finest().error("H.uniform").l2; }

bool wins(const BenchRun& run) { return cotangent_error(run) < uniform_error(run); }

/// Counts the surfaces where cotangent H converges on one kind of triangulation, and keeps its worst error.
struct Tally {
    int surfaces = 0, converging = 0;
    double worst = 0;
};
Tally tally(const BenchRuns& runs, MeshKind kind) {
    Tally tally;
    for (const BenchRun& run : of_kind(runs, kind)) {
        ++tally.surfaces;
        tally.converging += run.errors(H_with(areas_used)).order().converges() ? 1 : 0;
        tally.worst = std::max(tally.worst, cotangent_error(run));
    }
    return tally;
}

// ---- what the pictures show

report::Text flat_picture(const CotangentComparison& c) {
    const std::string& mesh = c.name();
    if (c.subject.interior == 0) return words.say("flat.no_inside", "mesh"_a = mesh);
    const bool regular = std::max(c.drift, c.precision) < 1e-4;   // what six digits of the coordinates leave
    const bool improved = !regular && c.drift > 10 * c.precision;
    const bool exact = c.drift == 0 && c.precision == 0;
    report::Text t = words.say(exact      ? "flat.exact"
                               : regular  ? "flat.regular"
                               : improved ? "flat.improved"
                                          : "flat.as_bad",
                               "mesh"_a = mesh, "drift"_a = readable(c.drift, 2), "precision"_a = readable(c.precision, 2));
    const double pull = largest_magnitude(0.5 * c.subject.uniform.rowwise().norm(), [&](int i) { return c.subject.inside(i); });
    if (regular && c.drift > 10 * c.precision && c.subject.is_rounding(pull))
        go_on(t, words.say("flat.rounded", "step"_a = readable(coordinate_step(c.subject.mesh()))));
    return t;
}

/// Names the vertex with a thin triangle whose value is far beyond all others.
void go_on_about_outlier(report::Text& t, const CotangentComparison& c) {
    Eigen::Index vertex = 0;
    const double largest = c.cotangent.array().isFinite().select(c.cotangent.array().abs(), 0).maxCoeff(&vertex) * c.subject.mean_edge;
    const double times = largest / cotangent_range(c);
    const double angle = smallest_angle_around(c.subject.mesh(), c.subject.topology(), static_cast<int>(vertex));
    if (times > 10 && angle < thin)
        go_on(t, words.say("curved.outlier", "times"_a = readable(times, 2), "angle"_a = readable(angle * 180 / pi, 2)));
}

report::Text curved_picture(const CotangentComparison& c) {
    const std::string& mesh = c.name();
    if (summary_of(c.difference).count == 0) return words.say("curved.nothing", "mesh"_a = mesh);
    const double range = cotangent_range(c), beyond = share_beyond(c.subject.mean_edge * c.uniform, range);
    report::Text t = words.say(beyond > 0.2 ? "curved.beyond"
                               : beyond > 0 ? "curved.within"
                                            : "curved.all_within",
                               "mesh"_a = mesh, "beyond"_a = readable_percent(beyond, 2),
                               "own"_a = readable_percent(share_beyond(c.subject.mean_edge * c.cotangent, range), 2));
    const SignsByDistance seen = signs_by_distance(c.subject, c.cotangent, 0.05 * range / c.subject.mean_edge);
    if (seen.caps_outside())
        go_on(t, words.say("curved.where", "outer"_a = readable_percent(seen.outer_positive, 2),
                           "inner"_a = readable_percent(seen.inner_negative, 2)));
    const double uniform = roughness(c.uniform, c.subject.topology()), cotangent = roughness(c.cotangent, c.subject.topology());
    if (uniform > 0 && cotangent > 0) {
        const double ratio = uniform / cotangent;
        const char* key = ratio > 1.2 ? "curved.smoother" : ratio < 1 / 1.2 ? "curved.rougher" : "curved.as_smooth";
        go_on(t, words.say(key, "cotangent"_a = readable_percent(cotangent, 2), "uniform"_a = readable_percent(uniform, 2)));
    }
    if (c.sign_change > 0.005) go_on(t, words.say("curved.sign", "sign"_a = readable_percent(c.sign_change, 2)));
    go_on_about_outlier(t, c);
    return t;
}

// ---- what the errors say

std::string times_smaller(double factor) {
    if (factor >= 100) return words.line("times.over", "factor"_a = readable(rounded_down(factor, 1), 1));
    return factor >= 1 ? words.line("times.smaller", "factor"_a = readable(factor, 2))
                       : words.line("times.larger", "factor"_a = readable(1 / factor, 2));
}

/// Finds the surface of one kind where the gain over uniform weights is smallest.
report::Text smallest_gain(const BenchRuns& runs, MeshKind kind, const char* key) {
    const BenchRun* least = nullptr;
    const auto gain = [](const BenchRun& run) { return uniform_error(run) / cotangent_error(run); };
    for (const BenchRun& run : of_kind(runs, kind))
        if (!least || gain(run) < gain(*least)) least = &run;
    return words.say(key, "surface"_a = least->surface, "error"_a = readable_percent(cotangent_error(*least), 2),
                     "uniform"_a = readable_percent(uniform_error(*least), 2), "times"_a = times_smaller(gain(*least)));
}

/// The largest difference of the errors.
double gain_of_mixed_areas(const BenchRuns& runs) {
    return largest_of(runs, [&](const BenchRun& run) { return cotangent_error(run) - cotangent_error(run, AreaForm::mixed); });
}

report::Text about_errors(const BenchRuns& runs) {
    const Tally jittered = tally(runs, MeshKind::jittered);
    report::Text t = smallest_gain(runs, MeshKind::regular, "errors.regular");
    go_on(t, smallest_gain(runs, MeshKind::jittered, "errors.jittered"));
    const auto mixed = std::ranges::count_if(runs, [](auto& run) { return cotangent_error(run, AreaForm::mixed) < cotangent_error(run); });
    go_on(t, words.say(mixed == std::ssize(runs) ? "errors.mixed.all" : "errors.mixed", "mixed"_a = mixed, "runs"_a = runs.size()));
    if (2 * mixed > std::ssize(runs)) go_on(t, words.say("errors.mixed.kept", "gain"_a = readable(100 * gain_of_mixed_areas(runs), 2)));
    const BenchRun& sphere = run_on(runs, "sphere", MeshKind::jittered);
    if (const double special = cotangent_error(sphere, AreaForm::voronoi); special < 0.1 * cotangent_error(sphere))
        go_on(t, words.say("errors.sphere", "error"_a = readable_percent(special, 2)));
    go_on(t, words.say(jittered.converging == 0                   ? "errors.stall"
                       : jittered.converging == jittered.surfaces ? "errors.converge"
                                                                  : "errors.stall.partly",
                       "converging"_a = jittered.converging, "surfaces"_a = jittered.surfaces));
    return t;
}

report::Text about_negative_weights(const CotangentComparison& c) {
    const OperatorVariant& used = c.variants[0];
    const double change = c.variants[2].change;
    const int negative = used.negative_inside + used.negative_boundary;
    if (negative == 0) return words.say("negative.none", "mesh"_a = c.name());
    report::Text t = words.say("negative", "mesh"_a = c.name(), "negative"_a = negative, "edges"_a = c.subject.topology().edges.size(),
                               "smallest"_a = readable(used.smallest_weight, 2));
    if (std::isfinite(change)) go_on(t, words.say("negative.clamped", "change"_a = readable_percent(change, 2)));
    return t;
}

report::Text about_square(const PlaneTest& plane) {
    return words.say("square", "uniform"_a = readable(plane.uniform, 2), "cotangent"_a = readable(plane.cotangent, 2));
}

report::Text about_clamping(const PlaneTest& plane, const BenchRuns& runs) {
    double least = infinity, most = 0;
    for (const BenchRun& run : of_kind(runs, MeshKind::jittered)) {
        least = std::min(least, run.finest().error("H.clamped").l2);
        most = std::max(most, run.finest().error("H.clamped").l2);
    }
    const bool costs = plane.clamped > 1e3 * plane.cotangent;
    report::Text t = words.say(costs ? "square.clamping_costs" : "square.clamping_free", "clamped"_a = readable(plane.clamped, 2),
                               "least"_a = readable_percent(least, 2), "most"_a = readable_percent(most, 2));
    for (const BenchRun& run : of_kind(runs, MeshKind::regular)) {
        const BenchLevel& finest = run.finest();
        if (const double error = finest.error("H.clamped").l2; error > 10 * cotangent_error(run))
            go_on(t, words.say("square.clamping_regular", "surface"_a = run.surface,
                               "negative"_a = readable_percent(finest.negative_weights, 2), "error"_a = readable_percent(error, 2)));
    }
    return t;
}

/// The error on the ellipsoid with random points, a mesh that comes from no regular one.
double on_random_points(const BenchRuns& panel, const std::string& estimator) {
    return run_on(panel, "ellipsoid", MeshKind::random).finest().error(estimator).l2;
}

/// Cotangent against uniform over every sequence of meshes of the ground-truth panel, and who does better still.
report::Text about_panel(const BenchRuns& panel) {
    std::set<MeshKind> lost;
    double least = infinity;   // error where the cotangent one is not better
    for (const BenchRun& run : panel) {
        if (wins(run)) continue;
        lost.insert(run.kind);
        least = std::min(least, uniform_error(run));
    }
    Names kinds;
    for (const MeshKind kind : lost) kinds.emplace_back(name_of(kind));
    const auto error = [&](const std::string& key) { return readable_percent(on_random_points(panel, key), 2); };
    const auto better = std::ranges::count_if(panel, wins);
    return paragraph_of({words.say("panel", "runs"_a = panel.size(), "better_than_uniform"_a = better),
                         kinds.empty()                       ? report::Text()
                         : lost == std::set{MeshKind::noisy} ? words.say("panel.noisy", "lost"_a = std::ssize(panel) - better,
                                                                         "least"_a = readable_percent(rounded_down(least, 2), 2))
                                                             : words.say("panel.lost", "kinds"_a = listed(kinds)),
                         words.say("panel.jet", "cotangent"_a = error(H_with(areas_used)), "jet"_a = error("H.jet"))});
}

// ---- appendix

report::Text about_boundary(const CotangentComparison& c) {
    return words.say("boundary", "mesh"_a = c.name(), "half_sum"_a = readable(c.variants[0].boundary, 2),
                     "opposite_mean"_a = readable(c.variants[1].boundary, 2), "inside"_a = readable(c.variants[0].inside, 2));
}

report::Text about_sphere(const BenchRun& regular) {
    const BenchLevel& coarse = regular.levels.front();
    const BenchLevel& fine = regular.finest();
    return words.say("sphere", "coarse"_a = readable_percent(coarse.error("H.barycentric").linf, 4), "coarse_vertices"_a = coarse.vertices,
                     "fine"_a = readable_percent(fine.error("H.barycentric").linf, 4), "fine_vertices"_a = fine.vertices,
                     "limit"_a = readable_percent(pentagon_excess(), 4), "mixed"_a = readable_percent(fine.error("H.mixed").linf, 2));
}

}   // namespace

report::Text answer_of(const BenchRuns& runs) {
    const auto nearer = std::ranges::count_if(runs, wins), all = std::ssize(runs);
    double times = infinity;   // uniform H's error over cotangent H's, where that is least
    for (const BenchRun& run : runs) times = std::min(times, uniform_error(run) / cotangent_error(run));
    const Tally jittered = tally(runs, MeshKind::jittered);
    const bool converges = jittered.converging == jittered.surfaces;
    const char* key = 2 * nearer <= all ? "answer.no" : converges ? "answer.yes" : "answer.yes_but";
    return words.say(key, "wins"_a = times >= 2 ? words.line("answer.far", "runs"_a = all, "times"_a = readable(rounded_down(times, 1), 1))
                                                : words.line("answer.some", "wins"_a = nearer, "runs"_a = all));
}

report::Text lead_of(const BenchRuns& runs, const PlaneTest& plane, const BenchRuns& panel) {
    const Tally regular = tally(runs, MeshKind::regular), jittered = tally(runs, MeshKind::jittered);
    report::Text t = words.say("lead", "regular"_a = readable_percent(regular.worst, 2), "jittered"_a = readable_percent(jittered.worst, 2),
                               "cotangent"_a = readable(plane.cotangent, 2), "uniform"_a = readable(plane.uniform, 2));
    const double random = on_random_points(panel, H_with(areas_used));
    if (random > 2 * jittered.worst) go_on(t, words.say("lead.random", "random"_a = readable_percent(random, 2)));
    return t;
}

void add_discussion(report::Section& section, const Comparisons& meshes, const BenchRuns& runs, const PlaneTest& plane,
                    const BenchRuns& panel) {
    for (const CotangentComparison& c : meshes) add_paragraphs(section, {c.subject.plane_normal ? flat_picture(c) : curved_picture(c)});
    add_paragraphs(section, {about_square(plane), about_errors(runs), about_panel(panel)});
    report::Text clamping = about_clamping(plane, runs);
    for (const CotangentComparison& c : meshes)
        if (!c.subject.plane_normal && summary_of(c.difference).count > 0) go_on(clamping, about_negative_weights(c));
    add_paragraphs(section, {clamping});
}

void add_limits(report::Section& section, const Comparisons& meshes, const BenchRuns& runs) {
    add_paragraphs(section, {about_sphere(run_on(runs, "sphere", MeshKind::regular))});
    for (const CotangentComparison& c : meshes)
        if (!c.subject.preflight().closed()) add_paragraphs(section, {about_boundary(c)});
}

}   // namespace meshfolio::q3_cotangent
