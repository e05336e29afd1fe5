/// @file
/// What claims about denoising measure: noisy meshes smoothed step by step with one λ, against the clean mesh.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.h"
#include "questions/core/mesh_library.h"
#include "questions/core/settings.h"

namespace meshfolio {

/// One noisy mesh smoothed step by step.
struct DenoisingTrial {
    double sigma = 0;                   // of each coordinate [length]
    double relative = 0;                // over the box diagonal
    TriangleMesh noisy, best, last;     // best: at the smallest rms error
    std::vector<double> rms;            // after t = 0, 1, … iterations, against the clean mesh [length]
    std::vector<double> angle;          // mean angle between face normals and the clean ones [rad]
    int best_rms = 0, best_angle = 0;   // iterations
    int iterations() const { return static_cast<int>(rms.size()) - 1; }
    double feature_rms = 0, smooth_rms = 0;   // at the best iteration, on and off the feature edges [length]

    bool minimum_reached() const { return best_rms < iterations(); }
    /// The smallest error and the smallest angle reached.
    double least_rms() const { return rms[static_cast<std::size_t>(best_rms)]; }
    double least_angle() const { return angle[static_cast<std::size_t>(best_angle)]; }
    double gain() const { return rms.front() / least_rms(); }
};

struct DenoisingStudy {
    std::shared_ptr<const LibraryMesh> clean;
    double diagonal = 0, mean_edge = 0, lambda = 0;
    int iterations = 0, most_iterations = 0;   // a trial goes on beyond the first to twice its best iteration, up to the second
    std::vector<char> on_feature;              // n flags
    int feature_vertices = 0;
    std::vector<DenoisingTrial> trials;   // ascending σ
    std::vector<double> without_noise;    // rms after t iterations from the clean mesh [length]
    int analyses = 0;                     // symbolic, of all its runs together

    const std::string& name() const { return clean->name; }
};

/// At the noise levels of the settings, else from barely visible to hopeless.
DenoisingStudy denoising_study(std::shared_ptr<const LibraryMesh> clean, const QuestionSettings& settings);

}   // namespace meshfolio
