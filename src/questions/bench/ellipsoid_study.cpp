#include "questions/bench/ellipsoid_study.h"

#include <Eigen/LU>

#include "geometry/curvature/curvature.h"
#include "geometry/operators/vertex_areas.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/bench_mesh.h"

namespace meshfolio {

std::string axes_text(const Ellipsoid& e) {
    return curvature_words.line("axes", "a"_a = readable(e.a), "b"_a = readable(e.b), "c"_a = readable(e.c));
}

Vector3 axes_of(const Ellipsoid& e) { return {e.a, e.b, e.c}; }

namespace {

DiscreteTip discrete_tip(const Ellipsoid& ellipsoid, const TriangleMesh& mesh) {
    const MeshTopology topology = topology_of(mesh);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh, AreaForm::voronoi);
    Eigen::Index nearest = 0;
    DiscreteTip tip;
    tip.vertices = mesh.vertex_count();
    tip.mean_edge = mean_edge_length(mesh);
    tip.distance = (mesh.X.rowwise() - Eigen::RowVector3d(ellipsoid.a, 0, 0)).rowwise().norm().minCoeff(&nearest);
    tip.H = cotangent_mean_curvature(mesh, topology, laplacian)[nearest];
    tip.K = gaussian_curvature(mesh, topology, laplacian.M)[nearest];
    const CurvaturePair truth = ellipsoid_curvature(axes_of(ellipsoid), mesh.X.row(nearest));
    tip.H_error = std::abs(tip.H / truth.H - 1);
    tip.K_error = std::abs(tip.K / truth.K - 1);
    return tip;
}

}   // namespace

std::vector<OracleErrors> all_oracle_errors(const QuestionSettings& settings) {
    const auto deviation = [](const Eigen::Matrix2d& A, const Eigen::Matrix2d& B) {
        return (A - B).cwiseAbs().maxCoeff() / A.cwiseAbs().maxCoeff();
    };
    const int points = settings.quick ? 50 : 200;
    NormalNumbers random(settings.seed);
    std::vector<OracleErrors> all;
    for (const Ellipsoid& ellipsoid : {flat_ellipsoid, tall_ellipsoid, Ellipsoid{1, 1, 1}, Ellipsoid{1, 2, 3}, Ellipsoid{5, 1, 0.5}}) {
        OracleErrors& errors = all.emplace_back(OracleErrors{ellipsoid, 0, 0, 0, 0, points});
        for (int i = 0; i < points; ++i) {
            // A tenth of a radian away from the poles, where dividing by sin v would measure the rounding of the differences.
            const double u = 2 * pi * random.uniform();
            const double v = 0.1 + (pi - 0.2) * random.uniform();
            const FundamentalForms exact = ellipsoid_forms(ellipsoid, u, v);
            const FundamentalForms differences = ellipsoid_forms_by_differences(ellipsoid, u, v);
            const CurvaturePair implicit = ellipsoid_curvature(axes_of(ellipsoid), ellipsoid_point(ellipsoid, u, v));
            errors.I = std::max(errors.I, deviation(exact.I, differences.I));
            errors.II = std::max(errors.II, deviation(exact.II, differences.II));
            errors.K = std::max(errors.K, std::abs(gaussian_curvature(exact) / implicit.K - 1));
            errors.H = std::max(errors.H, std::abs(mean_curvature(exact) / implicit.H - 1));
        }
    }
    return all;
}

Tip tip_of(const Ellipsoid& ellipsoid) {
    Tip tip{ellipsoid, ellipsoid_forms(ellipsoid, 0, pi / 2), {}};
    tip.principal = principal_curvatures(tip.forms);
    tip.H = mean_curvature(tip.forms);
    tip.K = gaussian_curvature(tip.forms);
    for (int i = 0; i < 360; ++i) {
        const double t = i * pi / 180;
        // At the tip p_u = (0, b, 0) and p_v = (0, 0, −c): the unit tangent at angle t from +y has these parameters.
        const Eigen::Vector2d unit(std::cos(t) / ellipsoid.b, -std::sin(t) / ellipsoid.c), raw(std::cos(t), std::sin(t));
        tip.worst_euler = std::max(tip.worst_euler, std::abs(normal_curvature(tip.forms, unit) / tip_curvature_by_angle(ellipsoid, t) - 1));
        tip.worst_parameters =
            std::max(tip.worst_parameters, std::abs(normal_curvature(tip.forms, raw) / tip_curvature_by_parameters(ellipsoid, t) - 1));
    }
    tip.at_45_angle = tip_curvature_by_angle(ellipsoid, pi / 4);
    tip.at_45_parameters = tip_curvature_by_parameters(ellipsoid, pi / 4);
    return tip;
}

double curvature_near_pole(const Ellipsoid& ellipsoid) { return gaussian_curvature(ellipsoid_forms(ellipsoid, 0, pi - near_pole)); }

DiscreteTips discrete_tips(const Ellipsoid& ellipsoid, bool quick) {
    DiscreteTips tips;
    for (int level = 2; level <= (quick ? 4 : 5); ++level) {
        const int n = (2 << level) + 1;
        TriangleMesh patch = grid_mesh(n, n, 1, 1);   // every ring inside is symmetric about its vertex in (u, v)
        for (auto x : patch.X.rowwise())              // x runs along v and y along u, which turns the normal p_u × p_v outwards
            x = ellipsoid_point(ellipsoid, x[1] - 0.5, pi / 2 + x[0] - 0.5).transpose();
        tips.grid.push_back(discrete_tip(ellipsoid, patch));
        tips.icosphere.push_back(discrete_tip(ellipsoid, ellipsoid_mesh(level, axes_of(ellipsoid))));
    }
    return tips;
}

ErrorHistory errors_of(const std::vector<DiscreteTip>& tips, double DiscreteTip::*error) {
    return {each_of(tips, &DiscreteTip::mean_edge), each_of(tips, error)};
}

}   // namespace meshfolio
