// Question 7: what Laplacian smoothing can do against noise, measured against the clean mesh.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/study_list.h"
#include "questions/core/value_lists.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

using report::check_at_most;
using report::check_near;

// ---- results ----------------------------------------------------------------------------------------------------------

/// For ids and file names: σ in hundred-thousandths of the box diagonal, "sigma00300" for 0.3 %.
std::string sigma_name(double relative) {
    std::string digits = std::to_string(std::llround(1e5 * relative));
    return "sigma" + std::string(digits.size() < 5 ? 5 - digits.size() : 0, '0') + digits;
}

void add_figure_of(Answer& answer, const DenoisingStudy& study, const DenoisingTrial& trial) {
    const std::string name = sigma_name(trial.relative);
    const auto coloured = [&](const TriangleMesh& mesh, const std::string& what, std::string label) {
        const Vector distance = (mesh.X - study.clean->mesh().X).rowwise().norm() * (100 / study.diagonal);
        return panel_of(mesh, id_of("q7", study.name(), name + "_" + what), std::move(label), distance);
    };
    SixViewFigure figure;
    figure.id = id_of("q7", study.name(), name);
    figure.title = "Denoising " + study.name() + ", σ = " + readable_percent(trial.relative, 2) + " of the box diagonal";
    figure.subtitle = "implicit, λ = " + readable(study.lambda) + " = " + readable(study.lambda / (study.mean_edge * study.mean_edge), 2) +
                      " h̄², operator of the noisy mesh";
    std::vector<output::Panel> panels{coloured(trial.noisy, "noisy", "noisy")};
    const std::string last = "t = " + std::to_string(trial.iterations());
    if (trial.minimum_reached()) {
        panels.push_back(coloured(trial.best, "best", "best, t = " + std::to_string(trial.best_rms)));
        panels.push_back(coloured(trial.last, "over", "smoothed on, " + last));
    } else {
        panels.push_back(coloured(trial.best, "best", last + ", error still falling"));
    }
    figure.range = output::robust_range(panels, "viridis", "distance to the clean mesh", "% of the box diagonal", 0.01);
    figure.range->low = figure.range->clipped_below = 0;   // a distance begins at 0
    figure.panels.push_back(panel_of(*study.clean, id_of("q7", study.name(), name + "_clean"), "clean"));
    figure.panels.insert(figure.panels.end(), panels.begin(), panels.end());
    figure.frame_panel = -1;   // noise may reach beyond the clean box
    figure.caption = study.name() + " with σ = " + readable_percent(trial.relative, 2) + " of the box diagonal (" +
                     readable(trial.sigma / study.mean_edge, 2) + " mean edges): clean, noisy, " +
                     (trial.minimum_reached() ? "at the iteration with the smallest error, and smoothed on to " : "and smoothed to ") +
                     last + "; coloured by the distance of each vertex to where it belongs.";
    add_figure(answer, std::move(figure));
}

/// The noise that smoothing did most against.
void add_before_after(Answer& answer, const DenoisingStudy& study, const std::string& colormap) {
    const auto less_gain = [](const DenoisingTrial& a, const DenoisingTrial& b) { return a.gain() < b.gain(); };
    const DenoisingTrial& trial = *std::max_element(study.trials.begin(), study.trials.end(), less_gain);
    if (trial.best_rms == 0) return;   // nothing was better than the noise
    const double percent = 100 / study.diagonal;
    const std::string sigma = "σ = " + readable_percent(trial.relative, 2), times = counted(trial.best_rms, "iteration");
    ComparisonFigure figure;
    figure.id = id_of("q7", study.name(), "before_after");
    figure.title = study.name() + " noisy and denoised, " + sigma;
    figure.subtitle = "implicit, " + times + " with λ = " + readable(study.lambda);
    figure.caption = study.name() + " with noise of " + sigma + " of the box diagonal, and after " + times +
                     ", when it is closest to the clean mesh: the rms error falls from " + readable(percent * trial.rms.front()) +
                     "\u202f% to " + readable(percent * trial.rms[static_cast<std::size_t>(trial.best_rms)]) +
                     "\u202f% of the box diagonal, " + readable(trial.gain(), 2) + "-fold.";
    figure.before = panel_of(trial.noisy, figure.id + "_noisy", "noisy, " + sigma);
    figure.after = panel_of(trial.best, figure.id + "_denoised", "denoised, t = " + std::to_string(trial.best_rms));
    figure.diagonal = study.diagonal;
    figure.colormap = colormap;
    figure.frame_panel = -1;   // noise may reach beyond the clean box
    add_comparison(answer, std::move(figure));
}

