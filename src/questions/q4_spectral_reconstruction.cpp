// Question 4: meshes rebuilt from the k smoothest eigenvectors of the cotangent Laplace–Beltrami operator.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/mesh_error.h"
#include "geometry/spectral_reconstruction.h"
#include "mesh/triangle_measures.h"
#include "number_text.h"
#include "questions/question.h"
#include "questions/section_tools.h"
#include "questions/six_view_figure.h"

namespace meshfolio {

namespace {

using report::check_at_most;
using report::check_near;
using report::math;
using report::ref;

/// All modes are taken when the mesh is no larger than this; beyond, `largest_k` modes are the "large value".
constexpr int all_modes_up_to = 700;

/// The k of the assignment, 5, 15 and large, with steps in between.
std::vector<int> mode_counts(const QuestionSettings& settings, int n) {
    std::vector<int> counts = settings.k;
    if (counts.empty()) {
        counts = settings.quick ? std::vector{5, 15, 60} : std::vector{5, 15, 30, 60, 150};
        if (!settings.quick) counts.push_back(n <= all_modes_up_to ? n : 300);
    }
    for (int& k : counts) k = std::clamp(k, 1, n);
    std::sort(counts.begin(), counts.end());
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    return counts;
}

struct Reconstruction {
    int k = 0;
    TriangleMesh mesh;
    Vector distance;             // n, |x_i − x_i^(k)| [length]
    MeshDifference difference;   // against the original
    double predicted_rms = 0;    // area-weighted, from the coefficients alone [length]
};

struct Study {
    const LibraryMesh* mesh = nullptr;
    double diagonal = 0;   // of the bounding box [length]
    LaplaceBeltrami laplacian;
    Spectrum spectrum;
    Vector rms;   // entry k: predicted error of k modes [length]
    std::vector<Reconstruction> reconstructions;
};

Study study_of(const LibraryMesh& mesh, const QuestionSettings& settings) {
    Study study;
    study.mesh = &mesh;
    study.diagonal = bounding_box(mesh.mesh()).diagonal();
    study.laplacian = laplace_beltrami(mesh.mesh());
    const std::vector<int> counts = mode_counts(settings, mesh.prepared->preflight.vertices_in_use);
    study.spectrum = smallest_eigenpairs(study.laplacian, counts.back());
    const Positions& X = mesh.mesh().X;
    study.rms = reconstruction_rms(study.spectrum, study.laplacian.M, X);
    for (const int k : counts) {
        if (k > study.spectrum.eigenvalues.size()) continue;
        Reconstruction r;
        r.k = k;
        r.mesh = moved_to(mesh.mesh(), reconstruct(study.spectrum, study.laplacian.M, X, k));
        r.distance = (r.mesh.X - X).rowwise().norm();
        r.difference = compare_meshes(mesh.mesh(), r.mesh);
        r.predicted_rms = study.rms[k];
        study.reconstructions.push_back(std::move(r));
    }
    return study;
}

int modes_of(const Study& study) { return static_cast<int>(study.spectrum.eigenvalues.size()); }

/// Smallest k whose error is at most `share` of the box diagonal; 0 when no k that was computed reaches it.
int smallest_k_below(const Study& study, double share) {
    for (int k = 1; k <= modes_of(study); ++k) {
        if (study.rms[k] <= share * study.diagonal) return k;
    }
    return 0;
}

std::string id_of(const Study& study, const std::string& what) { return "q4_" + study.mesh->name + "_" + what; }

// ---- results ----------------------------------------------------------------------------------------------------------

void add_reconstruction_figure(Answer& answer, const Study& study) {
    SixViewFigure figure;
    figure.id = id_of(study, "reconstructions");
    figure.title = "Reconstructions of " + study.mesh->name + " from k eigenvectors";
    figure.subtitle = study.mesh->input.file + ", " + std::to_string(study.mesh->mesh().vertex_count()) + " vertices";
    std::vector<output::Panel> coloured;
    for (const Reconstruction& r : study.reconstructions) {
        coloured.push_back(
            panel_of(r.mesh, id_of(study, "k" + std::to_string(r.k)), "k = " + std::to_string(r.k), 100 / study.diagonal * r.distance));
    }
    // The first k would use up the whole range, the last has only rounding: the range is that of all panels together.
    figure.range = output::robust_range(coloured, "viridis", "distance to the original", "% of the box diagonal", 0.1);
    figure.range->low = figure.range->clipped_below = 0;   // a distance begins at 0
    figure.panels.push_back(panel_of(*study.mesh, id_of(study, "original"), "original"));
    figure.panels.insert(figure.panels.end(), coloured.begin(), coloured.end());
    figure.caption =
        "The original and its reconstructions from the k smallest eigenvectors, one row a k, coloured by how far each vertex "
        "is from where it was. All rows share camera, scale and colour range.";
    add_figure(answer, std::move(figure));
}

void add_error_table(report::Section& section, const Study& study) {
    report::Table table;
    table.id = id_of(study, "errors");
    table.caption = "Error of the reconstructions of " + study.mesh->name +
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

void add_error_plot(report::Section& section, const Study& study) {
    report::Plot plot;
    plot.id = id_of(study, "error_versus_k");
    plot.x_label = "number of eigenvectors k";
    plot.y_label = "rms error [% of box diagonal]";
    plot.log_x = plot.log_y = true;
    report::Series predicted{"predicted from the coefficients (Parseval)", {}, {}, {}, {}, report::Series::Style::line};
    const double percent = 100 / study.diagonal;
    // The curve ends above rounding: a logarithm of 1e-16 would squeeze everything else.
    for (int k = 1; k <= modes_of(study) && study.rms[k] > 1e-9 * study.diagonal; ++k) {
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
        "Area-weighted rms error of " + study.mesh->name + " for every k up to " + std::to_string(modes_of(study)) +
        ", from one eigensolve. Marked: the smallest k whose error is below 10 %, 1 % and 0.1 % of the box diagonal, where reached.";
    plot.alt = "Error falls from " + readable(percent * study.rms[1]) + " % of the box diagonal at k = 1 to " +
               readable(percent * study.rms[modes_of(study)]) + " % at k = " + std::to_string(modes_of(study)) + ".";
    plot.series = {std::move(predicted), std::move(measured)};
    section.blocks.push_back(std::move(plot));
}

void add_eigenvalue_table(report::Section& section, const Study& study) {
    report::Table table;
    table.id = id_of(study, "eigenvalues");
    table.caption = "Eigenvalues of −Cφ = μMφ on " + study.mesh->name +
                    " with their residuals ‖−Cφ − μMφ‖/(μ‖Mφ‖), absolute for the zero modes; the "
                    "wavelength is 2π/√μ.";
    table.columns = {{"index", "", 6}, {"μ", "1/length²", 6}, {"residual", "", 2}, {"wavelength", "length", 3}};
    for (int i = 1; i <= modes_of(study); ++i) {
        const bool shown =
            i <= 10 || std::any_of(study.reconstructions.begin(), study.reconstructions.end(), [&](const auto& r) { return r.k == i; });
        const double mu = study.spectrum.eigenvalues[i - 1];
        if (shown) table.rows.push_back({double(i), mu, study.spectrum.residuals[i - 1], cell_of(2 * M_PI / std::sqrt(mu), mu > 0)});
    }
    section.blocks.push_back(std::move(table));
}

// ---- checks -----------------------------------------------------------------------------------------------------------

void add_checks(report::Section& section, const Study& study) {
    const std::string on = " on " + study.mesh->name;
    const Spectrum& spectrum = study.spectrum;
    const int needles = study.mesh->prepared->preflight.needle_faces + study.mesh->prepared->preflight.zero_area_faces;
    const std::string note = needles > 0 ? counted(needles, "needle or empty face") + ": rounding there limits what can be reached" : "";
    section.checks.push_back(check_at_most("largest eigenpair residual" + on, 1e-8, spectrum.residuals.maxCoeff(), 0, note));
    section.checks.push_back(check_at_most("‖ΦᵀMΦ − I‖" + on, 1e-9, orthonormality_error(spectrum, study.laplacian.M), 0, note));
    const int components = study.mesh->prepared->preflight.components;
    const auto zeros = (spectrum.eigenvalues.array() == 0).count();
    section.checks.push_back(check_near("zero eigenvalues = components" + on, std::min(components, modes_of(study)), double(zeros), 0));
    if (spectrum.inertia_count >= 0) {
        section.checks.push_back(
            check_near("eigenvalues below " + plain_text(spectrum.inertia_shift, 4) + " found = counted by inertia" + on,
                       spectrum.inertia_count, spectrum.found_below, 0));
    }
    double largest_gap = 0, largest_rise = 0;
    for (const Reconstruction& r : study.reconstructions) {
        largest_gap = std::max(largest_gap, std::abs(r.predicted_rms - r.difference.area_weighted_rms));
    }
    for (int k = 1; k <= modes_of(study); ++k) largest_rise = std::max(largest_rise, study.rms[k] - study.rms[k - 1]);
    section.checks.push_back(
        check_at_most("Parseval: |predicted − measured rms| / box diagonal" + on, 0, largest_gap / study.diagonal, 1e-9));
    section.checks.push_back(
        check_at_most("error never rises with k: largest rise / box diagonal" + on, 0, largest_rise / study.diagonal, 1e-12));
    if (modes_of(study) == study.mesh->prepared->preflight.vertices_in_use) {
        section.checks.push_back(check_at_most("k = n gives the mesh back: maximum error / box diagonal" + on, 0,
                                               study.reconstructions.back().difference.max / study.diagonal, 1e-9));
    }
}

// ---- what the numbers say ---------------------------------------------------------------------------------------------

/// How far from the centroid the worst-placed 5 % of the vertices are, over how far an average vertex is.
double remoteness_of_worst(const Study& study, const Reconstruction& r) {
    const Positions& X = study.mesh->mesh().X;
    const Vector& M = study.laplacian.M;
    const Vector3 centroid = (X.transpose() * M) / M.sum();
    const Vector from_centre = (X.rowwise() - centroid.transpose()).rowwise().norm();
    std::vector<int> order(static_cast<std::size_t>(X.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return r.distance[a] > r.distance[b]; });
    const std::size_t worst = std::max<std::size_t>(1, order.size() / 20);
    double sum = 0;
    for (std::size_t i = 0; i < worst; ++i) sum += from_centre[order[i]];
    return sum / static_cast<double>(worst) / (from_centre.dot(M) / M.sum());
}

report::Text answer_to_larger_k(const Study& study) {
    const Reconstruction& first = study.reconstructions.front();
    const Reconstruction& last = study.reconstructions.back();
    const double percent = 100 / study.diagonal;
    if (study.reconstructions.size() == 1) {
        return report::text("On ", study.mesh->name, " k = ", std::to_string(first.k), " leaves an rms error of ",
                            readable(percent * first.difference.rms),
                            "\u202f% of the box diagonal; one k alone cannot say whether more is better, but ",
                            ref(id_of(study, "error_versus_k")), " covers every smaller k.");
    }
    report::Text t = report::text(
        "Yes, on ", study.mesh->name, " every further eigenvector lowers the error (", ref(id_of(study, "error_versus_k")),
        "), as it must for an M-orthogonal projection: from ", readable(percent * first.difference.rms),
        "\u202f% of the box diagonal at k = ", std::to_string(first.k), " to ",
        last.difference.rms < 1e-9 * study.diagonal ? std::string("rounding") : readable(percent * last.difference.rms) + "\u202f%",
        " at k = ", std::to_string(last.k), ".");
    std::vector<std::string> steps;
    for (const double share : {0.1, 0.01, 0.001}) {
        const int k = smallest_k_below(study, share);
        if (k > 0) steps.push_back(std::to_string(k) + " for " + readable_percent(share, 1));
    }
    if (!steps.empty()) report::extend(t, " It takes k = ", listed(steps), " of the diagonal.");
    return t;
}

/// The error falls like k^−p between two k: the gain that doubling k still brings.
report::Text diminishing_returns(const Study& study) {
    const int end = modes_of(study);
    const auto slope = [&](int a, int b) { return std::log(study.rms[a] / study.rms[b]) / std::log(double(b) / a); };
    const int low = std::max(2, study.reconstructions.front().k), middle = std::max(low + 1, end / 8), high = std::max(middle + 1, end / 2);
    if (high > end || !(study.rms[high] > 1e-12 * study.diagonal)) return {};
    const double early = slope(low, middle), late = slope(middle, high);
    return report::text("Between k = ", std::to_string(low), " and ", std::to_string(middle), " the rms error falls like ", math("k"),
                        " to the power \u2212", readable(early, 2), ", between ", std::to_string(middle), " and ", std::to_string(high),
                        " like \u2212", readable(late, 2), ": doubling k there still divides the error by ", readable(std::pow(2, late), 2),
                        ". Each mode of wavelength ", math("2π/√μ"), " carries the detail of that size; the shortest wavelength in use is ",
                        readable(2 * M_PI / std::sqrt(study.spectrum.eigenvalues[end - 1])), ", ",
                        readable(2 * M_PI / std::sqrt(study.spectrum.eigenvalues[end - 1]) / study.mesh->prepared->preflight.mean_edge, 2),
                        " mean edges.");
}

report::Text where_the_error_sits(const Study& study) {
    const auto is_informative = [&](const Reconstruction& r) { return r.difference.rms > 1e-3 * study.diagonal; };
    const auto it = std::find_if(study.reconstructions.rbegin(), study.reconstructions.rend(), is_informative);
    if (it == study.reconstructions.rend()) return {};
    const double remoteness = remoteness_of_worst(study, *it);
    const MeshDifference& d = it->difference;
    report::Text t = report::text("At k = ", std::to_string(it->k), " the 5\u202f% of vertices that are farthest off lie at ",
                                  readable(remoteness, 2), " times the mean distance from the centroid");
    if (remoteness > 1.15) {
        report::extend(t,
                       ": the error sits in the extremities. Thin limbs are narrow in the eigenfunctions' metric too; the low modes are "
                       "nearly constant along them, and the bands that tell them apart are the ones left out");
    } else if (remoteness < 0.85) {
        report::extend(t, ": the error sits in the inner parts of the shape, not at its extremities");
    } else {
        report::extend(t, ": it is spread over the surface and not tied to the extremities");
    }
    report::extend(t, " (largest error ", readable(d.max / d.rms, 2), " times the rms).");
    if (std::isfinite(d.volume_ratio) && study.mesh->prepared->preflight.closed()) {
        report::extend(t, " The enclosed volume there is ", readable(100 * d.volume_ratio, 3), "\u202f% of the original.");
    }
    return t;
}

void add_discussion(report::Section& section, const std::vector<Study>& studies) {
    add_heading(section, "Discussion: does a larger k give better reconstructions?");
    for (const Study& study : studies) {
        for (report::Text t : {answer_to_larger_k(study), diminishing_returns(study), where_the_error_sits(study)}) {
            if (!t.empty()) section.blocks.push_back(report::Paragraph{std::move(t)});
        }
    }
}

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
    add_paragraph(
        section,
        "The largest k is solved once; every smaller k is a prefix of it. Completeness is proved, not assumed: by Sylvester's law the "
        "negative pivots of a factorisation of ",
        math("−C − σM"), " count the eigenvalues below σ.");
    section.code = {
        {"smallest_eigenpairs", "src/geometry/laplace_spectrum.cpp", "the k smallest eigenpairs, with residuals and inertia count"},
        {"reconstruct", "src/geometry/spectral_reconstruction.cpp", "X_k = Φ_k Φ_kᵀ M X"},
        {"reconstruction_rms", "src/geometry/spectral_reconstruction.cpp", "error for every k by Parseval"},
        {"answer_q4", "src/questions/q4_spectral_reconstruction.cpp", "this section"}};
}

void add_findings(report::Section& section, const Study& study) {
    const Reconstruction& last = study.reconstructions.back();
    const int for_one_percent = smallest_k_below(study, 0.01);
    if (for_one_percent > 0) {
        section.findings.push_back(
            {report::text("Q4: ", std::to_string(for_one_percent), " of ", std::to_string(study.mesh->prepared->preflight.vertices_in_use),
                          " eigenvectors rebuild ", study.mesh->name, " to 1\u202f% of its box diagonal."),
             80});
    } else {
        section.findings.push_back(
            {report::text("Q4: even k = ", std::to_string(last.k), " leaves ", study.mesh->name, " ",
                          readable(100 * last.difference.rms / study.diagonal), "\u202f% of its box diagonal away (rms)."),
             80});
    }
}

}   // namespace

Answer answer_q4(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("q4");
    const auto meshes = meshes_for(library, settings, {"armadillo"}, section);
    add_method(section);

    add_heading(section, "Results");
    std::vector<Study> studies;
    std::vector<std::string> done;
    for (const auto& mesh : meshes) {
        progress("eigenpairs of " + mesh->name);
        studies.push_back(study_of(*mesh, settings));
        const Study& study = studies.back();
        add_reconstruction_figure(answer, study);
        add_error_table(section, study);
        add_error_plot(section, study);
        add_eigenvalue_table(section, study);
        add_checks(section, study);
        add_findings(section, study);
        std::vector<std::string> counts;
        for (const Reconstruction& r : study.reconstructions) {
            const std::string file = id_of(study, "k" + std::to_string(r.k)) + ".ply";
            answer.meshes.push_back({file, std::make_shared<const TriangleMesh>(r.mesh)});
            section.output_meshes.push_back("meshes/" + file);
            counts.push_back(std::to_string(r.k));
        }
        done.push_back(mesh->name + " with k = " + listed(counts));
        section.parameters["k on " + mesh->name] = listed(counts);
        section.parameters["solver on " + mesh->name] = study.spectrum.dense ? "dense" : "shift-invert Lanczos";
    }
    add_discussion(section, studies);
    section.parameters["area form"] = "barycentric";
    section.extent =
        "Reconstructed " + listed(done) + "; error for every k; completeness of the spectrum proved by inertia; output meshes included";
    return answer;
}

}   // namespace meshfolio
