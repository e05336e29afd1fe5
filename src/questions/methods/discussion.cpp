// What the numbers of the denoising laboratory say.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/number_text.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/methods/parts.h"

namespace meshfolio::methods {

namespace {

using report::ref;

template <class Visit>
void for_each_trial(const DenoisingLaboratory& laboratory, Visit visit) {
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        for (const NoiseTrial& trial : mesh.trials) visit(mesh, trial);
    }
}

double of(const std::vector<double>& gains, int method) { return gains[static_cast<std::size_t>(method)]; }

report::Text winner_words(const ClassResult& c) {
    const int best = c.best(), by_angle = c.best_by_angle();
    report::Text t = report::text("On ", listed(c.meshes), " (", c.title, ") ");
    if (best < 0) return report::text(std::move(t), "the noise changed no shape.");
    report::extend(t, "“", method_title(best), "” restores the shape best, ", readable(of(c.gain, best)), "-fold over ",
                   counted(c.trials, "noisy mesh", "noisy meshes"), " (geometric mean)");
    if (by_angle >= 0 && ties(of(c.angle_gain, best), of(c.angle_gain, by_angle))) {
        report::extend(t, ", and the normals too, ", readable(of(c.angle_gain, by_angle)), "-fold.");
    } else if (by_angle >= 0) {
        report::extend(t, "; for the normals it is “", method_title(by_angle), "”, ", readable(of(c.angle_gain, by_angle)), "-fold");
        if (std::isfinite(of(c.angle_gain, best)))
            report::extend(t, ", where “", method_title(best), "” gains ", readable(of(c.angle_gain, best)));
        report::extend(t, ".");
    } else {
        report::extend(t, ".");
    }
    return t;
}

/// How often filters of normals win, on meshes with sharp edges and on the others; and whether both measures agree.
report::Text winners_counted(const DenoisingLaboratory& laboratory) {
    int trials[2] = {0, 0}, by_shape[2] = {0, 0}, by_angle[2] = {0, 0}, differ = 0, compared = 0;
    for_each_trial(laboratory, [&](const DenoisingTrials& mesh, const NoiseTrial& trial) {
        const int sharp = mesh.subject.character.kind() == MeshClass::sharp_edged ? 1 : 0;
        const int shape = winner(trial, &SearchResult::gain), angle = winner(trial, &SearchResult::angle_gain);
        const auto filters = [](int method) {
            return method >= 0 && filters_normals(denoising_list()[static_cast<std::size_t>(method)].method) ? 1 : 0;
        };
        ++trials[sharp];
        by_shape[sharp] += filters(shape);
        by_angle[sharp] += filters(angle);
        if (shape < 0 || angle < 0) return;
        ++compared;
        const auto angle_gain = [&](int method) { return trial.results[static_cast<std::size_t>(method)].angle_gain(); };
        differ += ties(angle_gain(shape), angle_gain(angle)) ? 0 : 1;
    });
    report::Text t;
    const auto say = [&](int sharp, const char* where) {
        report::extend(t, "Filters of normals are best in shape on ", std::to_string(by_shape[sharp]), ", in normals on ",
                       std::to_string(by_angle[sharp]), " of ", counted(trials[sharp], "noisy mesh", "noisy meshes"), where);
    };
    if (trials[1] > 0) say(1, " with sharp edges. ");
    if (trials[0] > 0) say(0, " without them. ");
    if (compared > 0) {
        report::extend(t, "The method that is best in shape is not the best in normals too on ", std::to_string(differ), " of ",
                       counted(compared, "noisy mesh", "noisy meshes"), " on which both can be told (tables of gains, from ",
                       ref(id_of("methods", laboratory.meshes.front().name(), "gains")), " on): ",
                       3 * differ > compared ? "which one is best depends on what is asked for."
                       : differ > 0          ? "mostly they agree."
                                             : "here they agree.");
    }
    return t;
}

/// The largest gains in places and in shape against Gaussian noise below half a mean edge.
report::Text places_words(const DenoisingLaboratory& laboratory) {
    double places = 0, shape = 0;
    for_each_trial(laboratory, [&](const DenoisingTrials&, const NoiseTrial& trial) {
        if (trial.kind != NoiseKind::gaussian || trial.edges > 0.5) return;
        for (const SearchResult& r : trial.results) {
            if (std::isfinite(r.rms_gain())) places = std::max(places, r.rms_gain());
            if (std::isfinite(r.gain())) shape = std::max(shape, r.gain());
        }
    });
    if (places == 0 || shape == 0) return {};
    return report::text("Against Gaussian noise of up to half a mean edge the largest gain in places is ", readable(places),
                        ", the largest in shape ", readable(shape),
                        shape > 1.5 * places ? ": of what vertices lost within the surface less comes back than of the shape." : ".");
}

int defined_methods(const NoiseTrial& trial) {
    return static_cast<int>(std::count_if(trial.results.begin(), trial.results.end(), [](const SearchResult& r) { return r.defined; }));
}

/// The methods whose gain in shape is as large in a trial: "by none", "by explicit and guided normals".
std::string those_with(const NoiseTrial& trial, double gain) {
    std::vector<std::string> titles;
    for (const SearchResult& r : trial.results) {
        if (r.gain() >= gain) titles.emplace_back(denoising_entry(r.method).title);
    }
    if (titles.empty()) return "by none";
    if (static_cast<int>(titles.size()) == defined_methods(trial)) return "by every method";
    return "by " + listed(titles);
}

/// From where and up to where, on one mesh.
report::Text limit_words(const DenoisingTrials& mesh) {
    const auto levels = mesh.of_kind(NoiseKind::gaussian);
    const NoiseTrial &low = *levels.front(), &high = *levels.back();
    report::Text t = report::text("On ", mesh.name(), " the error of shape by Gaussian noise of ", readable(low.edges, 2),
                                  " mean edges is lowered (gain ≥ 1.2) ", those_with(low, helps));
    if (levels.size() == 1) {
        report::extend(t, ".");
        return t;
    }
    report::extend(t, "; that of ", readable(high.edges, 2), " is halved ", those_with(high, works), " (", ref("methods_limits"), ").");
    const int best = winner(high, &SearchResult::gain);
    if (best < 0) {
        report::extend(t, " There the best is to leave it alone.");
        return t;
    }
    const SearchResult& result = high.results[static_cast<std::size_t>(best)];
    const double angle = degrees * result.difference.mean_normal_angle;
    report::extend(t, " The best there, ", method_title(best), ", leaves an error of ",
                   readable(result.by_shape.shape / mesh.subject.mean_edge, 2), " mean edges and normals ", readable(angle, 2),
                   "° off on average");
    report::extend(t, angle > 30 ? ": the error is lower, but the surface is not there again." : ".");
    return t;
}

/// What the noise of the pictures does to the limit of explicit steps and to the area, and what follows.
report::Text spoilt_words(const DenoisingLaboratory& laboratory) {
    std::vector<std::string> limits, areas;
    double largest_limit = 0, smallest_area = INFINITY;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        const NoiseTrial& trial = mesh.trials[static_cast<std::size_t>(mesh.pictured)];
        const double limit = mesh.subject.largest_eigenvalue / trial.largest_eigenvalue;
        largest_limit = std::max(largest_limit, limit);
        smallest_area = std::min(smallest_area, trial.spoilt.area_ratio);
        limits.push_back(readable_percent(limit, 2) + " on " + mesh.name());
        areas.push_back(readable(trial.spoilt.area_ratio) + " on " + mesh.name());
    }
    report::Text t = report::text("The worst triangle sets the limit of explicit steps. With the noise of the pictures λ_crit is ",
                                  listed(limits), " of that of the clean mesh");
    report::extend(t, largest_limit < 1 ? ": noise spoils triangles, and holds back explicit smoothing and Taubin, which have no other "
                                          "steps to take than the operator of the noisy mesh allows."
                                        : ".");
    report::extend(t, " The area is ", listed(areas), " times that of the clean mesh");
    report::extend(t, smallest_area > 1.02 ? ", all of which the conformalised flow gives back after every step: it was made to lead to a "
                                             "sphere without singularities, not to denoise."
                                           : ".");
    return t;
}

