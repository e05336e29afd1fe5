// Question 4: meshes rebuilt from the k smoothest eigenvectors of the cotangent Laplace–Beltrami operator.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/law_checks.h"
#include "questions/core/comparison_figure.h"
#include "questions/core/section_tools.h"
#include "questions/core/six_view_figure.h"
#include "questions/core/study_list.h"
#include "questions/core/value_lists.h"
#include "questions/q4_spectral/parts.h"

namespace meshfolio::q4_spectral {

namespace {

using report::check_at_most;
using report::math;
using report::ref;

// ---- results ----------------------------------------------------------------------------------------------------------

void add_reconstruction_figure(Answer& answer, const SpectralStudy& study) {
    SixViewFigure figure;
    figure.id = id_of("q4", study.name(), "reconstructions");
    figure.title = "Reconstructions of " + study.name() + " from k eigenvectors";
    figure.subtitle = study.source->input.file + ", " + std::to_string(study.mesh().vertex_count()) + " vertices";
    std::vector<output::Panel> coloured;
    for (const Reconstruction& r : study.reconstructions) {
        coloured.push_back(panel_of(r.mesh, id_of("q4", study.name(), "k" + std::to_string(r.k)), "k = " + std::to_string(r.k),
                                    100 / study.diagonal * r.distance));
    }
    // The first k would use up the whole range, the last has only rounding: the range is that of all panels together.
    figure.range = output::robust_range(coloured, "viridis", "distance to the original", "% of the box diagonal", 0.1);
    figure.range->low = figure.range->clipped_below = 0;   // a distance begins at 0
    figure.panels.push_back(panel_of(*study.source, id_of("q4", study.name(), "original"), "original"));
    figure.panels.insert(figure.panels.end(), coloured.begin(), coloured.end());
    figure.caption =
        "The original and its reconstructions from the k smallest eigenvectors, one row a k, coloured by how far each vertex "
        "is from where it was. All rows share camera, scale and colour range.";
    add_figure(answer, std::move(figure));
}

/// The original against the reconstruction in the middle: coarser ones are blobs, finer ones show nothing.
void add_before_after(Answer& answer, const SpectralStudy& study, const std::string& colormap) {
    const Reconstruction& r = study.reconstructions[study.reconstructions.size() / 2];
    const std::string k = std::to_string(r.k);
    ComparisonFigure figure;
    figure.id = id_of("q4", study.name(), "before_after");
    figure.title = study.name() + " rebuilt from " + k + " eigenvectors";
    figure.subtitle = study.source->input.file + ", " + k + " of " + std::to_string(study.vertices()) + " modes";
    figure.caption = "The original " + study.name() + " against its reconstruction from the first " + k + " of " +
                     std::to_string(study.vertices()) + " modes: the Hausdorff distance between the surfaces is " +
                     readable(100 / study.diagonal * r.difference.hausdorff) + "\u202f% of the box diagonal, and the normals turn by " +
                     readable(r.difference.mean_normal_angle * 180 / M_PI) + "° on average.";
    figure.before = panel_of(*study.source, figure.id + "_original", "original");
    figure.after = panel_of(r.mesh, figure.id + "_rebuilt", "rebuilt, k = " + k);
    figure.diagonal = study.diagonal;
    figure.colormap = colormap;
    add_comparison(answer, std::move(figure));
}

void add_error_table(report::Section& section, const SpectralStudy& study) {
    report::Table table;
    table.id = id_of("q4", study.name(), "errors");
    table.caption = "Error of the reconstructions of " + study.name() +
                    ". rms and maximum over vertices, Hausdorff distance between the "
                    "surfaces, all against the bounding-box diagonal of " +
                    readable(study.diagonal, 4) + ".";
    table.columns = {{"k", "", 6},
                     {"μ_k", "1/length²", 4},
                     {"rms", "length", 3},
                     {"rms", "% of box", 3, report::Column::Best::smallest},
                     {"maximum", "% of box", 3, report::Column::Best::smallest},
                     {"Hausdorff", "% of box", 3, report::Column::Best::smallest},
                     {"mean normal angle", "°", 3, report::Column::Best::smallest},
                     {"volume", "% of original", 4}};
    for (const Reconstruction& r : study.reconstructions) {
        const double percent = 100 / study.diagonal;
        const MeshDifference& d = r.difference;
        table.rows.push_back({double(r.k), study.spectrum.eigenvalues[r.k - 1], d.rms, percent * d.rms, percent * d.max,
                              percent * d.hausdorff, d.mean_normal_angle * 180 / M_PI, cell_of(100 * d.volume_ratio)});
    }
    section.blocks.push_back(std::move(table));
}

void add_error_plot(report::Section& section, const SpectralStudy& study) {
    report::Plot plot;
    plot.id = id_of("q4", study.name(), "error_versus_k");
    plot.x_label = "number of eigenvectors k";
    plot.y_label = "rms error [% of box diagonal]";
    plot.log_x = plot.log_y = true;
    report::Series predicted{"predicted from the coefficients (Parseval)", {}, {}, {}, {}, report::Series::Style::line};
    const double percent = 100 / study.diagonal;
    // The curve ends above rounding: a logarithm of 1e-16 would squeeze everything else.
    for (int k = 1; k <= study.modes() && study.rms[k] > 1e-9 * study.diagonal; ++k) {
        predicted.x.push_back(k);
        predicted.y.push_back(percent * study.rms[k]);
    }
    report::Series measured{"measured on the rebuilt meshes", {}, {}, {}, {}, report::Series::Style::points};
    for (const Reconstruction& r : study.reconstructions) {
        if (r.difference.area_weighted_rms <= 1e-9 * study.diagonal) continue;
        measured.x.push_back(r.k);
        measured.y.push_back(percent * r.difference.area_weighted_rms);
    }
    for (const double share : {0.1, 0.01, 0.001}) {
        const int k = smallest_k_below(study, share);
        if (k > 0) plot.markers.push_back({double(k), percent * study.rms[k], readable_percent(share, 1) + ": k = " + std::to_string(k)});
    }
    plot.caption =
        "Area-weighted rms error of " + study.name() + " for every k up to " + std::to_string(study.modes()) +
        ", from one eigensolve. Marked: the smallest k whose error is below 10 %, 1 % and 0.1 % of the box diagonal, where reached.";
    plot.alt = "Error falls from " + readable(percent * study.rms[1]) + " % of the box diagonal at k = 1 to " +
               readable(percent * study.rms[study.modes()]) + " % at k = " + std::to_string(study.modes()) + ".";
    plot.series = {std::move(predicted), std::move(measured)};
    section.blocks.push_back(std::move(plot));
}

void add_eigenvalue_table(report::Section& section, const SpectralStudy& study) {
    report::Table table;
    table.id = id_of("q4", study.name(), "eigenvalues");
    table.caption = "Eigenvalues of −Cφ = μMφ on " + study.name() +
                    " with their residuals ‖−Cφ − μMφ‖/(μ‖Mφ‖), absolute for the zero modes; the "
                    "wavelength is 2π/√μ.";
    table.columns = {{"index", "", 6}, {"μ", "1/length²", 6}, {"residual", "", 2}, {"wavelength", "length", 3}};
    for (int i = 1; i <= study.modes(); ++i) {
        const bool shown =
            i <= 10 || std::any_of(study.reconstructions.begin(), study.reconstructions.end(), [&](const auto& r) { return r.k == i; });
        const double mu = study.spectrum.eigenvalues[i - 1];
        if (shown) table.rows.push_back({double(i), mu, study.spectrum.residuals[i - 1], cell_of(2 * M_PI / std::sqrt(mu), mu > 0)});
    }
    section.blocks.push_back(std::move(table));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const SpectralStudy& study) {
    const std::string on = " on " + study.name();
    const int needles = study.source->prepared->preflight.needle_faces + study.source->prepared->preflight.zero_area_faces;
    const std::string note = needles > 0 ? counted(needles, "needle or empty face") + ": rounding there limits what can be reached" : "";
    for (report::Check& check : spectrum_checks(study.certificate, on, note)) section.checks.push_back(std::move(check));
    section.checks.push_back(check_at_most("rms from the coefficients = rms of the meshes: difference / box diagonal" + on, 0,
                                           largest_parseval_gap(study) / study.diagonal, 1e-9));
    section.checks.push_back(
        check_at_most("error never rises with k: largest rise / box diagonal" + on, 0, largest_rise(study.rms) / study.diagonal, 1e-12));
    if (study.modes() == study.vertices()) {
        section.checks.push_back(check_at_most("k = n gives the mesh back: maximum error / box diagonal" + on, 0,
                                               study.reconstructions.back().difference.max / study.diagonal, 1e-9));
    }
}

// ---- the section -----------------------------------------------------------------------------------------------------

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section,
        "The eigenvectors of the cotangent Laplace–Beltrami operator are the mesh's own Fourier basis. They solve the generalised "
        "problem with the lumped barycentric mass matrix M and stay M-orthonormal, so no similarity transform has to be undone:");
    add_formula(section, "generalised_eigenproblem", "q4_eq_eigenproblem");
    add_formula(section, "m_orthonormal");
    add_paragraph(section, "The reconstruction is the M-orthogonal projection of the three coordinate functions on the first k of them,");
    add_formula(section, "spectral_reconstruction", "q4_eq_reconstruction");
    add_paragraph(section, "and its error for every k follows from the coefficients alone:");
    add_formula(section, "parseval", "q4_eq_parseval");
    add_paragraph(section,
                  "The largest k is solved once; every smaller k is a prefix of it. Completeness is not assumed: by Sylvester's law the "
                  "negative pivots of a factorisation of ",
                  math("−C − σM"),
                  " count the eigenvalues below σ. They prove it where the rounding of that count is smaller than the gap in which "
                  "σ lies; the checks say where it is not.");
    add_paragraph(section, "Between analysis and synthesis each coefficient may be multiplied by a gain ", ref("vallet_levy_2008"),
                  ", with the detail beyond the K known modes carried along:");
    add_formula(section, "spectral_filter", "q4_eq_filter");
    add_paragraph(section, "A low-pass needs no modes at all: a polynomial of the operator, here a Chebyshev series on a proved bound ",
                  math("b"), " of the spectrum, takes as many products with ", math("C"), " as its degree says.");
    add_formula(section, "chebyshev_filter", "q4_eq_chebyshev");
}

