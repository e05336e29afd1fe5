// Tables and plots of the denoising laboratory.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/methods/parts.h"

namespace meshfolio::methods {

namespace {

using report::Column;

std::vector<Column> noise_columns() { return {{"noise", ""}, {"σ", "mean edges", 2}, {"σ", "% of box", 2}}; }

std::vector<report::Cell> noise_cells(const DenoisingTrials& mesh, const NoiseTrial& trial) {
    return {trial.s1_level ? "20 % of the box, axis by axis" : std::string(noise_entry(trial.kind).title), trial.edges,
            100 * trial.sigma / mesh.subject.diagonal};
}

}   // namespace

std::string method_title(int method) { return std::string(denoising_list()[static_cast<std::size_t>(method)].title); }

report::Table subject_table(const DenoisingLaboratory& laboratory) {
    report::Table table;
    table.id = "methods_meshes";
    table.caption =
        "The meshes, and the class that their faces put them in. Sharp-edged: a hundredth of the vertices or more lie on edges "
        "sharper than 40°, and off these faces meet at less than 10° (median); rough or coarse: at more; smooth: there are "
        "fewer such vertices; flat: no two faces meet at 1°.";
    table.columns = {{"mesh", ""},
                     {"vertices", "", 7},
                     {"cut from", "vertices", 7},
                     {"mean edge", "% of box", 3},
                     {"on edges sharper than 40°", "% of vertices", 3},
                     {"median angle at other edges", "°", 3},
                     {"class", ""}};
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        const DenoisingSubject& s = mesh.subject;
        table.rows.push_back({s.name, double(s.mesh.vertex_count()), cell_of(s.whole_vertices, s.is_patch()),
                              100 * s.mean_edge / s.diagonal, 100 * s.character.feature_share, s.character.typical_angle, s.class_title()});
    }
    return table;
}

report::Table gain_table(const DenoisingTrials& mesh, Measure measure) {
    struct Wording {
        const char *id, *caption, *noisy, *unit;
        Gain gain;
    };
    static constexpr Wording wordings[] = {
        {"gains", "the distance of the vertices to the clean triangles around their places (rms)", "error, noisy", "% of box",
         &SearchResult::gain},
        {"gains_rms", "the distance of the vertices to their clean places (rms), which counts what moves them within the surface too",
         "error, noisy", "% of box", &SearchResult::rms_gain},
        {"gains_angle", "the mean angle between the face normals and the clean ones", "angle, noisy", "°", &SearchResult::angle_gain}};
    const Wording& wording = wordings[static_cast<std::size_t>(measure)];
    report::Table table;
    table.id = id_of("methods", mesh.name(), wording.id);
    table.caption = "Gains on " + mesh.name() + ": " + wording.caption +
                    ", of the noisy mesh over the least that each method reached with any of its parameters in any step. 1: nothing it did "
                    "was better than nothing. Darker is larger. –: not defined, or the noise has nothing of it.";
    table.columns = noise_columns();
    table.columns.push_back({wording.noisy, wording.unit, 3});
    for (const DenoisingEntry& entry : denoising_list()) {
        table.columns.push_back({std::string(entry.title), "×", 3});
        table.columns.back().heat = Column::Heat{1, 8};
    }
    const double percent = 100 / mesh.subject.diagonal;
    for (const NoiseTrial& trial : mesh.trials) {
        const SearchState& noisy = trial.results.front().noisy;
        auto row = noise_cells(mesh, trial);
        row.emplace_back(measure == Measure::shape    ? percent * noisy.shape
                         : measure == Measure::places ? percent * noisy.rms
                                                      : degrees * noisy.angle);
        for (const SearchResult& result : trial.results) row.push_back(cell_of((result.*wording.gain)()));
        table.rows.push_back(std::move(row));
    }
    return table;
}

namespace {

/// "λ = 0.16 h̄², step 5"; empty for the noisy mesh.
report::Cell where(const SearchResult& r, const SearchState& state) {
    if (!r.defined || state.step == 0) return {};
    return parameter_words(r.method, state.value) + ", step " + std::to_string(state.step);
}

std::vector<report::Cell> result_cells(const DenoisingSubject& subject, const SearchResult& r) {
    const MeshDifference& d = r.difference;
    const double percent = 100 / subject.diagonal;
    return {std::string(denoising_entry(r.method).title),
            where(r, r.by_shape),
            cell_of(percent * r.by_shape.shape, r.defined),
            cell_of(r.gain()),
            cell_of(percent * d.rms, r.defined),
            cell_of(percent * d.hausdorff, r.defined),
            cell_of(degrees * d.mean_normal_angle, r.defined),
            cell_of(degrees * degrees * d.mean_squared_normal_angle, r.defined),
            cell_of(d.volume_ratio, r.defined && subject.encloses_volume),
            cell_of(percent * r.by_rms.rms, r.defined),
            where(r, r.by_rms),
            cell_of(degrees * r.by_angle.angle, r.defined),
            where(r, r.by_angle)};
}

}   // namespace

