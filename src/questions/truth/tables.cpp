// Everything the ground-truth panel measured, as one table.
#include <charconv>
#include <cmath>

#include "questions/core/section_tools.h"
#include "questions/truth/parts.h"

namespace meshfolio::truth {

report::Table ground_truth_table(const GroundTruth& truth) {
    report::Table table;
    table.id = "truth_all";
    table.columns = {{"of"},
                     {"estimator"},
                     {"surface"},
                     {"mesh"},
                     {"vertices"},
                     {"mean edge", "length"},
                     {"L2 error"},
                     {"L∞ error"},
                     {"undefined", "vertices"},
                     {"order, L2"},
                     {"standard error, L2"},
                     {"order, L∞"},
                     {"standard error, L∞"}};
    for (const PanelRun& run : truth.runs) {
        for (const Quantity quantity : {Quantity::H, Quantity::K}) {
            for (std::size_t e = 0; e < estimators_of(quantity).size(); ++e) {
                const FittedOrder l2 = truth.order(run, quantity, e), linf = truth.order(run, quantity, e, &EstimateError::linf);
                for (std::size_t level = 0; level < run.levels.size(); ++level) {
                    const EstimateError& error = run.error(quantity, e, level);
                    table.rows.push_back({std::string(quantity == Quantity::H ? "H" : "K"), estimators_of(quantity)[e].name(), run.surface,
                                          std::string(name_of(run.kind)), double(run.levels[level].vertices), run.levels[level].mean_edge,
                                          error.l2, error.linf, double(error.undefined), cell_of(l2.order), cell_of(l2.standard_error),
                                          cell_of(linf.order), cell_of(linf.standard_error)});
                }
            }
        }
    }
    return table;
}

}   // namespace meshfolio::truth
