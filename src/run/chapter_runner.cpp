#include "run/chapter_runner.h"

#include <tbb/task_arena.h>

#include <new>
#include <stdexcept>

#include "base/linux_only.h"
#include "output/publish/folder_system.h"
#include "questions/core/section_tools.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace {

/// Thrown through a chapter that --fail-fast stops.
struct Stopped {};

/// Requires names that begin with the id of the chapter: names become files, and no two chapters may write one file.
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
    Answer answer{section_of(id)};
    answer.section.status = report::Status::failed;
    answer.section.failure = printable(message);
    return answer;
}

/// Places output meshes in meshes/, unless the settings name another folder for the chapter.
void place_meshes(Answer& answer, const ReportSettings& settings) {
    const QuestionTable& table = table_of(settings, answer.section.id);
    if (!table.output) return;
    for (std::string& path : answer.section.output_meshes)
        if (path.starts_with("meshes/")) path = *table.output + path.substr(6);
}

}   // namespace

report::Section skipped_section(std::string_view id, const std::string& why) {
    report::Section section = section_of(id);
    section.status = report::Status::skipped;
    section.code.clear();
    section.extent = why;
    return section;
}

Answer ChapterRunner::answer(const Chapter& chapter, ProgressDisplay& display) {
    const Effort effort = effort_of(settings_, std::string(chapter.id));
    Answer answer = attempted(chapter, meshes_.offering(chapter.roles).limited_to(effort.most_vertices), display);
    if (effort.small && !settings_.quick) say_small_settings(answer.section);
    return_free_memory();   // the next chapter needs blocks of other sizes
    return answer;
}

Answer ChapterRunner::attempted(const Chapter& chapter, const MeshLibrary& meshes, ProgressDisplay& display) try {
    const auto progress = [&](std::string_view step) {
        if (stop_) throw Stopped();
        display.step(std::string(chapter.id) + ": " + std::string(step));
    };
    progress("begins");
    if (contains(split(environment("MESHFOLIO_FAIL"), ','), std::string(chapter.id)))
        throw std::runtime_error("made to fail by MESHFOLIO_FAIL");
    Answer answer = answered_on_its_threads(chapter, meshes, progress);
    require_own_names(answer);
    place_meshes(answer, settings_);
    return answer;
} catch (const Stopped&) {
    return {skipped_section(chapter.id, "stopped, because another question had failed")};
} catch (const std::bad_alloc&) {
    stop_ = stop_ || settings_.fail_fast;
    return failed(chapter.id, "out of memory");
} catch (const std::exception& error) {
    stop_ = stop_ || settings_.fail_fast;
    return failed(chapter.id, error.what());
}

Answer ChapterRunner::answered_on_its_threads(const Chapter& chapter, const MeshLibrary& meshes, const Progress& progress) const {
    const std::string id(chapter.id);
    const auto work = [&] { return chapter.answer(meshes, question_settings(settings_, id), progress); };
    if (const int threads = table_of(settings_, id).threads.value_or(0); threads > 0) return tbb::task_arena(threads).execute(work);
    // Isolated: a thread that waits for its own work must not begin another chapter, which would count as time of this one.
    Answer answer;
    tbb::this_task_arena::isolate([&] { answer = work(); });
    return answer;
}

}   // namespace meshfolio::run
