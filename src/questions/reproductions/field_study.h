/// @file
/// Experiments of earlier reports that look at one mesh at a time: curvatures, and meshes rebuilt from eigenvectors.
#pragma once

#include "geometry/measures/mesh_error.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "questions/reproductions/study.h"

namespace meshfolio::reproductions {

/// One estimate of curvature on one mesh.
struct ExperimentField {
    std::size_t mesh = 0;   // index into the meshes
    ExperimentColour colour = ExperimentColour::h_cotan;
    OperatorKind kind = OperatorKind::cotan;   // of h_cotan
    AreaForm area = AreaForm::barycentric;     // of h_cotan and gauss
    Vector inside = {};                        // NaN on the boundary, where it is no curvature; times h̄, 1/h̄ or h̄²: dimensionless
    Vector drawn = {};                         // the same formula applied on the boundary too, as the reports drew it
    ValueSummary summary = {};                 // of `inside`
    double positive = 0;                       // share of the values inside that are > 0
    double largest_inside = 0;                 // |value|
    double largest_boundary = 0;               // |drawn| on the boundary; NaN on a closed mesh
};

struct CurvatureExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<ExperimentField> fields;   // mesh by mesh, colour, operator, area; what does not depend on one is there once
};
CurvatureExperiment curvature_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// Colours of the mesh at X: curvature as `drawn` above, in mean edges of the mesh, or the distance to it [% of the box diagonal]; empty
/// without a colour.
Vector colours_of(const ExperimentMesh& mesh, ExperimentColour colour, const Positions& X);

/// A mesh rebuilt from the smoothest k eigenvectors of one operator.
struct RebuiltMesh {
    std::size_t mesh = 0;
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    int k = 0;   // cut to the modes there are
    Positions X;
    MeshDifference difference;   // to the original
    double mass_rms = 0;         // in the norm of the operator's own mass, in which it falls with every k [length]
    double residual = 0;         // largest of the eigenpairs used
};

struct ReconstructionExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<RebuiltMesh> rebuilt;   // mesh by mesh, operator, area, k ascending
};
ReconstructionExperiment reconstruction_experiment(const MeshLibrary& library, const Experiment& experiment,
                                                   const QuestionSettings& settings);

}   // namespace meshfolio::reproductions
