/// @file
/// An experiment of an earlier report as plain data: its meshes, parameters and findings. Settings files hold them as [[experiment]];
/// data/reports has those of four reports.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/operators/laplace_operator.h"
#include "geometry/operators/vertex_areas.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/stability.h"

namespace meshfolio {

/// A mesh that a report used, and the bundled one in its place. Its measures scale raw parameters, which are lengths and areas of it.
struct OriginalMesh {
    std::string name;         // "bunny"
    std::string file;         // "bunny.off", looked for beside the settings file and in the data folders; empty: not to be had
    std::string stand_in;     // "creature.obj", bundled
    double lambda_crit = 0;   // 2/μ_max of its cotangent operator, barycentric areas; 0: not known [length²]
    double mean_edge = 0;     // 0: not known [length]
    double diagonal = 0;      // of its bounding box; 0: not known [length]
};

enum class ExperimentKind { curvature, forms, reconstruction, smoothing, denoising, error_curve };

/// A smoothing scheme, with its operator frozen or rebuilt from the current positions at every step.
struct SmoothingMethod {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    bool rebuild = false;
    friend bool operator==(const SmoothingMethod&, const SmoothingMethod&) = default;
};

/// Unit of a noise level: model units; extent of the box along each axis; box diagonal; mean edge.
enum class NoiseUnit { raw, box, diagonal, edge };

/// The colours of pictures: none, H by cotangent or uniform weights, K, or the distance to the original.
enum class ExperimentColour { none, h_cotan, h_uniform, gauss, distance };

struct Experiment {
    std::vector<int> rows;   // of the requirements, 7 to 34
    std::string from;        // the report: "S0"
    std::string name;        // "Explicit smoothing of the bunny, λ rising"
    ExperimentKind kind = ExperimentKind::smoothing;
    std::vector<OriginalMesh> meshes;   // none for the forms of an ellipsoid

    std::vector<SmoothingMethod> methods{{}};
    std::vector<OperatorKind> operators{OperatorKind::cotan};
    std::vector<AreaForm> areas{AreaForm::barycentric};
    std::vector<double> lambda;             // steps, each in lambda_unit; dimensionless for the uniform operator
    StepUnit lambda_unit = StepUnit::raw;   // tau: multiples of the mesh's own limit
    bool search = false;                    // λ is lost: the largest usable one is searched for too
    std::vector<int> iterations;            // ascending
    std::vector<int> k;                     // modes
    std::vector<double> noise;              // standard deviation of each coordinate, in noise_unit
    NoiseUnit noise_unit = NoiseUnit::raw;
    std::vector<int> minimum;   // one a noise level: where the report has the smallest error; 0: not said
    std::uint64_t seed = 1;

    std::vector<ExperimentColour> colours{ExperimentColour::none};
    std::string colormap;   // empty: diverging for signed values, else that of the settings
    std::string said;       // what the report says of it, in other words
    std::string lost;       // which parameters the report does not give, and by what rule they are chosen here
    bool brief = false;     // small and telling enough for a report that names no experiments
};

// All names as in settings files, in the order of the enumerations.
std::vector<std::string> experiment_kind_names();     // "curvature", … "error-curve"
std::vector<std::string> smoothing_method_names();    // "explicit", … "implicit-rebuilt", "taubin"
std::vector<std::string> noise_unit_names();          // "raw", "box", "diagonal", "edge"
std::vector<std::string> experiment_colour_names();   // "none", "h-cotan", … "distance"

std::string name_of(ExperimentKind kind);
std::string name_of(const SmoothingMethod& method);
std::string name_of(NoiseUnit unit);
std::string name_of(ExperimentColour colour);
/// Return the value of a name in a settings file. @throws UsageError that suggests the nearest name
ExperimentKind experiment_kind_named(const std::string& name);
SmoothingMethod smoothing_method_named(const std::string& name);
NoiseUnit noise_unit_named(const std::string& name);
ExperimentColour experiment_colour_named(const std::string& name);

namespace limits {
inline constexpr int first_row = 7, last_row = 34;   // of the requirements that experiments reproduce
inline constexpr int most_experiments = 100;
}   // namespace limits

/// Returns the text of a settings file of data/reports as compiled in, by its name without ending ("s0"); empty if there is none.
std::string_view bundled_report_text(const std::string& name);
/// Returns the names that bundled_report_text() knows, sorted: "earlier", "laboratory", "s0", …
std::vector<std::string> bundled_report_names();

}   // namespace meshfolio
