#include "run/one_mesh/smoothing_trace.h"

#include <algorithm>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/dirichlet_energy.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

namespace {

report::Cell number_cell(const std::string& text) {
    const auto number = parse_number(text);
    return number ? report::Cell(*number) : report::Cell();
}

}   // namespace

void measure(const PreparedMesh& input, const LaplaceBeltrami& laplacian, const TriangleMesh* clean, const Positions& X,
             SmoothingTrace& trace) {
    const TriangleMesh now = moved_to(input.mesh, X);
    if (clean != nullptr) trace.error.push_back(100 * vertex_rms(clean->X, X) / bounding_box(*clean).diagonal());
    trace.energy.push_back(dirichlet_energy(laplacian.C, X));
    trace.area.push_back(surface_area(now));
    if (input.preflight.encloses_volume()) trace.volume.push_back(signed_volume(now));
}

std::vector<double> times_of(const Smoothed& run) {
    std::vector<double> times{0};
    for (std::size_t t = 0; t < static_cast<std::size_t>(run.iterations); ++t)
        times.push_back(times[t] + (t < run.steps.size() ? run.steps[t].lambda : run.time / run.iterations));
    return times;
}

report::Table table_of(const std::vector<SmoothingTrace>& runs) {
    const bool with_error = !runs.front().error.empty(), with_lambda = runs.size() > 1;
    report::Table table;
    for (const char* name : {"lambda", "iteration", "time", "error", "energy", "area", "volume"})
        if ((with_lambda || name != std::string("lambda")) && (with_error || name != std::string("error"))) table.columns.push_back({name});
    for (const SmoothingTrace& run : runs) {
        for (std::size_t t = 0; t < run.energy.size(); ++t) {
            std::vector<report::Cell>& row = table.rows.emplace_back();
            if (with_lambda) row.push_back(number_cell(run.lambda));
            row.insert(row.end(), {static_cast<double>(t), run.time[t]});
            if (with_error) row.emplace_back(run.error[t]);
            row.insert(row.end(), {run.energy[t], run.area[t], run.volume.empty() ? report::Cell() : report::Cell(run.volume[t])});
        }
    }
    return table;
}

report::Table summary_of(const std::vector<SmoothingTrace>& runs) {
    report::Table table;
    for (const char* name : {"lambda", "share", "iterations", "end", "energy", "area", "volume", "moved"}) table.columns.push_back({name});
    if (!runs.front().error.empty())
        for (const char* name : {"error_before", "error_least", "least_at", "error_after"}) table.columns.push_back({name});
    const auto left = [](const std::vector<double>& values) { return values.empty() ? report::Cell() : values.back() / values.front(); };
    for (const SmoothingTrace& run : runs) {
        std::vector<report::Cell>& row = table.rows.emplace_back();
        row = {number_cell(run.lambda), run.share, static_cast<double>(run.energy.size() - 1), run.end};
        row.insert(row.end(), {left(run.energy), left(run.area), left(run.volume), run.moved});
        if (run.error.empty()) continue;
        const auto least = std::ranges::min_element(run.error);
        row.insert(row.end(), {run.error.front(), *least, static_cast<double>(least - run.error.begin()), run.error.back()});
    }
    return table;
}

report::Plot plot_of(const std::vector<SmoothingTrace>& runs, const std::string& measure) {
    report::Plot plot{.id = "smoothing", .x_label = "iteration"};
    plot.y_label = measure == "error" ? "rms error [% of the box diagonal of the clean mesh]" : measure + " [% of the input's]";
    double least = INFINITY, largest = 0;
    for (const SmoothingTrace& run : runs) {
        const std::vector<double>& values = measure == "error"    ? run.error
                                            : measure == "energy" ? run.energy
                                            : measure == "area"   ? run.area
                                                                  : run.volume;
        if (values.empty())
            throw UsageError("there is no " + measure + " to plot",
                             measure == "error" ? "give --trace CLEAN" : "the mesh encloses no volume; take energy or area");
        const double unit = measure == "error" ? 1 : 100 / values.front();
        report::Series series{.name = runs.size() > 1 ? "λ = " + run.lambda : ""};
        for (std::size_t t = 0; t < values.size(); ++t) {
            series.x.push_back(static_cast<double>(t));
            series.y.push_back(unit * values[t]);
            least = std::min(least, series.y.back());
            largest = std::max(largest, series.y.back());
        }
        plot.alt += (plot.alt.empty() ? "" : "; ") + (series.name.empty() ? measure : series.name) + ": " +
                    plain_text(series.y.front(), 3) + " at first, " + plain_text(series.y.back(), 3) + " after " +
                    std::to_string(values.size() - 1) + " iterations";
        plot.series.push_back(std::move(series));
    }
    plot.log_y = least > 0 && largest > 100 * least;
    return plot;
}

}   // namespace meshfolio::run
