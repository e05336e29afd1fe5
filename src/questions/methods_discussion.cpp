// What the numbers of the denoising laboratory say.
#include <algorithm>
#include <cmath>
#include <set>

#include "number_text.h"
#include "questions/methods_section.h"
#include "questions/section_tools.h"
#include "questions/study_list.h"

namespace meshfolio {

namespace {

using report::ref;

constexpr double degrees = 180 / M_PI;

template <class Visit>
void for_each_trial(const DenoisingLaboratory& laboratory, Visit visit) {
    for (const DenoisingTrials& mesh : laboratory.meshes) {
        for (const NoiseTrial& trial : mesh.trials) visit(mesh, trial);
    }
}

report::Text winner_words(const ClassResult& c) {
    const int best = c.best(), by_angle = c.best_by_angle();
    report::Text t = report::text("What is ", c.title, " (", listed(c.meshes), "): ", method_title(best), " gains most in position, ",
                                  readable(c.gain[static_cast<std::size_t>(best)]), "-fold over ",
                                  counted(c.trials, "noisy mesh", "noisy meshes"), " (geometric mean)");
    if (by_angle == best) {
        report::extend(t, ", and in normals too, ", readable(c.angle_gain[static_cast<std::size_t>(by_angle)]), "-fold.");
    } else if (by_angle >= 0) {
        report::extend(t, "; in normals ", method_title(by_angle), " does, ", readable(c.angle_gain[static_cast<std::size_t>(by_angle)]),
                       "-fold, where ", method_title(best), " gains ", readable(c.angle_gain[static_cast<std::size_t>(best)]), ".");
    } else {
        report::extend(t, ".");
    }
    return t;
}

/// How often filters of normals win, on meshes with sharp edges and on the others; and whether both measures agree.
report::Text winners_counted(const DenoisingLaboratory& laboratory) {
    int trials[2] = {0, 0}, by_position[2] = {0, 0}, by_angle[2] = {0, 0}, differ = 0, compared = 0;
    for_each_trial(laboratory, [&](const DenoisingTrials& mesh, const NoiseTrial& trial) {
        const int sharp = mesh.subject.character.kind() == MeshClass::sharp_edged ? 1 : 0;
        const int position = winner_by_rms(trial), angle = winner_by_angle(trial);
        const auto filters = [](int method) {
            return method >= 0 && filters_normals(denoising_list()[static_cast<std::size_t>(method)].method) ? 1 : 0;
        };
        ++trials[sharp];
        by_position[sharp] += filters(position);
        by_angle[sharp] += filters(angle);
        if (position < 0 || angle < 0) return;
        ++compared;
        differ += position != angle ? 1 : 0;
    });
    report::Text t;
    const auto say = [&](int sharp, const char* where) {
        report::extend(t, "Filters of normals are best in position on ", std::to_string(by_position[sharp]), ", in normals on ",
                       std::to_string(by_angle[sharp]), " of ", counted(trials[sharp], "noisy mesh", "noisy meshes"), where);
    };
    if (trials[1] > 0) say(1, " with sharp edges. ");
    if (trials[0] > 0) say(0, " without them. ");
    if (compared > 0) {
        report::extend(t, "The method that is best in position is not the one that is best in normals on ", std::to_string(differ), " of ",
                       std::to_string(compared), " (", ref("methods_winners"), "): ",
                       2 * differ > compared ? "which one is best depends on what is asked for."
                       : differ > 0          ? "mostly they agree."
                                             : "here they agree.");
    }
    return t;
}

/// Titles of the methods with that gain in a trial.
std::vector<std::string> methods_with(const NoiseTrial& trial, double gain) {
    std::vector<std::string> titles;
    for (const SearchResult& r : trial.results) {
        if (r.gain() >= gain) titles.emplace_back(denoising_entry(r.method).title);
    }
    return titles;
}

int defined_methods(const NoiseTrial& trial) {
    return static_cast<int>(std::count_if(trial.results.begin(), trial.results.end(), [](const SearchResult& r) { return r.defined; }));
}

std::string those_with(const NoiseTrial& trial, double gain) {
    const std::vector<std::string> titles = methods_with(trial, gain);
    if (titles.empty()) return "by none";
    if (static_cast<int>(titles.size()) == defined_methods(trial)) return "by every method";
    return "by " + listed(titles);
}

/// From where and up to where, on one mesh.
report::Text limit_words(const DenoisingTrials& mesh) {
    const auto levels = mesh.of_kind(NoiseKind::gaussian);
    const NoiseTrial &low = *levels.front(), &high = *levels.back();
    report::Text t = report::text("On ", mesh.name(), " Gaussian noise of ", readable(low.edges, 2), " mean edges is helped (gain ≥ 1.2) ",
                                  those_with(low, helps));
    if (levels.size() == 1) {
        report::extend(t, ".");
        return t;
    }
    report::extend(t, "; at ", readable(high.edges, 2), " the error is halved ", those_with(high, works), ".");
    const int winner = winner_by_rms(high);
    if (winner < 0) {
        report::extend(t, " There the best is to leave it alone.");
        return t;
    }
    const SearchResult& best = high.results[static_cast<std::size_t>(winner)];
    const double angle = degrees * best.difference.mean_normal_angle;
    report::extend(t, " The best there, ", method_title(winner), ", leaves an error of ",
                   readable(best.by_rms.rms / mesh.subject.mean_edge, 2), " mean edges and normals ", readable(angle, 2),
                   "° off on average");
    report::extend(t, angle > 30 ? ": the error is lower, but the surface is not there again." : ".");
    return t;
}

/// The four kinds at the level they share, best gain of each.
report::Text kind_words(const DenoisingTrials& mesh) {
    std::vector<std::string> told;
    double edges = 0, smallest = INFINITY, largest = 0;
    std::string hardest, easiest;
    for (const NoiseTrial* gaussian : mesh.of_kind(NoiseKind::gaussian)) {
        std::vector<std::string> list;
        double low = INFINITY, high = 0;
        std::string low_name, high_name;
        for (const NoiseEntry& entry : noise_list()) {
            for (const NoiseTrial* trial : mesh.of_kind(entry.kind)) {
                if (trial->edges != gaussian->edges) continue;
                const int winner = winner_by_rms(*trial);
                const double gain = winner >= 0 ? trial->results[static_cast<std::size_t>(winner)].gain() : 1;
                list.push_back(std::string(entry.title) + " " + readable(gain) + (winner >= 0 ? " (" + method_title(winner) + ")" : ""));
                if (gain < low) low = gain, low_name = entry.title;
                if (gain > high) high = gain, high_name = entry.title;
            }
        }
        // Of several shared levels, the one in the middle of the Gaussian ones or the last before it.
        if (list.size() != noise_list().size() ||
            (!told.empty() && gaussian->edges > mesh.trials[static_cast<std::size_t>(mesh.pictured)].edges))
            continue;
        told = list, edges = gaussian->edges, smallest = low, largest = high, hardest = low_name, easiest = high_name;
    }
    if (told.empty()) return {};
    report::Text t = report::text("The kind of noise at the same strength, ", readable(edges, 2), " mean edges on ", mesh.name(),
                                  ", largest gains: ", listed(told), ".");
    if (largest > 1.1 * smallest) {
        report::extend(t, " The noise that is easiest to take off is the one called ", easiest, ", the hardest the one called ", hardest,
                       ".");
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
        const int winner = winner_by_rms(trial);
        if (winner < 0) {
            report::extend(t, " on ", mesh.name(), " nothing helps");
            return;
        }
        const SearchResult& best = trial.results[static_cast<std::size_t>(winner)];
        report::extend(t, " on ", mesh.name(), " ", method_title(winner), " gains ", readable(best.gain(), 2), ", which leaves ",
                       readable_percent(best.by_rms.rms / mesh.subject.diagonal, 2), " of the diagonal and normals ",
                       readable(degrees * best.difference.mean_normal_angle, 2), "° off");
    });
    if (t.empty()) return t;
    report::extend(
        t, ". Gains there are not cures: what shrinks to a smooth blob is nearer to the truth than what is scattered all over the box.");
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
        report::extend(t, t.empty() ? "Volume over that of the clean mesh, each method at its best: on " : "; on ", mesh.name(), " with ",
                       trial.words(), " noise (noisy ", readable(trial.spoilt.volume_ratio), ") ", listed(told));
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

void add_methods_discussion(report::Section& section, const DenoisingLaboratory& laboratory) {
    add_heading(section, "Discussion: which method for which mesh, and when does it fail?");
    for (const ClassResult& c : class_results(laboratory)) add_paragraphs(section, {winner_words(c)});
    add_paragraphs(section, {winners_counted(laboratory)});
    for (const DenoisingTrials& mesh : laboratory.meshes) add_paragraphs(section, {limit_words(mesh), kind_words(mesh)});
    add_paragraphs(section, {hopeless_words(laboratory), volume_words(laboratory), failure_words(laboratory), patch_words(laboratory)});
}

}   // namespace meshfolio
