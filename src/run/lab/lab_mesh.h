/// @file
/// A small mesh for the live laboratory of the page. With all its modes, every filter of the report is a weighted sum. The program's own
/// results at some settings are there for comparison.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/quantised_modes.h"
#include "questions/bench/lab_offer.h"
#include "scene/sight.h"

namespace meshfolio::run {

/// Measures of the positions that the program's own steps lead to; the energy is that of the clean mesh's operator.
struct LabReading {
    LabSetting setting;
    double energy = 0;                // ½ Σ C_ij |x_i − x_j|² [length²]
    double volume = 0;                // signed; meaningful when closed [length³]
    double rms = 0;                   // √(Σ|x − x_clean|²/n), of a projection √(ΣA|x − x_clean|²/ΣA) [length]
    double factor = 0;                // of the finest mode in one step, negative if it flips; NaN for the projection and denoising
    std::vector<double> gains = {};   // by the measures of question 7; empty without noise
};

struct LabLimits {
    int vertices = 620, decimated_to = 420;                         // larger meshes are decimated
    int all_modes = 2000, fewer_modes = 300, numbers = 1'600'000;   // more vertices: the lowest 300 modes, of so many numbers at most
};

struct LabMesh {
    std::string name;          // "cube"
    int source_vertices = 0;   // of the file
    bool is_decimated = false, is_closed = false;
    TriangleMesh mesh;           // about its box centre, without unreferenced vertices
    LaplaceBeltrami laplacian;   // cotangent, barycentric
    Vector eigenvalues;
    DenseMatrix coefficients;   // Φᵀ M X [length²]
    QuantisedModes modes;
    double diagonal = 0;                        // of the box [length]
    double largest_eigenvalue = 0;              // of all modes, also where the page has fewer [1/length²]
    double mean_edge = 0;                       // h̄ [length]
    double quantisation_shift = 0;              // how far the modes' rounding moves a vertex at most, in box diagonals
    std::map<std::string, LabSetting> starts;   // by question
    std::vector<LabPreset> presets;             // with numbers of iterations
    std::vector<LabReading> readings;
    render::Sight sight = {};   // that the page begins with

    double critical() const { return 2 / largest_eigenvalue; }
    bool has_all_modes() const { return eigenvalues.size() >= (laplacian.M.array() > 0).count(); }   // a vertex without area has none
};

/// Computes the readings at these settings by the program's own methods; a run that blows up has none.
std::vector<LabReading> readings_at(const LabMesh& lab, const Spectrum& spectrum, const std::vector<LabSetting>& settings);

/// Computes operator, modes, settings and readings of a mesh for the laboratory; decimates a mesh above limits.vertices to about
/// limits.decimated_to.
/// @param questions  ids of the panels that open on this mesh, with the user's settings; "lab" stands for the page of `meshfolio lab`
/// @throws MeshError if the mesh cannot be decimated
LabMesh lab_mesh(const TriangleMesh& source, const std::string& name, const std::map<std::string, QuestionSettings>& questions,
                 const LabLimits& limits = {});

/// Returns the data that templates/viewer/lab_math.js reads: the length of the header (4 bytes) and the header (JSON); then, little endian
/// and aligned to 8 bytes: eigenvalues, areas, positions, coefficients, scales (doubles), corners of the triangles (4 bytes each), and the
/// numbers of the modes, all high bytes before all low bytes, which compresses better. If the page has only some modes, each number is
/// stored as its difference d from the mean of its neighbours before it, rounded down: d ≥ 0 as 2d, d < 0 as −2d − 1, modulo 2¹⁶.
std::string bytes_of(const LabMesh& lab);

}   // namespace meshfolio::run
