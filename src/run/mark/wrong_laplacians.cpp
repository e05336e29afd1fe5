#include "run/mark/references.h"

namespace meshfolio::run {

namespace {

Vector ones_where(const Vector& M) { return (M.array() > 0).select(Vector::Ones(M.size()), 0); }

}   // namespace

std::vector<WrongLaplacian> wrong_laplacians(const AnswerSettings& s) {
    std::vector<WrongLaplacian> all;
    const auto named = [&](const std::string& key, OperatorKind kind, AreaForm area) {
        all.push_back({key, kind, [=](const TriangleMesh& mesh) { return laplace_operator(mesh, kind, area); }});
    };
    const auto with_masses = [&](const std::string& key, auto masses) {
        all.push_back({key, s.laplacian, [=](const TriangleMesh& mesh) {
                           const LaplaceBeltrami right = laplace_operator(mesh, s.laplacian, s.area);
                           return LaplaceBeltrami{right.C, masses(right.M), right.copies};
                       }});
    };
    const auto by_two_areas = [&](const std::string& key, double factor, bool clamp_negative) {
        all.push_back({key, OperatorKind::edge_normalised, [=](const TriangleMesh& mesh) {
                           return LaplaceBeltrami{factor * edge_normalised_laplacian(mesh, clamp_negative),
                                                  ones_where(vertex_areas(mesh, AreaForm::barycentric))};
                       }});
    };
    for (const OperatorEntry& entry : operator_list())
        if (entry.kind != s.laplacian) named("operator_" + std::string(entry.name), entry.kind, s.area);
    if (is_dimensionless(s.laplacian)) {   // it has no areas: its masses are the valences
        with_masses("valence_sum", ones_where);
        return all;
    }
    for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed})
        if (form != s.area) named("area_" + std::string(name_of(form)), s.laplacian, form);
    with_masses("without_area", ones_where);
    with_masses("whole_ring", [](const Vector& M) -> Vector { return 3 * M; });
    by_two_areas("unclamped", 1, false);
    by_two_areas("half_kept", 0.5, true);
    by_two_areas("half_kept", 0.5, false);
    return all;
}

}   // namespace meshfolio::run
