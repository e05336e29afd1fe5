// Plots of the section "prediction".
#include <cmath>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/prediction/parts.h"

namespace meshfolio::prediction {

namespace {

using Style = report::Series::Style;

/// √ of the values in % of the box; a negative estimate leaves a gap, and so does what lies beyond `most`.
report::Series root_series(std::string name, const Vector& square, Style style, double most = INFINITY) {
    report::Series series;
    series.name = std::move(name);
    series.style = style;
    for (Eigen::Index t = 0; t < square.size(); ++t) {
        series.x.push_back(static_cast<double>(t));
        series.y.push_back(square[t] >= 0 && square[t] <= most ? 100 * std::sqrt(square[t]) : std::nan(""));
    }
    return series;
}

report::Series measured_series(std::string name, const MeasuredCurve& measured) {
    report::Series series = root_series(std::move(name), measured.square, Style::line);
    for (Eigen::Index t = 0; t < measured.square.size(); ++t) {
        series.y_low.push_back(100 * measured.low[t]);
        series.y_high.push_back(100 * measured.high[t]);
    }
    return series;
}

/// "measured t = 7"; an error that is smallest at its end has no minimum yet.
report::Marker marker_at(const Vector& square, int t, std::string label) {
    if (t > 0 && t + 1 == square.size()) label = "still falling, t = ";
    return {static_cast<double>(t), 100 * std::sqrt(std::max(square[t], 0.0)), label + std::to_string(t)};
}

report::Plot error_plot(std::string id) {
    report::Plot plot;
    plot.id = std::move(id);
    plot.x_label = "iteration";
    plot.y_label = "rms error [% of box diagonal]";
    plot.log_y = true;
    return plot;
}

}   // namespace

report::Plot clean_prediction_plot(const PredictionStudy& study) {
    report::Plot plot = error_plot(id_of("prediction", study.name(), "clean"));
    double farthest = 0;
    int levels = 0;
    for (const NoiseLevelStudy& level : study.levels) {
        const OperatorStudy& clean = level.of(FlowOperator::clean);
        const std::string sigma = "σ = " + readable_percent(level.sigma, 2);
        plot.series.push_back(measured_series(sigma + ", measured", clean.measured));
        plot.series.back().color = levels;
        plot.series.back().pattern = 0;   // a continuous line at every level
        plot.series.push_back(root_series(sigma + ", expected", clean.formula().square, Style::dashed));
        plot.series.back().color = levels++ + 3;   // another colour than that of the line it runs on
        const int expected = clean.formula().best(), measured = clean.measured.best();
        if (expected == measured) {
            plot.markers.push_back(marker_at(clean.measured.square, measured, "both t = "));
        } else {
            plot.markers.push_back(marker_at(clean.measured.square, measured, "measured t = "));
            plot.markers.push_back(marker_at(clean.formula().square, expected, "expected t = "));
        }
        farthest = std::max(farthest, deviation(clean.formula(), clean.measured));
    }
    plot.caption = "Denoising " + study.name() + " with the operator of the clean mesh: the root of the mean squared error of " +
                   counted(study.seeds, "noisy mesh", "noisy meshes") +
                   ", with the band of the tenth to the ninetieth percentile, and dashed on it what was expected "
                   "before any of them was drawn, at most " +
                   readable_percent(farthest, 2) + " away. The best iterations are marked.";
    plot.alt = plot.caption;
    return plot;
}

report::Plot operator_prediction_plot(const PredictionStudy& study, FlowOperator kind) {
    const NoiseLevelStudy& level = study.levels.back();
    const OperatorStudy& own = level.of(kind);
    report::Plot plot = error_plot(id_of("prediction", study.name(), name_of(kind)));
    plot.series.push_back(measured_series("measured", own.measured));
    for (const PredictedCurve& predicted : own.predictions) {
        // Far beyond what is measured a curve would only flatten the others.
        plot.series.push_back(root_series(predicted.name, predicted.square, Style::dashed, 9 * own.measured.square.maxCoeff()));
    }
    plot.markers.push_back(marker_at(own.measured.square, own.measured.best(), "measured t = "));
    plot.markers.push_back(marker_at(own.formula().square, own.formula().best(), "formula t = "));
    const std::string which = kind == FlowOperator::noisy ? "the noisy mesh's own operator" : "the operator rebuilt at every step";
    plot.caption = study.name() + " with " + which + " at σ = " + readable_percent(level.sigma, 2) + " of the box (" +
                   readable(level.sigma_edges, 2) + " mean edges): measured over " + counted(study.seeds, "seed") +
                   " with the band of the tenth to the ninetieth percentile, and each way to foresee it. The formula is " +
                   readable_percent(deviation(own.formula(), own.measured), 2) + " off at most, the closest, " + own.closest().name + ", " +
                   readable_percent(deviation(own.closest(), own.measured), 2) + ".";
    plot.alt = plot.caption;
    return plot;
}

}   // namespace meshfolio::prediction
