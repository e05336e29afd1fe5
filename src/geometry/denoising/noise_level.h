/// @file
/// How large the noise of a mesh is, from the mesh alone.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct NoiseLevel {
    double sigma = 0;   // of the coordinate along the normal [length]; NaN where no patch has more points than coefficients
    int patches = 0;    // fitted
    int kept = 0;       // of them, those whose residual noise alone explains
};

/// Standard deviation of independent noise along the normals. Around each vertex a quadratic height is fitted, in least squares, to the
/// vertex and its two rings, m points, over the plane of its normal; plane and parameters are those of a smoothed copy (two half steps to
/// the mean of the neighbours, which know no noise but by what is left of it), so that noise as long as the edges does not bend them. On
/// a smooth surface with white noise the sum of the squared residuals is σ²χ² with m − 6 degrees of freedom.
/// Creases and whatever else no quadratic follows leave larger residuals: the lower quartile begins, then patches beyond the 99th
/// percentile of the noise found so far are left out until nothing changes. Where most patches are such, as on a coarse mesh or one
/// whose noise is small beside its detail, shape is taken for noise and σ comes out too large.
/// @throws MeshError if the topology is of another mesh
NoiseLevel noise_level(const TriangleMesh& mesh, const MeshTopology& topology);

/// A quantile of χ² with k degrees of freedom, and its share below x (Wilson & Hilferty 1931; within 0.01 for k ≥ 2, as used here).
double chi_square_quantile(double z, double k);   // z: that of the normal distribution, −0.6745 for the lower quartile
double chi_square_share(double x, double k);

}   // namespace meshfolio