report::Table result_table(const DenoisingTrials& mesh) {
    report::Table table;
    table.id = id_of("methods", mesh.name(), "results");
    table.caption = "Each method on " + mesh.name() +
                    " at its least error of shape, in all measures; then the least rms error and the least normal angle that it reached "
                    "anywhere. –: the noisy mesh is best left as it is, or the measure is not defined. λ_crit and h̄ (mean edge) are those "
                    "of the noisy mesh. "
                    "Hausdorff: two-sided, vertices to surface. Volume: over that of the clean mesh.";
    table.columns = noise_columns();
    for (Column& column : std::vector<Column>{{"method", ""},
                                              {"best with", ""},
                                              {"error of shape", "% of box", 3},
                                              {"gain", "×", 3},
                                              {"rms error", "% of box", 3},
                                              {"Hausdorff", "% of box", 3},
                                              {"normal angle", "°", 3},
                                              {"squared normal angle", "°²", 3},
                                              {"volume", "×", 4},
                                              {"least rms error", "% of box", 3},
                                              {"with", "", 3},
                                              {"least normal angle", "°", 3},
                                              {"with", "", 3}}) {
        table.columns.push_back(std::move(column));
    }
    for (const NoiseTrial& trial : mesh.trials) {
        for (const SearchResult& r : trial.results) {
            auto row = noise_cells(mesh, trial);
            for (report::Cell& cell : result_cells(mesh.subject, r)) row.push_back(std::move(cell));
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

report::Table winner_table(const std::vector<ClassResult>& classes) {
    report::Table table;
    table.id = "methods_winners";
    table.caption =
        "The best method for each class of mesh: largest geometric mean of the gains over all noisy meshes made from those named, in "
        "shape and in normals. Methods that are not defined on all of them do not compete.";
    table.columns = {{"class", ""},    {"meshes", ""},          {"noisy meshes", "", 4},    {"best in shape", ""},
                     {"gain", "×", 3}, {"best in normals", ""}, {"gain in normals", "×", 3}};
    for (const DenoisingEntry& entry : denoising_list()) table.columns.push_back({std::string(entry.title) + ", shape", "×", 3});
    for (const ClassResult& c : classes) {
        const auto title = [](int method) { return method >= 0 ? report::Cell{method_title(method)} : report::Cell{}; };
        const auto value = [](const std::vector<double>& gains, int method) {
            return method >= 0 ? cell_of(gains[static_cast<std::size_t>(method)]) : report::Cell{};
        };
        std::vector<report::Cell> row{c.title,
                                      listed(c.meshes),
                                      double(c.trials),
                                      title(c.best()),
                                      value(c.gain, c.best()),
                                      title(c.best_by_angle()),
                                      value(c.angle_gain, c.best_by_angle())};
        for (const double gain : c.gain) row.push_back(cell_of(gain));
        table.rows.push_back(std::move(row));
    }
    return table;
}

report::Table limit_table(const DenoisingLaboratory& laboratory) {
    report::Table table;
    table.id = "methods_limits";
    std::string levels;
    for (const NoiseTrial* trial : laboratory.meshes.front().of_kind(NoiseKind::gaussian))
        levels += (levels.empty() ? "" : ", ") + readable(trial->edges, 2);
    table.caption = "When each method works, when it fails, against Gaussian noise: of the levels tried (σ = " + levels +
                    " mean edges on " + laboratory.meshes.front().name() +
                    ") the smallest and the largest at which it helps (gain ≥ 1.2), and the largest at which it works (gain ≥ 2), by shape "
                    "and by the places of the vertices. ≤ and ≥: the first or last level tried, so that the limit may lie beyond. –: at "
                    "none of them, or not defined.";
    table.columns = {{"mesh", ""}, {"class", ""}, {"method", ""}};
    for (const char* measure : {"shape", "places"}) {
        for (const char* limit : {": helps from", ": helps up to", ": works up to"})
            table.columns.push_back({std::string(measure) + limit, "mean edges"});
    }
    const auto cell = [](double edges, bool at_end, const char* sign) {
        return std::isfinite(edges) ? report::Cell{(at_end ? sign : "") + readable(edges, 2)} : report::Cell{};
    };
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        for (std::size_t i = 0; i < denoising_list().size(); ++i) {
            std::vector<report::Cell> row{mesh.name(), mesh.subject.class_title(), method_title(int(i))};
            for (const Gain gain : {&SearchResult::gain, &SearchResult::rms_gain}) {
                const NoiseLimits limits = noise_limits(mesh, i, gain);
                row.push_back(cell(limits.helps_from, limits.helps_at_first, "≤ "));
                row.push_back(cell(limits.helps_to, limits.helps_at_last, "≥ "));
                row.push_back(cell(limits.halves_to, limits.halves_at_last, "≥ "));
            }
            table.rows.push_back(std::move(row));
        }
    }
    return table;
}

report::Plot gain_plot(const DenoisingTrials& mesh) {
    report::Plot plot;
    plot.id = id_of("methods", mesh.name(), "gain_versus_noise");
    plot.x_label = "σ of Gaussian noise [mean edges]";
    plot.y_label = "gain: error of shape, noisy / best";
    plot.log_x = plot.log_y = true;
    const auto levels = mesh.of_kind(NoiseKind::gaussian);
    std::string ends;
    for (std::size_t i = 0; i < denoising_list().size(); ++i) {
        report::Series series{method_title(int(i)), {}, {}, {}, {}, report::Series::Style::line_and_points};
        if (filters_normals(denoising_list()[i].method)) series.style = report::Series::Style::dashed;
        series.color = series.pattern = int(i);   // as on the other meshes, also where a method before it has no gain
        for (const NoiseTrial* trial : levels) {
            series.x.push_back(trial->edges);
            series.y.push_back(trial->results[i].gain());
        }
        if (!std::isfinite(series.y.front())) continue;
        ends += (ends.empty() ? " " : "; ") + series.name + " " + readable(series.y.front()) + " to " + readable(series.y.back());
        plot.series.push_back(std::move(series));
    }
    plot.caption = "What every method can gain on " + mesh.name() + " (" + mesh.subject.class_title() +
                   "), each at its best parameter and step, as Gaussian noise rises. At 1 the best is to leave the mesh alone.";
    plot.alt = plot.caption + " Gains at the lowest and the highest level:" + ends + ".";
    return plot;
}

}   // namespace meshfolio::methods