/// The kinds of noise at the level of the picture, the best gain against each.
report::Text kind_words(const DenoisingTrials& mesh) {
    const double edges = mesh.trials[static_cast<std::size_t>(mesh.pictured)].edges;
    std::vector<std::string> told;
    double smallest = INFINITY, largest = 0;
    std::string_view with_least, with_most;
    for (const NoiseTrial& trial : mesh.trials) {
        if (trial.edges != edges) continue;
        const std::string_view title = noise_entry(trial.kind).title;
        const int best = winner(trial, &SearchResult::gain);
        const double gain = best >= 0 ? trial.results[static_cast<std::size_t>(best)].gain() : 1;
        told.push_back(std::string(title) + " " + readable(gain) + (best >= 0 ? " (" + method_title(best) + ")" : ""));
        if (gain < smallest) smallest = gain, with_least = title;
        if (gain > largest) largest = gain, with_most = title;
    }
    if (told.size() < 2) return {};
    report::Text t = report::text("Kinds of noise of the same strength, ", readable(edges, 2), " mean edges on ", mesh.name(),
                                  ", and the largest gain in shape against each: ", listed(told), ".");
    if (largest > 1.1 * smallest) {
        report::extend(t, " The gain is largest for the noise called “", std::string(with_most), "”, smallest for “",
                       std::string(with_least), "”.");
    }
    return t;
}

