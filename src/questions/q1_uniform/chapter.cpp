// Question 1: mean curvature from the uniform Laplacian, Gaussian curvature from the angle deficit.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "questions/q1_uniform/parts.h"

namespace meshfolio::q1_uniform {

namespace {

using report::check_at_most;
using report::check_near;

void add_checks(report::Section& section, const AngleSums& sums, const std::vector<FlatMesh>& flat, const Refinements& refinements) {
    for (const AngleSum& s : sums)
        if (s.applies)
            section.checks.push_back(check_near(words.line("check.gauss_bonnet", "mesh"_a = s.mesh), s.euler, s.measured, s.tolerance()));
    for (const FlatMesh& f : flat) {
        const CurvatureSubject& s = f.curvature->subject;
        if (s.interior == 0) continue;
        const std::string note = words.line("check.flat.note");
        section.checks.push_back(check_at_most(words.line("check.flat.normal_part", "mesh"_a = s.name()), 0, f.normal_part, 1e-6, note));
        section.checks.push_back(check_at_most(words.line("check.flat.deficit", "mesh"_a = s.name()), 0, f.deficit, 1e-5, note));
    }
    const UniformRefinement& torus = refinement_on(refinements, "torus", Triangulation::regular);
    section.checks.push_back(check_near(words.line("check.order"), 2, deficit_K(torus).order(), 0.2));
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        const UniformRefinement& sphere = refinement_on(refinements, "sphere", triangulation);
        section.checks.push_back(check_at_most(words.line("check.sphere", "triangulation"_a = name_of(triangulation)), 0,
                                               sphere.finest().normal_part.linf, 1e-9, words.line("check.sphere.note")));
    }
}

void add_findings(report::Section& section, const Refinements& refinements, const AngleSums& sums) {
    const UniformRefinement& regular = refinement_on(refinements, "torus", Triangulation::regular);
    const UniformRefinement& jittered = refinement_on(refinements, "torus", Triangulation::jittered);
    const auto error = [](const UniformRefinement& r, bool gaussian) { return readable_percent(errors_of(r, gaussian).last()); };
    section.findings = {{words.say("finding.torus", "H_regular"_a = error(regular, false), "K_regular"_a = error(regular, true),
                                   "H_jittered"_a = error(jittered, false), "K_jittered"_a = error(jittered, true)),
                         70},
                        {words.say("finding.gauss_bonnet", "gap"_a = readable(euler_gap(sums), 2)), 30}};
}

}   // namespace

double euler_gap(const AngleSums& sums) {
    double gap = 0;
    for (const AngleSum& s : sums)
        if (s.applies) gap = std::max(gap, std::abs(s.measured - s.euler));
    return gap;
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q1");
    const auto sources = meshes_for(library, settings, {"plane", "lilium", "bumpy_cube", "sphere"}, section);
    add_words(section, words, "method");

    add_words(section, words, "results");
    Meshes meshes;
    std::vector<std::string> names;
    for (const auto& source : sources) {
        progress("uniform curvature of " + source->name);
        meshes.push_back(curvature_of(source));
        names.push_back(source->name);
    }
    add_figures(answer, meshes);
    add(section, statistics_table(meshes));
    const auto refinements = refine_known_surfaces(settings, progress, "uniform curvature", uniform_errors);
    add(section, error_table(refinements));
    add(section, area_table(refinements, &FieldError::l2, "l2", "L2"));
    add(section, area_table(refinements, &FieldError::linf, "linf", "L∞"));
    add(section, convergence_plot(refinements, false));
    add(section, convergence_plot(refinements, true));
    const AngleSums sums = angle_sums(meshes, refinements);
    add(section, gauss_bonnet_table(sums));
    std::vector<FlatMesh> flat;
    for (const MeshCurvature& c : meshes)
        if (c.subject.plane_normal) flat.push_back(flat_mesh(c));
    add_checks(section, sums, flat, refinements);
    add_discussion(section, meshes, refinements, sums, flat, *shared_ground_truth(settings, progress));
    add_findings(section, refinements, sums);

    const std::size_t levels = refinements.front().levels.size();
    section.parameters = {{"area form", "barycentric"},
                          {"colour range", words.line("parameter.colour_range")},
                          {"levels of refinement", std::to_string(levels)},
                          {"seed of the jitter", std::to_string(settings.seed)}};
    section.extent = words.line("extent", "meshes"_a = listed(names), "levels"_a = levels, "sums"_a = sums.size());
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
    .answer = answer,
};

}   // namespace meshfolio::q1_uniform
