#include "questions/bench/estimators.h"

#include <algorithm>
#include <stdexcept>

// The estimators, by their names in the files of estimators/, in the order of all tables. A new one is a line here.
// clang-format off
#define MESHFOLIO_ESTIMATORS(estimator) \
    estimator(H_uniform) \
    estimator(H_uniform_along_normal) \
    estimator(H_uniform_along_own_normal) \
    estimator(H_barycentric) \
    estimator(H_barycentric_along_normal) \
    estimator(H_voronoi) \
    estimator(H_voronoi_along_normal) \
    estimator(H_mixed) \
    estimator(H_mixed_along_normal) \
    estimator(H_clamped) \
    estimator(H_jet) \
    estimator(H_corrected_area) \
    estimator(H_corrected_angle) \
    estimator(H_corrected_max) \
    estimator(H_corrected_exact) \
    estimator(K_barycentric) \
    estimator(K_voronoi) \
    estimator(K_mixed) \
    estimator(K_jet) \
    estimator(K_corrected_area) \
    estimator(K_corrected_angle) \
    estimator(K_corrected_max) \
    estimator(K_corrected_exact)
// clang-format on

namespace meshfolio {

#define MESHFOLIO_DECLARED(name) extern const Estimator name;
namespace estimates {
MESHFOLIO_ESTIMATORS(MESHFOLIO_DECLARED)
}

std::span<const Estimator* const> estimators() {
#define MESHFOLIO_LISTED(name) &estimates::name,
    static constexpr const Estimator* all[] = {MESHFOLIO_ESTIMATORS(MESHFOLIO_LISTED)};
    return all;
}

std::vector<const Estimator*> panel_estimators(Quantity quantity) {
    std::vector<const Estimator*> chosen;
    std::ranges::copy_if(estimators(), std::back_inserter(chosen),
                         [&](const Estimator* e) { return e->in_panel && e->quantity == quantity; });
    return chosen;
}

const Estimator& estimator(std::string_view key) {
    const auto found = std::ranges::find(estimators(), key, &Estimator::key);
    if (found == estimators().end()) throw std::logic_error("no estimator " + std::string(key));
    return **found;
}

std::string area_name(AreaForm form) { return form == AreaForm::voronoi ? "Voronoi" : std::string(name_of(form)); }

}   // namespace meshfolio
