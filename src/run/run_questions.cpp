#include "run/run_questions.h"

#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>

#include "base/linux_only.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "output/publish/folder_system.h"
#include "questions/core/section_tools.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

/// Thrown through a question that --fail-fast stops.
struct Stopped {};

/// Requires names that begin with the id of the question: names become files, and no two questions may write the same one.
void require_own_names(const Answer& answer) {
    const std::string prefix = answer.section.id + "_";
    const auto require = [&](const std::string& name) {
        if (!name.starts_with(prefix) || !output::is_safe_name(name))
            throw std::logic_error("'" + name + "' is no file name of " + answer.section.id);
    };
    for (const output::FigureRequest& figure : answer.figures) {
        require(figure.id);
        for (const output::Panel& panel : figure.panels) require(panel.name);
    }
    for (const output::MeshOutput& mesh : answer.meshes) require(mesh.name);
}

Answer failed(std::string_view id, const std::string& message) {
    Answer answer;
    answer.section = section_of(id);
    answer.section.status = report::Status::failed;
    answer.section.failure = printable(message);
    return answer;
}

Answer skipped(std::string_view id, const std::string& why) {
    Answer answer;
    answer.section = section_of(id);
    answer.section.status = report::Status::skipped;
    answer.section.code.clear();
    answer.section.extent = why;
    return answer;
}

class Runner {
public:
    Runner(const MeshLibrary& meshes, const ReportSettings& settings, const QuestionCache* cache,
           const std::map<std::string, StoredAnswer>& kept, ProgressDisplay& display)
        : meshes_(meshes), settings_(settings), cache_(cache), kept_(kept), display_(display) {
        for (const auto& [id, effort] : settings.efforts) all_ += effort.cpu_seconds;
    }

    QuestionResult result(const Chapter& question) {
        if (!is_asked_for(settings_, question.id)) return not_asked(question);
        if (effort_of(settings_, std::string(question.id)).left_out) return {skipped(question.id, left_out_to_fit()), {}, {}};
        const auto began = std::chrono::steady_clock::now();
        QuestionResult result;
        if (cache_ != nullptr) result.stored = cache_->find(std::string(question.id));
        if (result.stored) {
            result.answer.section = result.stored->section;
        } else {
            LookupRecord record;
            const Effort effort = effort_of(settings_, std::string(question.id));
            result.answer = attempted(question, meshes_.recorded_in(record).limited_to(effort.most_vertices));
            if (effort.small && !settings_.quick) say_small_settings(result.answer.section);
            result.lookups = record.lookups();
            return_free_memory();   // blocks of other sizes are wanted next
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        result.answer.section.timings.push_back({result.stored ? "taken from the cache" : "whole question", took.count()});
        announce(result, took.count());
        return result;
    }

private:
    const MeshLibrary& meshes_;
    const ReportSettings& settings_;
    const QuestionCache* cache_;
    const std::map<std::string, StoredAnswer>& kept_;
    ProgressDisplay& display_;
    std::atomic<bool> stop_ = false;
    std::atomic<double> done_ = 0;   // of what is planned [CPU s]
    double all_ = 0;

    QuestionResult not_asked(const Chapter& question) const {
        const auto kept = kept_.find(std::string(question.id));
        if (kept == kept_.end()) return {skipped(question.id, "not asked for"), {}, {}};
        QuestionResult result{{}, kept->second, {}};
        result.answer.section = kept->second.section;
        return result;
    }

    Answer attempted(const Chapter& question, const MeshLibrary& meshes) try {
        const auto progress = [&](std::string_view step) {
            if (stop_) throw Stopped();
            display_.step(std::string(question.id) + ": " + std::string(step));
        };
        progress("begins");
        if (contains(split(environment("MESHFOLIO_FAIL"), ','), std::string(question.id)))
            throw std::runtime_error("made to fail by MESHFOLIO_FAIL");
        Answer answer = on_its_threads(
            question, [&] { return question.answer(meshes, question_settings(settings_, std::string(question.id)), progress); });
        require_own_names(answer);
        place_meshes(answer);
        return answer;
    } catch (const Stopped&) {
        return skipped(question.id, "stopped, because another question had failed");
    } catch (const std::bad_alloc&) {
        stop_ = stop_ || settings_.fail_fast;
        return failed(question.id, "out of memory");
    } catch (const std::exception& error) {
        stop_ = stop_ || settings_.fail_fast;
        return failed(question.id, error.what());
    }

    template <class Work>
    Answer on_its_threads(const Chapter& question, Work work) {
        const auto table = settings_.questions.find(std::string(question.id));
        const int threads = table != settings_.questions.end() ? table->second.threads.value_or(0) : 0;
        if (threads > 0) return tbb::task_arena(threads).execute(work);
        // Isolated: while it waits for work of its own, a thread does not begin another question, whose time would count as its own.
        Answer answer;
        tbb::this_task_arena::isolate([&] { answer = work(); });
        return answer;
    }

    /// meshes/<name>, unless the settings name another folder for this question.
    void place_meshes(Answer& answer) {
        const auto table = settings_.questions.find(answer.section.id);
        if (table == settings_.questions.end() || !table->second.output) return;
        for (std::string& path : answer.section.output_meshes)
            if (path.starts_with("meshes/")) path = *table->second.output + path.substr(6);
    }

    void announce(const QuestionResult& result, double seconds) {
        const report::Section& section = result.section();
        const bool ok = section.status == report::Status::ok;
        done_ += effort_of(settings_, section.id).cpu_seconds;
        display_.advance(0.7 * done_ / std::max(all_, 1e-9));
        display_.milestone(section.id +
                           (result.stored                              ? ": from the cache"
                            : ok                                       ? ": answered in " + plain_text(seconds, 2) + " s"
                            : section.status == report::Status::failed ? ": failed"
                                                                       : ": stopped") +
                           (settings_.time ? display_.left() : ""));
    }
};

}   // namespace

std::vector<QuestionResult> run_questions(const MeshLibrary& meshes, const ReportSettings& settings, const QuestionCache* cache,
                                          const std::map<std::string, StoredAnswer>& kept, ProgressDisplay& display) {
    ReportSettings with_kept = settings;
    for (const auto& [id, answer] : kept) with_kept.only.push_back(id);
    const std::vector<const Chapter*> chapters = chapters_of(with_kept);
    std::vector<QuestionResult> results(chapters.size());
    Runner runner(meshes, settings, cache, kept, display);
    // Handed out one by one and from the last: the later questions take longest.
    std::atomic<std::size_t> left = chapters.size();
    for_each_task(chapters.size(), [&](std::size_t) {
        const std::size_t i = --left;
        results[i] = runner.result(*chapters[i]);
    });
    return results;
}

}   // namespace meshfolio::run