void add_error_plot(report::Section& section, const DenoisingStudy& study) {
    report::Plot plot;
    plot.id = id_of("q7", study.name(), "error_versus_iteration");
    plot.x_label = "1 + iteration t";   // so that the noisy mesh, t = 0, has a place on the logarithmic axis
    plot.y_label = "rms error [% of box diagonal]";
    plot.log_x = plot.log_y = true;
    const double percent = 100 / study.diagonal;
    for (const DenoisingTrial& trial : study.trials) {
        report::Series series{"σ = " + readable_percent(trial.relative, 2), {}, {}, {}, {}, report::Series::Style::line};
        for (std::size_t t = 0; t < trial.rms.size(); ++t) {
            series.x.push_back(1 + double(t));
            series.y.push_back(percent * trial.rms[t]);
        }
        plot.series.push_back(std::move(series));
        plot.markers.push_back({1 + double(trial.best_rms), percent * trial.rms[static_cast<std::size_t>(trial.best_rms)],
                                (trial.minimum_reached() ? "minimum, t = " : "still falling, t = ") + std::to_string(trial.best_rms)});
    }
    report::Series clean{"without noise", {}, {}, {}, {}, report::Series::Style::dashed};
    for (std::size_t t = 1; t < study.without_noise.size(); ++t) {
        clean.x.push_back(1 + double(t));
        clean.y.push_back(percent * study.without_noise[t]);
    }
    plot.series.push_back(std::move(clean));
    plot.caption = "Error of " + study.name() +
                   " against the clean mesh while it is smoothed, one curve a noise level, from the noisy mesh, 1 + t = 1, on; its minimum "
                   "marked. The one without noise is "
                   "what smoothing alone does to the clean mesh: the price that rises while the noise falls.";
    plot.alt = plot.caption;
    section.blocks.push_back(std::move(plot));
}

/// "at twice the best iteration, but at t = 40 at least and 600 at most"
std::string length_of_runs(const DenoisingStudy& study) {
    std::string least = "t = " + std::to_string(study.iterations);
    if (study.most_iterations <= study.iterations) return least;
    return "at twice the best iteration, but at " + least + " at least and " + std::to_string(study.most_iterations) + " at most";
}

/// Where a run ended before the error or the angle had turned; empty when none did.
std::string words_of_unended(const std::vector<DenoisingStudy>& studies) {
    const bool any = std::any_of(studies.begin(), studies.end(), [](const DenoisingStudy& study) {
        return std::any_of(study.trials.begin(), study.trials.end(),
                           [](const DenoisingTrial& trial) { return !trial.minimum_reached() || trial.best_angle == trial.iterations(); });
    });
    return any ? " A best iteration that is the last of its run is no minimum: places or normals were still getting nearer." : "";
}

