#include "run/plan/plan.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <stdexcept>

#include "base/errors.h"
#include "questions/core/chapter.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

/// The rungs of a question: its own mesh matters most. Of a section that explores: its settings do. The preflight is about the mesh itself,
/// so that the certificates beside it are never left out.
constexpr Effort of_question[] = {{}, {true}, {true, 100000}, {true, 30000}, {true, 10000}, {true, 3000}};
constexpr Effort exploring[] = {{}, {false, 30000}, {false, 10000}, {true, 10000}, {true, 3000}, {true, 0, true}};
constexpr Effort of_certificates[] = {{}, {false, 30000}, {false, 10000}, {true, 10000}, {true, 3000}};

std::span<const Effort> ladder_of(std::string_view id) {
    if (id == "certificates") return of_certificates;
    return chapter_of_id(id).is_question() ? std::span<const Effort>(of_question) : exploring;
}

const SectionModel& model_of(std::string_view id) {
    const auto models = section_models();
    const auto found = std::ranges::find(models, id, &SectionModel::id);
    if (found == models.end()) throw std::logic_error("no cost model of " + std::string(id));
    return *found;
}

/// `cost` of the section's meshes as they are worked on.
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

/// Every section, at the top of what the settings allow.
template <class MeshesOf>
Plan started(const ReportSettings& settings, bool alone, const MeshesOf& meshes_of_section) {
    Plan plan;
    plan.printed = settings.pdf != "off";
    for (const Chapter* chapter : chapters_of(settings)) {
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

}   // namespace

Effort PlannedSection::effort() const {
    Effort effort = ladder_of(model->id)[rung];
    if (effort.left_out) return effort;
    effort.cpu_seconds =
        (effort.small ? cost_of(model->small_cpu, *this, effort, work_small) : cost_of(model->full_cpu, *this, effort, work_full)) +
        cost_of(model->whole_cpu, *this, {}, 1);
    if (effort.most_vertices >= largest_mesh()) effort.most_vertices = 0;
    return effort;
}

double PlannedSection::memory() const {
    const Effort planned = effort();
    if (planned.left_out) return 0;
    double largest = 0;   // one mesh at a time
    const CostModel& model_memory = planned.small ? model->small_memory : model->full_memory;
    for (const PlannedMesh& mesh : meshes) largest = std::max(largest, model_memory.per_mesh(mesh.within(planned.most_vertices)));
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

}   // namespace meshfolio::run
