/// @file
/// Estimates the noise of a mesh from the mesh alone.
#pragma once

#include "mesh/mesh_topology.h"

namespace meshfolio {

struct NoiseLevel {
    double sigma = 0;   // standard deviation along the normal; NaN if no patch has more points than coefficients [length]
    int patches = 0;    // patches fitted
    int kept = 0;       // patches with a residual that noise alone explains
};

/// Estimates the standard deviation of independent noise along the normals. Around each vertex a quadratic height is fitted, in least
/// squares, to the vertex and its two rings, m points, over the plane of its normal. Plane and parameters come from a copy smoothed by two
/// half steps to the mean of the neighbours, so that noise as long as the edges does not bend them. On a smooth surface with white noise
/// the sum of the squared residuals is σ²χ² with m − 6 degrees of freedom.
/// Creases and other features that no quadratic follows leave larger residuals: the estimate begins at the lower quartile, then leaves out
/// patches beyond the 99th percentile of the noise found so far until nothing changes. Where most patches are such, as on a coarse mesh or
/// one with noise that is small beside its detail, shape is taken for noise and σ comes out too large.
/// @throws MeshError if the topology is of another mesh
NoiseLevel noise_level(const TriangleMesh& mesh, const MeshTopology& topology);

/// Returns the quantile of χ² with k degrees of freedom at the normal quantile z (−0.6745: the lower quartile; 2.3263: 99 %), by Wilson &
/// Hilferty 1931, within 0.01 for k ≥ 2.
double chi_square_quantile(double z, double k);
/// Returns the probability that χ² with k degrees of freedom is below x, by the approximation of Wilson & Hilferty 1931.
double chi_square_share(double x, double k);

}   // namespace meshfolio
