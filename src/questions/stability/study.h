/// @file
/// The limit of explicit smoothing proved, tried on both sides, and watched while the operator is rebuilt.
#pragma once

#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/smoothing/mode_growth.h"
#include "geometry/smoothing/stability_certificate.h"
#include "questions/bench/smoothing_study.h"

namespace meshfolio::stability {

struct OperatorLimit {
    std::string name;   // "cotangent", "uniform"
    StabilityCertificate certificate;
    ModeGrowth below, beyond;   // at 0.99 and 1.01 of the limit, the top mode seeded a thousandth of the mean edge high

    double critical() const { return largest_stable_step(certificate.top); }
};

/// Why that vertex: its area and its weights beside those of the others.
struct LimitingVertex {
    int vertex = -1;
    double area_share = 0;        // its area over the median
    double stiffness_share = 0;   // its −C_ii over the median
    bool on_boundary = false;
    double smallest_angle = 0;   // of the triangles around it [rad]

    double rate() const { return stiffness_share / area_share; }   // weights over area, which set how fast a vertex moves
};

struct StabilityStudy : OnMesh {
    OperatorLimit cotangent, uniform;
    LimitingVertex limiting;   // of the cotangent operator
    double mean_edge = 0;      // [length]
    double diagonal = 0;       // of the bounding box [length]

    std::array<const OperatorLimit*, 2> operators() const { return {&cotangent, &uniform}; }
};
StabilityStudy stability_study(SharedMesh source, const QuestionSettings& settings);

/// A run, and the first triangle it turned against the input.
struct WatchedRun {
    Smoothed run;
    double lambda = 0;          // asked for [length²]
    int iterations = 0;         // asked for
    int turned_iteration = 0;   // the first after which a triangle faces away from its own first normal; 0: none
    int turned_face = -1;       // that triangle, the first of them
    int inverted = 0;           // how many at the end
};

/// Flow with the operator rebuilt at every step, at half the limit of the input; and flow beyond the limit with the operator of the input.
struct RebuiltFlow : OnMesh {
    double lambda = 0;    // asked for [length²]
    double share = 0;     // of the proved limit, kept by the adaptive run
    int iterations = 0;   // asked for
    double beyond = 0;    // λ of the frozen run over the limit
    WatchedRun fixed, adaptive, frozen;

    std::array<std::pair<std::string, const WatchedRun*>, 3> runs() const {
        return {{{"rebuilt, fixed λ", &fixed}, {"rebuilt, adaptive λ", &adaptive}, {"frozen, fixed λ", &frozen}}};
    }
};
RebuiltFlow rebuilt_flow(const StabilityStudy& study, const QuestionSettings& settings);

/// What a mode has grown to over what the law says.
double over_predicted(const ModeGrowth& growth);

}   // namespace meshfolio::stability
