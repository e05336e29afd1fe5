// Question 7: what Laplacian smoothing can do against noise, measured against the clean mesh.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "number_text.h"
#include "questions/section_tools.h"
#include "questions/six_view_figure.h"
#include "questions/smoothing_study.h"

namespace meshfolio {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;
using report::ref;

/// σ over the box diagonal: from barely visible to hopeless.
const std::vector<double> default_noise{0.001, 0.003, 0.01, 0.03};
/// Step of the implicit scheme in squared mean edges: small enough that the minimum of the error lies at several iterations.
constexpr double step_in_squared_edges = 0.1;
/// Two faces that meet at more than this make a feature edge. [rad]
constexpr double feature_angle = 40 * M_PI / 180;

/// One noisy mesh smoothed step by step.
struct Trial {
    double sigma = 0;                   // of each coordinate [length]
    double relative = 0;                // over the box diagonal
    TriangleMesh noisy, best, last;     // best: at the smallest rms error
    std::vector<double> rms;            // after t = 0, 1, … iterations, against the clean mesh [length]
    std::vector<double> angle;          // mean angle between face normals and the clean ones [rad]
    int best_rms = 0, best_angle = 0;   // iterations
    int iterations() const { return static_cast<int>(rms.size()) - 1; }
    double feature_rms = 0, smooth_rms = 0;   // at the best iteration, on and off the feature edges [length]

    bool minimum_reached() const { return best_rms < iterations(); }

    double gain() const { return rms.front() / rms[static_cast<std::size_t>(best_rms)]; }
    double angle_gain() const { return angle.front() / angle[static_cast<std::size_t>(best_angle)]; }
};

struct Study {
    std::shared_ptr<const LibraryMesh> clean;
    double diagonal = 0, mean_edge = 0, lambda = 0;
    int iterations = 0, most_iterations = 0;   // a trial goes on beyond the first to twice its best iteration, up to the second
    std::vector<char> on_feature;              // n flags
    int feature_vertices = 0;
    std::vector<Trial> trials;           // ascending σ
    std::vector<double> without_noise;   // rms after t iterations from the clean mesh [length]

