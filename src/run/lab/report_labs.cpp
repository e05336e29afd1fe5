#include "run/lab/report_labs.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/joined.h"
#include "base/parallel_tasks.h"
#include "questions/bench/lab_offer.h"
#include "questions/core/section_tools.h"
#include "report/words.h"
#include "run/console.h"
#include "run/lab/lab_mesh.h"
#include "run/provenance.h"

namespace meshfolio::run {

namespace {

constexpr int largest_source = 100000;   // vertices: larger meshes are decimated twice, of which other sections share the first

bool is_answered(const std::vector<ReportSection>& sections, std::string_view id) {
    return std::ranges::any_of(sections, [&](const ReportSection& section) {
        return section.answer.section.id == id && section.answer.section.status == report::Status::ok;
    });
}

struct LabJob {
    SharedMesh mesh;
    std::set<std::string> answered = {};                      // whose panels open it
    std::map<std::string, QuestionSettings> questions = {};   // that have this mesh, answered or not: parts of a report hold the same data
};

std::string names_of(const LabJob& job) { return joined({job.answered.begin(), job.answered.end()}, " "); }

/// Returns the cache key, of everything that shapes the data; empty if the program or the mesh has no digest.
std::string key_of(const LabJob& job, const ReportSettings& settings) {
    if (program_identity().empty() || job.mesh->input.sha256.empty()) return "";
    output::KeyMaker key;
    key.add("laboratory").add(program_identity()).add(report::words_identity()).add(names_of(job)).add(job.mesh->name);
    key.add(job.mesh->input.sha256);
    for (const auto& [id, unused] : job.questions) {
        key.add(id);
        for (const std::string& word : identity_of(settings, id)) key.add(word);
    }
    return key.key();
}

/// Returns the mesh of a chapter's laboratory; null if it is missing, which the section reports.
SharedMesh mesh_for(const Chapter& chapter, const MeshLibrary& meshes, const ReportSettings& settings) try {
    report::Section unused;
    return meshes_for(meshes, question_settings(settings, std::string(chapter.id)), {chapter.lab->role}, unused).front();
} catch (const Error&) {
    return nullptr;
}

}   // namespace

std::vector<report::Lab> report_labs(const std::vector<ReportSection>& sections, const MeshLibrary& meshes, const ReportSettings& settings,
                                     output::ResultCache* store) {
    const MeshLibrary sources = meshes.limited_to(largest_source);
    std::vector<LabJob> jobs;
    for (const Chapter* chapter : chapter_list()) {
        if (chapter->lab == nullptr) continue;
        const std::string_view id = chapter->id;
        const SharedMesh mesh = mesh_for(*chapter, sources, settings);
        if (!mesh) continue;
        auto job = std::ranges::find(jobs, mesh, &LabJob::mesh);
        if (job == jobs.end()) job = jobs.insert(job, LabJob{mesh});
        job->questions.emplace(id, question_settings(settings, std::string(id)));
        if (is_answered(sections, id)) job->answered.emplace(id);
    }
    std::erase_if(jobs, [](const LabJob& job) { return job.answered.empty(); });
    std::ranges::sort(jobs, {}, names_of);
    std::vector<report::Lab> labs(jobs.size());
    for_each_task(jobs.size(), [&](std::size_t i) {
        const SharedMesh& mesh = jobs[i].mesh;
        const std::string key = store != nullptr ? key_of(jobs[i], settings) : "";
        try {
            if (auto stored = key.empty() ? std::nullopt : store->get(key)) {
                labs[i] = {names_of(jobs[i]), std::move(*stored)};
                return;
            }
            LabMesh lab = lab_mesh(mesh->mesh(), mesh->name, jobs[i].questions);
            lab.source_vertices = mesh->input.vertices;
            lab.sight = settings.sight;
            labs[i] = report::lab_of(names_of(jobs[i]), bytes_of(lab));
            if (!key.empty()) store->put(key, labs[i].data);
        } catch (const OutputError&) {
            // the cache is no part of the report
        } catch (const Error& error) {
            warn("no laboratory with " + mesh->name + ": " + error.what());
        }
    });
    std::erase_if(labs, [](const report::Lab& lab) { return lab.data.empty(); });
    return labs;
}

}   // namespace meshfolio::run
