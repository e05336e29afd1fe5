#include "run/plan/plan.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <span>
#include <stdexcept>

#include "base/errors.h"
#include "base/number_text.h"
#include "questions/core/chapter.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

constexpr double megabyte = 1e6;

/// The rungs of a question: its own mesh matters most. Of a section that explores: its settings do. The preflight is about the mesh itself.
constexpr Effort of_question[] = {{}, {true}, {true, 100000}, {true, 30000}, {true, 10000}, {true, 3000}};
constexpr Effort exploring[] = {{}, {false, 30000}, {false, 10000}, {true, 10000}, {true, 3000}, {true, 0, true}};
constexpr Effort of_preflight[] = {{}, {true}};

std::span<const Effort> ladder_of(std::string_view id) {
    if (id == "preflight") return of_preflight;
    return chapter_of_id(id).is_question() ? std::span<const Effort>(of_question) : exploring;
}

const SectionModel& model_of(std::string_view id) {
    const auto models = section_models();
    const auto found = std::ranges::find(models, id, &SectionModel::id);
    if (found == models.end()) throw std::logic_error("no cost model of " + std::string(id));
    return *found;
}

double at_most(double vertices, int limit) { return limit > 0 ? std::min<double>(vertices, limit) : vertices; }

/// `cost` of the section's meshes as they are worked on.
double cost_of(const CostModel& cost, const PlannedSection& section, const Effort& effort, double work) {
    double sum = cost.fixed;
    for (const PlannedMesh& mesh : section.meshes) sum += cost.per_mesh(at_most(mesh.vertices, effort.most_vertices), work);
    return sum;
}

double sum_over(const CostModel& cost, const std::vector<PlannedMesh>& meshes) {
    double sum = cost.fixed;
    for (const PlannedMesh& mesh : meshes) sum += cost.per_mesh(mesh.vertices);
    return sum;
}

/// The first rung further down that costs less; the section's own where there is none.
PlannedSection next_rung(const PlannedSection& section) {
    PlannedSection next = section;
    while (++next.rung < ladder_of(section.model->id).size())
        if (next.effort().cpu_seconds < section.effort().cpu_seconds) return next;
    return section;
}

double saved_by(const PlannedSection& section) {
    const double saved = section.effort().cpu_seconds - next_rung(section).effort().cpu_seconds;
    return chapter_of_id(section.model->id).is_question() ? saved / 2 : saved;
}

PlannedMesh planned(const LibraryMesh& mesh) {
    return {mesh.input.file, std::max<double>(mesh.input.vertices, 0.5 * static_cast<double>(mesh.input.triangles))};
}

/// Those that `get` gives; what cannot be had costs nothing.
template <class Get>
void add(std::vector<PlannedMesh>& meshes, const Get& get) try {
    for (const std::shared_ptr<const LibraryMesh>& mesh : get()) meshes.push_back(planned(*mesh));
} catch (const Error&) {   // the section says so
}

std::vector<PlannedMesh> meshes_of(const SectionModel& model, const QuestionSettings& settings, const MeshLibrary& library) {
    using List = std::vector<std::shared_ptr<const LibraryMesh>>;
    std::vector<PlannedMesh> meshes;
    if (!settings.meshes.empty()) {
        for (const std::string& path : settings.meshes) add(meshes, [&] { return List{library.file(path, settings.base)}; });
    } else if (!library.has_own_meshes()) {
        for (const std::string& role : split(model.roles, ' ')) add(meshes, [&] { return List{library.role(role)}; });
    } else if (!model.roles.empty()) {
        add(meshes, [&] { return library.own_meshes(); });
    }
    return meshes;
}

bool is_asked_for(const ReportSettings& settings, std::string_view id) {
    return settings.only.empty() || contains(settings.only, std::string(id));
}

/// Every section, at the top of what the settings allow.
template <class MeshesOf>
Plan started(const ReportSettings& settings, bool alone, const MeshesOf& meshes_of_section) {
    Plan plan;
    plan.printed = settings.pdf != "off";
    for (const Chapter* chapter : chapter_list()) {
        const std::string id(chapter->id);
        if (alone && !is_asked_for(settings, id)) continue;
        const auto table = settings.questions.find(id);
        const QuestionTable asked = table != settings.questions.end() ? table->second : QuestionTable();
        PlannedSection section{&model_of(id), meshes_of_section(model_of(id)), work_of(id, asked, false), work_of(id, asked, true)};
        const auto ladder = ladder_of(id);
        while (settings.quick && !ladder[section.rung].small) ++section.rung;
        for (const PlannedMesh& mesh : section.meshes) {
            if (std::ranges::find(plan.meshes, mesh.file, &PlannedMesh::file) == plan.meshes.end()) plan.meshes.push_back(mesh);
        }
        plan.sections.push_back(std::move(section));
    }
    return plan;
}

Plan scaled(Plan plan, const ReportSettings& settings, Scope scope) {
    double vertices = 0;
    for (const PlannedMesh& mesh : plan.meshes) vertices += mesh.vertices;
    plan.time = settings.time.value_or(promised_seconds(2 * vertices, settings.quick));
    while (plan.seconds() > plan.time && !plan.sections.empty()) {
        const auto dearest = std::ranges::max_element(plan.sections, {}, saved_by);
        if (saved_by(*dearest) <= 0) break;
        *dearest = next_rung(*dearest);
    }
    for (PlannedSection& section : plan.sections) {
        const std::string id(section.model->id);
        if (!is_asked_for(settings, id)) {
            plan.others[id] = section.effort();
            plan.others[id].cpu_seconds = 0;
        } else if (!settings.only.empty() && scope != Scope::part && section.effort().left_out) {
            --section.rung;
        }
    }
    std::erase_if(plan.sections, [&](const PlannedSection& section) { return !is_asked_for(settings, section.model->id); });
    return plan;
}