void add_result_table(report::Section& section, const std::vector<DenoisingStudy>& studies) {
    report::Table table;
    table.id = "q7_results";
    table.caption =
        "Denoising by implicit smoothing with the noisy mesh's own operator. Gain: error of the noisy mesh over the smallest error "
        "reached. Works: gain "
        "≥ 2; helps: ≥ 1.2; fails: below; harms: no iteration is better than none. Last: where the run ended, " +
        length_of_runs(studies.front()) + "." + words_of_unended(studies);
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
    for (const DenoisingStudy& study : studies) {
        for (const DenoisingTrial& trial : study.trials) {
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

void add_checks(report::Section& section, const DenoisingStudy& study) {
    const std::string on = " on " + study.name();
    const double n = study.clean->mesh().vertex_count();
    const std::vector<double> backwards(study.without_noise.rbegin(), study.without_noise.rend());
    const double fall = largest_rise(backwards) / study.diagonal;
    section.checks.push_back(check_at_most("without noise the error never falls: largest fall / box diagonal" + on, 0, fall, 1e-12));
    for (const DenoisingTrial& trial : study.trials) {
        // rms of 3n normal numbers has relative standard deviation 1/√(6n); five of them.
        section.checks.push_back(check_near("noise as asked: rms / (√3 σ) at " + plain_text(100 * trial.relative, 3) + " %" + on, 1,
                                            trial.rms.front() / (std::sqrt(3.0) * trial.sigma), 5 / std::sqrt(6 * n)));
    }
}

// ---- the section -----------------------------------------------------------------------------------------------------

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
}

void add_finding(report::Section& section, const std::vector<DenoisingStudy>& studies) {
    const DenoisingStudy *best_on = &studies.front(), *worst_on = best_on;
    const DenoisingTrial *best = &best_on->trials.front(), *worst = best;
    for (const DenoisingStudy& study : studies) {
        for (const DenoisingTrial& trial : study.trials) {
            if (trial.gain() > best->gain()) best = &trial, best_on = &study;
            if (trial.gain() < worst->gain()) worst = &trial, worst_on = &study;
        }
    }
    if (best->best_rms == 0) {
        report::Text none = report::text("Q7: smoothing lowers the error in no case tried, from ",
                                         readable_percent(studies.front().trials.front().relative, 2), " to ",
                                         readable_percent(studies.front().trials.back().relative, 2), " noise.");
        section.findings.push_back({std::move(none), 78});
        return;
    }
    report::Text t = report::text("Q7: smoothing lowers the error of ", best_on->name(), " with ", readable_percent(best->relative, 2),
                                  " noise ", readable(best->gain(), 2), "-fold");
    if (best != worst) {
        report::extend(t,
                       worst->best_rms == 0   ? ", but only harms "
                       : worst->gain() < 1.05 ? ", but hardly that of "
                                              : ", and of ",
                       worst_on->name(), " with ", readable_percent(worst->relative, 2), " noise");
        if (worst->gain() >= 1.05) report::extend(t, " only ", readable(worst->gain(), 2), "-fold");
    }
    report::extend(t, ".");
    section.findings.push_back({std::move(t), 78});
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q7");
    const auto meshes = meshes_for(library, settings, {"cube", "fandisk", "armadillo"}, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "denoising", settings, progress, section, denoising_study);
    add_result_table(section, studies);
    for (const DenoisingStudy& study : studies) {
        add_error_plot(section, study);
        for (std::size_t i = study.trials.size() > 2 ? 1 : 0; i < study.trials.size(); ++i) add_figure_of(answer, study, study.trials[i]);
        add_before_after(answer, study, settings.colormap);
        add_checks(section, study);
        section.parameters["λ on " + study.name()] = plain_text(study.lambda, 6);
    }
    add_discussion(section, studies);
    std::vector<std::string> levels;
    for (const DenoisingTrial& trial : studies.front().trials) levels.push_back(readable_percent(trial.relative, 2));
    section.parameters["noise"] = listed(levels) + " of the box diagonal";
    section.parameters["iterations"] = length_of_runs(studies.front());
    section.parameters["seed"] = std::to_string(settings.seed);
    section.extent = "Noise of " + listed(levels) + " of the box diagonal on " + listed(names_of(studies)) +
                     "; error after every iteration with its minimum; when it works and when it fails, measured";
    add_finding(section, studies);
    return answer;
}

extern const Chapter chapter{
    .id = "q7",
    .code = {{"with_gaussian_noise", "src/mesh/vertex_noise.cpp"},
             {"smooth", "src/geometry/smoothing/laplacian_smoothing.cpp"},
             {"vertex_rms", "src/geometry/measures/mesh_error.cpp"},
             {"answer", "src/questions/q7_denoising/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q7_denoising
