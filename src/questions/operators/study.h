/// @file
/// The operator laboratory: every discrete Laplacian of the program on the same meshes, scored alike.
#pragma once

#include "geometry/measures/operator_scores.h"
#include "geometry/operators/laplace_operator.h"
#include "questions/bench/curvature_subject.h"

namespace meshfolio::operators {

/// An operator with a form of area.
struct LaboratoryOperator {
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;

    std::string title() const;   // "cotangent, Voronoi areas"; areas are not named if barycentric
    std::string id() const;      // for file names: "cotan_voronoi"
    LaplaceBeltrami of(const TriangleMesh& mesh) const { return laplace_operator(mesh, kind, area); }
};
/// Returns all kinds with barycentric areas, the default first, then the default with the other areas.
const std::vector<LaboratoryOperator>& laboratory_operators();

/// One operator on one mesh. Changes are relative to the default operator; NaN if they are not defined.
struct OperatorTrial {
    LaboratoryOperator made_by;
    OperatorScores scores = {};
    double critical_ratio = 0;   // λ_crit over that of the default; NaN for dimensionless operators
    double spectrum_shift = 0;   // largest relative change of the first ten eigenvalues above 0; a dimensionless spectrum is scaled to fit
    double H_change = 0;         // relative L2 difference of H inside
    Vector H = {};               // [1/length]
};
/// All operators on one mesh.
struct LaboratoryMesh {
    CurvatureSubject subject;
    std::vector<OperatorTrial> trials;   // one for each of laboratory_operators()
    int flips = 0;                       // of the intrinsic Delaunay triangulation
    bool oriented_manifold = false;

    const std::string& name() const { return subject.name(); }
    const OperatorTrial& trial(OperatorKind kind) const;
};
/// Scores every one of laboratory_operators() on one mesh; large meshes have no spectra.
LaboratoryMesh laboratory_mesh(SharedMesh source, const QuestionSettings& settings);

/// Errors of one operator on surfaces with known values.
struct KnownTrial {
    LaboratoryOperator made_by;
    double plane = 0;                  // largest |H| × mean edge inside an irregular flat square, where all curvature is 0
    std::array<double, 2> H_error{};   // relative L2 on the jittered sphere and the jittered ellipsoid
    double eigenvalue_error = 0;       // largest relative one of the first eight above 0 on that sphere, l(l + 1)/R²
};
/// Measures each of laboratory_operators() on irregular_plane(), a jittered sphere and a jittered ellipsoid of level 4 (quick: 3).
std::vector<KnownTrial> known_trials(const QuestionSettings& settings);

}   // namespace meshfolio::operators
