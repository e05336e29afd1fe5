#include "questions/modes/mode_study.h"

namespace meshfolio::modes {

namespace {

/// Solves f(x) = value for x > 0 and decreasing f > 0: brackets from `guess`, then false position (Illinois) in the logarithms.
template <class Function> double argument_of(Function f, double value, double guess) {
    const auto above = [&](double u) { return std::log(f(std::exp(u)) / value); };
    double u = std::log(guess), v = u, fu = above(u), fv = fu;
    for (int i = 0; i < 100 && fu < 0; ++i) fu = above(u -= 2);
    for (int i = 0; i < 100 && fv > 0; ++i) fv = above(v += 2);
    double w = u;
    int kept = 0;   // which end stayed last
    for (int i = 0; i < 100 && v > u; ++i) {
        w = (u * fv - v * fu) / (fv - fu);
        const double fw = above(w);
        if (!(std::abs(fw) > 1e-13)) break;
        if (fw > 0) {
            if (kept > 0) fv *= 0.5;
            kept = 1;
            u = w;
            fu = fw;
        } else {
            if (kept < 0) fu *= 0.5;
            kept = -1;
            v = w;
            fv = fw;
        }
    }
    return std::exp(w);
}

auto filter_of(SmoothingScheme scheme, double lambda, int steps) {
    return [=](double mu) { return damping_law(scheme, lambda, steps, mu); };
}
auto exact_filter(double time) {
    return [=](double mu) { return std::exp(-time * mu); };
}

SmoothingWay way_of(const CostModel& model, SmoothingScheme scheme, double lambda, int steps) {
    SmoothingWay way{scheme, lambda, steps};
    const auto filter = filter_of(scheme, lambda, steps);
    way.energy = model.share(filter);
    const auto exact = exact_filter(model.exact_time(way.energy));
    const double motion = model.measure.rms([&](double mu) { return 1 - exact(mu); });
    way.error = model.measure.rms([&](double mu) { return filter(mu) - exact(mu); }) / motion;
    way.operations =
        scheme == SmoothingScheme::explicit_euler ? steps * model.explicit_step : model.factor.factorisation + steps * model.implicit_step;
    return way;
}

SmoothingWay implicit_way_of(const CostModel& model, double energy, const SmoothingWay& explicit_way, std::size_t which) {
    if (which < std::size(implicit_steps)) return model.implicit_way(energy, implicit_steps[which]);
    if (which == accurate_way) return model.implicit_way_within(energy, implicit_accuracy);
    if (explicit_way.steps == 0) return {SmoothingScheme::implicit_euler};
    return model.implicit_way_within(explicit_way.energy, explicit_way.error);
}

}   // namespace

CostModel::CostModel(const SmoothingSubject& subject, SpectralMeasure of_input)
    : measure(std::move(of_input)),
      factor(implicit_operations_of(subject)),
      critical(subject.critical),
      initial_energy(measure.energy([](double) { return 1.0; })) {
    const OperatorWithMass whole = operator_with_mass(subject.laplacian);
    explicit_step = 3 * double(whole.A.nonZeros());
    implicit_step = 3 * (factor.solve + whole.size());
}

double CostModel::exact_time(double energy) const {
    return argument_of([&](double time) { return share(exact_filter(time)); }, energy, critical);
}

double CostModel::least_energy(double least) const {
    double relative = 1.5e9;
    while ((relative /= 1.5) > 1) {
        const auto filter = filter_of(SmoothingScheme::implicit_euler, relative * critical, 1);
        if (share(filter) < least) continue;
        if (measure.uncertainty([&](double mu) { return mu * filter(mu) * filter(mu); }) <= 1e-7) return share(filter);
    }
    return share(filter_of(SmoothingScheme::implicit_euler, critical, 1));
}

SmoothingWay CostModel::explicit_way(double energy) const {
    const double lambda = 0.95 * critical;
    const auto is_enough = [&](int steps) { return share(filter_of(SmoothingScheme::explicit_euler, lambda, steps)) <= energy; };
    int enough = 1;
    while (enough < most_steps && !is_enough(enough)) enough = std::min(2 * enough, most_steps);
    if (!is_enough(enough)) return {SmoothingScheme::explicit_euler, lambda};
    for (int too_few = enough / 2; enough - too_few > 1;) {
        const int middle = too_few + (enough - too_few) / 2;
        (is_enough(middle) ? enough : too_few) = middle;
    }
    return way_of(*this, SmoothingScheme::explicit_euler, lambda, enough);
}

SmoothingWay CostModel::implicit_way(double energy, int steps) const {
    const auto energy_left = [&](double lambda) { return share(filter_of(SmoothingScheme::implicit_euler, lambda, steps)); };
    return way_of(*this, SmoothingScheme::implicit_euler, argument_of(energy_left, energy, critical / steps), steps);
}

SmoothingWay CostModel::implicit_way_within(double energy, double error) const {
    constexpr int most = 10000;
    SmoothingWay found{SmoothingScheme::implicit_euler};
    int low = 0, high = most + 1, steps = 1;   // too few, and enough
    for (int tries = 1; high - low > 1; ++tries) {
        const SmoothingWay way = implicit_way(energy, steps);
        (way.error <= error ? high : low) = steps;
        if (way.error <= error) found = way;
        // Errors fall about as 1/steps, so each one predicts the number of steps; after eight tries the interval is halved.
        const double enough = std::ceil(steps * way.error / error);
        steps = tries >= 8 ? low + std::max((high - low) / 2, 1) : enough < high ? std::max(static_cast<int>(enough), low + 1) : high - 1;
    }
    return found;
}

Names implicit_way_names() {
    Names names;
    for (const int steps : implicit_steps) names.push_back(words.line("way.steps", "steps"_a = steps));
    names.push_back(words.line("way.accurate", "error"_a = readable_percent(implicit_accuracy, 1)));
    names.push_back(words.line("way.matched"));
    return names;
}

SmoothingTarget smoothing_target(const CostModel& model, double energy) {
    SmoothingTarget target{energy, model.explicit_way(energy), {}};
    for (std::size_t which = 0; which < implicit_way_count; ++which)
        target.implicit_ways.push_back(implicit_way_of(model, energy, target.explicit_way, which));
    return target;
}

bool is_cheaper(const SmoothingWay& way, const SmoothingWay& explicit_way) {
    return way.steps > 0 && (explicit_way.steps == 0 || way.operations < explicit_way.operations);
}

std::optional<std::size_t> cheaper_from(const std::vector<SmoothingTarget>& targets, std::size_t which) {
    std::optional<std::size_t> from;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const bool cheaper = is_cheaper(targets[i].implicit_ways[which], targets[i].explicit_way);
        if (!cheaper) from.reset();
        if (cheaper && !from) from = i;
    }
    return from;
}

std::optional<SmoothingTarget> crossing_of(const CostModel& model, const std::vector<SmoothingTarget>& targets, std::size_t which) {
    const auto from = cheaper_from(targets, which);
    if (!from || *from == 0) return from ? std::optional(targets.front()) : std::nullopt;
    double cheaper = targets[*from].energy, dearer = targets[*from - 1].energy;
    for (int i = 0; i < 8; ++i) {
        const double middle = std::sqrt(cheaper * dearer);
        const SmoothingWay explicit_way = model.explicit_way(middle);
        (is_cheaper(implicit_way_of(model, middle, explicit_way, which), explicit_way) ? cheaper : dearer) = middle;
    }
    return smoothing_target(model, cheaper);
}

}   // namespace meshfolio::modes
