#include "run/plan/plan.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>

#include "base/errors.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

/// The cost of everything beside the sections: the program; reading the meshes; making decimated copies; printing.
constexpr CostModel base_cpu{0.2, 0}, reading_cpu{0, 0.25}, copies_cpu{0, 2.3}, printing_cpu{8, 0};   // [s]
constexpr CostModel reading_memory{0, 25}, copies_memory{0, 80};                                      // [MB]

/// The rungs of a question keep its own mesh longest. A supporting section keeps its settings longest; its last rung leaves it out.
constexpr Effort of_question[] = {{}, {true}, {true, 100000}, {true, 30000}, {true, 10000}, {true, 3000}};
constexpr Effort of_supporting[] = {{}, {false, 30000}, {false, 10000}, {true, 10000}, {true, 3000}, {true, 0, true}};

std::span<const Effort> ladder_of(const Chapter& chapter) {
    if (chapter.is_question()) return of_question;
    return std::span(of_supporting).first(std::size(of_supporting) - (chapter.never_left_out ? 1 : 0));
}

/// Returns the cost of the section's meshes as they are worked on.
double cost_of(const CostModel& cost, const PlannedSection& section, const Effort& effort, double work) {
    double sum = cost.fixed;
    for (const PlannedMesh& mesh : section.meshes) sum += cost.per_mesh(mesh.within(effort.most_vertices), work);
    return sum;
}

double sum_over(const CostModel& cost, const std::vector<PlannedMesh>& meshes) {
    double sum = cost.fixed;
    for (const PlannedMesh& mesh : meshes) sum += cost.per_mesh(mesh.vertices);
    return sum;
}

/// Returns the section on the first rung further down that costs less; the section itself if there is none.
PlannedSection next_rung(const PlannedSection& section) {
    PlannedSection next = section;
    while (++next.rung < ladder_of(*section.chapter).size())
        if (next.effort().cpu_seconds < section.effort().cpu_seconds) return next;
    return section;
}

double saved_by(const PlannedSection& section) {
    const double saved = section.effort().cpu_seconds - next_rung(section).effort().cpu_seconds;
    return section.chapter->is_question() ? saved / 2 : saved;
}

PlannedMesh planned(const LibraryMesh& mesh) {
    return {mesh.input.file, std::max<double>(mesh.input.vertices, 0.5 * static_cast<double>(mesh.input.triangles))};
}

/// Returns the meshes that decide the cost of a chapter. One that cannot be had costs nothing: the section reports it.
std::vector<PlannedMesh> meshes_of(const Chapter& chapter, const QuestionSettings& settings, const MeshLibrary& library) {
    std::vector<PlannedMesh> meshes;
    const auto add = [&](const auto& get) {
        try {
            meshes.push_back(planned(*get()));
        } catch (const Error&) {
        }
    };
    if (!settings.meshes.empty()) {
        for (const std::string& path : settings.meshes) add([&] { return library.file(path, settings.base); });
    } else if (!library.has_own_meshes()) {
        for (std::size_t i = 0; i < chapter.planned_roles; ++i) add([&] { return library.role(std::string(chapter.roles[i])); });
    } else if (!chapter.roles.empty()) {
        for (const SharedMesh& mesh : library.own_meshes()) add([&] { return mesh; });
    }
    return meshes;
}

/// Returns every section at the top of its ladder, as far as the settings allow.
template <class MeshesOf> Plan started(const ReportSettings& settings, bool alone, const MeshesOf& meshes_of_section) {
    Plan plan;
    plan.printed = settings.pdf != "off";
    for (const Chapter* chapter : chapter_list()) {
        if (alone && !is_asked_for(settings, chapter->id)) continue;
        const QuestionSettings asked = question_settings(settings, std::string(chapter->id));
        PlannedSection section{chapter, meshes_of_section(*chapter, asked), chapter->cost.work_of(asked, false),
                               chapter->cost.work_of(asked, true)};
        const auto ladder = ladder_of(*chapter);
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
        const std::string id(section.chapter->id);
        if (!is_asked_for(settings, id)) {
            plan.others[id] = section.effort();
            plan.others[id].cpu_seconds = 0;
        } else if (!settings.only.empty() && scope != Scope::part && section.effort().left_out) {
            --section.rung;
        }
    }
    std::erase_if(plan.sections, [&](const PlannedSection& section) { return !is_asked_for(settings, section.chapter->id); });
    return plan;
}

}   // namespace

Effort PlannedSection::effort() const {
    Effort effort = ladder_of(*chapter)[rung];
    if (effort.left_out) return effort;
    effort.cpu_seconds = (effort.small ? cost_of(chapter->cost.cpu.small, *this, effort, work_small)
                                       : cost_of(chapter->cost.cpu.full, *this, effort, work_full)) +
                         cost_of(chapter->cost.whole_cpu, *this, {}, 1);
    if (effort.most_vertices >= largest_mesh()) effort.most_vertices = 0;
    return effort;
}

double PlannedSection::memory() const {
    const Effort planned = effort();
    if (planned.left_out) return 0;
    double largest = 0;   // one mesh at a time
    const CostModel& model = planned.small ? chapter->cost.memory.small : chapter->cost.memory.full;
    for (const PlannedMesh& mesh : meshes) largest = std::max(largest, model.per_mesh(mesh.within(planned.most_vertices)));
    return megabyte * (model.fixed + largest);
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

/// Adds to all meshes the largest sections, or the decimation of one mesh and the largest sections that work on no copy. The memory that
/// decimation took in small pieces is not returned.
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
    return megabyte * (base_memory + sum_over(reading_memory, meshes)) + std::max(largest(of_sections) + kept, largest(while_copied));
}

std::map<std::string, Effort> Plan::efforts() const {
    std::map<std::string, Effort> efforts = others;
    for (const PlannedSection& section : sections) efforts[std::string(section.chapter->id)] = section.effort();
    return efforts;
}

double promised_seconds(double triangles, bool quick) {
    const double millions = triangles / 1e6;
    if (!quick) return std::max(180.0, 180 * millions / 0.346);
    return millions <= 1 ? std::max(20.0, 20 + 40 * (millions - 0.1) / 0.9) : 60 + 120 * (millions - 1) / 4.5;
}

Plan plan_of(const ReportSettings& settings, const MeshLibrary& meshes, Scope scope) {
    const auto meshes_of_section = [&](const Chapter& chapter, const QuestionSettings& asked) { return meshes_of(chapter, asked, meshes); };
    return scaled(started(settings, scope == Scope::alone, meshes_of_section), settings, scope);
}

Plan plan_for(const ReportSettings& settings, const std::vector<PlannedMesh>& meshes) {
    const auto meshes_of_section = [&](const Chapter& chapter, const QuestionSettings&) {
        return chapter.roles.empty() ? std::vector<PlannedMesh>() : meshes;
    };
    return scaled(started(settings, false, meshes_of_section), settings, Scope::report);
}

}   // namespace meshfolio::run