std::string rounded_text(double x) { return plain_text(rounded(x, 2), 6); }

/// "small settings, copies of at most 30000 vertices"
std::string words_of(const PlannedSection& section) {
    const Effort effort = section.effort();
    if (effort.left_out) return "left out, to fit into the time";
    std::string words = effort.small ? "small settings" : "full settings";
    if (section.works_on_copies()) words += ", copies of at most " + std::to_string(effort.most_vertices) + " vertices";
    return words;
}

std::string padded(const std::string& text, std::size_t width) { return std::string(width - std::min(width, text.size()), ' ') + text; }

}   // namespace

Effort PlannedSection::effort() const {
    Effort effort = ladder_of(model->id)[rung];
    if (effort.left_out) return effort;
    effort.cpu_seconds =
        effort.small ? cost_of(model->small_cpu, *this, effort, work_small) : cost_of(model->full_cpu, *this, effort, work_full);
    if (effort.most_vertices >= largest_mesh()) effort.most_vertices = 0;
    return effort;
}

double PlannedSection::memory() const {
    const Effort planned = effort();
    if (planned.left_out) return 0;
    double largest = 0;   // one mesh at a time
    const CostModel& model_memory = planned.small ? model->small_memory : model->full_memory;
    for (const PlannedMesh& mesh : meshes)
        largest = std::max(largest, model_memory.per_mesh(at_most(mesh.vertices, planned.most_vertices)));
    return megabyte * (model_memory.fixed + largest);
}

double PlannedSection::largest_mesh() const {
    double largest = 0;
    for (const PlannedMesh& mesh : meshes) largest = std::max(largest, mesh.vertices);
    return largest;
}

bool PlannedSection::works_on_copies() const { return effort().most_vertices > 0; }

double Plan::rest_cpu() const {
    const bool copies = std::ranges::any_of(sections, &PlannedSection::works_on_copies);
    return base_cpu.fixed + sum_over(reading_cpu, meshes) + (copies ? sum_over(copies_cpu, meshes) : 0) +
           (printed ? printing_cpu.fixed : 0);
}

double Plan::cpu_seconds() const {
    double sum = rest_cpu();
    for (const PlannedSection& section : sections) sum += section.effort().cpu_seconds;
    return sum;
}

double Plan::seconds() const { return cpu_seconds() / (cores * busy_share); }

/// Beside all meshes the largest sections, or one mesh being decimated and the largest sections that work on no copy of it. What decimating
/// took in small pieces is not given back.
double Plan::memory(int at_a_time) const {
    double copies = 0;
    if (std::ranges::any_of(sections, &PlannedSection::works_on_copies))
        for (const PlannedMesh& mesh : meshes) copies = std::max(copies, megabyte * copies_memory.per_mesh(mesh.vertices));
    std::vector<double> of_sections, while_copied{copies};
    for (const PlannedSection& section : sections) {
        of_sections.push_back(section.memory());
        if (!section.works_on_copies()) while_copied.push_back(section.memory());
    }
    const auto largest = [&](std::vector<double>& memories) {
        std::ranges::sort(memories, std::greater());
        memories.resize(static_cast<std::size_t>(at_a_time));
        return std::accumulate(memories.begin(), memories.end(), 0.0);
    };
    const double kept = std::min(1.25 * copies, 110 * megabyte);
    return megabyte * (base_memory.fixed + sum_over(reading_memory, meshes)) + std::max(largest(of_sections) + kept, largest(while_copied));
}

std::map<std::string, Effort> Plan::efforts() const {
    std::map<std::string, Effort> efforts = others;
    for (const PlannedSection& section : sections) efforts[std::string(section.model->id)] = section.effort();
    return efforts;
}

double promised_seconds(double triangles, bool quick) {
    const double millions = triangles / 1e6;
    if (!quick) return std::max(180.0, 180 * millions / 0.346);
    return millions <= 1 ? std::max(20.0, 20 + 40 * (millions - 0.1) / 0.9) : 60 + 120 * (millions - 1) / 4.5;
}

Plan plan_of(const ReportSettings& settings, const MeshLibrary& meshes, Scope scope) {
    return scaled(
        started(settings, scope == Scope::alone,
                [&](const SectionModel& model) { return meshes_of(model, question_settings(settings, std::string(model.id)), meshes); }),
        settings, scope);
}

Plan plan_for(const ReportSettings& settings, const std::vector<PlannedMesh>& meshes) {
    return scaled(
        started(settings, false, [&](const SectionModel& model) { return model.roles.empty() ? std::vector<PlannedMesh>() : meshes; }),
        settings, Scope::report);
}

std::string text_of(const Plan& plan) {
    std::string text = "section           CPU s       MB  how\n";
    const auto line = [&](const std::string& name, double cpu, double bytes, const std::string& how) {
        text += name + padded(padded(rounded_text(cpu), 8), 23 - std::min<std::size_t>(name.size(), 15)) +
                padded(rounded_text(bytes / megabyte), 9) + "  " + how + "\n";
    };
    for (const PlannedSection& section : plan.sections)
        line(std::string(section.model->id), section.effort().cpu_seconds, section.memory(), words_of(section));
    line("all else", plan.rest_cpu(), megabyte * base_memory.fixed, plan.printed ? "meshes, pages, printing" : "meshes, pages");
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
            meshes.push_back(
                {{"file", mesh.file}, {"vertices", mesh.vertices}, {"worked_on", at_most(mesh.vertices, effort.most_vertices)}});
        Plan part = plan;
        part.sections = {section};
        sections.push_back({{"id", section.model->id},
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
    constexpr double always_tried = 300 * megabyte;   // what so little does not suffice for says so itself
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