    const std::string& name() const { return clean->name; }
};

/// Vertices on an edge whose two faces meet at more than `feature_angle`.
std::vector<char> feature_vertices(const LibraryMesh& mesh) {
    const Positions normals = face_normals(mesh.mesh());
    const MeshTopology& topology = mesh.prepared->topology;
    std::vector<char> on_feature(static_cast<std::size_t>(mesh.mesh().vertex_count()), 0);
    for (const Edge& edge : topology.edges) {
        std::vector<int> faces;
        std::set_intersection(topology.vertex_faces.begin(edge.a), topology.vertex_faces.end(edge.a), topology.vertex_faces.begin(edge.b),
                              topology.vertex_faces.end(edge.b), std::back_inserter(faces));
        if (faces.size() != 2 || normals.row(faces[0]).dot(normals.row(faces[1])) >= std::cos(feature_angle)) continue;
        on_feature[static_cast<std::size_t>(edge.a)] = on_feature[static_cast<std::size_t>(edge.b)] = 1;
    }
    return on_feature;
}

double mean_normal_angle(const Positions& a, const Positions& b) {
    double sum = 0;
    for (Eigen::Index f = 0; f < a.rows(); ++f) {
        const Vector3 u = a.row(f), v = b.row(f);
        sum += std::atan2(u.cross(v).norm(), u.dot(v));
    }
    return sum / static_cast<double>(a.rows());
}

/// rms over the vertices whose flag is `flag`. [length]
double rms_where(const Study& study, const Positions& X, char flag) {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < X.rows(); ++v) {
        if (study.on_feature[static_cast<std::size_t>(v)] != flag) continue;
        sum += (X.row(v) - study.clean->mesh().X.row(v)).squaredNorm();
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

SmoothingOptions denoiser(const Study& study) {
    SmoothingOptions options;
    options.scheme = SmoothingScheme::implicit_euler;
    options.lambda = study.lambda;
    options.iterations = study.most_iterations;
    return options;
}

Trial trial_of(const Study& study, double relative, std::uint64_t seed) {
    const TriangleMesh& clean = study.clean->mesh();
    const Positions normals = face_normals(clean);
    Trial trial;
    trial.relative = relative;
    trial.sigma = relative * study.diagonal;
    trial.noisy = moved_to(clean, with_gaussian_noise(clean.X, Vector3::Constant(trial.sigma), seed));
    trial.best = trial.noisy;
    trial.rms = {vertex_rms(clean.X, trial.noisy.X)};
    trial.angle = {mean_normal_angle(normals, face_normals(trial.noisy))};

    SmoothingOptions options = denoiser(study);
    options.after_step = [&](int iteration, const Positions& X) {
        trial.rms.push_back(vertex_rms(clean.X, X));
        trial.angle.push_back(mean_normal_angle(normals, face_normals(moved_to(clean, X))));
        if (trial.rms.back() < trial.rms[static_cast<std::size_t>(trial.best_rms)]) {
            trial.best_rms = iteration;
            trial.best.X = X;
        }
        if (trial.angle.back() < trial.angle[static_cast<std::size_t>(trial.best_angle)]) trial.best_angle = iteration;
        return iteration < std::max(study.iterations, 2 * trial.best_rms);
    };
    trial.last = moved_to(clean, smooth(trial.noisy, options).X);
    trial.feature_rms = rms_where(study, trial.best.X, 1);
    trial.smooth_rms = rms_where(study, trial.best.X, 0);
    return trial;
}

Study study_of(std::shared_ptr<const LibraryMesh> mesh, const QuestionSettings& settings) {
    Study study;
    study.clean = std::move(mesh);
    study.diagonal = bounding_box(study.clean->mesh()).diagonal();
    study.mean_edge = mean_edge_length(study.clean->mesh());
    study.lambda = settings.lambda.empty() ? step_in_squared_edges * study.mean_edge * study.mean_edge : settings.lambda.front();
    study.iterations = settings.iterations.empty() ? (settings.quick ? 20 : 40) : settings.iterations.back();
    study.most_iterations = settings.iterations.empty() ? 15 * study.iterations : study.iterations;
    study.on_feature = feature_vertices(*study.clean);
    study.feature_vertices = static_cast<int>(std::count(study.on_feature.begin(), study.on_feature.end(), 1));

    study.without_noise = {0};
    SmoothingOptions options = denoiser(study);
    options.iterations = study.iterations;
    options.after_step = [&](int, const Positions& X) {
        study.without_noise.push_back(vertex_rms(study.clean->mesh().X, X));
        return true;
    };
    smooth(study.clean->mesh(), options);

    std::vector<double> levels = settings.noise;
    if (levels.empty()) levels = settings.quick ? std::vector{0.003, 0.01} : default_noise;
    levels = each_once(levels);
    for (const double level : levels) study.trials.push_back(trial_of(study, level, settings.seed));
    return study;
}

std::string id_of(const Study& study, const std::string& what) { return "q7_" + study.name() + "_" + what; }

/// For ids and file names: σ in hundred-thousandths of the box diagonal, "sigma00300" for 0.3 %.
std::string sigma_name(double relative) {
    std::string digits = std::to_string(std::llround(1e5 * relative));
    return "sigma" + std::string(digits.size() < 5 ? 5 - digits.size() : 0, '0') + digits;
}

// ---- results ----------------------------------------------------------------------------------------------------------

void add_figure_of(Answer& answer, const Study& study, const Trial& trial) {
    const std::string name = sigma_name(trial.relative);
    const auto coloured = [&](const TriangleMesh& mesh, const std::string& what, std::string label) {
        const Vector distance = (mesh.X - study.clean->mesh().X).rowwise().norm() * (100 / study.diagonal);
        return panel_of(mesh, id_of(study, name + "_" + what), std::move(label), distance);
    };
    SixViewFigure figure;
    figure.id = id_of(study, name);
    figure.title = "Denoising " + study.name() + ", σ = " + readable_percent(trial.relative, 2) + " of the box diagonal";
    figure.subtitle = "implicit, λ = " + readable(study.lambda) + " = " + readable(study.lambda / (study.mean_edge * study.mean_edge), 2) +
                      " h̄², operator of the noisy mesh";
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy")};
    const std::string last = "t = " + std::to_string(trial.iterations());
    if (trial.minimum_reached()) {
        panels.push_back(coloured(trial.best, "best", "best, t = " + std::to_string(trial.best_rms)));
        panels.push_back(coloured(trial.last, "over", "over-smoothed, " + last));
    } else {
        panels.push_back(coloured(trial.best, "best", last + ", error still falling"));
    }
    figure.range = output::robust_range(panels, "viridis", "distance to the clean mesh", "% of the box diagonal", 0.01);
    figure.range->low = figure.range->clipped_below = 0;   // a distance begins at 0
    figure.panels.push_back(panel_of(*study.clean, id_of(study, name + "_clean"), "clean"));
    figure.panels.insert(figure.panels.end(), panels.begin(), panels.end());
    figure.frame_panel = -1;   // noise may reach beyond the clean box
    figure.caption = study.name() + " with σ = " + readable_percent(trial.relative, 2) + " of the box diagonal (" +
                     readable(trial.sigma / study.mean_edge, 2) + " mean edges): clean, noisy, " +
                     (trial.minimum_reached() ? "at the iteration with the smallest error, and smoothed on to " : "and smoothed to ") +
                     last + "; coloured by the distance of each vertex to where it belongs.";
    add_figure(answer, std::move(figure));
}

void add_error_plot(report::Section& section, const Study& study) {
    report::Plot plot;
    plot.id = id_of(study, "error_versus_iteration");
    plot.x_label = "iteration";
    plot.y_label = "rms error [% of box diagonal]";
    plot.log_y = true;
    const double percent = 100 / study.diagonal;
    for (const Trial& trial : study.trials) {
        report::Series series{"σ = " + readable_percent(trial.relative, 2), {}, {}, {}, {}, report::Series::Style::line};
        for (std::size_t t = 0; t < trial.rms.size(); ++t) {
            series.x.push_back(double(t));
            series.y.push_back(percent * trial.rms[t]);
        }
        plot.series.push_back(std::move(series));
        plot.markers.push_back({double(trial.best_rms), percent * trial.rms[static_cast<std::size_t>(trial.best_rms)],
                                (trial.minimum_reached() ? "minimum, t = " : "still falling, t = ") + std::to_string(trial.best_rms)});
    }
    report::Series clean{"without noise", {}, {}, {}, {}, report::Series::Style::dashed};
    for (std::size_t t = 1; t < study.without_noise.size(); ++t) {
        clean.x.push_back(double(t));
        clean.y.push_back(percent * study.without_noise[t]);
    }
    plot.series.push_back(std::move(clean));
    plot.caption = "Error of " + study.name() +
                   " against the clean mesh while it is smoothed, one curve a noise level, its minimum marked. The dashed curve is "
                   "what smoothing alone does to the clean mesh: the price that rises while the noise falls.";
    plot.alt = plot.caption;
    section.blocks.push_back(std::move(plot));
}

std::string outcome_of(const Trial& trial) {
    if (trial.best_rms == 0) return "harms";
    return trial.gain() >= 2 ? "works" : trial.gain() >= 1.2 ? "helps" : "fails";
}

void add_result_table(report::Section& section, const std::vector<Study>& studies) {
    report::Table table;
    table.id = "q7_results";
    table.caption =
        "Denoising by implicit smoothing with the noisy mesh's own operator. Gain: error of the noisy mesh over the smallest error "
        "reached. Works: gain "
        "≥ 2; helps: ≥ 1.2; fails: below; harms: no iteration is better than none. Last: at twice the best iteration, but at least t = " +
        std::to_string(studies.front().iterations) + ".";
    table.columns = {{"mesh", "", 3},
                     {"σ", "% of box", 3},
                     {"σ", "mean edges", 3},
                     {"error, noisy", "% of box", 3},
                     {"best iteration", "", 5},
                     {"error, best", "% of box", 3},
                     {"gain", "×", 3},
                     {"normal angle, noisy", "°", 3},
                     {"best iteration (angle)", "", 5},
                     {"normal angle, best", "°", 3},
                     {"error at features / elsewhere", "×", 3},
                     {"error, last", "% of box", 3},
                     {"outcome", "", 3}};
    const double degrees = 180 / M_PI;
    for (const Study& study : studies) {
        for (const Trial& trial : study.trials) {
            const double percent = 100 / study.diagonal, ratio = trial.feature_rms / trial.smooth_rms;
            table.rows.push_back({study.name(), 100 * trial.relative, trial.sigma / study.mean_edge, percent * trial.rms.front(),
                                  double(trial.best_rms), percent * trial.rms[static_cast<std::size_t>(trial.best_rms)], trial.gain(),
                                  degrees * trial.angle.front(), double(trial.best_angle),
                                  degrees * trial.angle[static_cast<std::size_t>(trial.best_angle)], cell_of(ratio),
                                  percent * trial.rms.back(), outcome_of(trial)});
        }
    }
    section.blocks.push_back(std::move(table));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const Study& study) {
    const std::string on = " on " + study.name();
    const double n = study.clean->mesh().vertex_count();
    double fall = 0;
    for (std::size_t t = 1; t < study.without_noise.size(); ++t) {
        fall = std::max(fall, (study.without_noise[t - 1] - study.without_noise[t]) / study.diagonal);
    }
    section.checks.push_back(check_at_most("without noise the error never falls: largest fall / box diagonal" + on, 0, fall, 1e-12));
    for (const Trial& trial : study.trials) {
        // rms of 3n normal numbers has relative standard deviation 1/√(6n); five of them.
        section.checks.push_back(check_near("noise as asked: rms / (√3 σ) at " + plain_text(100 * trial.relative, 3) + " %" + on, 1,
                                            trial.rms.front() / (std::sqrt(3.0) * trial.sigma), 5 / std::sqrt(6 * n)));
    }
}

// ---- what the numbers say ---------------------------------------------------------------------------------------------

report::Text what_happened(const Study& study) {
    const Trial &low = study.trials.front(), &high = study.trials.back();
    const auto told = [&](const Trial& trial) {
        std::string s = "at σ = " + readable_percent(trial.relative, 2) + " of the diagonal (" +
                        readable(trial.sigma / study.mean_edge, 2) + " mean edges) ";
        if (trial.best_rms == 0) return s + "no iteration is better than none";
        return s + "the error falls by a factor of " + readable(trial.gain()) + " at iteration " + std::to_string(trial.best_rms);
    };
    report::Text t = report::text("On ", study.name(), " ", told(low));
    if (&low != &high) report::extend(t, ", ", told(high));
    report::extend(t, " (", ref(id_of(study, "error_versus_iteration")), ").");
    if (&low != &high && low.best_rms != high.best_rms) {
        report::extend(t, " More noise asks for ", high.best_rms > low.best_rms ? "more" : "fewer",
                       " iterations, as far as these levels go.");
    }
    const bool at_end =
        std::any_of(study.trials.begin(), study.trials.end(), [&](const Trial& trial) { return trial.best_rms == trial.iterations(); });
    if (at_end)
        report::extend(t, " At the highest level the minimum was not reached within ",
                       counted(study.trials.back().iterations(), "iteration"), ".");
    for (const Trial& trial : study.trials) {
        if (trial.best_rms == 0 || 2 * trial.best_rms > trial.iterations()) continue;
        report::extend(t, " Going on to iteration ", std::to_string(trial.iterations()), " at σ = ", readable_percent(trial.relative, 2),
                       " leaves ", readable(trial.rms.back() / trial.rms[static_cast<std::size_t>(trial.best_rms)], 2),
                       " times the smallest error.");
        break;
    }
    return t;
}

report::Text features_pay(const Study& study) {
    if (study.feature_vertices == 0) {
        return report::text(study.name(), " has no edge sharper than 40°, so there is no feature to lose there.");
    }
    const int vertices = study.clean->mesh().vertex_count();
    if (2 * study.feature_vertices > vertices) {
        return report::text(std::to_string(study.feature_vertices), " of the ", std::to_string(vertices), " vertices of ", study.name(),
                            " lie on edges sharper than 40°: on so coarse a mesh features and tessellation cannot be told apart.");
    }
    double lowest = INFINITY, highest = 0;
    for (const Trial& trial : study.trials) {
        if (trial.best_rms == 0) continue;
        lowest = std::min(lowest, trial.feature_rms / trial.smooth_rms);
        highest = std::max(highest, trial.feature_rms / trial.smooth_rms);
    }
    if (highest == 0) return {};
    report::Text t = report::text("Of its ", std::to_string(vertices), " vertices ", std::to_string(study.feature_vertices),
                                  " lie on edges sharper than 40°; at the best iterations the error there is ", readable(lowest, 3));
    if (highest > lowest) report::extend(t, " to ", readable(highest, 3));
    report::extend(t, " times that elsewhere",
                   highest > 1.2  ? ": the filter cannot tell an edge from noise, and rounds it."
                   : lowest > 0.9 ? ": edges fare no worse than the rest."
                                  : ": edges fare better than the rest here.");
    return t;
}

report::Text position_against_normals(const Study& study) {
    for (const Trial& trial : study.trials) {
        if (std::abs(trial.best_angle - trial.best_rms) < 3) continue;
        return report::text("Position and normals disagree about when to stop: at σ = ", readable_percent(trial.relative, 2),
                            " the rms error of ", study.name(), " is smallest at iteration ", std::to_string(trial.best_rms),
                            ", the angle between face normals at iteration ", std::to_string(trial.best_angle),
                            trial.best_angle == trial.iterations() ? " or later" : "", ".");
    }
    return {};
}

/// Above which noise, measured in mean edges, the gain reaches 1.2: a clean split of the cases or none.
report::Text limit_in_mean_edges(const std::vector<Study>& studies) {
    double smallest_helped = INFINITY, largest_failed = 0;
    for (const Study& study : studies) {
        for (const Trial& trial : study.trials) {
            const double edges = trial.sigma / study.mean_edge;
            if (trial.gain() >= 1.2) {
                smallest_helped = std::min(smallest_helped, edges);
            } else {
                largest_failed = std::max(largest_failed, edges);
            }
        }
    }
    if (!std::isfinite(smallest_helped) || largest_failed == 0) return {};
    if (largest_failed < smallest_helped) {
        return report::text(" Measured in mean edges the cases split cleanly: every σ up to ", readable(largest_failed, 2),
                            " gains less than 1.2, every one from ", readable(smallest_helped, 2), " on gains more.");
    }
    return report::text(" Noise in mean edges does not decide alone: a gain of 1.2 was reached from ", readable(smallest_helped, 2),
                        " mean edges on, but missed at up to ", readable(largest_failed, 2), ".");
}

report::Text verdict(const std::vector<Study>& studies) {
    std::vector<std::string> works, fails;
    for (const Study& study : studies) {
        for (const Trial& trial : study.trials) {
            const std::string name = study.name() + " at " + readable_percent(trial.relative, 2);
            const std::string outcome = outcome_of(trial);
            if (outcome == "works") works.push_back(name);
            if (outcome == "fails" || outcome == "harms") fails.push_back(name);
        }
    }
    report::Text t;
    if (works.empty()) {
        report::extend(t, "In none of the cases tried does smoothing halve the error.");
    } else {
        report::extend(t, "Smoothing at least halves the error on ", listed(works), ".");
    }
    if (fails.empty()) {
        report::extend(t, " In no case is the gain below 1.2.");
    } else {
        report::extend(t, " It gains less than a fifth, or nothing, on ", listed(fails), ".");
    }
    report::extend(t, limit_in_mean_edges(studies));
    report::extend(t, " The two curves of ", math("bias"), " and ", math("noise"),
                   " explain it: smoothing removes noise at a rate set by λ and the operator, and shape at a "
                   "rate set by the shape; it pays as long as the noise is larger than what the same iterations take from the clean mesh (",
                   ref("q7_results"), ").");
    return t;
}

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(section,
                  "Clean meshes get independent zero-mean Gaussian noise on every coordinate, σ being a fraction of the box diagonal:");
    add_formula(section, "gaussian_noise");
    add_paragraph(section,
                  "They are smoothed implicitly with the operator of the noisy mesh, which is all that a user has, and compared with the "
                  "clean mesh after every "
                  "iteration:");
    add_formula(section, "rms_error", "q7_eq_rms");
    section.code = {{"with_gaussian_noise", "src/mesh/vertex_noise.cpp", "seeded noise"},
                    {"smooth", "src/geometry/laplacian_smoothing.cpp", "implicit smoothing"},
                    {"vertex_rms", "src/geometry/mesh_error.cpp", "error against the clean mesh"},
                    {"answer_q7", "src/questions/q7_denoising_study.cpp", "this section"}};
}

void add_finding(report::Section& section, const std::vector<Study>& studies) {
    const Trial *best = nullptr, *worst = nullptr;
    const Study *best_on = nullptr, *worst_on = nullptr;
    for (const Study& study : studies) {
        for (const Trial& trial : study.trials) {
            if (best == nullptr || trial.gain() > best->gain()) best = &trial, best_on = &study;
            if (worst == nullptr || trial.gain() < worst->gain()) worst = &trial, worst_on = &study;
        }
    }
    report::Text t = report::text("Q7: smoothing lowers the error of ", best_on->name(), " with ", readable_percent(best->relative, 2),
                                  " noise ", readable(best->gain(), 2), "-fold");
    if (best != worst) {
        report::extend(t, worst->gain() < 1.05 ? ", but does nothing for " : ", and of ", worst_on->name(), " with ",
                       readable_percent(worst->relative, 2), " noise");
        if (worst->gain() >= 1.05) report::extend(t, " only ", readable(worst->gain(), 2), "-fold");
    }
    report::extend(t, ".");
    section.findings.push_back({std::move(t), 78});
}

}   // namespace