/// What the modes are good for beyond rebuilding, and what they cost.
void add_uses(Answer& answer, const SpectralStudy& study, const SpectralUses& uses, const QuestionSettings& settings) {
    report::Section& section = answer.section;
    add_limb_table(section, study, uses.limbs);
    add_cost_table(section, study, uses);
    add_band_figure(answer, study, uses.bands, settings.colormap);
    add_band_table(section, study, uses.bands);
    add_low_pass_blocks(section, study, uses.low_pass);
    add_mistake_figure(answer, study, uses.mistakes, settings.colormap);
    add_mistake_table(section, study, uses.mistakes);
    for (report::Check& check : spectral_use_checks(study, uses)) section.checks.push_back(std::move(check));
    section.timings.push_back({"eigenpairs of " + study.name(), study.seconds});
    if (uses.low_pass.k > 0) section.timings.push_back({"low-pass of " + study.name() + " by products", uses.low_pass.seconds});
}

void add_findings(report::Section& section, const SpectralStudy& study) {
    const Reconstruction& last = study.reconstructions.back();
    const int for_one_percent = smallest_k_below(study, 0.01);
    if (for_one_percent > 0) {
        section.findings.push_back({report::text("Q4: ", std::to_string(for_one_percent), " of ", std::to_string(study.vertices()),
                                                 " eigenvectors rebuild ", study.name(), " to 1\u202f% of its box diagonal."),
                                    80});
    } else {
        section.findings.push_back(
            {report::text("Q4: even k = ", std::to_string(last.k), " leaves ", study.name(), " ",
                          readable(100 * last.difference.rms / study.diagonal), "\u202f% of its box diagonal away (rms)."),
             80});
    }
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q4");
    const auto meshes = meshes_for(library, settings, {"armadillo"}, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "eigenpairs", settings, progress, section, spectral_study);
    std::vector<SpectralUses> uses;
    for (const SpectralStudy& study : studies) {
        progress("uses of the modes of " + study.name());
        uses.push_back(spectral_uses(study, settings));
    }
    std::vector<std::string> done;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        const SpectralStudy& study = studies[i];
        add_reconstruction_figure(answer, study);
        add_before_after(answer, study, settings.colormap);
        add_error_table(section, study);
        add_error_plot(section, study);
        add_threshold_table(section, study);
        add_eigenvalue_table(section, study);
        add_eigenfunction_gallery(answer, study, settings.quick);
        add_checks(section, study);
        add_uses(answer, study, uses[i], settings);
        add_findings(section, study);
        std::vector<std::string> counts;
        for (const Reconstruction& r : study.reconstructions) {
            const std::string file = id_of("q4", study.name(), "k" + std::to_string(r.k)) + ".ply";
            answer.meshes.push_back({file, std::make_shared<const TriangleMesh>(r.mesh)});
            section.output_meshes.push_back("meshes/" + file);
            counts.push_back(std::to_string(r.k));
        }
        done.push_back(study.name() + " with k = " + listed(counts));
        section.parameters["k on " + study.name()] = listed(counts);
        section.parameters["solver on " + study.name()] = study.spectrum.dense ? "dense" : "shift-invert Lanczos";
    }
    add_discussion(section, studies, uses);
    section.parameters["area form"] = "barycentric";
    section.extent =
        "Reconstructed " + listed(done) +
        "; error for every k; completeness of the spectrum checked by inertia; frequency bands, low-pass without modes and mistaken "
        "ways beside the right one; output meshes included";
    return answer;
}

extern const Chapter chapter{
    .id = "q4",
    .code = {{"smallest_eigenpairs", "src/geometry/spectrum/laplace_spectrum.cpp"},
             {"certify_spectrum", "src/geometry/spectrum/spectrum_certificate.cpp"},
             {"reconstruct", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"reconstruction_rms", "src/geometry/spectrum/spectral_reconstruction.cpp"},
             {"filtered", "src/geometry/spectrum/spectral_filter.cpp"},
             {"chebyshev_low_pass", "src/geometry/spectrum/chebyshev_filter.cpp"},
             {"reconstruct_unmapped", "src/geometry/spectrum/spectral_mistakes.cpp"},
             {"local_thickness", "src/geometry/measures/local_thickness.cpp"},
             {"answer", "src/questions/q4_spectral/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::q4_spectral
