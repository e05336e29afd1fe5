#include "run/lab/report_labs.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/parallel_tasks.h"
#include "questions/core/section_tools.h"
#include "run/console.h"
#include "run/lab/lab_mesh.h"

namespace meshfolio::run {

namespace {

constexpr int most_vertices = 20000;

/// Question, and which of its own choice of meshes.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> choices{
    {{"q4", "armadillo"}, {"q5", "cube"}, {"q6", "fandisk_ns"}, {"q7", "cube"}}};

bool is_answered(const std::vector<QuestionResult>& results, std::string_view id) {
    return std::any_of(results.begin(), results.end(), [&](const QuestionResult& result) {
        return result.section().id == id && result.section().status == report::Status::ok;
    });
}

using Questions = std::map<std::string, QuestionSettings>;
using Wanted = std::map<std::shared_ptr<const LibraryMesh>, Questions>;   // those of each mesh

std::string names_of(const Questions& questions) {
    std::string names;
    for (const auto& [id, settings] : questions) names += (names.empty() ? "" : " ") + id;
    return names;
}

/// One of the settings, else the user's own, else the question's choice.
void want(Wanted& wanted, const std::string& id, std::string_view role, const MeshLibrary& meshes, const ReportSettings& settings) try {
    report::Section unused;
    const QuestionSettings own = question_settings(settings, id);
    wanted[meshes_for(meshes, own, {role}, unused).front()].emplace(id, own);
} catch (const InputError&) {   // the section has said so
}

}   // namespace

std::vector<report::Lab> report_labs(const std::vector<QuestionResult>& results, const MeshLibrary& meshes,
                                     const ReportSettings& settings) {
    Wanted wanted;
    for (const auto& [id, role] : choices) {
        if (is_answered(results, id)) want(wanted, std::string(id), role, meshes, settings);
    }
    std::map<std::string, const Wanted::value_type*> by_questions;   // and not by address
    for (const auto& job : wanted) {
        if (job.first->mesh().vertex_count() <= most_vertices) by_questions.emplace(names_of(job.second), &job);
    }
    const std::vector<std::pair<std::string, const Wanted::value_type*>> jobs(by_questions.begin(), by_questions.end());
    std::vector<report::Lab> labs(jobs.size());
    for_each_task(jobs.size(), [&](std::size_t i) {
        const auto& [mesh, questions] = *jobs[i].second;
        try {
            labs[i] = report::lab_of(jobs[i].first, bytes_of(lab_mesh(mesh->mesh(), mesh->name, questions)));
        } catch (const Error& error) {
            warn("no laboratory with " + mesh->name + ": " + error.what());
        }
    });
    std::erase_if(labs, [](const report::Lab& lab) { return lab.data.empty(); });
    return labs;
}

}   // namespace meshfolio::run
