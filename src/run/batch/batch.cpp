#include "run/batch/batch.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/available_memory.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "base/sha256.h"
#include "output/publish/publish.h"
#include "output/publish/temporaries.h"
#include "questions/core/section_tools.h"
#include "report/words.h"
#include "run/arguments.h"
#include "run/batch/batch_folder.h"
#include "run/batch/finished_report.h"
#include "run/batch/job_pool.h"
#include "run/batch/report_run.h"
#include "run/console.h"
#include "run/paper.h"
#include "run/plan/plan.h"
#include "run/progress.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

using report::BatchRow;

constexpr std::size_t most_failures_told = 20;

/// Returns the SHA-256 of a file; empty if it cannot be read, which the run on the mesh reports.
std::string digest_of(const std::string& file) try { return sha256_of_file(file); } catch (const InputError&) {
    return "";
}

BatchRow failed_row(const BatchMesh& mesh, std::string error) {
    return {.name = mesh.name, .file = mesh.file, .state = BatchRow::State::failed, .error = std::move(error)};
}

std::vector<BatchRow> rows_found(const std::vector<BatchMesh>& meshes, const ReportSettings& settings) {
    std::vector<BatchRow> rows(meshes.size());
    for_each_task(meshes.size(), [&](std::size_t i) {
        rows[i] =
            finished_row(meshes[i], digest_of(meshes[i].file), settings).value_or(BatchRow{.name = meshes[i].name, .file = meshes[i].file});
    });
    return rows;
}

/// A mesh that has no finished report.
struct Task {
    std::size_t mesh;
    double cpu_seconds = 0, memory = 0;
};

class Batch {
public:
    Batch(const BatchFlags& flags, const ReportSettings& settings, std::vector<BatchMesh> meshes, BatchIndex& index)
        : flags_(flags), settings_(settings), meshes_(std::move(meshes)), index_(index) {}

    void run() {
        for (std::size_t i = 0; i < meshes_.size(); ++i)
            if (index_.batch().rows[i].state == BatchRow::State::waiting) tasks_.push_back({i});
        const std::size_t kept = meshes_.size() - tasks_.size();
        estimate();
        const auto largest = std::ranges::max_element(tasks_, {}, &Task::memory);
        complain(std::to_string(meshes_.size()) + (meshes_.size() == 1 ? " mesh" : " meshes") +
                 (kept > 0 ? ", " + std::to_string(kept) + " done before" : "") +
                 (tasks_.empty() ? ""
                                 : ", " + std::to_string(jobs_) + " at a time, the largest with " +
                                       plain_text(rounded(largest->memory / 1e9, 2)) + " GB"));
        make_reports();
    }
    bool has_output_error() const { return has_output_error_; }

private:
    const BatchFlags& flags_;
    const ReportSettings& settings_;
    const std::vector<BatchMesh> meshes_;
    BatchIndex& index_;
    std::vector<Task> tasks_;
    const int cores_ = settings_.threads > 0 ? settings_.threads : tbb::this_task_arena::max_concurrency();
    const double available_ = available_memory().bytes;
    int jobs_ = 1, threads_ = 1;   // of each
    std::atomic<bool> has_output_error_ = false;

    double cpu_seconds() const {
        double sum = 0;
        for (const Task& task : tasks_) sum += task.cpu_seconds;
        return sum;
    }
    std::vector<double> memories() const {
        std::vector<double> list;
        for (const Task& task : tasks_) list.push_back(task.memory);
        return list;
    }

    /// Estimates the cost of each task, and drops meshes that cannot be read: their rows say why.
    void estimate() {
        std::vector<char> can_be_read(tasks_.size());
        run_jobs(std::min<int>(cores_, static_cast<int>(tasks_.size())), memories(), 0,
                 [&](std::size_t i) { can_be_read[i] = estimate_one(tasks_[i]); });
        std::vector<Task> readable;
        for (std::size_t i = 0; i < tasks_.size(); ++i)
            if (can_be_read[i]) readable.push_back(tasks_[i]);
        tasks_ = std::move(readable);
        const int asked = flags_.jobs.empty() ? 0 : static_cast<int>(integer_between("--jobs", flags_.jobs, 1, limits::largest_threads));
        jobs_ = asked > 0 ? asked : jobs_for(memories(), available_, cores_);
        threads_ = std::max(1, cores_ / jobs_);
    }
    bool estimate_one(Task& task) {
        const BatchMesh& mesh = meshes_[task.mesh];
        const ChildEnd end = run_this_program(report_words(flags_, mesh, {"--plan", "--json", "--threads=1"}));
        const auto vertices = planned_vertices(end.output);
        if (!has_ended_well(end) || !vertices) {
            index_.set(task.mesh, failed_row(mesh, failure_of(end)));
            return false;
        }
        const ReportSettings own = settings_on(mesh, *vertices, settings_);
        const Plan plan = plan_for(own, {{mesh.file, *vertices}});
        task.cpu_seconds = plan.cpu_seconds();
        task.memory = plan.memory();
        return true;
    }
    static bool has_ended_well(const ChildEnd& end) { return end.kind == ChildEnd::Kind::exited && end.code == 0; }

