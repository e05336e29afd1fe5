// A plan as text and as JSON, and the error for a plan that does not fit into memory.
#include <tbb/task_arena.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/number_text.h"
#include "run/plan/plan.h"

namespace meshfolio::run {

namespace {

std::string rounded_text(double x) { return plain_text(rounded(x, 2), 6); }

/// Returns words about how a section is done: "small settings, copies of at most 30000 vertices".
std::string words_of(const PlannedSection& section) {
    const Effort effort = section.effort();
    if (effort.left_out) return "left out, to fit into the time";
    std::string words = effort.small ? "small settings" : "full settings";
    if (section.works_on_copies()) words += ", copies of at most " + std::to_string(effort.most_vertices) + " vertices";
    if (section.chapter->cost.is_guess) words += "; its cost is a guess, as the chapter gives none";
    return words;
}

std::string padded(const std::string& text, std::size_t width) { return std::string(width - std::min(width, text.size()), ' ') + text; }

}   // namespace

std::string text_of(const Plan& plan) {
    std::string text = "section           CPU s       MB  how\n";
    const auto line = [&](const std::string& name, double cpu, double bytes, const std::string& how) {
        text += name + padded(padded(rounded_text(cpu), 8), 23 - std::min<std::size_t>(name.size(), 15)) +
                padded(rounded_text(bytes / megabyte), 9) + "  " + how + "\n";
    };
    for (const PlannedSection& section : plan.sections)
        line(std::string(section.chapter->id), section.effort().cpu_seconds, section.memory(), words_of(section));
    line("all else", plan.rest_cpu(), megabyte * base_memory, plan.printed ? "meshes, pages, printing" : "meshes, pages");
    line("total", plan.cpu_seconds(), plan.memory(),
         "about " + rounded_text(plan.seconds()) + " s on two cores, of " + rounded_text(plan.time));
    return text;
}

std::string json_of(const Plan& plan) {
    using nlohmann::ordered_json;
    ordered_json sections = ordered_json::array();
    for (const PlannedSection& section : plan.sections) {
        const Effort effort = section.effort();
        ordered_json meshes = ordered_json::array();
        for (const PlannedMesh& mesh : section.meshes)
            meshes.push_back({{"file", mesh.file}, {"vertices", mesh.vertices}, {"worked_on", mesh.within(effort.most_vertices)}});
        Plan part = plan;
        part.sections = {section};
        sections.push_back({{"id", section.chapter->id},
                            {"cpu_seconds", rounded(effort.cpu_seconds, 3)},
                            {"memory_bytes", rounded(section.memory(), 3)},
                            {"alone", {{"cpu_seconds", rounded(part.cpu_seconds(), 3)}, {"memory_bytes", rounded(part.memory(), 3)}}},
                            {"settings", effort.left_out ? "left out"
                                         : effort.small  ? "small"
                                                         : "full"},
                            {"how", words_of(section)},
                            {"meshes", meshes}});
    }
    const ordered_json json{{"time", rounded(plan.time, 3)},
                            {"cores", cores},
                            {"seconds", rounded(plan.seconds(), 3)},
                            {"fits", plan.seconds() <= plan.time},
                            {"cpu_seconds", rounded(plan.cpu_seconds(), 3)},
                            {"cpu_seconds_beside_sections", rounded(plan.rest_cpu(), 3)},
                            {"memory_bytes", rounded(plan.memory(), 3)},
                            {"sections", sections}};
    return json.dump(2) + "\n";
}

void require_memory(const Plan& plan, const ReportSettings& settings, const AvailableMemory& available) {
    constexpr double always_tried = 300 * megabyte;   // a run that fails below this says so itself
    const int threads = settings.threads > 0 ? settings.threads : tbb::this_task_arena::max_concurrency();
    const double needed = plan.memory(threads);
    if (available.bytes <= 0 || needed <= std::max(available.bytes, always_tried)) return;
    const auto gigabytes = [](double bytes) { return plain_text(rounded(bytes / 1e9, 2), 3) + " GB"; };
    ReportSettings quick = settings;
    quick.quick = true;
    const double least = plan_for(quick, plan.meshes).memory(1);
    double vertices = 0;
    std::vector<PlannedMesh> fitting = plan.meshes;
    while (!fitting.empty() && fitting.front().vertices > 1 && plan_for(quick, fitting).memory(1) > available.bytes)
        for (PlannedMesh& mesh : fitting) mesh.vertices *= 0.9;
    for (const PlannedMesh& mesh : fitting) vertices += mesh.vertices;
    throw InputError({},
                     "out of memory: the report needs about " + gigabytes(needed) + ", " + gigabytes(available.bytes) + " are there (" +
                         available.limited_by + ")",
                     plan.memory(1) <= available.bytes ? "--threads 1 would fit, with " + gigabytes(plan.memory(1))
                     : least <= available.bytes        ? "--quick --threads 1 would fit, with " + gigabytes(least)
                                                       : "meshes of " + rounded_text(vertices) + " vertices in all would fit");
}

}   // namespace meshfolio::run