Answer answer_q7(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q7");
    const auto meshes = meshes_for(library, settings, {"cube", "fandisk", "armadillo"}, section);
    add_method(section);

    add_heading(section, "Results");
    std::vector<Study> studies;
    std::vector<std::string> names, levels;
    for (const auto& mesh : meshes) {
        progress("denoising of " + mesh->name);
        studies.push_back(study_of(mesh, settings));
        names.push_back(mesh->name);
    }
    add_result_table(section, studies);
    for (const Study& study : studies) {
        add_error_plot(section, study);
        for (std::size_t i = study.trials.size() > 2 ? 1 : 0; i < study.trials.size(); ++i) add_figure_of(answer, study, study.trials[i]);
        add_checks(section, study);
        section.parameters["λ on " + study.name()] = plain_text(study.lambda, 6);
    }
    add_heading(section, "Discussion: when does it work, when does it fail?");
    section.blocks.push_back(report::Paragraph{verdict(studies)});
    for (const Study& study : studies) {
        for (report::Text t : {what_happened(study), features_pay(study), position_against_normals(study)}) {
            if (!t.empty()) section.blocks.push_back(report::Paragraph{std::move(t)});
        }
    }
    for (const Trial& trial : studies.front().trials) levels.push_back(readable_percent(trial.relative, 2));
    section.parameters["noise"] = listed(levels) + " of the box diagonal";
    section.parameters["iterations"] = "at least " + std::to_string(studies.front().iterations) + ", and twice the best one";
    section.parameters["seed"] = std::to_string(settings.seed);
    section.extent = "Noise of " + listed(levels) + " of the box diagonal on " + listed(names) +
                     "; error after every iteration with its minimum; when it works and when it fails, measured";
    add_finding(section, studies);
    return answer;
}

}   // namespace meshfolio
