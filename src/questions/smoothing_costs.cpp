#include "questions/smoothing_costs.h"

#include <algorithm>
#include <cmath>

namespace meshfolio {

namespace {

/// Where the decreasing function f takes a value, for arguments > 0: bracketed from `guess`, then halved in the logarithm.
template <class Function>
double argument_of(Function f, double value, double guess) {
    double low = guess, high = guess;
    for (int i = 0; i < 200 && f(low) < value; ++i) low /= 4;
    for (int i = 0; i < 200 && f(high) > value; ++i) high *= 4;
    double u = std::log(low), v = std::log(high);
    for (int i = 0; i < 100 && v - u > 1e-13 * std::max(std::abs(u), 1.0); ++i) {
        const double middle = 0.5 * (u + v);
        (f(std::exp(middle)) > value ? u : v) = middle;
    }
    return std::exp(0.5 * (u + v));
}

/// The smallest count in [1, most] for which a condition holds that goes on holding; most + 1: none.
template <class Condition>
int first_count(int most, Condition holds) {
    int high = 1;
    while (high < most && !holds(high)) high = std::min(2 * high, most);
    if (!holds(high)) return most + 1;
    int low = high / 2;   // does not hold there
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (holds(middle) ? high : low) = middle;
    }
    return high;
}

auto explicit_filter(double lambda, int steps) {
    return [=](double mu) { return std::pow(1 - lambda * mu, steps); };
}
auto implicit_filter(double lambda, int steps) {
    return [=](double mu) { return std::pow(1 + lambda * mu, -steps); };
}
auto exact_filter(double time) {
    return [=](double mu) { return std::exp(-time * mu); };
}

FactorOperations operations_of(const SmoothingSubject& subject, const OperatorWithMass& whole) {
    ImplicitSolver solver;
    solver.prepare(whole, subject.critical, subject.mesh().X);
    std::vector<int> row(static_cast<std::size_t>(whole.all_vertices), -1), order;
    for (std::size_t i = 0; i < whole.vertex.size(); ++i) row[static_cast<std::size_t>(whole.vertex[i])] = static_cast<int>(i);
    for (const int v : solver.vertex()) order.push_back(row[static_cast<std::size_t>(v)]);
    return factor_operations(whole.A, order);
}

}   // namespace

CostModel::CostModel(const SmoothingSubject& subject, SpectralMeasure measure)
    : measure_(std::move(measure)), critical_(subject.critical), energy_(measure_.energy([](double) { return 1.0; })) {
    const OperatorWithMass whole = operator_with_mass(subject.laplacian);
    factor_ = operations_of(subject, whole);
    rows_ = whole.size();
    nonzeros_ = double(whole.A.nonZeros());
}

template <class Filter>
double CostModel::error_of(Filter filter, double energy) const {
    const auto exact = exact_filter(exact_time(energy));
    const double motion = measure_.rms([&](double mu) { return 1 - exact(mu); });
    return measure_.rms([&](double mu) { return filter(mu) - exact(mu); }) / motion;
}

double CostModel::exact_time(double energy) const {
    return argument_of([&](double time) { return share(exact_filter(time)); }, energy, critical_);
}

SmoothingWay CostModel::explicit_way(double energy) const {
    SmoothingWay way{SmoothingScheme::explicit_euler, 0.95 * critical_};
    const int steps = first_count(most_steps, [&](int t) { return share(explicit_filter(way.lambda, t)) <= energy; });
    if (steps > most_steps) return way;
    way.steps = steps;
    way.energy = share(explicit_filter(way.lambda, steps));
    way.error = error_of(explicit_filter(way.lambda, steps), way.energy);
    way.operations = steps * explicit_step_operations();
    return way;
}

SmoothingWay CostModel::implicit_way(double energy, int steps) const {
    SmoothingWay way{SmoothingScheme::implicit_euler};
    way.lambda = argument_of([&](double lambda) { return share(implicit_filter(lambda, steps)); }, energy, critical_ / steps);
    way.steps = steps;
    way.energy = share(implicit_filter(way.lambda, steps));
    way.error = error_of(implicit_filter(way.lambda, steps), way.energy);
    way.operations = factor_.factorisation + steps * implicit_step_operations();
    return way;
}

SmoothingWay CostModel::as_true_as(const SmoothingWay& way) const {
    constexpr int most = 10000;
    const int steps = first_count(most, [&](int s) { return implicit_way(way.energy, s).error <= way.error; });
    return steps > most ? SmoothingWay{SmoothingScheme::implicit_euler} : implicit_way(way.energy, steps);
}

SmoothingTarget smoothing_target(const CostModel& model, double energy) {
    SmoothingTarget target;
    target.energy = energy;
    target.explicit_way = model.explicit_way(energy);
    for (const int steps : implicit_steps) target.implicit_ways.push_back(model.implicit_way(energy, steps));
    target.matched.scheme = SmoothingScheme::implicit_euler;
    if (target.explicit_way.steps > 0) target.matched = model.as_true_as(target.explicit_way);
    return target;
}

bool is_cheaper(const SmoothingWay& way, const SmoothingTarget& target) {
    return way.steps > 0 && (target.explicit_way.steps == 0 || way.operations < target.explicit_way.operations);
}

}   // namespace meshfolio