/// What 20 % of the box leaves.
report::Text hopeless_words(const DenoisingLaboratory& laboratory) {
    report::Text t;
    for_each_trial(laboratory, [&](const DenoisingTrials& mesh, const NoiseTrial& trial) {
        if (!trial.s1_level) return;
        if (t.empty())
            report::extend(t, "Noise of 20 % of the box, the highest of an earlier report:");
        else
            report::extend(t, ";");
        const int best_method = winner(trial, &SearchResult::gain);
        if (best_method < 0) {
            report::extend(t, " on ", mesh.name(), " nothing helps");
            return;
        }
        const SearchResult& best = trial.results[static_cast<std::size_t>(best_method)];
        report::extend(t, " on ", mesh.name(), " ", method_title(best_method), " gains ", readable(best.gain(), 2), ", which leaves ",
                       readable_percent(best.by_shape.shape / mesh.subject.diagonal, 2), " of the diagonal and normals ",
                       readable(degrees * best.difference.mean_normal_angle, 2), "° off");
    });
    if (t.empty()) return t;
    report::extend(t,
                   ". Such a gain need not be a cure: a smooth blob of the right size is nearer to any shape than vertices scattered all "
                   "over the box.");
    return t;
}

report::Text volume_words(const DenoisingLaboratory& laboratory) {
    report::Text t;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        if (!mesh.subject.encloses_volume) continue;
        const NoiseTrial& trial = mesh.trials[static_cast<std::size_t>(mesh.pictured)];
        std::vector<std::string> told;
        for (const SearchResult& r : trial.results) {
            if (r.defined) told.push_back(std::string(denoising_entry(r.method).title) + " " + readable(r.difference.volume_ratio));
        }
        report::extend(t, t.empty() ? "Volume over that of the clean mesh, each method at its best: on " : "; on ", mesh.name(), " (",
                       trial.words(), "; noisy ", readable(trial.spoilt.volume_ratio), ") ", listed(told));
    }
    if (!t.empty()) report::extend(t, ".");
    return t;
}

report::Text failure_words(const DenoisingLaboratory& laboratory) {
    std::vector<int> failed(denoising_list().size(), 0);
    for_each_trial(laboratory, [&](const DenoisingTrials&, const NoiseTrial& trial) {
        for (std::size_t i = 0; i < failed.size(); ++i) failed[i] += trial.results[i].failed;
    });
    std::vector<std::string> told;
    for (std::size_t i = 0; i < failed.size(); ++i) {
        if (failed[i] > 0) told.push_back(counted(failed[i], "run") + " of " + method_title(int(i)));
    }
    if (told.empty()) return {};
    return report::text("Ended before their time, because the mesh collapsed, blew up, or left a system that cannot be factored: ",
                        listed(told), ". What they had reached until then counts.");
}

report::Text patch_words(const DenoisingLaboratory& laboratory) {
    std::vector<std::string> told;
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        if (mesh.subject.is_patch())
            told.push_back(mesh.name() + " (" + std::to_string(mesh.subject.mesh.vertex_count()) + " of " +
                           std::to_string(mesh.subject.whole_vertices) + " vertices)");
    }
    if (told.empty()) return {};
    return report::text("Of meshes that are too large for so many runs a patch around the sharpest edge was taken: ", listed(told),
                        ". Where it was cut it has a boundary, which diffusion pulls inwards.");
}

}   // namespace

void add_discussion(report::Section& section, const DenoisingLaboratory& laboratory) {
    add_heading(section, "Discussion: which method for which mesh, and when does it fail?");
    for (const ClassResult& c : class_results(laboratory)) add_paragraphs(section, {winner_words(c)});
    add_paragraphs(section, {winners_counted(laboratory), places_words(laboratory)});
    for (const DenoisingTrials& mesh : laboratory.meshes) add_paragraphs(section, {limit_words(mesh), kind_words(mesh)});
    add_paragraphs(section, {spoilt_words(laboratory), hopeless_words(laboratory), volume_words(laboratory), failure_words(laboratory),
                             patch_words(laboratory)});
}

}   // namespace meshfolio::methods
