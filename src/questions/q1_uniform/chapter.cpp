// Question 1: mean curvature from the uniform Laplacian, Gaussian curvature from the angle deficit.
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

struct Spread {
    std::string mesh, quantity, unit;
    ValueSummary values;
};

report::Table statistics_table(const Meshes& meshes) {
    std::vector<Spread> rows;
    for (const MeshCurvature& c : meshes) {
        rows.push_back({c.name(), "½‖Δx‖", "length", summary_of(c.length)});
        rows.push_back({c.name(), "H scaled", "1/length", summary_of(c.H)});
        rows.push_back({c.name(), "K", "1/length²", summary_of(c.K)});
    }
    return table("q1_statistics", words.line("statistics"), rows)
        .column("mesh", &Spread::mesh)
        .column("quantity", &Spread::quantity)
        .column("unit", &Spread::unit)
        .column("minimum", {.digits = 4}, [](auto& row) { return cell_of(row.values.minimum); })
        .column("median", {.digits = 4}, [](auto& row) { return cell_of(row.values.median); })
        .column("mean", {.digits = 4}, [](auto& row) { return cell_of(row.values.mean); })
        .column("maximum", {.digits = 4}, [](auto& row) { return cell_of(row.values.maximum); })
        .column("standard deviation", [](auto& row) { return cell_of(row.values.standard_deviation); })
        .column("defined", [](auto& row) { return row.values.count; })
        .column("undefined", [](auto& row) { return row.values.undefined; });
}

report::Table error_table(const BenchRuns& runs) {
    const auto error = [](std::string_view estimator, Norm norm = &EstimateError::l2) {
        return [=](const BenchRun& run) { return 100 * run.finest().error(estimator).*norm; };
    };
    const auto order = [](std::string_view estimator) {
        return [=](const BenchRun& run) { return cell_of(run.errors(estimator).order().exponent); };
    };
    int vertices = 0;
    for (const BenchRun& run : runs) vertices = std::max(vertices, run.finest().vertices);
    return table("q1_errors", words.line("errors", "vertices"_a = vertices), runs)
        .column("surface", &BenchRun::surface)
        .column("triangulation", [](auto& run) { return name_of(run.kind); })
        .column("uniform H", {.unit = "%"}, error(uniform_H))
        .column("order of H", {.rounding = Rounding::tenths}, order(uniform_H))
        .column("normal part", {.unit = "%", .digits = 2}, error(normal_H))
        .column("K barycentric", {.unit = "%", .digits = 2}, error(deficit_K))
        .column("order of K", {.rounding = Rounding::tenths}, order(deficit_K))
        .column("worst vertex", {.unit = "% of largest K", .digits = 2}, error(deficit_K, &EstimateError::linf))
        .column("K Voronoi", {.unit = "%", .digits = 2}, error("K.voronoi"))
        .column("K mixed", {.unit = "%", .digits = 2}, error("K.mixed"));
}

void add_checks(report::Section& section, const AngleSums& sums, const std::vector<FlatMesh>& flat, const BenchRuns& runs) {
    for (const AngleSum& s : sums)
        if (s.applies) add(section, check_near(words.line("check.gauss_bonnet", "mesh"_a = s.mesh), s.euler, s.measured, s.tolerance()));
    for (const FlatMesh& f : flat) {
        const CurvatureSubject& s = f.curvature->subject;
        if (s.interior == 0) continue;
        const std::string note = words.line("check.flat.note");
        add(section, check_at_most(words.line("check.flat.normal_part", "mesh"_a = s.name()), 0, f.normal_part, 1e-6, note),
            check_at_most(words.line("check.flat.deficit", "mesh"_a = s.name()), 0, f.deficit, 1e-5, note));
    }
    const Order of_K = run_on(runs, "torus", MeshKind::regular).errors(deficit_K).order();
    add(section, check_near(words.line("check.order"), 2, of_K.exponent, 0.2));
    for (const MeshKind kind : question_kinds) {
        const double error = run_on(runs, "sphere", kind).finest().error("H.uniform_n").linf;
        add(section,
            check_at_most(words.line("check.sphere", "triangulation"_a = name_of(kind)), 0, error, 1e-9, words.line("check.sphere.note")));
    }
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("q1")};
    report::Section& section = answer.section;
    const auto sources = meshes_for(library, settings, section);
    Meshes meshes;
    for (const auto& source : sources) {
        progress("uniform curvature of " + source->name);
        meshes.push_back(curvature_of(source));
    }
    const std::optional<Drifting> drifting = most_drifting(meshes);
    const BenchRuns runs = question_runs(library, settings, progress);
    const AngleSums sums = angle_sums(meshes, runs);
    std::vector<FlatMesh> flat;
    for (const MeshCurvature& c : meshes)
        if (c.subject.plane_normal) flat.push_back(flat_mesh(c));

    add_answer(section, runs);
    add_words(section, words, "method");
    add(section, sign_diagram());
    add_words(section, words, "method.laplacian");
    add(section, ring_diagram());
    add_words(section, words, {"method.deficit", "results"});
    add_figures(answer, meshes);
    if (drifting) add_tangential_figure(answer, meshes, settings.colormap);
    add(section, error_table(runs));
    add_discussion(section, meshes, flat, runs, panel_runs(library, settings.seed, settings.quick, progress), sums, drifting);
    add_checks(section, sums, flat, runs);

    begin_appendix(section);
    add_words(section, words, "appendix");
    add(section, convergence_plot("q1_convergence", words, runs, {{uniform_H, "convergence.h"}, {deficit_K, "convergence.k"}}),
        statistics_table(meshes), area_table(runs));
    for (const FlatMesh& f : flat)
        if (f.boundary_vertices > 0)
            add_words(section, words, "flat.boundary", "mesh"_a = f.curvature->name(), "length"_a = readable(f.boundary_length, 2),
                      "turning"_a = readable(f.turning, 4));

    const std::size_t levels = runs.front().levels.size();
    section.parameters = {{"area form", "barycentric"},
                          {"colour range", words.line("parameter.colour_range")},
                          {"levels of refinement", levels},
                          {"seed of the jitter", settings.seed}};
    section.extent = words.line("extent", "meshes"_a = listed(names_of(meshes)), "levels"_a = levels, "sums"_a = sums.size());
    return answer;
}

extern const Chapter chapter{
    .id = "q1",
    .code = {{"uniform_laplacian", "src/geometry/operators/uniform_laplacian.cpp"},
             {"uniform_mean_curvature", "src/geometry/curvature/curvature.cpp"},
             {"angle_deficit", "src/geometry/curvature/curvature.cpp"},
             {"gaussian_curvature", "src/geometry/curvature/curvature.cpp"},
             {"vertex_areas", "src/geometry/operators/vertex_areas.cpp"},
             {"known_surfaces", "src/questions/bench/known_surfaces.cpp"},
             {"answer", "src/questions/q1_uniform/chapter.cpp"}},
    .roles = {"bumpy_cube", "lilium", "sphere", "plane"},
    .cost = {.cpu = {{1.7, 2}, {1.5, 0.5, 0.8}}, .memory = {{40, 42}, {10, 42}}},
    .answer = answer,
};

}   // namespace meshfolio::q1_uniform
