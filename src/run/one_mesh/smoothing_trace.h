/// @file
/// Measures of the surface after every iteration of smoothing runs, as tables and as a plot.
#pragma once

#include <string>
#include <vector>

#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/mesh_checks.h"
#include "report/document.h"

namespace meshfolio::run {

/// The measures that can be plotted, by the names of their columns.
inline const std::vector<std::string> trace_measures{"error", "energy", "area", "volume"};

/// The run of one λ. Lists have an entry after t = 0, 1, … iterations.
struct SmoothingTrace {
    std::string lambda;                // as the user gave it; empty: the default
    std::string end = {};              // "whole", "blew up", "collapsed"
    double share = 0;                  // λ over the largest stable step
    double moved = 0;                  // rms motion of the vertices [% of the input's box diagonal]
    std::vector<double> time = {};     // diffusion time [as λ]
    std::vector<double> error = {};    // rms distance to the clean vertices [% of the clean mesh's box diagonal]; empty: no clean mesh
    std::vector<double> energy = {};   // Dirichlet energy with the operator of the input [length²]
    std::vector<double> area = {};     // [length²]
    std::vector<double> volume = {};   // [length³]; empty if the surface encloses none
};

/// Appends the measures of the positions X, but not the time.
/// @param laplacian  operator of the input @param clean  null: no error
/// @throws MeshError if `clean` has another number of vertices
void measure(const PreparedMesh& input, const LaplaceBeltrami& laplacian, const TriangleMesh* clean, const Positions& X,
             SmoothingTrace& trace);

/// Returns the diffusion time after 0, 1, … iterations.
std::vector<double> times_of(const Smoothed& run);

/// Returns iteration, time, error, energy, area, volume as a table, with λ in front if there are several runs.
report::Table table_of(const std::vector<SmoothingTrace>& runs);

/// Returns a row for each run: its step and end, the energy, area and volume left as shares of the input's, the motion, and with a clean
/// mesh the error before, at its least, and after.
report::Table summary_of(const std::vector<SmoothingTrace>& runs);

/// Returns the plot of one measure against the iterations: the error as it is, others in % of the input's. A curve for each run.
/// @throws UsageError if the runs do not have the measure
report::Plot plot_of(const std::vector<SmoothingTrace>& runs, const std::string& measure);

}   // namespace meshfolio::run
