#include "run/lab/report_labs.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
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

struct LabJob {
    std::set<std::string> answered;                      // whose panels open it
    std::map<std::string, QuestionSettings> questions;   // that have this mesh, answered or not: parts of a report hold the same data
};
using Wanted = std::map<std::shared_ptr<const LibraryMesh>, LabJob>;

std::string names_of(const LabJob& job) {
    std::string names;
    for (const std::string& id : job.answered) names += (names.empty() ? "" : " ") + id;
    return names;
}

/// One of the settings, else the user's own, else the question's choice.
std::string source_of(std::string_view id, std::string_view role, const ReportSettings& settings) {
    const QuestionSettings own = question_settings(settings, std::string(id));
    return !own.meshes.empty() ? "file " + own.meshes.front() : !settings.meshes.empty() ? "own" : std::string(role);
}

void want(Wanted& wanted, const std::string& id, std::string_view role, const MeshLibrary& meshes, const ReportSettings& settings) try {
    report::Section unused;
    LabJob& job = wanted[meshes_for(meshes, question_settings(settings, id), {role}, unused).front()];
    job.answered.insert(id);
    for (const auto& [other, its_role] : choices) {
        if (source_of(other, its_role, settings) == source_of(id, role, settings))
            job.questions.emplace(other, question_settings(settings, std::string(other)));
    }
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
        const auto& [mesh, job] = *jobs[i].second;
        try {
            labs[i] = report::lab_of(jobs[i].first, bytes_of(lab_mesh(mesh->mesh(), mesh->name, job.questions)));
        } catch (const Error& error) {
            warn("no laboratory with " + mesh->name + ": " + error.what());
        }
    });
    std::erase_if(labs, [](const report::Lab& lab) { return lab.data.empty(); });
    return labs;
}

}   // namespace meshfolio::run
