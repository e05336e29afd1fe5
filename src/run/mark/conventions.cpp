#include "run/mark/conventions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshfolio::run {

namespace {

constexpr double coarsest_rounding = 0.005;   // relative to the typical size; beyond, too few digits are left to judge by

double median_magnitude(const Vector& values) {
    std::vector<double> magnitudes;
    for (const double value : values)
        if (std::isfinite(value)) magnitudes.push_back(std::abs(value));
    if (magnitudes.empty()) return 0;
    const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
    std::nth_element(magnitudes.begin(), middle, magnitudes.end());
    return *middle;
}

}   // namespace

const std::vector<std::string>& convention_keys() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> keys{"doubled",      "halved",        "negated",        "magnitude",      "square_root",
                                      "descending",   "inverse",       "without_area",   "whole_ring",     "valence_sum",
                                      "scaled",       "unclamped",     "zero_left_out",  "unmapped",       "unweighted",
                                      "one_more",     "one_less",      "lambda_negated", "lambda_doubled", "lambda_halved",
                                      "other_scheme", "other_rebuild", "reversed_faces", "half_kept"};
        for (const OperatorEntry& entry : operator_list()) keys.push_back("operator_" + std::string(entry.name));
        for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed})
            keys.push_back("area_" + std::string(name_of(form)));
        return keys;
    }();
    return all;
}

const std::vector<ValueConvention>& value_conventions(MarkedThing what) {
    using List = std::vector<ValueConvention>;
    const auto times = [](double factor) { return [factor](const Vector& right) -> Vector { return factor * right; }; };
    const auto magnitude_times = [](double factor) {
        return [factor](const Vector& right) -> Vector { return factor * right.cwiseAbs(); };
    };
    const auto root = [](const Vector& right) -> Vector { return right.cwiseMax(0).cwiseSqrt(); };
    const auto inverse = [](const Vector& right) -> Vector { return right.cwiseInverse(); };
    const auto reverse_times = [](double factor) { return [factor](const Vector& right) -> Vector { return factor * right.reverse(); }; };
    const auto factors_and = [&](List more) {
        const List factors{{{}, times(1)},
                           {{"doubled"}, times(2)},
                           {{"halved"}, times(0.5)},
                           {{"negated"}, times(-1)},
                           {{"doubled", "negated"}, times(-2)},
                           {{"halved", "negated"}, times(-0.5)}};
        more.insert(more.begin(), factors.begin(), factors.end());
        return more;
    };
    static const List positions{{{}, times(1)}};
    static const List curvature = factors_and({{{"magnitude"}, magnitude_times(1)}, {{"doubled", "magnitude"}, magnitude_times(2)}});
    static const List spectrum =
        factors_and({{{"square_root"}, root}, {{"descending"}, reverse_times(1)}, {{"descending", "negated"}, reverse_times(-1)}});
    static const List number = factors_and({{{"inverse"}, inverse}});
    if (is_of_mesh(what)) return positions;
    return what == MarkedThing::eigenvalues ? spectrum : what == MarkedThing::number ? number : curvature;
}

Agreement agreement_of(const GivenValues& given, const RightValues& right, double tolerance) {
    const double typical = right.relative_to_scale ? right.scale : std::max(median_magnitude(right.values), right.scale);
    Agreement agreement;
    Eigen::Index good = 0;
    for (Eigen::Index i = 0; i < right.values.size(); ++i) {
        if (!std::isfinite(right.values[i])) continue;
        const double size = right.relative_to_scale ? typical : std::abs(right.values[i]) + typical;
        const double rounding = given.rounding.size() > 0 ? std::min(given.rounding[i], coarsest_rounding * typical) : 0;
        const double difference = std::max(std::abs(given.values[i] - right.values[i]) - rounding, 0.0) / size;
        const double off = std::isfinite(difference) ? difference : std::numeric_limits<double>::infinity();
        ++agreement.asked;
        good += off <= tolerance ? 1 : 0;
        if (agreement.where < 0 || off > agreement.worst) agreement.worst = off, agreement.where = i;
    }
    agreement.share = agreement.asked > 0 ? static_cast<double>(good) / static_cast<double>(agreement.asked) : 1;
    return agreement;
}

std::vector<ConventionKeys> recognised(const GivenValues& given, const RightValues& right, MarkedThing what, double tolerance,
                                       const std::function<const std::vector<Variant>&()>& variants) {
    std::vector<ConventionKeys> found;
    const Agreement with_right = agreement_of(given, right, tolerance);
    if (with_right.agrees(tolerance)) return found;
    const auto try_one = [&](const Vector& base, const std::string& key, const ValueConvention& convention) {
        ConventionKeys keys = convention.keys;
        if (!key.empty()) keys.insert(keys.begin(), key);
        if (keys.empty() || (!found.empty() && keys.size() > found.front().size())) return;
        RightValues wrong = right;
        wrong.values = convention.apply(base);
        if (right.relative_to_scale) wrong.scale = std::max(right.scale, wrong.values.cwiseAbs().maxCoeff());   // a run that blows up
        if (agreement_of({wrong.values}, right, tolerance).worst <= 2 * tolerance) return;                      // the right answer again
        const Agreement with_wrong = agreement_of(given, wrong, tolerance);
        if (!with_wrong.agrees(tolerance) || 2 * with_wrong.asked < with_right.asked) return;   // too little is defined
        if (!found.empty() && keys.size() < found.front().size()) found.clear();
        if (std::ranges::find(found, keys) == found.end()) found.push_back(std::move(keys));
    };
    for (const ValueConvention& convention : value_conventions(what)) try_one(right.values, "", convention);
    if (what == MarkedThing::number) return found;
    for (const Variant& variant : variants())
        for (const ValueConvention& convention : value_conventions(what)) try_one(variant.values, variant.key, convention);
    return found;
}

}   // namespace meshfolio::run