    void make_reports() {
        ProgressDisplay display(stderr_is_terminal());   // meshes that are done tell how long the others take
        const double cpu = cpu_seconds();
        std::mutex telling;
        double done_cpu = 0;
        std::size_t done = 0;
        run_jobs(std::min<int>(jobs_, static_cast<int>(tasks_.size())), memories(), available_, [&](std::size_t i) {
            const BatchMesh& mesh = meshes_[tasks_[i].mesh];
            display.step(mesh.name);
            BatchRow row = row_made(mesh);
            const std::string words = row.error.empty() ? words_of(row.score) : "no report";
            index_.set(tasks_[i].mesh, std::move(row));
            const std::lock_guard lock(telling);
            ++done;
            done_cpu += tasks_[i].cpu_seconds;
            display.advance(done_cpu / cpu);
            display.milestone(std::to_string(done) + " of " + std::to_string(tasks_.size()) + ": " + mesh.name + ", " + words +
                              (done < tasks_.size() ? display.left() : ""));
        });
    }
    BatchRow row_made(const BatchMesh& mesh) {
        const ChildEnd end = run_this_program(report_words(flags_, mesh, {"--threads=" + std::to_string(threads_)}));
        has_output_error_ = has_output_error_ || (end.kind == ChildEnd::Kind::exited && end.code == static_cast<int>(ExitCode::output));
        // The last that a report prints is its page.
        const std::string beside = output::failed_beside(mesh.name).string();
        for (const std::string& line : split(end.output, '\n'))
            if (line.starts_with("meshfolio: ") && line.find(": kept ") != std::string::npos) complain(line.substr(11));
        const std::string printed = end.output.substr(0, end.output.find_last_not_of('\n') + 1);
        if (end.kind != ChildEnd::Kind::exited || end.code > 1 || !printed.ends_with("/index.html"))
            return failed_row(mesh, failure_of(end));
        try {
            return row_of_report(mesh, settings_.out, printed.ends_with("/" + beside + "/index.html") ? beside : mesh.name);
        } catch (const InputError& error) {
            return failed_row(mesh, error.what());
        }
    }
};

void tell_of_failures(const report::Batch& batch) {
    std::size_t told = 0;
    for (const BatchRow& row : batch.rows) {
        if (row.state != BatchRow::State::failed || told++ >= most_failures_told) continue;
        complain(row.error.find(row.file) != std::string::npos ? row.error : row.file + ": " + row.error);
    }
    if (told > most_failures_told) complain("… and " + std::to_string(told - most_failures_told) + " more meshes without a report");
}

}   // namespace

ExitCode run_batch(const BatchFlags& flags) {
    const ReportSettings settings = report_settings(flags.report, true);
    if (!flags.jobs.empty()) integer_between("--jobs", flags.jobs, 1, limits::largest_threads);
    std::vector<BatchMesh> meshes = batch_meshes(flags.meshes, flags.lists, settings.out);
    if (flags.plan) {
        for (const BatchMesh& mesh : meshes) print(mesh.name + "\t" + mesh.file + "\n");
        return ExitCode::ok;
    }
    const report::Templates templates(settings.templates);
    report::use_words_of(templates);                          // the provenance of finished reports names them
    static_cast<void>(Paper(settings, templates, nullptr));   // throws unless an engine that is required is there
    const BatchFolder folder(settings.out);
    for (const BatchMesh& mesh : meshes)
        output::sweep_leftovers(folder.path() / mesh.name);   // what is finished is not made again, and sweeps nothing
    const auto began = std::chrono::steady_clock::now();
    BatchIndex index(folder.path(), {rows_found(meshes, settings), settings.timings}, templates);
    index.write();
    Batch batch(flags, settings, std::move(meshes), index);
    batch.run();
    index.write();
    tell_of_failures(index.batch());
    const std::size_t good = report::count_of(index.batch(), BatchRow::State::good), all = index.batch().rows.size();
    conclude(std::to_string(good) + " of " + counted(static_cast<int>(all), "mesh", "meshes") + " without a failure, " +
                 words_of(report::score_of(index.batch())) + ", " +
                 time_text(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()),
             good == all);
    print_path(folder.path() / "index.html");
    if (batch.has_output_error()) return ExitCode::output;
    return good == all ? ExitCode::ok : ExitCode::failed;
}

}   // namespace meshfolio::run
